#!/bin/bash
# A model whose scale cannot be right, by real input events: the editor asks, one click scales it with all that was laid out on
# it, undo takes that back, and what was saved is what the command line reads.
#   scale.sh EDITOR ACENTRIC WORK_FOLDER
. "$(dirname "$0")/script.sh" "$@"

# Four towers of ten storeys, 20 units each, and a stair with steps of 1.2 units.
awk 'function box(x, y, z, X, Y, Z,  k, n) {
       for (k = 0; k < 8; ++k) printf "v %g %g %g\n", k % 2 ? X : x, int(k / 4) ? Z : z, -(int(k / 2) % 2 ? Y : y)
       n = 8 * boxes++
       split("1 3 4 2 5 6 8 7 1 2 6 5 4 3 7 8 3 1 5 7 2 4 8 6", c, " ")
       for (k = 1; k < 25; k += 4) printf "f %d %d %d %d\n", n + c[k], n + c[k + 1], n + c[k + 2], n + c[k + 3]
     }
     BEGIN {
       box(0, 0, -4, 400, 400, 0)
       for (t = 0; t < 4; ++t)
         for (s = 1; s <= 10; ++s) {
           x = 40 + 180 * (t % 2); y = 40 + 180 * int(t / 2)
           box(x, y, 20 * s - 1, x + 140, y + 140, 20 * s)
         }
       for (s = 0; s < 12; ++s) box(10 + 2 * s, 10, 1.2 * s, 38, 30, 1.2 * (s + 1))
     }' >"$WORK/city.obj"
PROJECT=$WORK/city.acentric.json
"$ACENTRIC" new "$WORK/city.obj" -o "$PROJECT" --samples-per-degree 1 --cell 40 >"$WORK/new.out" 2>&1 || { cat "$WORK/new.out"; exit 1; }
grep -q 'scale in doubt: .*its steps are 1.2 m high and its storeys are 20 m high.*--metres-per-unit 0.15' "$WORK/new.out" ||
  fail "the command line does not ask: $(cat "$WORK/new.out")"
scale() { "$ACENTRIC" model "$PROJECT" 2>&1; }
scale | grep -q '1 metres per unit (guessed)' || fail "before: $(scale)"

open_project
click tab.problems
wait_for '^rect problem\.0\.fix' 60
import -window root "$WORK/before.png"
click problem.0.fix
wait_state 'working 0 dirty 1 undo 1' 60
wait_state 'working 0 dirty 1 undo 1 problems [0-2] ' 60  # that nothing is baked yet, and notes
import -window root "$WORK/after.png"
press_with ctrl s
wait_state 'working 0 dirty 0 undo 1' 30
scale | grep -q '0.15 metres per unit, ' || fail "saved: $(scale)"
press_with ctrl z
wait_state 'working 0 dirty 1 undo 0' 60
press_with ctrl s
wait_state 'working 0 dirty 0 undo 0' 30
scale | grep -q '1 metres per unit (guessed)' || fail "taken back: $(scale)"
leave_editor
echo "the scale was asked about, changed and taken back"

# The model itself is asked about however it is opened, and once.
start_editor "$WORK/city.obj"
wait_for '^rect new\.scale ' 60
press Return
wait_until 20 is_gone new.scale || fail "Create doesn't close the dialog"
wait_state 'working 0' 60
sleep 1
rect new.scale >/dev/null && fail "asked about twice"
press_with ctrl n
wait_for '^rect file\.name ' 20
xdotool type --delay 1 "$WORK/city.ob"
press Return
wait_until 60 rect new.scale || fail "New project doesn't ask, or a path that is typed isn't completed"
click new.scale
wait_until 60 is_gone new.scale || fail "the scale is still in doubt"
wait_until 60 rect dialog.create || fail "New project isn't shown again"
press Return
wait_until 20 is_gone dialog.create || fail "Create doesn't close the dialog"
wait_state 'working 0' 60
leave_editor
echo "a new project was asked about its scale"
