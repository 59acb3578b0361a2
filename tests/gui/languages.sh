#!/bin/bash
# The editor in German and in Japanese: as the preferences say, as the system says, and changed while it runs; commands are
# found by the name that is shown and by the English one.
#   languages.sh EDITOR ACENTRIC WORK_FOLDER
. "$(dirname "$0")/script.sh" "$@"
make_room
PREFERENCES=$WORK/config/acentric/editor.json

spoken() { grep '^event language' "$WORK/ui.log" | tail -1 | cut -d' ' -f3; }
# width NAME: of a widget, pixels
width() { rect "$1" | awk '{ print $5 - $3 }'; }
# is_found ACTION: the look-up shows it, and not every command
is_found() { rect "command.$1" >/dev/null && ! rect command.tool.cells >/dev/null; }
# finds TEXT ACTION: the look-up of commands shows that action for what is typed, at once after its key
finds() {
  xdotool key ctrl+shift+p
  xdotool type "$1"
  wait_until 10 is_found "$2" || fail "\"$1\" does not find $2"
  press Escape
  wait_until 10 is_gone commands.query || fail "Esc does not close the look-up"
}
# choose_language STEPS: in the preferences, so many lines below or (Up) above the one that is chosen
choose_language() {
  press_with ctrl comma
  wait_until 10 rect preferences.language >/dev/null || fail "the preferences do not open"
  click preferences.language
  for _ in $(seq "$2"); do press "$1" 0.1; done
  press Return 0.1
}

start_display

# German by the preferences.
echo '{ "guideSeen": true, "language": "de" }' >"$PREFERENCES"
start_editor "$PROJECT"
wait_for '^event message room.acentric.json geöffnet' 60
wait_state 'working 0' 60
[ "$(spoken)" = de ] || fail "it speaks $(spoken), not German"
GERMAN=$(width menu.File)
finds Speichern file.save
finds save file.save
import -window "$WINDOW" "$WORK/de.png"

# English at once, the dialog still open; the choice is kept.
choose_language Up 1
wait_for '^event language en' 10
wait_until 10 rect dialog.ok >/dev/null || fail "the dialog closed as the language changed"
press Escape
wait_until 10 is_gone dialog.ok || fail "Esc does not close the preferences"
wait_until 10 grep -q '"language": *"en"' "$PREFERENCES" || fail "the language is not kept"
[ "$(width menu.File)" != "$GERMAN" ] || fail "the menus are as wide as in German"
import -window "$WINDOW" "$WORK/en.png"
cmp -s "$WORK/de.png" "$WORK/en.png" && fail "English looks like German"
leave_editor

# Japanese by the system, in a locale that is not installed.
echo '{ "guideSeen": true }' >"$PREFERENCES"
LANGUAGE=ja:en start_editor "$PROJECT"
wait_for '^event message room.acentric.jsonを開きました' 60
wait_state 'working 0' 60
[ "$(spoken)" = ja ] || fail "it speaks $(spoken), not Japanese"
grep -q '^event message .*fonts-vlgothic' "$WORK/ui.log" && fail "the Japanese font is missing"
finds undo edit.undo
import -window "$WINDOW" "$WORK/ja.png"
choose_language Down 2
wait_for '^event language de' 10
press Escape
wait_until 10 is_gone dialog.ok || fail "Esc does not close the preferences"
leave_editor
grep -q '"language": *"de"' "$PREFERENCES" || fail "German is not kept"

# The locale C is English.
LC_ALL=C LANGUAGE=de start_editor "$PROJECT"
wait_state 'working 0' 60
[ "$(spoken)" = de ] || fail "the preferences come before the system"
leave_editor
echo '{ "guideSeen": true, "language": "" }' >"$PREFERENCES"
LC_ALL=C LANGUAGE=de start_editor "$PROJECT"
wait_for '^event message Opened room.acentric.json' 60
leave_editor
echo "German, Japanese and English, chosen, changed and from the system"
