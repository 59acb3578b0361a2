#!/bin/bash
# The window on screens of several sizes: all of it on the screen at the first start, and where it was left at the next.
#   screen.sh EDITOR ACENTRIC WORK_FOLDER
. "$(dirname "$0")/script.sh" "$@"
make_room

# geometry: X Y WIDTH HEIGHT of the window on the screen
geometry() {
  eval "$(xdotool getwindowgeometry --shell "$WINDOW" | sed 's/^/G_/')"
  echo "$G_X $G_Y $G_WIDTH $G_HEIGHT"
}
# wait_geometry "X Y WIDTH HEIGHT"
wait_geometry() {
  for _ in $(seq 200); do [ "$(geometry)" = "$1" ] && return; sleep 0.1; done
  fail "the window is at $(geometry), not at $1"
}
# start_on WIDTHxHEIGHT
start_on() {
  SCREEN=$1 start_display
  start_editor "$PROJECT"
  wait_for '^event message Opened' 60
  wait_state 'working 0' 60
}
leave_screen() {
  leave_editor
  kill "$DISPLAY_PID"
  wait "$DISPLAY_PID" 2>/dev/null
  DISPLAY_PID=
}

# A small screen, a first start: it is filled, and nothing lies outside.
start_on 1280x720
wait_geometry "0 0 1280 720"
import -window root "$WORK/small.png"
for widget in status.problems menu.file settings.configuration; do
  line=$(rect "$widget") || continue
  echo "$line" | awk '{ exit !($3 >= 0 && $4 >= 0 && $5 <= 1280 && $6 <= 720) }' || fail "outside: $line"
done
# It is left elsewhere and smaller: there it opens again.
xdotool windowsize "$WINDOW" 900 600
xdotool windowmove "$WINDOW" 140 70
wait_geometry "140 70 900 600"
leave_screen
start_on 1280x720
wait_geometry "140 70 900 600"
leave_screen

# Another screen knows nothing of that; a smaller one holds it all the same.
start_on 1920x1080
wait_geometry "160 90 1600 900"
# Left half off the screen: it comes back.
xdotool windowmove "$WINDOW" 1500 800
wait_geometry "1500 800 1600 900"
press Escape
leave_screen
start_on 1920x1080
wait_geometry "320 180 1600 900"
leave_screen
start_on 1280x720
wait_geometry "140 70 900 600"
leave_screen
echo "passed"
