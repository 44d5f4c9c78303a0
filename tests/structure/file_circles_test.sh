#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# file_circles.sh accepts a chain and refuses a circle of three pairs over header and source.
#   file_circles_test.sh ROOT
set -euo pipefail
script=$1/tests/structure/file_circles.sh
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT
files=$tree/src/crowdface/core
mkdir -p "$files"

fail() {
  echo "file_circles.sh: $1"
  exit 1
}
echo '#include "crowdface/core/b.h"' >"$files/a.h"
echo '#include "crowdface/core/a.h"' >"$files/a.cpp"
echo '#  include <crowdface/core/c.h>' >"$files/b.cpp"
echo '#include "crowdface/core/a.h"' >"$files/alone.cpp"
touch "$files/b.h" "$files/c.h"
"$script" "$tree" || fail 'refuses a chain'

echo '#include "crowdface/core/a.h"' >"$files/c.h"
circle='core/a -> core/b -> core/c -> core/a'
if said=$("$script" "$tree"); then fail 'accepts a circle'; fi
grep -qxF "$circle" <<<"$said" || fail "expected '$circle', said '$said'"
