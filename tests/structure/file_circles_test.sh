#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# file_circles.sh accepts a chain, refuses a circle of three pairs over header and source, forgives a known
# one, and refuses a known one that is gone.
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
# expect_error TEXT [KNOWN]: fails and says TEXT.
expect_error() {
  local said
  if said=$("$script" "$tree" "${@:2}"); then fail "accepted what it should refuse: $1"; fi
  grep -qxF "$1" <<<"$said" || fail "expected '$1', said '$said'"
}

echo '#include "crowdface/core/b.h"' >"$files/a.h"
echo '#include "crowdface/core/a.h"' >"$files/a.cpp"
echo '#  include <crowdface/core/c.h>' >"$files/b.cpp"
echo '#include "crowdface/core/a.h"' >"$files/alone.cpp"
touch "$files/b.h" "$files/c.h"
"$script" "$tree" || fail 'refuses a chain'

echo '#include "crowdface/core/a.h"' >"$files/c.h"
circle='core/a -> core/b -> core/c -> core/a'
expect_error "$circle"
echo "$circle" >"$tree/known"
"$script" "$tree" "$tree/known" || fail 'refuses a known circle'
rm "$files/c.h"
expect_error "$circle" "$tree/known"
