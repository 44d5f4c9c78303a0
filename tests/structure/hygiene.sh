#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Every source file names its licence on its first line (scripts: below the shebang), and no file
# names a place on somebody's machine.
#   hygiene.sh ROOT
set -euo pipefail
cd "$1"

if git rev-parse --is-inside-work-tree >/dev/null 2>&1; then
  mapfile -t files < <(git ls-files --cached --others --exclude-standard)
else
  mapfile -t files < <(find . -type f -not -path './build/*' -not -path './out/*' |
    sed 's,^\./,,' | sort)
fi

status=0
for file in "${files[@]}"; do
  [ -f "$file" ] || continue
  line=1
  case "$file" in
    *.h | *.cpp | *.h.in) ;;
    *.sh | .ci/run) line=2 ;;
    *) continue ;;
  esac
  if [[ $(sed -n "${line}{p;q}" "$file") != *"SPDX-License-Identifier: Apache-2.0" ]]; then
    echo "$file:$line: expected '// SPDX-License-Identifier: Apache-2.0'"
    status=1
  fi
done

# Written in pieces, so that this file does not match itself.
places='(^|[^[:alnum:]_.~}$<>/-])/(home|root|User''s|work|mnt|srv|data)/[[:alnum:]]'
for file in "${files[@]}"; do
  [ -f "$file" ] || continue
  if grep -HnIE "$places" "$file"; then
    echo "$file: expected no absolute path of a machine"
    status=1
  fi
done
exit $status
