#!/bin/bash
# The whole story by real input events, as a layout designer lives it: the first start with its guide, a project opened by
# the dialog, another configuration, a cell moved, a triangle budget that a region exceeds, cells fitted to it, a bake that is
# cancelled and goes on, a walk, the figures against the truth, saved; opened again all of it is as it was.
#   story.sh EDITOR ACENTRIC WORK_FOLDER
. "$(dirname "$0")/script.sh" "$@"

# The sample of the first start, and a hall, 6 x 5 x 3 m, whose floor has many triangles at its eastern end.
make_room
SAMPLE=$PROJECT
PROJECT=$WORK/hall.acentric.json
python3 - >"$WORK/hall.obj" <<'PY'
corners, faces = [], []
def wall(at, along, up, columns, rows):
    first = len(corners) + 1
    for i in range(columns + 1):
        for j in range(rows + 1):
            corners.append([at[k] + along[k] * i / columns + up[k] * j / rows for k in range(3)])
    for i in range(columns):
        for j in range(rows):
            a = first + i * (rows + 1) + j
            b = a + rows + 1
            faces.extend([(a, b + 1, a + 1), (a, b, b + 1)])
wall((-3, 0, -2.5), (0, 0, 5), (4, 0, 0), 5, 4)
wall((1, 0, -2.5), (0, 0, 5), (2, 0, 0), 50, 20)
wall((-3, 3, -2.5), (6, 0, 0), (0, 0, 5), 3, 3)
wall((-3, 0, -2.5), (6, 0, 0), (0, 3, 0), 3, 2)
wall((3, 0, 2.5), (-6, 0, 0), (0, 3, 0), 3, 2)
wall((-3, 0, 2.5), (0, 0, -5), (0, 3, 0), 3, 2)
wall((3, 0, -2.5), (0, 0, 5), (0, 3, 0), 3, 2)
for corner in corners: print("v %g %g %g" % tuple(corner))
for face in faces: print("f %d %d %d" % face)
PY
make_project "$WORK/hall.obj" 0,0 --config b --cell 1.6 --samples-per-degree 5 --outline "-2,-1.4;2,-1.4;2,1.4;-2,1.4"

# shown NAME SECONDS: the widget is shown and at rest
shown() {
  local last='' now
  for _ in $(seq $(($2 * 4))); do
    now=$(rect "$1")
    [ -n "$now" ] && [ "$now" = "$last" ] && return
    last=$now
    sleep 0.25
  done
  fail "waited $2 s for widget $1"
}
# move_a_cell: drags one to the free place that is nearest to it
move_a_cell() {
  local cell target
  cell=$(grep -oE '^rect cell\.-?[0-9]+\.-?[0-9]+\.0 ' "$WORK/ui.log" | awk '{ print $2 }' | sort -u | while read -r name; do
    rect "$name" >/dev/null && echo "$name"
  done | sed -n 1p)
  target=$(grep -oE '^rect free\.-?[0-9]+\.-?[0-9]+\.0 ' "$WORK/ui.log" | awk '{ print $2 }' | sort -u | while read -r name; do
    rect "$name" >/dev/null && echo "$(place "$name") $name $(place "$cell")"
  done | awk '{ d = ($1 - $4) ^ 2 + ($2 - $5) ^ 2; print d, $3 }' | sort -n | sed -n 1p | awk '{ print $2 }')
  [ -n "$cell" ] && [ -n "$target" ] || fail "no cell, or no free place, is shown"
  # shellcheck disable=SC2046
  drag_to $(place "$cell") $(place "$target")
  shown "cell.${target#free.}" 10
}

# The first start: no preferences; the sample opens with its guide, which is left.
start_display
"$EDITOR" --sample "$SAMPLE" --log-ui "$WORK/ui.log" --exit-after 890 >"$WORK/editor.out" 2>&1 &
EDITOR_PID=$!
wait_for '^event READY' 60
WINDOW=$(xdotool search --sync --name 'Acentric' | sed -n 1p)
wait_for '^event message Opened room.acentric.json' 60
wait_state 'working 0' 60
shown guide.skip 20
click guide.skip

# Open the hall by the dialog.
press_with ctrl o
shown file.name 20
xdotool type --delay 60 "$PROJECT"
sleep 0.5
press Return
wait_for '^event message Opened hall.acentric.json' 60
wait_state 'working 0 dirty 0 undo 0' 60
OF_B=$(field regions)

# Another configuration, by the picker.
click settings.configuration
shown configuration.d 10
click configuration.d
wait_state 'working 0 dirty 1 undo 1' 30
grep -q '^rect cell\.' "$WORK/ui.log" || fail "no cell is shown"
[ "$(field regions)" -ne "$OF_B" ] || fail "configuration d has as many regions as b: $OF_B"
OF_D=$(field regions)

move_a_cell
wait_state 'working 0 dirty 1 undo 2' 30

# A triangle budget: the region at the eastern end exceeds it.
click section.Triangle-budget
shown settings.budget.most 10
xdotool keydown ctrl; sleep 0.1
click settings.budget.most
xdotool keyup ctrl; sleep 0.2
xdotool type --delay 80 "1500"
sleep 0.3
press Return
wait_state 'working 0 dirty 1 undo 3 problems [0-9]+ over [1-9]' 30
press t
wait_for '^event action view.triangles' 10
import -window root "$WORK/over.png"

