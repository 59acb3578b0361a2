#!/bin/bash
# A variant that is kept, an edit that is baked, and both in one walk, by real input events. Checks their figures and the border.
#   variants.sh EDITOR ACENTRIC WORK_FOLDER
. "$(dirname "$0")/script.sh" "$@"

make_room
"$ACENTRIC" bake "$PROJECT" >"$WORK/bake.out" 2>&1 || fail "the room is not baked: $(cat "$WORK/bake.out")"
open_project
wait_for '^event frame' 60
rest

click menu.Walk
click menu.variant.keep
wait_for '^event message Kept' 10
press n
wait_for '^event variants kept' 60
decibels() { grep '^event variants' "$WORK/ui.log" | tail -1 | grep -o '[0-9.]* dB' | sed 's/ dB//' | tr '\n' ' '; }
# shellcheck disable=SC2046
set -- $(decibels)
[ "$1" = "$2" ] || fail "the project against itself: $1 and $2 dB"

# Three times as many samples per degree; what was kept stays as it was.
at=$(place settings.samplesPerDegree)
xdotool mousemove --window "$WINDOW" $at; sleep 0.3
xdotool keydown ctrl; sleep 0.2; xdotool mousedown 1; sleep 0.3; xdotool mouseup 1; sleep 0.2; xdotool keyup ctrl; sleep 0.3
xdotool type --delay 120 '3'
press Return
wait_state 'undo 1' 20
N=$(grep -c '^event variants' "$WORK/ui.log")
press_with ctrl b
wait_state 'baked 60' 120
wait_state 'working 0' 60
better() {
  # shellcheck disable=SC2046
  set -- $(decibels)
  awk -v kept="$1" -v now="$2" 'BEGIN { exit !(now > kept + 0.5) }'
}
wait_until 60 better || fail "finer captures are not nearer to the truth: $(decibels)"

# The border is dragged as that of the truth is.
rect walk.border >/dev/null || fail "no border"
at=$(place walk.border)
# shellcheck disable=SC2086
set -- $at
drag_to "$1" "$2" "$(($1 - 150))" "$2"
moved() { [ "$(place walk.border | cut -d' ' -f1)" -lt $(($1 - 100)) ]; }
wait_until 10 moved "$1" || fail "the border was not dragged: $(place walk.border)"
import -window root "$WORK/variants.png"
press n
press_with ctrl s
leave_editor
echo "passed"
