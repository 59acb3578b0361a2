#!/bin/bash
# The editor as the keeper of a document, by real input events: killed with edits unsaved it offers them at the next start;
# the history's list is clicked; a second editor on the same project is read-only; a model and a project that others change
# are noticed; a model outside the project is brought in; problems are listed; damaged preferences, locks and autosaves are survived.
#   document.sh EDITOR ACENTRIC WORK_FOLDER
. "$(dirname "$0")/script.sh" "$@"

make_room

# shown NAME SECONDS: the widget is shown and at rest
shown() {
  for _ in $(seq $(($2 * 10))); do
    rect "$1" >/dev/null && { sleep 1; return; }
    kill -0 "$EDITOR_PID" 2>/dev/null || fail "the editor is gone: $(cat "$WORK/editor.out")"
    sleep 0.1
  done
  fail "waited $2 s for widget $1"
}
kill_editor() {
  kill -9 "$EDITOR_PID"
  wait "$EDITOR_PID" 2>/dev/null
  EDITOR_PID=
}
free_cell() {
  grep -oE '^rect free\.-?[0-9]+\.-?[0-9]+\.0 ' "$WORK/ui.log" | awk '{ print $2 }' | sort -u | while read -r name; do
    rect "$name" >/dev/null && echo "$(place "$name") $name $(place plan)"
  done | awk '{ d = ($1 - $4) ^ 2 + ($2 - $5) ^ 2; print d, $3 }' | sort -n | sed -n 1p | awk '{ print $2 }'
}
add_cell() {
  local free
  free=$(free_cell)
  [ -n "$free" ] || fail "no free cell is shown"
  click "$free"
}

start_display
start_editor "$PROJECT"
wait_state 'working 0' 60
REGIONS=$(field regions)
add_cell
wait_state "regions $((REGIONS + 1)) .*working 0 dirty 1 undo 1" 30
for _ in $(seq 100); do [ -f "$PROJECT.autosave" ] && break; sleep 0.1; done
[ -f "$PROJECT.autosave" ] || fail "the edit was not autosaved"
SAVED=$(md5sum <"$PROJECT")
kill_editor
[ "$(md5sum <"$PROJECT")" = "$SAVED" ] || fail "the project's file was touched"
[ -f "$PROJECT.lock" ] || fail "the killed editor had no lock"

# The next start: the dead editor's lock is no obstacle, its work is offered. Preferences were damaged meanwhile.
echo '{ half a fi' >"$WORK/config/acentric/editor.json"
start_editor "$PROJECT"
wait_for '^event message The preferences were damaged' 30
wait_for '^event message The last editor on this project ended without closing it' 60
shown dialog.recover 30
import -window root "$WORK/recover.png"
click dialog.recover
wait_state "regions $((REGIONS + 1)) .*working 0 dirty 1 undo 1" 30

# The list of the history: back to the beginning and forth again.
click tab.history
shown history.1 10
click history.0
wait_state "regions $REGIONS .*working 0 dirty 0 undo 0" 30
import -window root "$WORK/history.png"
click history.1
wait_state "regions $((REGIONS + 1)) .*working 0 dirty 1 undo 1" 30

# A second editor on the same project says who has it and is read-only; what it does stays its own.
FIRST_PID=$EDITOR_PID FIRST_WORK=$WORK FIRST_WINDOW=$WINDOW
WORK=$WORK/second
mkdir -p "$WORK"
start_editor "$PROJECT"
shown dialog.readOnly 60
import -window root "$WORK/locked.png"
click dialog.readOnly
wait_state 'working 0' 60
kill "$EDITOR_PID"; wait "$EDITOR_PID" 2>/dev/null
EDITOR_PID=$FIRST_PID WORK=$FIRST_WORK WINDOW=$FIRST_WINDOW
grep -q "\"process\": $FIRST_PID" "$PROJECT.lock" || fail "the lock is no longer the first editor's"

