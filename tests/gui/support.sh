# Functions for tests that drive the editor: a virtual display, waiting on its log, and input by widget names.
# Sourced. The caller sets EDITOR, WORK (an empty folder) and calls start_display and start_editor.

# The editor speaks English, whatever the caller does.
unset LANGUAGE LC_MESSAGES LANG
export LC_ALL=C.UTF-8

fail() {
  echo "FAILED: $*" >&2
  [ -n "${DISPLAY:-}" ] && import -window root "$WORK/failure.png" 2>/dev/null
  [ -f "$WORK/ui.log" ] && { echo "--- last events:" >&2; grep '^event' "$WORK/ui.log" | tail -12 >&2; }
  exit 1
}

need_tools() {
  for tool in Xvfb xdotool import; do
    command -v "$tool" >/dev/null || { echo "skipped: $tool is not installed"; exit 77; }
  done
}

stop_all() {
  [ -n "${EDITOR_PID:-}" ] && kill "$EDITOR_PID" 2>/dev/null && wait "$EDITOR_PID" 2>/dev/null
  [ -n "${DISPLAY_PID:-}" ] && kill "$DISPLAY_PID" 2>/dev/null && wait "$DISPLAY_PID" 2>/dev/null
}

# $SCREEN: its size, else 1600x900
start_display() {
  rm -f "$WORK/display"  # of an earlier run
  Xvfb -displayfd 3 -screen 0 "${SCREEN:-1600x900}x24" -nolisten tcp 3>"$WORK/display" 2>"$WORK/xvfb.log" &
  DISPLAY_PID=$!
  for _ in $(seq 100); do [ -s "$WORK/display" ] && break; sleep 0.1; done
  [ -s "$WORK/display" ] || fail "no virtual display: $(cat "$WORK/xvfb.log")"
  export DISPLAY=":$(cat "$WORK/display")"
}

# start_editor FILE
start_editor() {
  rm -f "$WORK/ui.log"
  "$EDITOR" "$1" --log-ui "$WORK/ui.log" --exit-after 890 >"$WORK/editor.out" 2>&1 &
  EDITOR_PID=$!
  wait_for '^event READY' 60
  WINDOW=$(xdotool search --sync --name 'Acentric' | sed -n 1p)
}

# wait_until SECONDS COMMAND...: it succeeds
wait_until() {
  for _ in $(seq $(($1 * 10))); do
    "${@:2}" && return
    sleep 0.1
  done
  return 1
}
# settled COMMAND...: what it prints once that has not changed for a second, waited for half a minute
settled() {
  local now last=
  for _ in $(seq 30); do
    now=$("$@")
    [ "$now" = "$last" ] && break
    last=$now
    sleep 1
  done
  echo "$now"
}
# comes_to_rest: within a minute there are three seconds in which the editor takes 0.15 s of a processor at most
comes_to_rest() {
  local before
  for _ in $(seq 20); do
    before=$(awk '{ print $14 + $15 }' "/proc/$EDITOR_PID/stat")
    sleep 3
    [ $(($(awk '{ print $14 + $15 }' "/proc/$EDITOR_PID/stat") - before)) -le 15 ] && return
  done
  return 1
}

# wait_for PATTERN SECONDS: a line of the log matches
wait_for() {
  for _ in $(seq $(($2 * 10))); do
    grep -Eq "$1" "$WORK/ui.log" 2>/dev/null && return
    kill -0 "$EDITOR_PID" 2>/dev/null || fail "the editor is gone: $(cat "$WORK/editor.out")"
    sleep 0.1
  done
  fail "waited $2 s for: $1"
}

# wait_state PATTERN SECONDS: the newest state line matches
wait_state() {
  for _ in $(seq $(($2 * 10))); do
    state | grep -Eq "$1" && return
    kill -0 "$EDITOR_PID" 2>/dev/null || fail "the editor is gone: $(cat "$WORK/editor.out")"
    sleep 0.1
  done
  fail "waited $2 s for state: $1 (it is: $(state))"
}

state() { grep '^event state' "$WORK/ui.log" | tail -1; }
# field NAME: number behind a word of the newest state line
field() { state | sed -nE "s/.* $1 ([0-9]+).*/\1/p"; }

# rect NAME: the line of a widget that is shown; fails without a word where it is not
rect() { grep -E "^(rect|gone) $1( |$)" "$WORK/ui.log" | tail -1 | grep '^rect'; }
# is_gone NAME: it was shown, and is no more
is_gone() { grep -E "^(rect|gone) $1( |$)" "$WORK/ui.log" | tail -1 | grep -q '^gone'; }
# place NAME: centre of a widget that is shown, "x y"
place() {
  local line
  line=$(rect "$1") || fail "widget $1 is not shown"
  echo "$line" | awk '{ printf "%d %d\n", ($3 + $5) / 2, ($4 + $6) / 2 }'
}

# The window may still be at work for some frames: buttons and keys are held for longer than one.
click_at() {
  xdotool mousemove --window "$WINDOW" "$1" "$2"; sleep 0.3
  xdotool mousedown 1; sleep 0.3; xdotool mouseup 1; sleep 0.3
}
click() {
  local at
  at=$(place "$1") || exit 1
  # shellcheck disable=SC2086
  click_at $at
}
press() { xdotool keydown "$1"; sleep "${2:-0.25}"; xdotool keyup "$1"; sleep 0.2; }
press_with() {  # press_with MODIFIER KEY
  xdotool keydown "$1"; sleep 0.1; press "$2"; xdotool keyup "$1"; sleep 0.2
}
# The window is left by Ctrl+Q, and the editor ends well.
leave_editor() {
  local code
  press_with ctrl q
  for _ in $(seq 100); do kill -0 "$EDITOR_PID" 2>/dev/null || break; sleep 0.1; done
  kill -0 "$EDITOR_PID" 2>/dev/null && fail "Ctrl+Q did not leave"
  wait "$EDITOR_PID"
  code=$?
  [ "$code" -eq 0 ] || fail "the editor ended with $code: $(cat "$WORK/editor.out")"
  EDITOR_PID=
}
# drag_to X0 Y0 X1 Y1
drag_to() {
  xdotool mousemove --window "$WINDOW" "$1" "$2"; sleep 0.3; xdotool mousedown 1; sleep 0.3
  for i in 1 2 3 4 5 6; do
    xdotool mousemove --window "$WINDOW" $(($1 + ($3 - $1) * i / 6)) $(($2 + ($4 - $2) * i / 6)); sleep 0.1
  done
  sleep 0.2; xdotool mouseup 1; sleep 0.3
}
