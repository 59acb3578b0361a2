#!/bin/bash
# The walk asked about a pixel, by real input events: the answer, what would improve it, and a click that applies it.
#   ask.sh EDITOR ACENTRIC WORK_FOLDER
. "$(dirname "$0")/script.sh" "$@"

make_room
"$ACENTRIC" bake "$PROJECT" >"$WORK/bake.out" 2>&1 || fail "the room is not baked: $(cat "$WORK/bake.out")"
open_project
wait_for '^event frame' 60
rest
shown() { wait_until "$2" rect "$1" >/dev/null || fail "$1 is not shown"; }

# By its tool, then by Alt and a click; Esc puts the answer away.
press j
click walk
shown answer 20
shown answer.close 60
press Escape
wait_until 10 is_gone answer || fail "Esc leaves the answer"
press j
at=$(place walk)
# shellcheck disable=SC2086
set -- $at
xdotool mousemove --window "$WINDOW" "$(($1 + 60))" "$(($2 - 40))"; sleep 0.3
xdotool keydown alt; sleep 0.2; xdotool mousedown 1; sleep 0.3; xdotool mouseup 1; sleep 0.2; xdotool keyup alt
shown answer.close 60

# By the menu of a right click, once the answer before is away.
press Escape
wait_until 10 is_gone answer || fail "Esc leaves the second answer"
# shellcheck disable=SC2086
set -- $at
xdotool mousemove --window "$WINDOW" "$(($1 + 60))" "$(($2 - 40))"; sleep 0.3
xdotool mousedown 3; sleep 0.3; xdotool mouseup 3
shown here.ask 10
sleep 0.5
click here.ask
shown answer.close 60

# What promises most is applied: the project is another one, which the answer is not of.
shown answer.apply.0 120
[ "$(field undo)" = 0 ] || fail "something was edited: $(state)"
click answer.apply.0
wait_state 'undo 1' 20
wait_until 20 is_gone answer || fail "the answer of the project before is still shown"
press_with ctrl z
wait_state 'undo 0' 20
press_with ctrl s
leave_editor
echo "passed"
