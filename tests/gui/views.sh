#!/bin/bash
# Which views the window shows, by real input events: each alone and back, four at once, a full screen. Checks their places, that
# the walk is drawn as large as its pane, and who gets the keys.
#   views.sh EDITOR ACENTRIC WORK_FOLDER
. "$(dirname "$0")/script.sh" "$@"

make_room
"$ACENTRIC" bake "$PROJECT" >"$WORK/bake.out" 2>&1 || fail "the room is not baked: $(cat "$WORK/bake.out")"
open_project

# size NAME: "width height" of a widget, pixels
size() { rect "$1" | awk '{ printf "%d %d\n", $5 - $3, $6 - $4 }'; }
# frame_fits: the walk's newest frame at rest is as large as its pane
frame_fits() {
  local frame
  frame=$(grep '^event frame' "$WORK/ui.log" | tail -1 | awk '{ sub("x", " ", $3); print $3 }')
  [ "$frame" = "$(size walk)" ]
}
fits() { wait_until 20 frame_fits || fail "$1: the newest frame is $(grep '^event frame' "$WORK/ui.log" | tail -1), its pane $(size walk)"; }
shown() { wait_until 10 rect "$1" >/dev/null || fail "$2: $1 is not shown"; }
hidden() { wait_until 10 is_gone "$1" || fail "$2: $1 is still shown"; }
wide() { [ "$(size "$1" | cut -d' ' -f1)" -ge "$2" ]; }
is_wide() { wait_until 10 wide "$1" "$2" || fail "$3: $1 is $(size "$1"), not $2 wide"; }

# One view alone, by its key, by another's, and by the button on its strip.
fits "beside the plan"
press F7
hidden plan "the walk alone"
is_wide walk 1600 "the walk alone"
fits "the walk alone"
press F2
hidden walk "the plan alone"
is_wide plan 1600 "the plan alone"
press F2
shown walk "back"
shown bake.start "back"
click enlarge.view.plan
hidden walk "the plan alone, by its button"
click enlarge.view.plan
shown walk "back, by its button"

# Four views; Esc goes to the one that the pointer is over.
press F8
for view in plan walk scene3d; do shown "$view" "four views"; done
shown view.accuracy "four views"
hidden bake.start "four views"
fits "four views"
click cell.0.0.0
wait_for '^event selection 1' 10
place scene3d | { read -r x y; xdotool mousemove --window "$WINDOW" "$x" "$y"; }
sleep 0.5
N=$(grep -c '^event selection' "$WORK/ui.log")
press Escape
wait_for '^event selection 0' 10
[ "$(grep -c '^event selection' "$WORK/ui.log")" -eq $((N + 1)) ] || fail "Esc was taken more than once"

# The walk on the whole screen, and back to four.
press F11
hidden plan "full screen"
hidden menu.File "full screen"
wait_until 10 test "$(size walk)" = "1600 900" || fail "the full screen is $(size walk)"
fits "full screen"
press Escape
shown plan "after the full screen"
shown menu.File "after the full screen"
press F8
shown bake.start "back to panels"
leave_editor
remembered() { grep -o '"fourViews": *[a-z]*' "$WORK/config/acentric/editor.json"; }
remembered | grep -q false || fail "the window's layout is not remembered: $(remembered)"

# Drawn by the graphics card, once it has drawn a frame as the processor did.
sed -i 's/"graphics": *"automatic"/"graphics": "card"/' "$WORK/config/acentric/editor.json"
start_editor "$PROJECT"
wait_for '^event graphics card' 60
wait_for '^event glframe' 60
grep -q 'draws this walk differently' "$WORK/ui.log" && fail "the trial says that the frames differ"
leave_editor
echo "passed"
