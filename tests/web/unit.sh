#!/usr/bin/env bash
# The page's unit tests and its types. usage: unit.sh WEB_FOLDER
set -euo pipefail
cd -- "$1"
command -v node > /dev/null || { echo "node is not installed: skipped"; exit 77; }
[[ -d node_modules ]] || { echo "the page's packages are not installed (npm ci in $1): skipped"; exit 77; }
[[ -f ../build/page/page.wasm ]] || { echo "the page's module is not built (./test does it): skipped"; exit 77; }
npx --no-install tsc --noEmit
npx --no-install vitest run
