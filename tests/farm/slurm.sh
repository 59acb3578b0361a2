#!/usr/bin/env bash
# A bake on a Slurm cluster of two nodes, both on this machine's loopback interface. One task's program and one
# whole node are killed; what comes of it must be the very store that a local bake makes.
# usage: slurm.sh ACENTRIC MAKE_INSTANCES FOLDER
set -euo pipefail

acentric=$1 generator=$2 work=$3
here=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd)
source "$here/cluster.sh"

fail() { echo "FAILED: $*" >&2; showLogs >&2; exit 1; }
note() { printf '%5.1f s  %s\n' "$(sinceBegin)" "$*"; }
sinceBegin() { awk -v a="$began" -v b="$EPOCHREALTIME" 'BEGIN { print b - a }'; }
began=$EPOCHREALTIME

skipUnlessPossible
trap stopCluster EXIT

# --- A project of an instanced scene in a folder whose name needs quoting, and what a local bake makes of it
rm -rf -- "$work"
shared="$work/it's a farm"
mkdir -p -- "$shared"
export XDG_CACHE_HOME=$work/cache
project=$shared/balls.acentric.json
captures=$shared/balls.captures
"$generator" "$shared/balls.glb" --instances 150 --triangles 20000 --spacing 4 --clear 3 > /dev/null
"$acentric" new "$shared/balls.glb" -o "$project" --cell 2 --samples-per-degree 1.5 --outline "-3,-2;3,-2;3,2;-3,2" > /dev/null
sed -i 's/"surfaceTexel": [0-9.]*/"surfaceTexel": 0.15/; s/"ambientRays": [0-9]*/"ambientRays": 16/' "$project"
"$acentric" bake "$project" > "$work/local.txt" || fail "the local bake failed"
mv -- "$captures" "$work/expected"
note "local: $(cat "$work/local.txt")"

# --- Without Slurm's programs there is a clear message; scripts can be written all the same
mkdir "$work/no-slurm"
ln -s "$(command -v bash)" "$work/no-slurm/bash"
if PATH=$work/no-slurm "$acentric" farm slurm "$project" --submit 2> "$work/refusal.txt"; then
  fail "submitted without sbatch"
fi
grep -q 'sbatch: is not on PATH' "$work/refusal.txt" || fail "unclear: $(cat "$work/refusal.txt")"

startCluster
note "cluster is up"

# --- The bake is submitted
"$acentric" farm slurm "$project" --nodes 2 --threads 1 --task-seconds 2 --submit --json > "$work/farm.json"
read -r array merge < <(sed -n 's/.*"array": "\([0-9]*\)".*/\1/p; s/.*"merge": "\([0-9]*\)".*/\1/p' "$work/farm.json" | xargs)
[[ -n $array && -n $merge ]] || fail "no jobs: $(cat "$work/farm.json")"
tasks=$(sed -n 's/.*"cameraTasks": \([0-9]*\).*/\1/p' "$work/farm.json")
((tasks >= 4)) || fail "only $tasks tasks: too few to lose some"
note "submitted $tasks tasks and the light as job $array, and $merge after them"

# Tasks are to find the scene beside the scripts, not in a cache of their nodes.
scene=$(find "$shared/balls.farm/scenes" -name '*.acscene')
[[ -f $scene ]] || fail "the scene is not beside the scripts"
rm -rf -- "$XDG_CACHE_HOME"

# --- Both nodes bake; then one program and the other node are killed
# Both programs are held while this is done, so that neither ends meanwhile however busy the machine is.
waitFor "both nodes to bake" holdOneOfEachNode
lostTask=$(variableOf "$orphan" SLURM_ARRAY_TASK_ID)
for process in "$killed" "$orphan"; do
  hasMapped "$process" "$scene" || fail "program $process does not map the shared scene: $(cat "/proc/$process/maps")"
done
kill -9 "$killed"
killNode two "$orphan"
note "killed the program of one task, and the node of task $lostTask"
kill -CONT "$orphan" 2> /dev/null || fail "the lost node's program went with it; it was to go on"

# --- Everything comes right in the end
waitFor "the jobs to end" jobsEnded
note "the jobs have ended"
for ((task = 0; task <= tasks; ++task)); do
  [[ $(stateOf "${array}_$task") == COMPLETED ]] || fail "task $task: $(stateOf "${array}_$task")"
done
[[ $(stateOf "$merge") == COMPLETED ]] || fail "the merging job: $(stateOf "$merge")"
[[ $(fieldOf "${array}_$lostTask" Restarts) -ge 1 ]] || fail "task $lostTask was not started again"
grep -q 'was ended by signal 9' "$shared"/balls.farm/bake-*.log || fail "the killed program is not in the logs"
grep -q '^baked 0 cameras' "$shared/balls.farm/merge.log" || fail "$(cat "$shared/balls.farm/merge.log")"

[[ -z $(find "$XDG_CACHE_HOME" -name '*.acscene' 2> /dev/null) ]] || fail "a task imported the scene again"

[[ $(ls -A "$captures") == "$(ls -A "$work/expected")" ]] || fail "the store has other files than a local bake's:
$(diff <(ls -A "$work/expected") <(ls -A "$captures"))"
diff -r "$work/expected" "$captures" || fail "the store differs from a local bake's"
note "the store is a local bake's, byte for byte: $(ls "$captures" | wc -l) files"

# --- Nothing is left to submit
"$acentric" farm slurm "$project" --submit | grep 'nothing to submit' > /dev/null || fail "a finished bake was submitted"

# --- The step after a bake bakes again what is damaged, and names it
read -r size pack < <(find "$captures" -name '*.pack' -printf '%s %p\n' | sort -rn)
touch -r "$pack" "$work/written"
printf 'XXXX' | dd of="$pack" bs=1 seek=$((size / 2)) conv=notrunc status=none
touch -r "$work/written" "$pack" # so that reading it to its end alone can tell
bash "$shared/balls.farm/submit.sh" > "$work/again.txt"
read -r array merge < "$work/again.txt"
waitFor "the second submission" jobsEnded
[[ $(stateOf "$merge") == COMPLETED ]] || fail "the second merging job: $(stateOf "$merge")"
grep -q "^written again: .*$(basename "$pack")" "$shared/balls.farm/merge.log" ||
  fail "the damaged capture is not named: $(cat "$shared/balls.farm/merge.log")"
diff -r "$work/expected" "$captures" || fail "the mended store differs from a local bake's"
note "passed"
