#!/bin/bash
# Where samples and bytes go, by real input events: cells made denser by keys and painted, from the plan and from the walk;
# goals that a search in the background looks for, and the setting that it proposes.
#   budgets.sh EDITOR ACENTRIC WORK_FOLDER
. "$(dirname "$0")/script.sh" "$@"

make_room --cell 1 --config e --outline "-1.4,-1.4;1.4,-1.4;1.4,1.4;-1.4,1.4"

# densities: "2.0 1.414": those in the project's file, sorted
densities() {
  python3 -c 'import json,sys
print(*sorted(round(d["times"], 3) for d in json.load(open(sys.argv[1]))["storeys"][0]["layout"].get("density", [])))' "$PROJECT"
}
saved() {
  local before
  before=$(grep -c '^event message Saved' "$WORK/ui.log")
  press_with ctrl s
  for _ in $(seq 100); do [ "$(grep -c '^event message Saved' "$WORK/ui.log")" -gt "$before" ] && return; sleep 0.1; done
  fail "the project was not saved"
}

open_project
NAMES=$(grep -oE '^rect cell\.[-0-9.]+ ' "$WORK/ui.log" | awk '{ print $2 }' | sort -u)
SHOWN=$(echo "$NAMES" | while read -r name; do echo "$(place "$name") $name"; done)
LEFT=$(echo "$SHOWN" | awk '{ print $1 }' | sort -n | sed -n 1p)
RIGHT=$(echo "$SHOWN" | awk '{ print $1 }' | sort -n | tail -1)
TOP=$(echo "$SHOWN" | awk '{ print $2 }' | sort -n | sed -n 1p)
ROW=$(echo "$SHOWN" | awk -v t="$TOP" '$2 < t + 5' | wc -l)

# Keys change the selected cell ...
click_at "$LEFT" "$TOP"
press bracketright; press bracketright
wait_state 'working 0 dirty 1 undo 2' 30
saved
[ "$(densities)" = 2.0 ] || fail "the selected cell has not twice the samples: $(densities)"
press_with ctrl z; press_with ctrl z
press Escape
# ... or the one that the eye stands in.
press bracketleft
wait_state 'working 0 dirty 1 undo 1' 30
saved
[ "$(densities)" = 0.707 ] || fail "the eye's cell has not half the samples: $(densities)"
press_with ctrl z

# Painted over a row of cells, one step; taken back with Ctrl in one of them.
press 8
click density.brush.2
drag_to "$LEFT" "$TOP" "$RIGHT" "$TOP"
wait_state 'working 0 dirty 1 undo 1' 30
sleep 1
import -window root "$WORK/density.png"
saved
[ "$(densities | wc -w)" = "$ROW" ] || fail "$ROW cells in a row, and painted are: $(densities)"
xdotool keydown ctrl; sleep 0.15; click_at "$LEFT" "$TOP"; xdotool keyup ctrl
wait_state 'working 0 dirty 1 undo 2' 30
saved
[ "$(densities | wc -w)" = $((ROW - 1)) ] || fail "a cell keeps its density: $(densities)"
press_with ctrl z; press_with ctrl z
press 1
saved

# Goals: half the bytes there are. Nothing is limited that is not ticked.
press F6
click accuracy.goals
wait_for '^rect goals.start ' 10
sleep 1
import -window root "$WORK/goals_empty.png"
click goals.frame.wanted
click goals.psnr.wanted
click goals.start
wait_for '^event goals running 1' 30
wait_for '^event goals running 1 points [1-9]' 120
click goals.stop
for _ in $(seq 600); do grep '^event goals' "$WORK/ui.log" | tail -1 | grep -q 'running 0' && break; sleep 0.1; done
grep '^event goals' "$WORK/ui.log" | tail -1 | grep -q 'running 0' || fail "the search did not stop"
wait_for '^rect goals.take ' 10
wait_for '^rect accuracy.mark0 ' 10
sleep 1
import -window root "$WORK/goals.png"
python3 -c 'import json,sys
sweep = json.load(open(sys.argv[1]))
assert list(sweep["goals"]) == ["mostBytes"], sweep["goals"]
assert "proposal" in sweep["presets"]' "$WORK/room.goals/sweep.json" || fail "the search wrote something else"
click goals.take
sleep 1

comes_to_rest || fail "an idle window goes on working"
leave_editor
grep -q '^event failure' "$WORK/ui.log" && fail "a failure was shown: $(grep '^event failure' "$WORK/ui.log")"
echo "passed: screenshots in $WORK"
