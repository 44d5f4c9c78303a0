#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The main job at full size, from heads on disk to meshes, points and contact sheets: what a night's
# work takes on this machine. Prints one line of a table.
#
#   scripts/bench_crowd.sh [HEADS [VERTICES [FACES [OPTION …]]]]      default: 15 1200000 200
#
# OPTIONs are those of `crowdface generate`, such as --memory "4 GiB". Everything goes to
# out/bench_crowd, the crowd itself is removed at the end (200 faces of 1.2 million vertices take
# 30 GB); the heads stay for the next time.
set -euo pipefail
cd "$(dirname "$0")/.."

heads=${1:-15} vertices=${2:-1200000} faces=${3:-200}
shift $(($# < 3 ? $# : 3))
crowdface=build/release/bin/crowdface
folder=out/bench_crowd
[ -x "$crowdface" ] || { scripts/install_dependencies.sh; scripts/build.sh release crowdface; }

mkdir -p "$folder"
source=$folder/heads_${heads}_$vertices
[ -e "$source/regions.png" ] || "$crowdface" synth -q -o "$source" --count "$heads" --vertices "$vertices"
config=$folder/crowd.yaml
cat > "$config" <<YAML
schema: 1
crowd: {name: bench, count: $faces, seed: 1}
faces: {directory: $(basename "$source"), units: cm}
regions: {names: [top, middle, bottom], mask: $(basename "$source")/regions.png}
sampling: {smoothness: [0.15, 0.7], extrapolation: [0.9, 1.2]}
output:
  directory: crowd
  meshes: [obj, points]
  contact_sheet: {columns: 10, rows: 10, cell: 256}
YAML
rm -rf "$folder/crowd"
"$crowdface" generate "$config" "$@"
bytes=$(du -sb "$folder/crowd" | cut -f1)
python3 - "$folder/crowd/timings.json" "$heads" "$vertices" "$faces" "$bytes" <<'PYTHON'
import json, sys
timings = json.load(open(sys.argv[1]))
heads, vertices, faces, size = (int(text) for text in sys.argv[2:])
wall, busy = timings["seconds"], timings["busy_seconds"]
making = wall["build"] + wall.get("sheets", 0)
print("| heads | vertices | faces | read, s | prepare, s | cast, s | build and sheets, s | faces an hour | " +
      " | ".join(f"{part}, s a face" for part in busy) + " | slowest | peak memory, GiB | written, GB |")
print(f"| {heads} | {vertices:,} | {faces:,} | {wall['read']:.1f} | {wall['prepare']:.1f} | {wall['cast']:.1f} | " +
      f"{making:.1f} | {3600 * faces / making:,.0f} | " +
      " | ".join(f"{seconds / faces:.4f}" for seconds in busy.values()) +
      f" | {timings['slowest']} | {timings['peak_memory_bytes'] / 2**30:.2f} | {size / 1e9:.2f} |")
PYTHON
rm -rf "$folder/crowd"