# Another program changes the project: saving asks, reloading takes that state, undo brings back what was here.
xdotool windowfocus "$WINDOW" 2>/dev/null
sed -i -E 's/"fovDegrees": [0-9.]+/"fovDegrees": 77.0/' "$PROJECT"
wait_for '^event message Another program has changed room.acentric.json' 20
press_with ctrl s
shown dialog.reload 20
import -window root "$WORK/changed.png"
click dialog.reload
wait_state "regions $REGIONS .*working 0 dirty 0 undo 2" 30
press_with ctrl z
wait_state "regions $((REGIONS + 1)) .*working 0 dirty 1 undo 1" 30
press_with ctrl s
wait_for '^event message Saved room.acentric.json' 20
wait_state 'dirty 0' 20

# The model changes on disk: told, and imported again on the user's word.
printf 'v 0 0 0\nv 0.5 0 0\nv 0 0.5 0\nf 9 10 11\n' >>"$WORK/room.obj"
wait_for '^event message room.obj changed on disk' 20
click tab.problems
shown problem.0.fix 10
import -window root "$WORK/problems.png"
press F5
wait_for '^event message Imported the model again' 30
wait_state 'working 0' 30
kill_editor

# The model is gone: the project opens with what was imported last, and asks where it is.
mkdir -p "$WORK/models" && mv "$WORK/room.obj" "$WORK/models/"
echo '{ half a lock' >"$PROJECT.lock"
start_editor "$PROJECT"
wait_for '^event message The lock beside the project was damaged' 60
shown dialog.later 30
import -window root "$WORK/missing.png"
click dialog.later
wait_state "regions $((REGIONS + 1)) .*working 0 dirty 0" 30
kill_editor

# Ended by the system: the lock goes, and what was not saved is offered the next time.
start_editor "$PROJECT"
shown dialog.later 30
click dialog.later
wait_state "regions $((REGIONS + 1)) .*working 0 dirty 0" 30
add_cell
wait_state "regions $((REGIONS + 2)) .*dirty 1 undo 1" 30
kill "$EDITOR_PID"
wait "$EDITOR_PID" || fail "the editor ended with $? on SIGTERM"
[ -e "$PROJECT.lock" ] && fail "the lock was left"
start_editor "$PROJECT"
shown dialog.recover 30
click dialog.recover
wait_state "regions $((REGIONS + 2)) .*dirty 1" 30
kill_editor
rm -f "$PROJECT.lock"

# A new project that was never saved survives too.
start_editor "$WORK/models/room.obj"
wait_state 'working 0' 60
wait_state 'undo 0 problems' 30
BEFORE=$(field regions)
add_cell
wait_state "regions $((BEFORE + 1)) .*working 0 dirty 1 undo 1" 30
for _ in $(seq 100); do ls "$WORK"/state/acentric/unsaved/*.json >/dev/null 2>&1 && break; sleep 0.1; done
kill_editor
start_editor ""
shown welcome.unsaved.0 20
import -window root "$WORK/unsaved.png"
click welcome.unsaved.0
wait_state "regions $((BEFORE + 1)) .*working 0 dirty 1" 60
kill_editor

# An older project, whose model lies outside its folder: it is asked about, and opens once the model is brought in.
mkdir -p "$WORK/older"
sed 's|"scene": ".*"|"scene": "../models/room.obj"|' "$PROJECT" >"$WORK/older/older.acentric.json"
start_editor "$WORK/older/older.acentric.json"
shown dialog.bring 30
import -window root "$WORK/outside.png"
click dialog.bring
wait_state "regions $((REGIONS + 1)) .*working 0 dirty 0" 60
cmp "$WORK/models/room.obj" "$WORK/older/models/room/room.obj" || fail "the model was not brought in"
grep -q '^event failure' "$WORK/ui.log" && fail "a failure was shown: $(grep '^event failure' "$WORK/ui.log")"
echo "passed: screenshots in $WORK"
