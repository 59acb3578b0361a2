#!/bin/bash
# What the editor looks like, against pictures of it in goldens/: the welcome, the toolbars, the plan with triangles, a bake
# panel with nothing baked, the preferences, a walk. Parts that tell times, rates, paths or free space are left out; a picture may differ
# in a small share of its pixels. Where one differs more, the picture, the golden and their difference are in the work folder.
#   goldens.sh EDITOR ACENTRIC WORK_FOLDER
# After a change that is meant: UPDATE_GOLDENS=1 goldens.sh ... writes them anew; look at them before they are kept.
HERE=$(cd "$(dirname "$0")" && pwd)
. "$(dirname "$0")/script.sh" "$@"

FUZZ=10%      # how far a channel may be off; edges of letters differ between versions of Mesa and FreeType
SHARE=0.004   # of the pixels may be off further
DIFFERENT=0

# Threads and memory as anywhere.
echo '{ "guideSeen": true, "bakeThreads": 1, "bakeMegabytes": 1024 }' >"$WORK/config/acentric/editor.json"

# still CROP FILE: a picture of that part of the window, once it keeps still
still() {
  local before='' now
  xdotool mousemove --window "$WINDOW" 800 893  # on the status bar: nothing is pointed at
  for _ in $(seq 60); do
    sleep 0.4
    import -window "$WINDOW" -crop "$1" +repage "$2"
    now=$(identify -format '%#' "$2")
    [ "$now" = "$before" ] && return
    before=$now
  done
  fail "$2 does not keep still"
}
# check NAME X0 Y0 X1 Y1: this part of the window, at half its size, against its golden
check() {
  local golden=$HERE/goldens/$1.png off whole
  still "$(($4 - $2))x$(($5 - $3))+$2+$3" "$WORK/$1-full.png"
  convert "$WORK/$1-full.png" -resize 50% -strip -define png:exclude-chunks=date,time "$WORK/$1.png"
  if [ -n "${UPDATE_GOLDENS:-}" ]; then
    mkdir -p "$HERE/goldens" && cp "$WORK/$1.png" "$golden"
    return
  fi
  [ -f "$golden" ] || fail "there is no $golden; UPDATE_GOLDENS=1 makes it"
  if [ "$(identify -format '%wx%h' "$golden")" != "$(identify -format '%wx%h' "$WORK/$1.png")" ]; then
    echo "FAILED: $1 is of $(identify -format '%wx%h' "$WORK/$1.png"), its golden of $(identify -format '%wx%h' "$golden")" >&2
    DIFFERENT=1
    return
  fi
  off=$(compare -metric AE -fuzz "$FUZZ" "$golden" "$WORK/$1.png" "$WORK/$1-difference.png" 2>&1)
  whole=$(identify -format '%[fx:w*h]' "$golden")
  echo "$1: $off of $whole pixels differ"
  echo "$off $whole $SHARE" | awk '{ exit !($1 <= $2 * $3) }' && return
  cp "$golden" "$WORK/$1-golden.png"
  echo "FAILED: $1 differs from its golden: see $WORK/$1.png, $1-golden.png and, in red, $1-difference.png" >&2
  DIFFERENT=1
}
# edges NAME: "x0 y0 x1 y1" of a widget that is shown, in whole pixels
edges() {
  local line
  for _ in $(seq 50); do rect "$1" >/dev/null && break; sleep 0.1; done
  line=$(rect "$1") || fail "widget $1 is not shown"
  echo "$line" | awk '{ printf "%d %d %d %d\n", $3, $4, $5, $6 }'
}

start_display
start_editor ""
# shellcheck disable=SC2046
set -- $(edges file.open)
check welcome $(($1 - 260)) $(($2 - 90)) $(($3 + 470)) $(($4 + 40))
press_with ctrl comma
set -- $(edges preferences.theme) $(edges dialog.ok)
check preferences $(($1 - 186)) $(($2 - 80)) $(($7 + 16)) $(($8 + 12))
press Escape
leave_editor

make_room
start_editor "$PROJECT"
wait_for '^event message Opened' 60
wait_state 'working 0' 60
set -- $(edges bake.start)
check bake-panel $(($1 - 12)) $(($2 - 34)) $(($1 + 440)) $(($4 + 50))
set -- $(edges tool.cells) $(edges walk.setStart)
check toolbars $(($1 - 8)) $(($2 - 6)) $(($5 + 60)) $(($8 + 6))
press t
wait_for '^event action view.triangles' 10
wait_state 'working 0' 30
set -- $(edges plan)
check plan-triangles "$@"
leave_editor

"$ACENTRIC" bake "$PROJECT" >"$WORK/bake.out" 2>&1 || fail "the bake failed: $(cat "$WORK/bake.out")"
start_editor "$PROJECT"
wait_for '^event message Opened' 60
wait_state 'working 0' 60
wait_for '^event frame .* images [1-9]' 60
set -- $(edges walk)
check walk "$1" "$2" "$3" $(($4 - 50))  # without the line with its time
leave_editor

[ "$DIFFERENT" -eq 0 ] || exit 1
echo "passed: $(ls "$HERE/goldens" | wc -l) pictures in $WORK"
