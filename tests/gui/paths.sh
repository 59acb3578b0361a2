#!/bin/bash
# Records a walk in the editor by real keys, replays it, moves a key pose of it on the plan, bookmarks a place, walks
# away and goes back there, saves. Checks the log, the project file, and that `acentric` plays the path.
#   paths.sh EDITOR ACENTRIC WORK_FOLDER
. "$(dirname "$0")/script.sh" "$@"

make_room --cell 1.6 --outline "-2.2,-1.6;2.2,-1.6;2.2,1.6;-2.2,1.6"
"$ACENTRIC" bake "$PROJECT" >"$WORK/bake.out" 2>&1 || { cat "$WORK"/*.out; exit 1; }

open_project


# Record: walk, turn, walk.
press_with ctrl r
wait_for '^rect path.0|^rect walk.record' 20
press w 0.9
press e 0.5
press w 0.5
rest
END=$(eye)
press_with ctrl r
wait_for '^event message Recorded walk 1' 20
wait_state 'working 0 dirty 1 undo 1' 20
import -window root "$WORK/recorded.png"

# Replay it from its beginning: it ends where the walk ended, and says how evenly pictures came.
xdotool keydown ctrl keydown shift; sleep 0.1; press b; xdotool keyup shift keyup ctrl; sleep 0.3
wait_state 'undo 2' 20
press s 0.8
press q 0.4
rest
[ "$(apart "$END" "$(eye)" | awk '{ print ($1 > 0.2) }')" = 1 ] || fail "S did not walk away: $END, $(eye)"
click path.0
press space
wait_for '^event message Replay of walk 1: [1-9][0-9]* frames' 60
rest
[ "$(apart "$END" "$(eye)" | awk '{ print ($1 < 0.05) }')" = 1 ] || fail "the replay ended elsewhere: $END, $(eye)"

# Away again, and back to the bookmark.
press a 0.6
rest
AWAY=$(eye)
[ "$(apart "$END" "$AWAY" | awk '{ print ($1 > 0.1) }')" = 1 ] || fail "A did not walk away: $END, $AWAY"
click bookmark.0
click bookmark.go
rest
[ "$(apart "$END" "$(eye)" | awk '{ print ($1 < 0.001) }')" = 1 ] || fail "the bookmark is elsewhere: $END, $(eye)"

# On the plan: move the path's last key pose, and take that back.
click path.0
press 7
LAST=$(grep -oE '^rect pose\.[0-9]+ ' "$WORK/ui.log" | awk '{ print $2 }' | sort -u -t. -k2n | tail -1)
at=$(place "$LAST") || exit 1
# shellcheck disable=SC2086
drag_to $at $((${at% *} - 40)) $((${at#* } - 30))
wait_state 'undo 3' 20
import -window root "$WORK/changed.png"
press_with ctrl z
wait_state 'undo 2' 20

press_with ctrl s
wait_for '^event message Saved room.acentric.json' 20
leave_editor
grep -q '^event failure' "$WORK/ui.log" && fail "a failure was shown: $(grep '^event failure' "$WORK/ui.log")"

# The saved project has both, and the path plays at 30 frames a second.
"$ACENTRIC" info "$PROJECT" >"$WORK/info.out" || fail "info failed"
grep -q '^bookmark place 1' "$WORK/info.out" || fail "no bookmark: $(cat "$WORK/info.out")"
grep -q '^path     walk 1' "$WORK/info.out" || fail "no path: $(cat "$WORK/info.out")"
"$ACENTRIC" render "$PROJECT" --bookmark "place 1" --size 160x90 -o "$WORK/place.png" >/dev/null || fail "render --bookmark"
"$ACENTRIC" walk "$PROJECT" --path "walk 1" --size 96x54 -o "$WORK/frames" --json >"$WORK/walk.json" || fail "walk --path"
python3 - "$PROJECT" "$WORK/walk.json" <<'PY' || fail "the path does not play in real time"
import json, math, sys
poses = json.load(open(sys.argv[1]))["paths"][0]["poses"]
frames = json.load(open(sys.argv[2]))["frames"]
sys.exit(0 if 3 <= len(poses) <= 40 and frames == math.ceil(poses[-1][0] * 30 - 1e-6) + 1 else 1)
PY
echo "passed: $(grep '^path' "$WORK/info.out"); $(grep 'Replay of' "$WORK/ui.log" | head -1)"
