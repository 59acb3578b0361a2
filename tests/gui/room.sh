# Sourced after support.sh.
# make_room [OPTIONS of `acentric new`]: a small project of a closed room, 6 x 5 x 3 m, faces inwards, as $PROJECT.
make_room() {
  [ $# -gt 0 ] || set -- --cell 1.2 --outline "-1.8,-1.2;1.8,-1.2;1.8,1.2;-1.8,1.2"
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
  "$ACENTRIC" new "$WORK/room.obj" -o "$PROJECT" --samples-per-degree 1 "$@" >"$WORK/new.out" 2>&1 || { cat "$WORK/new.out"; exit 1; }
}
