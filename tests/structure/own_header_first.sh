#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# A source file with a header of its own includes it before anything else, so that the header compiles
# alone; and headers may be included twice.
#   own_header_first.sh ROOT
set -euo pipefail
cd "$1/src"

status=0
while read -r header; do
  source=${header%.h}.cpp
  if [ -f "$source" ] && [ "$(grep -m 1 '^ *# *include' "$source")" != "#include \"$header\"" ]; then
    echo "src/$source: expected '#include \"$header\"' before all others"
    status=1
  fi
  # Highway compiles its -inl headers once for each instruction set; they have guards of its kind.
  if [[ $header != *-inl.h ]] && ! grep -qx '#pragma once' "$header"; then
    echo "src/$header: expected #pragma once"
    status=1
  fi
done < <(find . -name '*.h' | sed 's,^\./,,' | sort)
exit $status
