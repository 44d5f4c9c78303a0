#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# No file pair includes itself over others. A pair is NAME.h with NAME.cpp in one folder; a file alone is
# a pair of its own. Prints each circle as a path, for every include on a circle the shortest one through
# it.
#   file_circles.sh ROOT
set -euo pipefail
known=$(realpath "${2-/dev/null}")
cd "$1/src"
export LC_ALL=C

# "pair pair" for every include of ours, without the folder crowdface/.
includes() {
  find . -name '*.h' -o -name '*.cpp' -o -name '*.in' | sort |
    xargs grep -oE '^[[:space:]]*#[[:space:]]*include[[:space:]]*["<](crowdface|cli)/[^">]*' /dev/null |
    sed -E 's,^\./,,; s,:.*["<], ,; s,(^| )crowdface/,\1,g; s,\.(h|cpp|h\.in)( |$),\2,g' |
    awk '$1 != $2' | sort -u
}

circles() {
  includes | awk '
    { from[NR] = $1; to[NR] = $2; next_of[$1] = next_of[$1] " " $2 }
    # The shortest path from a to b, both named in it, or nothing.
    function path(a, b,   queue, before, seen, head, tail, pairs, count, i, way) {
      queue[tail = 1] = a; seen[a]
      for (head = 1; head <= tail && !(b in seen); ++head) {
        count = split(next_of[queue[head]], pairs, " ")
        for (i = 1; i <= count; ++i) {
          if (pairs[i] in seen) continue
          seen[pairs[i]]; before[pairs[i]] = queue[head]; queue[++tail] = pairs[i]
        }
      }
      if (!(b in seen)) return ""
      for (way = b; b != a; way = b " " way) b = before[b]
      return way
    }
    # A circle has no beginning: it is told from its first name in the alphabet on.
    function from_first_name(way,   pairs, count, first, i, told) {
      count = split(way, pairs, " ")
      first = 1
      for (i = 2; i <= count; ++i) if (pairs[i] < pairs[first]) first = i
      for (i = 0; i < count; ++i) told = told pairs[(first - 1 + i) % count + 1] " -> "
      return told pairs[first]
    }
    END {
      for (i = 1; i <= NR; ++i) if ((way = path(to[i], from[i])) != "") print from_first_name(way)
    }' | sort -u
}

found=$(circles)
[ -z "$found" ] && exit 0
echo "expected no circles of file pairs, found:"
echo "$found"
exit 1
