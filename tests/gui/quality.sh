#!/bin/bash
# Qualities of the bake by real input events: presets with what they cost, a size that is typed, settings that are folded
# away and opened where something asks for them, icons with their words in tooltips. Checks the log and the project's file.
#   quality.sh EDITOR ACENTRIC WORK_FOLDER
. "$(dirname "$0")/script.sh" "$@"

make_room

bake_value() { python3 -c 'import json,sys; print(json.load(open(sys.argv[1]))["bake"][sys.argv[2]])' "$PROJECT" "$1"; }
costs_known() { for row in draft balanced fine own; do rect "quality.$row.cost" >/dev/null || return 1; done; }

open_project
[ "$(field undo)" = 0 ] || fail "the project opens changed"

# Icons are large enough to be hit, in one line each.
for item in tool.cells tool.path view.backdrop overlay view.fit view.holes walk.settings walk.setStart; do
  rect $item | awk '{ exit !($5 - $3 >= 28 && $6 - $4 >= 28) }' || fail "$item is too small: $(rect $item)"
done
[ "$(rect tool.cells | awk '{ print $4 }')" = "$(rect view.fit | awk '{ print $4 }')" ] || fail "the plan's toolbar is not one line"
[ "$(rect view.holes | awk '{ print $4 }')" = "$(rect walk.setStart | awk '{ print $4 }')" ] || fail "the walk's toolbar is not one line"

# What each preset takes is predicted by itself; the room's own 1 sample per degree is none of them.
rect quality.own >/dev/null || fail "settings of one's own are not shown"
wait_until 120 costs_known || fail "the costs are not predicted"
import -window root "$WORK/costs.png"
click quality.fine
wait_state 'working 0 dirty 1 undo 1' 30
is_gone quality.own || fail "a preset is in force, and Own is shown"
press_with ctrl z
wait_state 'working 0 dirty 0 undo 0' 30

# A size: its resolution is looked for, and is one edit.
click quality.megabytes
xdotool type 1; press Return
for _ in $(seq 900); do rect quality.applySize >/dev/null && break; sleep 0.1; done
sleep 1
import -window root "$WORK/size.png"
click quality.applySize
wait_state 'working 0 dirty 1 undo 1' 30
press_with ctrl s
wait_for '^event message Saved room.acentric.json' 20
bake_value samplesPerDegree | awk '{ exit !($1 > 1.05 || $1 < 0.95) }' || fail "the resolution was not changed"

# Folded away, until the walk's settings ask for the eye range; a changed one is told of while it is hidden.
rect settings.eyeRange >/dev/null && fail "advanced settings are open at first"
xdotool keydown ctrl keydown shift; press p; xdotool keyup shift keyup ctrl
sleep 0.7
xdotool type 'advanced bake'; sleep 0.5; press Return
wait_for '^event action settings.advancedBake' 10
wait_for '^rect settings.eyeRange ' 10
sleep 1
import -window root "$WORK/advanced.png"

comes_to_rest || fail "an idle window goes on working"
grep -q '^event failure' "$WORK/ui.log" && fail "a failure was shown: $(grep '^event failure' "$WORK/ui.log")"
echo "passed: screenshots in $WORK"
