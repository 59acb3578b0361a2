#!/bin/bash
# Opens a project in the editor and does what a designer does, by real input events: adds a cell, drags one, removes one,
# takes edits back, bakes, walks, looks around, saves. Checks the log, the project file and the captures on disk.
#   walkthrough.sh EDITOR ACENTRIC WORK_FOLDER
. "$(dirname "$0")/script.sh" "$@"

make_room
open_project
REGIONS=$(field regions)
[ "$REGIONS" -gt 1 ] || fail "a project of $REGIONS regions is too small to try"

# Add: click the free ring nearest to the middle of the plan.
FREE=$(grep -oE '^rect free\.-?[0-9]+\.-?[0-9]+\.0 ' "$WORK/ui.log" | awk '{ print $2 }' | sort -u | while read -r name; do
  echo "$(place "$name") $name $(place plan)"
done | awk '{ d = ($1 - $4) ^ 2 + ($2 - $5) ^ 2; print d, $3 }' | sort -n | sed -n 1p | awk '{ print $2 }')
[ -n "$FREE" ] || fail "no free cell is shown"
CELL=cell.${FREE#free.}
click "$FREE"
wait_state "regions $((REGIONS + 1)) .*working 0 dirty 1 undo 1" 30

# Drag it to another free ring: one history entry, as many regions as before.
TARGET=$(grep -oE '^rect free\.-?[0-9]+\.-?[0-9]+\.0 ' "$WORK/ui.log" | awk '{ print $2 }' | sort -u | while read -r name; do
  [ "$name" != "$FREE" ] && echo "$(place "$name") $name $(place "$CELL")"
done | awk '{ d = ($1 - $4) ^ 2 + ($2 - $5) ^ 2; print d, $3 }' | sort -n | sed -n 1p | awk '{ print $2 }')
[ -n "$TARGET" ] || fail "no second free cell is shown"
# shellcheck disable=SC2046
drag_to $(place "$CELL") $(place "$TARGET")
wait_state "regions $((REGIONS + 1)) .*working 0 dirty 1 undo 2" 30
place "cell.${TARGET#free.}" >/dev/null

# Undo the drag, then remove the added cell by selecting it and pressing Delete.
press_with ctrl z
wait_state "regions $((REGIONS + 1)) .*working 0 dirty 1 undo 1" 30
click "$CELL"
press Delete
wait_state "regions $REGIONS .*working 0 dirty [01] undo 2" 30
# Take both back, and the first again: the cell is there.
press_with ctrl z
press_with ctrl z
wait_state "regions $REGIONS .*working 0 dirty 0 undo 0" 30
press_with ctrl y
wait_state "regions $((REGIONS + 1)) .*working 0 dirty 1 undo 1" 30

# Save by key, bake by button.
press_with ctrl s
wait_for '^event message Saved room.acentric.json' 20
grep -q '"added"' "$PROJECT" || fail "the project file has no added cells"
python3 - "$PROJECT" "${CELL#cell.}" <<'PY' || fail "the added cell is not in the project file"
import json, sys
layout = json.load(open(sys.argv[1]))["storeys"][0]["layout"]
sys.exit(0 if layout["added"] == [[int(n) for n in sys.argv[2].split(".")]] else 1)
PY
CAPTURES=$(field captures)
click bake.start
wait_for '^event message Baked' 240
wait_state "captures $CAPTURES baked $CAPTURES working 0" 60
FILES=$(find "$WORK/room.captures" -name '*.pack' | wc -l)
[ "$FILES" -ge "$CAPTURES" ] || fail "$FILES captures on disk, $CAPTURES expected"

# Walk with W for a second, then look by dragging to the right.
eye() { grep '^event eye' "$WORK/ui.log" | tail -1; }
EYE_BEFORE=$(eye)
press w 1.0
EYE_AFTER=$(settled eye)
echo "$EYE_BEFORE $EYE_AFTER" | awk '{ d = sqrt(($9 - $3) ^ 2 + ($10 - $4) ^ 2); exit !(d > 0.3 && d < 4) }' ||
  fail "W did not walk: from $EYE_BEFORE to $EYE_AFTER"
at=$(place walk)
# shellcheck disable=SC2086
xdotool mousemove --window "$WINDOW" $at; sleep 0.3
xdotool mousedown 1; sleep 0.3
for _ in 1 2 3 4 5 6; do xdotool mousemove_relative -- 20 0; sleep 0.1; done
xdotool mouseup 1
EYE_TURNED=$(settled eye)
echo "$EYE_AFTER $EYE_TURNED" | awk '{ d = $6 - $13; if (d < 0) d += 6.2831853; exit !(d > 0.1 && d < 1.5) }' ||
  fail "dragging did not look to the right: from $EYE_AFTER to $EYE_TURNED"

# In a closed room that is baked all around, little is left open.
sleep 1
grep '^event frame' "$WORK/ui.log" | tail -1 | awk '{ exit !($5 > 0 && $7 < 0.2) }' ||
  fail "the picture has holes: $(grep '^event frame' "$WORK/ui.log" | tail -1)"
import -window root "$WORK/screenshot.png"

# Nothing changes now, so nothing may be drawn: hardly any processor time is used.
ticks() { awk '{ print $14 + $15 }' "/proc/$EDITOR_PID/stat"; }
sleep 6
BEFORE=$(ticks)
sleep 3
USED=$(($(ticks) - BEFORE))
[ "$USED" -le 15 ] || fail "an idle window used $USED hundredths of a second in 3 s"

leave_editor
grep -q '^event failure' "$WORK/ui.log" && fail "a failure was shown: $(grep '^event failure' "$WORK/ui.log")"
"$ACENTRIC" validate "$PROJECT" >/dev/null || fail "the saved project is not valid"
echo "passed: $REGIONS regions and one added, $CAPTURES captures, screenshot $WORK/screenshot.png"
