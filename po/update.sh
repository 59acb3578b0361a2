#!/usr/bin/env bash
# po/update.sh: brings the texts that are new or changed into each catalogue; translate those, then build.
set -euo pipefail
here=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd)
pot=$(mktemp --suffix=.pot)
trap 'rm -f "$pot"' EXIT
"$here/extract.sh" "$pot"
while read -r language; do
  msgmerge --quiet --update --backup=none --no-wrap --add-location=file "$here/$language.po" "$pot"
  echo "$language: $(LC_ALL=C msgfmt --check --statistics --output-file=/dev/null "$here/$language.po" 2>&1)"
done <"$here/LINGUAS"
