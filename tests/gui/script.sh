# What every script begins with. Sourced with the script's own arguments, EDITOR ACENTRIC WORK_FOLDER: the folder is emptied,
# and the editor keeps its files in it.
set -u
EDITOR=$1
ACENTRIC=$2
WORK=$3
. "$(dirname "$0")/support.sh"
need_tools
rm -rf "$WORK"
mkdir -p "$WORK/config/acentric" "$WORK/cache" "$WORK/state"
export XDG_CONFIG_HOME=$WORK/config XDG_CACHE_HOME=$WORK/cache XDG_STATE_HOME=$WORK/state
trap stop_all EXIT

# make_project MODEL ORIGIN [OPTIONS of `acentric new`]: of it, as $PROJECT, with the lattice at a place that scripts know.
make_project() {
  local model=$1 origin=$2
  shift 2
  { "$ACENTRIC" new "$model" -o "$PROJECT" "$@" && "$ACENTRIC" layout "$PROJECT" --origin "$origin" --apply; } \
    >"$WORK/new.out" 2>&1 || { cat "$WORK/new.out"; exit 1; }
}

# make_room [OPTIONS of `acentric new`]: a small project of a closed room, 6 x 5 x 3 m, faces inwards, as $PROJECT.
make_room() {
  local origin=0,0
  [ $# -gt 0 ] || { origin=0.4,0; set -- --cell 1.2 --outline "-1.8,-1.2;1.8,-1.2;1.8,1.2;-1.8,1.2"; }
  cat >"$WORK/room.obj" <<'OBJ'
v -3 0 -2.5
v 3 0 -2.5
v 3 0 2.5
v -3 0 2.5
v -3 3 -2.5
v 3 3 -2.5
v 3 3 2.5
v -3 3 2.5
f 4 3 2 1
f 5 6 7 8
f 1 2 6 5
f 2 3 7 6
f 3 4 8 7
f 4 1 5 8
OBJ
  PROJECT=$WORK/room.acentric.json
  make_project "$WORK/room.obj" "$origin" --samples-per-degree 1 "$@"
}

# open_project: the display, the editor with $PROJECT in it, at rest
open_project() {
  start_display
  start_editor "$PROJECT"
  wait_for '^event message Opened' 60
  wait_state 'working 0' 60
}

eye() { grep '^event eye' "$WORK/ui.log" | tail -1; }
# rest: until the eye stands and its picture shows
rest() {
  local before='' now
  for _ in $(seq 60); do
    now=$(grep -Ec '^event (eye|frame)' "$WORK/ui.log")
    [ "$now" = "$before" ] && return
    before=$now
    sleep 0.8
  done
  fail "the eye does not come to rest"
}
# apart EYE EYE: metres between two lines of eye
apart() { echo "$1 $2" | awk '{ print sqrt(($10 - $3) ^ 2 + ($11 - $4) ^ 2) }'; }
