#!/bin/bash
# Publishes from the editor, by real input events: asked to bake first, then as a folder of files that a browser shows and curl reads,
# links copied, serving stopped, and again as one file.
#   publish.sh EDITOR ACENTRIC WORK_FOLDER
. "$(dirname "$0")/script.sh" "$@"
command -v curl >/dev/null || { echo "skipped: curl is not installed"; exit 77; }
[ -f "$(dirname "$EDITOR")/../../../web/dist/index.html" ] || { echo "skipped: the page is not built (./run web does so)"; exit 77; }

# What is opened in the browser: noted, and shown by Chromium where there is one.
mkdir "$WORK/bin"
cat >"$WORK/bin/xdg-open" <<SH
#!/bin/sh
echo "\$1" >>"$WORK/opened"
command -v chromium >/dev/null || exit 0
exec chromium --headless=new --no-sandbox --use-gl=angle --use-angle=swiftshader --enable-unsafe-swiftshader --no-first-run \
  --disable-background-networking --disable-component-update --disable-sync --window-size=640,360 \
  --user-data-dir="$WORK/chromium" "\$1" >"$WORK/chromium.log" 2>&1 & echo \$! >"$WORK/chromium.pid"
SH
chmod +x "$WORK/bin/xdg-open"
export PATH=$WORK/bin:$PATH
trap '[ -f "$WORK/chromium.pid" ] && kill "$(cat "$WORK/chromium.pid")" 2>/dev/null; stop_all' EXIT

# ask PATH [OPTIONS of curl]: what the server sends, behind its status
ask() { curl -s --path-as-is -o "$WORK/answer" -w '%{http_code}' "${@:2}" "$ADDRESS$1"; }
open_dialog() {
  press_with ctrl e
  wait_until 20 rect publish.begin >/dev/null || fail "no dialog opens"
}

make_room
open_project

# Nothing is baked: it asks to bake first.
open_dialog
click publish.begin
wait_for '^rect publish.bake ' 60
sleep 0.5
import -window root "$WORK/gaps.png"
[ -e "$WORK/room-web" ] && fail "something was written though nothing is baked"
click publish.bake
wait_for '^event message Baked' 120
wait_state 'working 0' 60

open_dialog
click publish.begin
wait_for '^event message Published .* which is at http' 120
ADDRESS=$(sed -nE 's/^event message Published .* is at (http[^ ]*\/) now/\1/p' "$WORK/ui.log" | tail -1)
SITE=$WORK/room-web
wait_until 20 grep -qx "$ADDRESS?report" "$WORK/opened" || fail "the browser was not opened at $ADDRESS: $(cat "$WORK/opened")"
[ "$(ask "")" = 200 ] && cmp -s "$WORK/answer" "$SITE/index.html" || fail "the page is not what is in $SITE"
[ "$(ask bundle.json)" = 200 ] && cmp -s "$WORK/answer" "$SITE/bundle.json" || fail "the index is not what is in $SITE"
[ "$(ask bundle.json -r 10-19)" = 206 ] && [ "$(cat "$WORK/answer")" = "$(tail -c +11 "$SITE/bundle.json" | head -c 10)" ] || fail "a range is not sent"
[ "$(ask ../room.obj)" = 404 ] && [ "$(ask %2e%2e/room.obj)" = 404 ] || fail "what lies outside is sent"
[ "$(ask "" -X POST -d x)" = 405 ] || fail "it takes what is posted"
if command -v chromium >/dev/null; then wait_for '^rect publish.loaded' 120; fi
sleep 0.5
import -window root "$WORK/published.png"
[ -z "$(find "$WORK" -maxdepth 1 -name '.acentric-tmp-*' ! -name '*-trial-*')" ] || fail "left beside it: $(ls -A "$WORK")"

# Links: to this view, and to the start.
click publish.copyView
wait_for "^event clipboard $ADDRESS#at=-?[0-9.]+,-?[0-9.]+,-?[0-9.]+,-?[0-9.]+&storey=0" 20
click publish.copyStart
wait_for "^event clipboard $ADDRESS\$" 20

click publish.stop
wait_until 10 rect publish.serve >/dev/null || fail "it does not say that nothing is served"
stopped() { ! curl -s -o /dev/null "$ADDRESS"; }
wait_until 10 stopped || fail "it is still served"

# Again, as one file.
click publish.oneFile
click publish.openBrowser
click publish.begin
published_twice() { [ "$(grep -c '^event message Published' "$WORK/ui.log")" = 2 ]; }
wait_until 120 published_twice || fail "it was not published again"
ADDRESS=$(sed -nE 's/^event message Published .* is at (http[^ ]*\/) now/\1/p' "$WORK/ui.log" | tail -1)
[ "$(ask room.acentric -r 0-63)" = 206 ] && [ "$(stat -c %s "$WORK/answer")" = 64 ] || fail "the walk is not read by ranges"
[ "$(ask bundle.json)" = 404 ] || fail "files of the former one are left"
[ "$(wc -l <"$WORK/opened")" = 1 ] || fail "the browser was opened though that was not wanted"
sleep 0.5
import -window root "$WORK/one_file.png"
click dialog.close
leave_editor
stopped || fail "it is served though the editor has ended"
grep -q '^event failure' "$WORK/ui.log" && fail "a failure was shown: $(grep '^event failure' "$WORK/ui.log")"
echo "passed: screenshots $WORK/gaps.png, published.png, one_file.png"
