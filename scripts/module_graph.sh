#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Draws the module graph from the #include lines. A module may include only modules of lower layers; for other
# includes, prints file and line, and exits with 1.
#
#   scripts/module_graph.sh                 prints the graph (Mermaid)
#   scripts/module_graph.sh --write         writes it into docs/architecture.md, between the markers
#   scripts/module_graph.sh --check         fails if docs/architecture.md has a different graph
#   … ROOT                                  uses the source tree ROOT (for tests)
set -euo pipefail

mode=print
case "${1-}" in
  --write | --check) mode=${1#--}; shift ;;
  --*) echo "usage: scripts/module_graph.sh [--write | --check] [ROOT]" >&2; exit 64 ;;
esac
cd "${1:-$(dirname "$0")/..}"
export LC_ALL=C
page=docs/architecture.md
begin='<!-- module graph: begin, by scripts/module_graph.sh -->'
end='<!-- module graph: end -->'

# The layer of each module (docs/architecture.md).
floors='core 0
mesh 1
plane 1
io 2
smooth 2
validity 2
preview 2
region 3
render 3
synth 3
page 3
parts 3
traits 3
lod 4
paint 4
shapes 4
attach 4
blend 4
morph 4
cast 5
wrap 5
texture 5
neck 6
config 6
crowd 6
pick 7
heads 7
pictures 8
bake 8
run 9
editor 10
cli 11
crowdface 11'

# Prints "file:line includer included" for each include of a project header. The umbrella header,
# crowdface/crowdface.h, counts as a module `crowdface`.
includes() {
  find src -name '*.h' -o -name '*.cpp' -o -name '*.in' | sort |
    xargs grep -HnoE '^[[:space:]]*#[[:space:]]*include[[:space:]]*["<]((crowdface|head_models)/[a-z_]+|cli)[/.][^">]*' |
    awk '{
      split($0, at, ":")
      from = at[1]; sub(/^src\//, "", from); sub(/^(crowdface|head_models)\//, "", from); sub(/[\/.].*/, "", from)
      to = $0; sub(/.*["<]/, "", to); sub(/^(crowdface|head_models)\//, "", to); sub(/[\/.].*/, "", to)
      print at[1] ":" at[2], from, to
    }'
}

graph() {
  { echo "$floors"; echo; includes; } | awk '
    BEGIN { wrong = 0 }
    NF == 0 { reading_includes = 1; next }
    !reading_includes { floor[$1] = $2; module[++modules] = $1; next }
    {
      for (i = 2; i <= 3; ++i) {
        if (!($i in floor)) {
          print $1 ": module " $i " has no floor in scripts/module_graph.sh" > "/dev/stderr"
          wrong = 1; next
        }
      }
      if ($2 == $3) next
      if (floor[$2] <= floor[$3]) {
        print $1 ": " $2 " (floor " floor[$2] ") includes " $3 " (floor " floor[$3] ")" \
          ": includes must point downwards" > "/dev/stderr"
        wrong = 1
      }
      uses[$2, $3] = 1
    }
    # Whether a path of includes leads down from a to b through at least one other module.
    function reaches(a, b,   i, via) {
      for (i = 1; i <= modules; ++i) {
        via = module[i]
        if (via != b && (a, via) in uses && floor[via] < floor[a] &&
            ((via, b) in uses || reaches(via, b))) return 1
      }
      return 0
    }
    END {
      if (wrong) exit 1
      print "```mermaid\nflowchart TD"
      for (i = modules; i >= 1; --i) {
        for (j = modules; j >= 1; --j) {
          if ((module[i], module[j]) in uses && !reaches(module[i], module[j])) {
            print "  " module[i] " --> " module[j]
          }
        }
      }
      print "```\n\nThe graph leaves out arrows that other arrows imply."
    }'
}

drawn=$(graph)
if [ "$mode" = print ]; then
  echo "$drawn"
  exit 0
fi

if ! grep -qxF "$begin" "$page" || ! grep -qxF "$end" "$page"; then
  echo "$page: expected the lines '$begin' and '$end', found none" >&2
  exit 1
fi
updated=$(GRAPH=$drawn BEGIN_MARK=$begin END_MARK=$end awk '
  $0 == ENVIRON["END_MARK"] { inside = 0 }
  !inside { print }
  $0 == ENVIRON["BEGIN_MARK"] { print ENVIRON["GRAPH"]; inside = 1 }' "$page")
if [ "$mode" = write ]; then
  printf '%s\n' "$updated" >"$page"
elif ! diff -u "$page" <(printf '%s\n' "$updated"); then
  echo "$page: the module graph is stale; scripts/module_graph.sh --write draws it anew" >&2
  exit 1
fi
