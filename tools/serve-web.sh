# ./run web. Sourced with `root`, `bin`, `subject` and tools/setup.sh.

# Samples per degree of the sample: a fifth of the bytes of its own, and half a minute to bake.
sampleDensity=4

# serveWeb PROJECT NAME: bakes what is missing, exports with the page, and serves it until Ctrl+C.
serveWeb() {
  local project=$1 name=$2 site=$root/out/$2/web
  mkdir -p -- "$root/out/$name"
  if [[ -z $subject ]]; then
    local sample=$root/out/$name/sample.acentric.json made
    # Beside the copy lie its captures, and a link to the model.
    made=$(sed -e "s|\"samplesPerDegree\": [0-9.]*|\"samplesPerDegree\": $sampleDensity.0|" "$project")
    ln -sfn "$(dirname -- "$project")/gallery.glb" "$root/out/$name/gallery.glb"
    [[ -f $sample && $(< "$sample") == "$made" ]] || printf '%s\n' "$made" > "$sample"
    project=$sample
  fi
  "$bin/acentric" bake "$project" || die "the bake did not finish (above is why); what is done is kept, so run this again."
  "$bin/acentric" export "$project" "$site" --to web || die "the walk was not exported (above is why)."
  exec "$bin/acentric" serve "$site" ${PORT:+--port "$PORT"}
}
