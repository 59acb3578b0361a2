#!/bin/bash
# The editor by keys alone: an action of each menu, commands found by name, Tab without stealing the walk's keys; the first
# start with its guide; windows of any size; and a display without OpenGL 3.3.
#   keyboard.sh EDITOR ACENTRIC WORK_FOLDER
. "$(dirname "$0")/script.sh" "$@"
make_room

lines() { grep -c "$1" "$WORK/ui.log"; }
# shown NAME: is this widget shown? lit ACTION: do the arrows stand on this item of a menu?
shown() { grep -E "^(rect|gone) $1( |$)" "$WORK/ui.log" | tail -1 | grep -q '^rect'; }
lit() { shown "lit\.$1"; }
# step KEY: a tap, and a moment for something else to be lit
step() {
  local before
  before=$(lines '^rect lit')
  press "$1" 0.05
  for _ in $(seq 15); do [ "$(lines '^rect lit')" -gt "$before" ] && break; sleep 0.1; done
}
# run_by_menu ACTION [KEY]: opens the menus by that key (F10), goes right or back until the one is open that has it, down, Enter
run_by_menu() {
  local before
  before=$(lines "^event action $1\$")
  step "${2:-F10}"
  for key in Right Right Right Right Right Right Right Left Left Left; do
    shown "menu\.$1" && break
    step $key
    shown "menu\.$1" || step Down  # opens the menu that Right went to
  done
  for _ in $(seq 40); do lit "$1" && break; step Down; done
  lit "$1" || fail "the arrows do not reach $1"
  press Return 0.05
  for _ in $(seq 50); do [ "$(lines "^event action $1\$")" -gt "$before" ] && return; sleep 0.1; done
  fail "Enter did not run $1"
}

start_display

# OpenGL too old: one line that says so, and a failure instead of a window.
MESA_GL_VERSION_OVERRIDE=2.1 "$EDITOR" --exit-after 5 >"$WORK/old.out" 2>&1
CODE=$?
[ "$CODE" -eq 1 ] || fail "without OpenGL 3.3 the editor ended with $CODE"
grep -q 'OpenGL 3.3' "$WORK/old.out" || fail "nothing was said of OpenGL 3.3: $(cat "$WORK/old.out")"

# No preferences yet: the sample opens, with the guide.
"$EDITOR" --sample "$PROJECT" --log-ui "$WORK/ui.log" --exit-after 890 >"$WORK/editor.out" 2>&1 &
EDITOR_PID=$!
wait_for '^event READY' 60
WINDOW=$(xdotool search --sync --name 'Acentric' | sed -n 1p)
wait_for '^event message Opened' 60
wait_for '^rect guide.next ' 20
wait_state 'working 0' 60

for action in window.lightTheme edit.selectAll view.plan view.lattice view.holes help.about; do
  run_by_menu "$action"
done
press Escape
run_by_menu edit.selectAll Alt_L
grep -q '"theme": "light"' "$WORK/config/acentric/editor.json" || fail "the theme is not remembered"

# A command by letters of its name, in any order.
press_with ctrl k
xdotool type --delay 200 "hol mar"
sleep 0.5
press Return
for _ in $(seq 20); do [ "$(lines '^event action view.holes$')" -ge 2 ] && break; sleep 0.1; done
[ "$(lines '^event action view.holes$')" -ge 2 ] || fail "the command was not found by its letters"

# W walks; after Tab the arrows belong to widgets, and to the walk again after Esc.
eyes() { lines '^event eye'; }
BEFORE=$(eyes)
walked() { [ "$(eyes)" -gt "$BEFORE" ]; }
press w 0.6
wait_until 10 walked || fail "W does not walk"
press Tab
BEFORE=$(settled eyes)
press Down 0.5; sleep 1
[ "$(eyes)" -eq "$BEFORE" ] || fail "an arrow walked while widgets had the keys"
press Escape
press Down 0.6
wait_until 10 walked || fail "arrows do not walk after Esc"

# The guide is left, and not shown again when so asked.
click guide.never
click guide.skip
grep -q '"guideSeen": true' "$WORK/config/acentric/editor.json" || fail "the guide will come again"

# Any size of window.
for size in "1 1" "40 30" "200 120" "500 300" "700 500" "1600 900"; do
  # shellcheck disable=SC2086
  xdotool windowsize "$WINDOW" $size; sleep 0.5
  kill -0 "$EDITOR_PID" 2>/dev/null || fail "a window of $size ended the editor: $(cat "$WORK/editor.out")"
done
for key in equal equal minus 0; do press_with ctrl "$key"; done
kill -0 "$EDITOR_PID" 2>/dev/null || fail "another scale ended the editor: $(cat "$WORK/editor.out")"
import -window root "$WORK/screenshot.png"

leave_editor
echo "passed: screenshot $WORK/screenshot.png"
