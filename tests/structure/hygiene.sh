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
  mapfile -t files < <(find . -type f -not -path './.git' -not -path './.git/*' -not -path './build/*' -not -path './out/*' |
    sed 's,^\./,,' | sort)
fi

status=0
sources=()
for file in "${files[@]}"; do
  case "$file" in
    *.h | *.cpp | *.h.in | *.sh | .ci/run) [ ! -f "$file" ] || sources+=("$file") ;;
  esac
done
awk '
  FNR == (FILENAME ~ /(\.sh|run)$/ ? 2 : 1) {
    if (!/SPDX-License-Identifier: Apache-2.0$/) {
      print FILENAME ":" FNR ": expected // SPDX-License-Identifier: Apache-2.0"
      wrong = 1
    }
    nextfile
  }
  END { exit wrong }' "${sources[@]}" || status=1

# Written in pieces, so that this file does not match itself.
places='(^|[^[:alnum:]_.~}$<>/-])/(home|root|User''s|work|mnt|srv|data)/[[:alnum:]]'
found=$(printf '%s\0' "${files[@]}" | xargs -0 grep -HnaoE --no-messages "$places.*" | cut -c1-200 || true)
# Pictures keep the command that made them, unless it is taken out.
pictures=$(printf '%s\n' "${files[@]}" | grep -E '\.(jpg|png)$' | xargs grep -HnaoE --no-messages '/t''mp/[[:alnum:]]*' |
  tr -d '\0' |
  cut -c1-200 || true)
found+=$pictures
if [ -n "$found" ]; then
  echo "expected no absolute path of a machine, found:"
  echo "$found"
  status=1
fi
exit $status
