#!/usr/bin/env bash
# The page in a real browser, on a small bake of the sample. usage: browser.sh ACENTRIC SAMPLE_GALLERY WEB_FOLDER WORK_FOLDER
set -euo pipefail
acentric=$1 gallery=$2 web=$3 work=$4
here=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd)
command -v node > /dev/null || { echo "node is not installed: skipped"; exit 77; }
chromium=$(command -v chromium || true)
[[ -n $chromium ]] || { echo "chromium is not installed: skipped"; exit 77; }
[[ -d $web/node_modules && -f $web/dist/index.html && -f $web/three/dist/acentric-three.js ]] || { echo "the page is not built (npm ci && npm run build in $web): skipped"; exit 77; }

mkdir -p "$work"
cd -- "$work"
project=$work/walk.acentric.json
[[ -f gallery.glb ]] || "$gallery" gallery.glb
sed -e 's/"samplesPerDegree": [0-9.]*/"samplesPerDegree": 2.0/' -e 's/"ambientRays": [0-9]*/"ambientRays": 4/' \
  -e 's/"surfaceTexel": [0-9.]*/"surfaceTexel": 0.2/' "$here/../../projects/gallery/gallery.acentric.json" > "$project"
"$acentric" bake "$project"
rm -rf site site-lossless
"$acentric" export "$project" site --to web
"$acentric" export "$project" site-lossless --to web --colour-quality 100
exec node "$here/browser.mjs" "$acentric" "$project" "$web" "$work" "$chromium"
