#!/bin/bash
# Accuracy against time by real input events: a small sweep is shown, a mark is pointed at and clicked, its setting and
# a preset become edits; measuring is begun in the editor and stopped. Checks the log and the files.
#   accuracy.sh EDITOR ACENTRIC WORK_FOLDER
. "$(dirname "$0")/script.sh" "$@"

make_room
"$ACENTRIC" sweep "$PROJECT" --knobs reconstruction=point/splat --no-search --size 160x90 --frames 2 --repeats 2 \
  --truth-samples 1 --crossings 1 >"$WORK/sweep.out" 2>&1 || { cat "$WORK/sweep.out"; exit 1; }

open_project
press F6
wait_for '^event sweep running 0 points 3' 30
wait_for '^rect accuracy.mark1 ' 30

# Pointing at a mark shows its frame; a click keeps it, and it is had by a button.
click accuracy.mark1
wait_for '^rect accuracy.picture ' 10
click accuracy.difference
click accuracy.apply
wait_state 'working 0 dirty 1 undo 1' 30
click preset.accurate
sleep 1
import -window root "$WORK/screenshot.png"
press_with ctrl z
for _ in 1 2 3; do press_with ctrl z; done
wait_state 'working 0 dirty 0 undo 0' 30

# Measured in the editor, as a process of its own that ends when it is told to.
click sweep.again
wait_for '^event sweep running 1' 30
wait_for '^rect sweep.stop ' 10
pgrep -P "$EDITOR_PID" -f 'acentric sweep' >/dev/null || fail "no process measures"
click sweep.stop
for _ in $(seq 300); do grep '^event sweep' "$WORK/ui.log" | tail -1 | grep -q 'running 0' && break; sleep 0.1; done
grep '^event sweep' "$WORK/ui.log" | tail -1 | grep -q 'running 0' || fail "measuring did not stop"
pgrep -P "$EDITOR_PID" -f 'acentric sweep' >/dev/null && fail "the process still runs"

leave_editor
grep -q '^event failure' "$WORK/ui.log" && fail "a failure was shown: $(grep '^event failure' "$WORK/ui.log")"
echo "passed: $(grep -c '^event sweep' "$WORK/ui.log") states of a sweep, screenshot $WORK/screenshot.png"