# Fit the cells to it.
click budget.fit
wait_for '^event message Cells of .* m keep every region to 1500 triangles' 60
wait_state 'working 0 dirty 1 undo 4 problems [0-9]+ over 0' 30
import -window root "$WORK/fitted.png"
# They were laid anew: the moved one is laid like the others, and another is moved.
move_a_cell
wait_state 'working 0 dirty 1 undo 5' 30
REGIONS=$(field regions)
CAPTURES=$(field captures)

# Bake, cancel when some of it is on disk, bake on: what was finished is not baked again.
press_with ctrl s
wait_for '^event message Saved hall.acentric.json' 20
press_with ctrl b
shown bake.cancel 30
wait_for '^event bakequeue finished [1-9]' 120
click bake.cancel
wait_for '^event message Baking was cancelled' 60
wait_state 'working 0' 60
KEPT=$(field baked)
[ "$KEPT" -gt 0 ] && [ "$KEPT" -lt "$CAPTURES" ] || fail "after cancelling $KEPT of $CAPTURES are baked"
press_with ctrl b
wait_for '^event message Baked [0-9]+ captures' 240
wait_state "captures $CAPTURES baked $CAPTURES working 0" 60
grep -q "^event message Baked $((CAPTURES - KEPT)) captures, $KEPT were there already" "$WORK/ui.log" ||
  fail "$KEPT of $CAPTURES were kept, but: $(grep '^event message Baked' "$WORK/ui.log")"

# Walk, and begin the walk there from now on; measure.
rest
START=$(eye)
press w 0.5
rest
[ "$(apart "$START" "$(eye)" | awk '{ print ($1 > 0.1) }')" = 1 ] || fail "W did not walk: $START, $(eye)"
press_with ctrl Home
wait_state 'working 0 dirty 1 undo 6' 20
press k
wait_for '^event compared .* against 4 rays per pixel' 60
rest
compared() { grep '^event compared' "$WORK/ui.log" | tail -1; }
FIGURES=$(compared)
echo "$FIGURES" | grep -Eq 'PSNR [2-9][0-9]\.[0-9] dB   SSIM 0\.[0-9]+   holes' || fail "no figures: $FIGURES"
import -window root "$WORK/measured.png"

# Save and quit; the file has it all.
press_with ctrl s
wait_state 'dirty 0' 20
WAS=$(state | sed -E 's/ undo [0-9]+ / /')
PROBLEMS=$(field problems)
EYE=$(eye)
grep -q '^event failure' "$WORK/ui.log" && fail "a failure was shown: $(grep '^event failure' "$WORK/ui.log")"
leave_editor
"$ACENTRIC" validate "$PROJECT" >/dev/null || fail "the saved project is not valid"
# shellcheck disable=SC2086
python3 - "$PROJECT" $EYE <<'PY' || fail "the project file lacks what was done: $(cat "$PROJECT")"
import json, sys
project = json.load(open(sys.argv[1]))
storey = project["storeys"][0]
layout, start = storey["layout"], storey["spawn"]["position"]
assert layout["configuration"] == "d" and layout["cellSize"] < 1.6, layout
assert layout["added"] and layout["removed"], "the moved cell"
assert project["budget"]["trianglesPerRegion"] == 1500
eye = [float(sys.argv[4]), float(sys.argv[5])]
assert max(abs(a - b) for a, b in zip(start, eye)) < 0.01, (start, eye)
PY

# Opened again everything is as it was, to the figures.
SAVED=$(cksum <"$PROJECT")
start_editor "$PROJECT"
wait_for '^event message Opened hall.acentric.json' 60
wait_state 'working 0 dirty 0 undo 0' 60
rect guide.skip >/dev/null && fail "the guide is shown again"
wait_state "problems $PROBLEMS " 30  # the layout is looked over once it has stood still
rest
[ "$(state | sed -E 's/ undo [0-9]+ / /')" = "$WAS" ] || fail "it was $WAS, it is $(state)"
[ "$(apart "$EYE" "$(eye)" | awk '{ print ($1 < 0.01) }')" = 1 ] || fail "the eye is elsewhere: $EYE, $(eye)"
press k
wait_for '^event compared .* against 4 rays per pixel' 60
rest
echo "$FIGURES $(compared)" | awk '{ for (i = 1; i < NF; ++i) if ($i == "PSNR") value[++n] = $(i + 1)
  d = value[1] - value[2]; exit !(n == 2 && d < 0.3 && d > -0.3) }' ||
  fail "the figures were $FIGURES, they are $(compared)"
import -window root "$WORK/reopened.png"
grep -q '^event failure' "$WORK/ui.log" && fail "a failure was shown: $(grep '^event failure' "$WORK/ui.log")"
leave_editor
[ "$SAVED" = "$(cksum <"$PROJECT")" ] || fail "looking changed the project's file"
echo "passed: $OF_B regions of b, $OF_D of d, $REGIONS fitted; $CAPTURES captures, $KEPT before the cancel; ${FIGURES#event compared }"
