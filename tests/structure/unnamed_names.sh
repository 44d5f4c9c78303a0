#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Sources of a module are compiled together (CMake's unity builds) and see each other's unnamed namespaces. A
# function there that is called as one of a header is might be taken for it by the module's other sources,
# without a word. (Two that clash do not compile.)
#   unnamed_names.sh ROOT
set -euo pipefail
cd "$1/src"

# What a line at its beginning declares: `Type name(`. awk has no way to capture but this.
found=$(
  find . -name '*.h' -o -name '*.cpp' | sed 's,^\./,,' | sort | xargs awk '
    FNR == 1 {
      module = FILENAME; sub(/\/[^\/]*$/, "", module)
      header = FILENAME ~ /\.h$/; unnamed = 0
    }
    /^namespace \{/ { unnamed = 1 }
    /^}  \/\/ namespace$/ { unnamed = 0 }
    /^(inline |constexpr |\[\[[a-z]+\]\] )*[A-Za-z_][A-Za-z0-9_:<>,&* ]*[ &*][a-z_][a-z0-9_]*\(/ && !/^(return|else) / {
      name = $0; sub(/\(.*/, "", name); sub(/.*[ &*]/, "", name)
      if (header) of_header[name] = FILENAME
      else if (unnamed) { owner[module, name] = FILENAME; next }
    }
    !header {
      rest = $0
      while (match(rest, /(^|[^A-Za-z0-9_.>:])[a-z_][a-z0-9_]*\(/)) {
        name = substr(rest, RSTART, RLENGTH - 1); sub(/^[^a-z_]/, "", name)
        calls[module, name] = calls[module, name] " " FILENAME
        rest = substr(rest, RSTART + RLENGTH)
      }
    }
    END {
      for (key in owner) {
        split(key, part, SUBSEP)
        if (!(part[2] in of_header)) continue
        count = split(calls[key], files, " ")
        for (i = 1; i <= count; ++i) {
          if (files[i] == owner[key]) continue
          print owner[key] ": " part[2] " is called as one of " of_header[part[2]] ", which " files[i] " may mean"
          break
        }
      }
    }' | sort
)
[ -z "$found" ] && exit 0
echo "expected names of functions in unnamed namespaces that no header has:"
echo "$found"
exit 1
