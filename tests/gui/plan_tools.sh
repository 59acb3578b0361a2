#!/bin/bash
# The plan's tools by real input events: a box that selects, cells dragged together and nudged, a copy, the lattice's handles,
# the picker of configurations, the table of regions, the overlays' menu, the ruler. Each step is checked in the log.
#   plan_tools.sh EDITOR ACENTRIC WORK_FOLDER
. "$(dirname "$0")/script.sh" "$@"

make_room --cell 1 --config e --outline "-1.4,-1.4;1.4,-1.4;1.4,1.4;-1.4,1.4"

selection() { grep '^event selection' "$WORK/ui.log" | tail -1 | awk '{ print $3 }'; }
# expect_selection NUMBER
expect_selection() {
  for _ in $(seq 50); do [ "$(selection)" = "$1" ] && return; sleep 0.1; done
  fail "$(selection) cells are selected, $1 expected"
}
# A list that opens is laid out in its first frame and put in place in the next.
click_settled() {
  local before="" now
  for _ in $(seq 20); do
    now=$(place "$1") || exit 1
    [ "$now" = "$before" ] && break
    before=$now; sleep 0.7
  done
  click "$1"
}
drag_with() {  # drag_with MODIFIER X0 Y0 X1 Y1
  xdotool keydown "$1"; sleep 0.15; drag_to "$2" "$3" "$4" "$5"; xdotool keyup "$1"; sleep 0.2
}
number_in_project() { python3 -c 'import json,sys; print(json.load(open(sys.argv[1]))["storeys"][0]["layout"][sys.argv[2]])' "$PROJECT" "$1"; }

open_project
REGIONS=$(field regions)
NAMES=$(grep -oE '^rect cell\.[-0-9.]+ ' "$WORK/ui.log" | awk '{ print $2 }' | sort -u)
SHOWN=$(echo "$NAMES" | while read -r name; do echo "$(place "$name") $name"; done)

# A box around the middles of the upper left cells: with Shift it adds, with Ctrl it toggles.
LEFT=$(echo "$SHOWN" | awk '{ print $1 }' | sort -n | sed -n 1p)
TOP=$(echo "$SHOWN" | awk '{ print $2 }' | sort -n | sed -n 1p)
EDGE=$(echo "$SHOWN" | awk -v l="$LEFT" '$1 > l + 5 { print $1 - l }' | sort -n | sed -n 1p)
drag_with shift $((LEFT - 4)) $((TOP - 4)) $((LEFT + EDGE + 4)) $((TOP + 4))
expect_selection 2
drag_with ctrl $((LEFT - 4)) $((TOP - 4)) $((LEFT + 4)) $((TOP + 4))
expect_selection 1
press Escape
expect_selection 0
drag_with shift $((LEFT - 4)) $((TOP - 4)) $((LEFT + EDGE + 4)) $((TOP + 4))
expect_selection 2

# Both are dragged upwards onto free places: one entry, as many regions.
drag_to "$LEFT" "$TOP" "$LEFT" $((TOP - EDGE))
wait_state "regions $REGIONS .*working 0 dirty 1 undo 1" 30
expect_selection 2
# A nudge to the right with Ctrl and an arrow.
press_with ctrl Right
wait_state "regions $REGIONS .*working 0 dirty 1 undo 2" 30
# A copy beside them.
press_with ctrl d
wait_state "regions $((REGIONS + 2)) .*working 0 dirty 1 undo 3" 30
expect_selection 2
for undo in 2 1 0; do press_with ctrl z; wait_state "working 0 dirty [01] undo $undo" 30; done
wait_state "regions $REGIONS .*dirty 0 undo 0" 30
press Escape

# Onto cells that are there: nothing moves.
press_with ctrl a
expect_selection "$REGIONS"
press_with ctrl i
expect_selection 0
click_at "$LEFT" "$TOP"
expect_selection 1
press_with ctrl Down
wait_for '^event message 1 place is taken' 10
state | grep -q 'undo 0' || fail "a blocked nudge is in the history"

# An array: three places to the left of the selected cell.
xdotool keydown ctrl keydown shift; sleep 0.1; press d; xdotool keyup shift keyup ctrl; sleep 0.3
click array.countI
click edit.placeArray
wait_for '^event action edit.placeArray' 10
press Escape
if [ "$(field undo)" != 0 ]; then press_with ctrl z; wait_state "regions $REGIONS .*dirty 0 undo 0" 30; fi

# Handles of the lattice: the middle, the circle, the corner; one entry each.
click tool.lattice
# shellcheck disable=SC2046
set -- $(place lattice.origin); drag_to "$1" "$2" $(($1 + 30)) $(($2 - 20))
wait_state "working 0 dirty 1 undo 1" 30
# shellcheck disable=SC2046
set -- $(place lattice.turn); drag_with shift "$1" "$2" $(($1 - 22)) $(($2 + 2))
wait_state "working 0 dirty 1 undo 2" 30
# shellcheck disable=SC2046
set -- $(place lattice.size); O=$(place lattice.origin); drag_to "$1" "$2" $(($1 + ($1 - ${O% *}) / 2)) $(($2 + ($2 - ${O#* }) / 2))
wait_state "working 0 dirty 1 undo 3" 30
press_with ctrl s
wait_for '^event message Saved room.acentric.json' 20
number_in_project rotationDegrees | awk '{ exit !($1 == 15 || $1 == 0) }' ||
  fail "Shift did not snap the rotation: $(number_in_project rotationDegrees)"
number_in_project cellSize | awk '{ exit !($1 > 1.3 && $1 < 1.7) }' || fail "the handle left cells of $(number_in_project cellSize) m"
for undo in 2 1 0; do press_with ctrl z; wait_state "working 0 dirty [01] undo $undo" 30; done

# The ruler: Esc takes it away, and again ends it.
click tool.measure
drag_to "$LEFT" "$TOP" $((LEFT + EDGE)) $((TOP + EDGE))
press Escape
press Escape
click tool.cells

# The picker: pointing shows, a click lays; one entry.
click settings.configuration
click_settled configuration.b
wait_state "working 0 dirty 1 undo 1" 30
press_with ctrl z
wait_state "regions $REGIONS .*working 0 .*undo 0" 30

# The table: a click on a row selects that cell, a click on a column sorts by it.
click view.table
wait_for '^rect table.column3 ' 10
wait_state 'working 0' 30
ROW=$(grep -oE '^rect table\.-?[0-9]+\.-?[0-9]+\.[0-9]+ ' "$WORK/ui.log" | awk '{ print $2 }' | sed -n 3p)
click_settled "$ROW"
expect_selection 1
SORTED=$(grep -c '^event table' "$WORK/ui.log")
click table.column1
for _ in $(seq 50); do [ "$(grep -c '^event table' "$WORK/ui.log")" -gt "$SORTED" ] && break; sleep 0.1; done
[ "$(grep -c '^event table' "$WORK/ui.log")" -gt "$SORTED" ] || fail "a click on a column did not sort"

# One overlay at a time, from the menu.
click overlay
click_settled overlay.bytes
wait_for '^event action overlay.bytes' 10
press t
wait_for '^event action view.triangles' 10
import -window root "$WORK/screenshot.png"
grep -q '^event failure' "$WORK/ui.log" && fail "a failure was shown: $(grep '^event failure' "$WORK/ui.log")"
echo "passed: $REGIONS regions, screenshot $WORK/screenshot.png"
