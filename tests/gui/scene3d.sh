#!/bin/bash
# The 3D view by real input events: opens it, orbits, comes nearer, selects a cell, asks a surface which cameras
# sample it, looks through cameras of the cell, and goes back to the plan. Checks the log.
#   scene3d.sh EDITOR ACENTRIC WORK_FOLDER
. "$(dirname "$0")/script.sh" "$@"

make_room

open_project

# frames: of the 3D view at rest, so far. at_rest N: there is another one after the N-th.
frames() { grep -c '^event scene3d frame' "$WORK/ui.log"; }
at_rest() {
  for _ in $(seq 300); do [ "$(frames)" -gt "$1" ] && return; sleep 0.1; done
  fail "no picture at rest after frame $1"
}
eye() { grep '^event scene3d frame' "$WORK/ui.log" | tail -1 | awk '{ print $8, $9, $10, $12 }'; }

click view.scene3d
wait_for '^event scene3d first' 30
at_rest 0
BEFORE=$(eye)

# A drag to the right turns the eye clockwise about the room; the wheel brings it nearer.
N=$(frames)
at=$(place scene3d)
# shellcheck disable=SC2086
set -- $at
drag_to "$1" "$2" $(($1 + 120)) "$2"
at_rest "$N"
AFTER=$(eye)
echo "$BEFORE $AFTER" | awk '{ d = $4 - $8; if (d < 0) d += 6.2831853; exit !(d > 0.5 && d < 1 && $3 - $7 < 0.01 && $7 - $3 < 0.01) }' ||
  fail "the drag did not orbit: $BEFORE, then $AFTER"
N=$(frames)
xdotool mousemove --window "$WINDOW" "$1" "$2"; sleep 0.3
xdotool click 4; sleep 0.3
at_rest "$N"
echo "$AFTER $(eye)" | awk '{ exit !($7 < $3 - 0.1) }' || fail "the wheel did not come nearer: $AFTER, then $(eye)"

# A cell with a ring (they have cameras of both hands) on the floor, by a click; then a surface, by Alt and a click.
CELL=$(grep -oE '^rect cell3d\.[-0-9]+\.[-0-9]+\.0 ' "$WORK/ui.log" | awk '{ print $2 }' | sort -u | while read -r name; do
  grep -E "^(rect|gone) $name( |$)" "$WORK/ui.log" | tail -1 | grep -q '^rect' && echo "$(place "$name") $name $at"
done | awk '{ d = ($1 - $4) ^ 2 + ($2 - $5) ^ 2; print d, $3 }' | sort -n | sed -n 1p | awk '{ print $2 }')
[ -n "$CELL" ] || fail "no cell is shown in 3D"
click "$CELL"
# F shows the cell, F again everything.
N=$(frames); press f; at_rest "$N"
NEAR=$(eye)
N=$(frames); press f; at_rest "$N"
echo "$NEAR $(eye)" | awk '{ exit !($7 > $3 + 0.5) }' || fail "F once more did not show everything: $NEAR, then $(eye)"
at=$(place "$CELL")
# shellcheck disable=SC2086
xdotool mousemove --window "$WINDOW" $at; sleep 0.3
xdotool keydown alt; sleep 0.2; xdotool mousedown 1; sleep 0.3; xdotool mouseup 1; sleep 0.2; xdotool keyup alt
wait_for '^rect pick.table ' 30
wait_for '^event scenepick ' 30
grep '^event scenepick' "$WORK/ui.log" | tail -1 | awk '{ exit !($5 * $5 < 1e-6 && $7 > 0) }' ||
  fail "the floor was not met, or nobody sees it: $(grep '^event scenepick' "$WORK/ui.log" | tail -1)"
press Escape
wait_until 10 is_gone pick.table || fail "Esc did not clear the pick"

# Look through a camera of the cell, then the next one, then one of the other hand.
click scene3d.lookThrough
wait_for '^event lookthrough camera' 30
click scene3d.nextCamera
click scene3d.otherHand
for _ in $(seq 100); do [ "$(grep -c '^event lookthrough' "$WORK/ui.log")" -ge 3 ] && break; sleep 0.1; done
CAMERAS=$(grep '^event lookthrough' "$WORK/ui.log" | awk '{ print $4 }' | sort -u | wc -l)
[ "$CAMERAS" -ge 3 ] || fail "three cameras were looked through, $CAMERAS were shown"
import -window root "$WORK/screenshot.png"
press Escape
wait_until 10 is_gone look || fail "Esc did not close the camera"

# At rest nothing is traced or drawn.
comes_to_rest || fail "an idle 3D view goes on working"

press F2
wait_until 10 rect plan >/dev/null || fail "F2 does not show the plan"
leave_editor
grep -q '^event failure' "$WORK/ui.log" && fail "a failure was shown: $(grep '^event failure' "$WORK/ui.log")"
echo "passed: $(grep '^event scene3d first' "$WORK/ui.log"); $(grep '^event lookthrough' "$WORK/ui.log" | sed -n 1p)"
