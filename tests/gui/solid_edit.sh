#!/bin/bash
# Editing in the 3D view and in the walk by real input events: a cell is placed on the floor by a click, a single APV too; its
# arrow is dragged, what was saved is read, and undone; Esc cancels a drag; the walk's menu tells what it cannot add.
#   solid_edit.sh EDITOR ACENTRIC WORK_FOLDER
. "$(dirname "$0")/script.sh" "$@"

make_room --cell 1 --config e --outline "-1.4,-1.4;1.4,-1.4;1.4,1.4;-1.4,1.4"

apv() { python3 -c 'import json,sys; l=json.load(open(sys.argv[1]))["storeys"][0]["layout"]; print(json.dumps(l.get("freeApvs", [])))' "$PROJECT"; }
# centre: of the only single APV that was saved, "x y"
centre() { apv | python3 -c 'import json,sys; a=json.load(sys.stdin); a=a[0] if isinstance(a,list) else list(a.values())[0]; c=a["centre"]; print(c[0], c[1])'; }
save() {
  local before
  before=$(grep -c '^event message Saved' "$WORK/ui.log")
  press_with ctrl s
  wait_until 20 saved_after "$before" || fail "the project was not saved"
}
saved_after() { [ "$(grep -c '^event message Saved' "$WORK/ui.log")" -gt "$1" ]; }
# still_place NAME: where it is once that keeps still for a second
still_place() { settled place "$1"; }

open_project
REGIONS=$(field regions)
click view.scene3d
wait_for '^event scene3d first' 30
wait_until 30 grep -q '^event scene3d frame' "$WORK/ui.log" || fail "no picture at rest"

# A cell: placed where the floor is free, by a click.
click scene3d.place
wait_for '^rect free3d\.' 10
FREE=$(grep -oE '^rect free3d\.[-0-9]+\.[-0-9]+\.[0-9]+ ' "$WORK/ui.log" | awk '{ print $2 }' | sort -u | while read -r name; do
  rect "$name" >/dev/null && echo "$(place "$name") $name"; done | sort -k2,2nr | sed -n 1p | awk '{ print $3 }')
[ -n "$FREE" ] || fail "no free place is shown"
click "$FREE"
wait_state "regions $((REGIONS + 1)) .*working 0 dirty 1 undo 1" 30
press_with ctrl z
wait_state "regions $REGIONS .*working 0 .*undo 0" 30
click scene3d.select

# A single APV on the floor beside a corner of the outline, then selected by a click.
click tool.panorama
CORNER=$(grep -oE '^rect corner3d\.0\.[0-9]+ ' "$WORK/ui.log" | awk '{ print $2 }' | sort -u | while read -r name; do
  rect "$name" >/dev/null && echo "$(place "$name") $name"; done | sort -k2,2nr | sed -n 1p)
# shellcheck disable=SC2086
set -- $CORNER
click_at $(($1 + 4)) $(($2 - 60))
wait_state 'working 0 dirty 1 undo 1' 30
click scene3d.select
save
FROM=$(centre)

# Its first arrow: the move is shown, one step when it is let go, and x alone changes.
# shellcheck disable=SC2046
set -- $(still_place gizmo.x) $(still_place apv3d.0)
[ $# -eq 4 ] || fail "the gizmo is not shown"
import -window root "$WORK/gizmo.png"
X0=$1 Y0=$2 X1=$(($1 + ($1 - $3))) Y1=$(($2 + ($2 - $4)))
drag_to "$X0" "$Y0" "$X1" "$Y1"
wait_state 'working 0 dirty 1 undo 2' 30
save
echo "$FROM $(centre)" | awk '{ d = $3 - $1; e = $4 - $2; exit !(d * d > 0.01 && e * e < 1e-12) }' || fail "the arrow moved from $FROM to $(centre)"
press_with ctrl z
wait_state 'working 0 .*undo 1' 30
save
[ "$(centre)" = "$FROM" ] || fail "undo left the APV at $(centre), not at $FROM"

# Esc in the middle of a drag.
# shellcheck disable=SC2046
set -- $(still_place gizmo.y)
xdotool mousemove --window "$WINDOW" "$1" "$2"; sleep 0.3; xdotool mousedown 1; sleep 0.3
xdotool mousemove --window "$WINDOW" $(($1 + 40)) $(($2 + 10)); sleep 0.3
import -window root "$WORK/dragged.png"
press Escape
xdotool mouseup 1; sleep 0.3
wait_state 'working 0 dirty 0 undo 1' 30

# A corner of the outline, the farthest: a click selects it, it has arrows, and fields for its exact place.
CORNER=$(grep -oE '^rect corner3d\.0\.[0-9]+ ' "$WORK/ui.log" | awk '{ print $2 }' | sort -u | while read -r name; do
  rect "$name" >/dev/null && echo "$(place "$name") $name"; done | sort -k2,2n | sed -n 1p | awk '{ print $3 }')
click "$CORNER"
wait_until 10 rect corner.x >/dev/null || fail "no corner is selected"
rect gizmo.x >/dev/null || fail "a corner has no arrows"
import -window root "$WORK/corner.png"
press Escape
wait_until 10 is_gone corner.x && is_gone gizmo.x || fail "Esc did not clear the selection"

# From the walk: the eye stands in a cell, which says so; the menu adds a single APV there, and selects the cell.
press Insert
wait_for '^event message Cell \(-?[0-9]+, -?[0-9]+\) covers this place already' 10
# shellcheck disable=SC2046
set -- $(place walk)
xdotool mousemove --window "$WINDOW" "$1" "$2"; sleep 0.3; xdotool mousedown 3; sleep 0.3; xdotool mouseup 3; sleep 0.5
wait_for '^rect here.walk.addApv ' 10
import -window root "$WORK/menu.png"
click here.walk.addApv
wait_state 'working 0 dirty 1 undo 2' 30
click walk.restart
xdotool keydown ctrl keydown shift; sleep 0.1; press a; xdotool keyup shift keyup ctrl; sleep 0.3
wait_for '^event action walk.selectCell' 10
import -window root "$WORK/screenshot.png"
press_with ctrl z
wait_state 'working 0 dirty 0 undo 1' 30

leave_editor
grep -q '^event failure' "$WORK/ui.log" && fail "a failure was shown: $(grep '^event failure' "$WORK/ui.log")"
echo "passed: $FROM, screenshots in $WORK"
