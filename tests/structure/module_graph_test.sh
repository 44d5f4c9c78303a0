#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# scripts/module_graph.sh accepts a downward include, and fails on an upward one, on one between
# modules of the same floor, on the umbrella header in a module, on an unknown module and on a stale page.
#   module_graph_test.sh ROOT
set -euo pipefail
script=$1/scripts/module_graph.sh
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT
mkdir -p "$tree"/src/crowdface/{core,mesh,plane,smooth,thing} "$tree"/docs
printf '%s\n' '# Page' '<!-- module graph: begin, by scripts/module_graph.sh -->' \
  '<!-- module graph: end -->' 'after' >"$tree/docs/architecture.md"

fail() {
  echo "module_graph.sh: $1"
  exit 1
}
# expect_error TEXT: fails and says TEXT.
expect_error() {
  local said
  if said=$("$script" "$tree" 2>&1); then fail "accepted what it should refuse: $1"; fi
  grep -qF "$1" <<<"$said" || fail "expected '$1', said '$said'"
}

echo '#include "crowdface/core/a.h"' >"$tree/src/crowdface/mesh/a.cpp"
drawn=$("$script" "$tree")
grep -qF 'mesh --> core' <<<"$drawn" || fail 'does not draw mesh --> core'

"$script" --check "$tree" >/dev/null 2>&1 && fail 'accepts a stale page'
"$script" --write "$tree"
"$script" --check "$tree" || fail 'does not accept the page it wrote'
[ "$(tail -n 1 "$tree/docs/architecture.md")" = after ] || fail 'lost text behind the graph'

echo '#  include <crowdface/smooth/a.h>' >"$tree/src/crowdface/mesh/b.h"
expect_error 'src/crowdface/mesh/b.h:1: mesh (floor 1) includes smooth (floor 2)'
echo '#include "crowdface/plane/a.h"' >"$tree/src/crowdface/mesh/b.h"
expect_error 'src/crowdface/mesh/b.h:1: mesh (floor 1) includes plane (floor 1)'
echo '#include "crowdface/crowdface.h"' >"$tree/src/crowdface/mesh/b.h"
expect_error 'src/crowdface/mesh/b.h:1: mesh (floor 1) includes crowdface (floor 11)'
rm "$tree/src/crowdface/mesh/b.h"
echo '#include "crowdface/core/a.h"' >"$tree/src/crowdface/thing/a.cpp"
expect_error 'module thing has no floor'
