#!/usr/bin/env bash
# po/extract.sh OUT.pot: the English texts of the interface, from the calls of ui/translate.h.
set -euo pipefail
cd "$(dirname -- "${BASH_SOURCE[0]}")/.."
LC_ALL=C.UTF-8 find ui editor \( -name '*.cpp' -o -name '*.h' \) ! -path ui/translate.h ! -path ui/translate.cpp | LC_ALL=C sort |
  xgettext --files-from=- --language=C++ --from-code=UTF-8 --output="$1" --force-po --add-location=file --no-wrap \
    --package-name=Acentric --keyword \
    --keyword=tr:1 --keyword=trPrintf:1 --keyword=trLater:1 --keyword=trIn:1c,2 --keyword=trLaterIn:1c,2 --keyword=trf:1 --keyword=trfMany:1,2 \
    --flag=tr:1:no-c-format --flag=trLater:1:no-c-format --flag=trf:1:no-c-format --flag=trfMany:1:no-c-format \
    --flag=trfMany:2:no-c-format
sed -i '/^"POT-Creation-Date:/d; /^#, no-c-format$/d; s/charset=CHARSET/charset=UTF-8/' "$1"
