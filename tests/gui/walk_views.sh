#!/bin/bash
# What the walk shows beside its picture, by real input events: split with the ray-traced truth and a border that is
# dragged, the difference, frame times, the minimap and the images in use, settings, saved pictures.
#   walk_views.sh EDITOR ACENTRIC WORK_FOLDER
. "$(dirname "$0")/script.sh" "$@"

echo '{ "walkWidth": 360 }' >"$WORK/config/acentric/editor.json"
make_room
"$ACENTRIC" bake "$PROJECT" >"$WORK/bake.out" 2>&1 || { cat "$WORK/bake.out"; exit 1; }

open_project

rect() { grep -E "^(rect|gone) $1( |$)" "$WORK/ui.log" | tail -1; }
# shown NAME...: waits until each is, and stays where it is
shown() {
  local name last
  for name in "$@"; do
    last=
    for _ in $(seq 40); do
      case "$(rect "$name")" in rect*) [ "$(rect "$name")" = "$last" ] && continue 2 ;; esac
      last=$(rect "$name")
      sleep 0.5
    done
    fail "$name is not shown"
  done
}
compared() { grep '^event compared' "$WORK/ui.log" | tail -1; }

# Every button of the toolbar lies within the narrow walk.
for item in view.holes view.sources view.split view.difference view.minimap view.images view.frameTimes walk.settings \
  walk.screenshot walk.restart walk.setStart; do
  rect $item | awk '{ exit !($1 == "rect" && $3 >= 1240 && $5 <= 1600) }' || fail "$item does not fit: $(rect $item)"
done

# Split: the truth comes by itself when the eye rests, with figures of the rays that were chosen.
click view.split
wait_for '^event compared .* against 4 rays per pixel' 40
compared | grep -Eq 'PSNR [2-9][0-9]\.[0-9] dB   SSIM 0\.[0-9]+   holes' || fail "no figures: $(compared)"
# shellcheck disable=SC2046
set -- $(place walk.border)
drag_to "$1" "$2" "$(($1 + 90))" "$2"
MOVED=$(place walk.border | awk -v x="$1" '{ print $1 - x }')
[ "$MOVED" -ge 85 ] && [ "$MOVED" -le 95 ] || fail "the border was dragged by 90 pixels and moved by $MOVED"
import -window root "$WORK/split.png"

# More rays, then another place: the truth is traced anew for each.
click compare.rays.9
wait_for '^event compared .* against 9 rays per pixel' 40
finest() { grep -c '^event compared .* against 9 rays' "$WORK/ui.log"; }
BEFORE=$(finest)
press q 0.4
for _ in $(seq 400); do [ "$(finest)" -gt "$BEFORE" ] && break; sleep 0.1; done
[ "$(finest)" -gt "$BEFORE" ] || fail "the truth did not follow the eye: $(compared)"

# The difference, and its picture on disk: never over another.
press_with shift k
click compare.gain.8
press F12
wait_for '^event message The picture is in .*room-view-001.png' 20
SUM=$(cksum <"$WORK/room-view-001.png")
press_with shift k
press F12
wait_for '^event message The picture is in .*room-view-002.png' 20
[ "$SUM" = "$(cksum <"$WORK/room-view-001.png")" ] || fail "the first picture was overwritten"
cmp -s "$WORK/room-view-001.png" "$WORK/room-view-002.png" && fail "difference and picture are the same"
set -- $(rect walk)
[ "$(identify -format '%wx%h' "$WORK/room-view-002.png")" = "$(($5 - $3))x$(($6 - $4))" ] ||
  fail "the picture is not as large as the walk: $(identify "$WORK/room-view-002.png")"

# Minimap, images in use, frame times: all are there, and walking goes on below them.
press m
press_with shift m
press F3
shown walk.minimap walk.images walk.frameTimes
ROW=$(grep -oE '^rect walk\.images\.[0-9]+' "$WORK/ui.log" | tail -1 | awk '{ print $2 }')
[ -n "$ROW" ] || fail "no image in use is listed"
EYE=$(eye)
# shellcheck disable=SC2046
drag_to $(place walk.minimap) 1300 600
[ "$(eye)" = "$EYE" ] || fail "dragging on the minimap turned the eye"
press w 0.8
walked() { [ "$(eye)" != "$EYE" ]; }
wait_until 20 walked || fail "W did not walk under the minimap"
ROW=$(grep -E '^(rect|gone) walk\.images\.[0-9]+' "$WORK/ui.log" | awk '$1 == "rect" { last[$2] = 1 } $1 == "gone" { delete last[$2] } END { for (row in last) print row }' | sort | sed -n 1p)
# shellcheck disable=SC2046
xdotool mousemove --window "$WINDOW" $(place "$ROW")
sleep 1
import -window root "$WORK/overlays.png"

# The settings: one home, with the renderer in it.
click walk.settings
shown walk.renderer settings.fov walk.eyeHeight settings.exposure
click walk.renderer
shown walk.renderer.zbuffer
click walk.renderer.zbuffer
sleep 0.5
import -window root "$WORK/settings.png"
press Escape
press_with ctrl s
wait_for '^event message Saved room.acentric.json' 20
grep -q '"renderer": "zbuffer"' "$PROJECT" || fail "the renderer was not chosen"

# With all of it open, a window in which nothing changes costs nothing.
comes_to_rest || fail "an idle window goes on working"

grep -q '^event failure' "$WORK/ui.log" && fail "a failure was shown: $(grep '^event failure' "$WORK/ui.log")"
echo "passed: $(compared)"
