#!/bin/bash
# Opens a shipped walk in the editor, by real input events: walks and looks around, puts the eye by a click on the plan,
# goes to a bookmark and plays a path, tries what a walk cannot do, saves a picture; then the folder of a bundle by the dialog,
# and a walk that was cut off.
#   shipped_walk.sh EDITOR ACENTRIC WORK_FOLDER
. "$(dirname "$0")/script.sh" "$@"

make_room
python3 - "$PROJECT" <<'PY'
import json, sys
project = json.load(open(sys.argv[1]))
project["bookmarks"] = [{"name": "corner", "eye": [1.2, 0.8, 1.6], "yawDegrees": 200, "fovDegrees": 80}]
project["paths"] = [{"name": "along", "poses": [[0, -1, 0, 1.6, 0, 0], [2, 1, 0, 1.6, 0, 0]]}]
json.dump(project, open(sys.argv[1], "w"))
PY
"$ACENTRIC" bake "$PROJECT" >"$WORK/bake.out" 2>&1 || { cat "$WORK/bake.out"; exit 1; }
mkdir "$WORK/shipped"
WALK=$WORK/shipped/room.acentric
"$ACENTRIC" export "$PROJECT" --to walk "$WALK" >"$WORK/export.out" 2>&1 || { cat "$WORK/export.out"; exit 1; }
SUM=$(cksum <"$WALK")
"$ACENTRIC" export "$PROJECT" --to bundle "$WORK/bundle" >"$WORK/export.out" 2>&1 || { cat "$WORK/export.out"; exit 1; }

start_display
start_editor "$WALK"
wait_for '^event message Opened room.acentric, a walk' 60
wait_state 'working 0 dirty 0 undo 0 problems 0' 60
[ "$(field captures)" -gt 1 ] && [ "$(field captures)" = "$(field baked)" ] || fail "not all of the walk is there: $(state)"
xdotool getwindowname "$WINDOW" | grep -q 'room.acentric (walk)' || fail "the title is $(xdotool getwindowname "$WINDOW")"

# Walking by key, looking by mouse, and the eye put by a click on the plan.
rest
BEFORE=$(eye)
press w 0.8
rest
awk -v d="$(apart "$BEFORE" "$(eye)")" 'BEGIN { exit !(d > 0.2 && d < 4) }' || fail "W did not walk: from $BEFORE to $(eye)"
BEFORE=$(eye)
# shellcheck disable=SC2046
xdotool mousemove --window "$WINDOW" $(place walk); sleep 0.3
xdotool mousedown 1; sleep 0.3
for _ in 1 2 3 4 5 6; do xdotool mousemove_relative -- 20 0; sleep 0.1; done
xdotool mouseup 1
rest
echo "$BEFORE $(eye)" | awk '{ d = $6 - $13; if (d < 0) d += 6.2831853; exit !(d > 0.1 && d < 1.5) }' ||
  fail "dragging did not look to the right: from $BEFORE to $(eye)"
BEFORE=$(eye)
# shellcheck disable=SC2046
set -- $(place plan.eye)
click_at $(($1 + 60)) $(($2 + 40))
rest
awk -v d="$(apart "$BEFORE" "$(eye)")" 'BEGIN { exit !(d > 0.1) }' || fail "a click on the plan did not move the eye"
import -window root "$WORK/walk.png"

# Bookmarks and paths of the walk.
click tab.paths
click bookmark.0
click bookmark.go
rest
eye | awk '{ exit !(($3 - 1.2) ^ 2 + ($4 - 0.8) ^ 2 < 0.01) }' || fail "the bookmark leads to $(eye)"
click path.0
click path.play
wait_for '^event message Replay of along' 30
import -window root "$WORK/paths.png"

# Another renderer for a look.
click walk.settings
click walk.renderer
click walk.renderer.gl
press Escape
wait_for '^event glframe .* missing 0' 60
import -window root "$WORK/opengl.png"

# Baking and editing are not to be had, by button, key or menu.
for item in tool.cells walk.setStart view.split view.scene3d; do
  click $item
done
press_with ctrl b
press_with ctrl s
grep -Eq '^event action (tool.cells|walk.setStart|view.split|view.scene3d|bake|file.save)' "$WORK/ui.log" &&
  fail "an action ran that needs a project: $(grep '^event action' "$WORK/ui.log" | tail -1)"
# shellcheck disable=SC2046
xdotool mousemove --window "$WINDOW" $(place tool.cells)
sleep 1.5
import -window root "$WORK/tooltip.png"

# A picture of it lies beside it, and nothing else does.
press F12
wait_for '^event message The picture is in .*room-view-001.png' 20
press_with ctrl w
wait_for '^event state empty' 20
[ "$(ls "$WORK/shipped")" = "$(printf 'room-view-001.png\nroom.acentric')" ] || fail "left beside the walk: $(ls "$WORK/shipped")"
[ "$SUM" = "$(cksum <"$WALK")" ] || fail "the walk was written to"

# The folder of a bundle, by the dialog.
press_with ctrl o
wait_until 20 rect file.name >/dev/null || fail "no dialog opens"
xdotool type --delay 60 "$WORK/bundle/bundle.json"
sleep 0.5
import -window root "$WORK/dialog.png"
press Return
wait_for '^event message Opened bundle, a walk' 60
wait_state 'working 0 dirty 0 undo 0 problems 0' 60
grep -q '^event failure' "$WORK/ui.log" && fail "a failure was shown: $(grep '^event failure' "$WORK/ui.log")"
leave_editor

# A walk that was not copied whole is named, with a way out, and the editor goes on.
head -c $(($(stat -c %s "$WALK") / 2)) "$WALK" >"$WORK/shipped/cut.acentric"
start_editor "$WORK/shipped/cut.acentric"
wait_for '^event failure Opening cut.acentric failed. .*cut.acentric: has .* not copied whole; copy the walk again' 30
sleep 1
import -window root "$WORK/cut.png"
press Return
leave_editor
echo "passed: screenshots $WORK/walk.png, paths.png, opengl.png, tooltip.png, dialog.png, cut.png"
