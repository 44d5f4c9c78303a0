#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Measures how the time of casting grows with the crowd's size: wall-clock and processor seconds of whole
# `crowdface plan` commands with prepared heads. Prints a table.
#
#   scripts/bench_cast.sh [HEADS_DIR [MASK [MIN_DISTANCE [COUNT …]]]]
#
# Default: 16 synthetic heads of 20,000 vertices in three regions, 0.5 mm, 1000 3000 10000 30000 100000.
set -euo pipefail
cd "$(dirname "$0")/.."

crowdface=build/release/bin/crowdface
folder=out/bench_cast
[ -x "$crowdface" ] || { scripts/install_dependencies.sh; scripts/build.sh release crowdface; }
mkdir -p "$folder"
if [ $# -eq 0 ]; then
  [ -e "$folder/heads/regions.png" ] || "$crowdface" synth -q -o "$folder/heads" --count 16
fi
heads=$(realpath "${1:-$folder/heads}") mask=$(realpath -m "${2:-$folder/heads/regions.png}")
distance=${3:-0.5 mm}
shift $(($# < 3 ? $# : 3))
[ $# -gt 0 ] || set -- 1000 3000 10000 30000 100000

cat > "$folder/cast.yaml" <<YAML
schema: 1
crowd: {name: cast, count: 1, seed: 1}
faces: {directory: "$heads", units: cm}
regions: {names: [top, middle, bottom], mask: "$mask"}
diversity: {min_distance: $distance}
output: {directory: crowd, meshes: [], contact_sheet: none}
YAML
"$crowdface" prepare -q "$folder/cast.yaml"
echo "| faces | min_distance | seconds | processor seconds | processor ms a face |"
TIMEFORMAT='%R %U %S'
for count in "$@"; do
  rm -rf "$folder/crowd"
  read -r wall user system < <({ time "$crowdface" plan -q --count "$count" "$folder/cast.yaml" >"$folder/log" 2>&1; } 2>&1) || true
  [ -e "$folder/crowd/plan.jsonl" ] || { cat "$folder/log" >&2; exit 1; }
  awk -v n="$count" -v d="$distance" -v w="$wall" -v u="$user" -v s="$system" \
    'BEGIN { printf "| %d | %s | %.1f | %.1f | %.2f |\n", n, d, w, u + s, 1000 * (u + s) / n }'
done
