#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The main job at full size, from heads on disk to meshes, points and contact sheets: what a night's
# work takes on this machine. Prints what each stage took beside its floor, measured just after, and one
# line of a table. Floors: reading, `cat` of the heads; blending, the bare benchmark (if scripts/bench.sh has
# built it, 15 heads); writing and the whole, `dd conv=fsync` of as many bytes.
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
seconds() {  # of the clock, that a command takes
  local start=$EPOCHREALTIME
  "$@" > /dev/null 2>&1
  echo "$EPOCHREALTIME $start" | awk '{ print $1 - $2 }'
}
read_floor=$(seconds cat "$source"/*.obj)
megabytes=$((bytes / 1000000 < 2000 ? bytes / 1000000 + 1 : 2000))
write_floor=$(seconds dd if=/dev/zero of="$folder/crowd/floor" bs=1MB count=$megabytes conv=fsync)
bench=build/release/bin/crowdface_blend_bench
blend_floor=
if [ "$heads" -eq 15 ] && [ -x $bench ]; then
  blend_floor=$($bench --benchmark_filter=heads:15/rank:12/faces:32 2> /dev/null | sed -n 's/.* ms_a_face=\([0-9.]*\).*/\1/p')
fi
python3 - "$folder/crowd/timings.json" "$heads" "$vertices" "$faces" "$bytes" \
  "$read_floor" "$write_floor" "$megabytes" "${blend_floor:-0}" <<'PYTHON'
import json, sys
timings = json.load(open(sys.argv[1]))
heads, vertices, faces, size = (int(text) for text in sys.argv[2:6])
read_floor, write_floor, megabytes, blend_floor = (float(text) for text in sys.argv[6:])
wall, busy = timings["seconds"], timings["busy_seconds"]
making = wall["build"] + wall.get("sheets", 0)
write_floor *= size / 1e6 / megabytes / faces
rows = [("read, s", wall["read"], read_floor), ("write, s a face", busy["write"] / faces, write_floor),
        ("build and sheets, s a face", making / faces, write_floor)]
if blend_floor:
    rows.insert(1, ("blend, s a face", busy["blend"] / faces, blend_floor / 1e3 * vertices / 1.2e6))
print("| stage | took | floor | ratio |")
for stage, took, floor in rows:
    print(f"| {stage} | {took:.4f} | {floor:.4f} | {took / floor:.1f} |")
print("\n| heads | vertices | faces | read, s | prepare, s | cast, s | build and sheets, s | faces an hour | " +
      " | ".join(f"{part}, s a face" for part in busy) + " | slowest | peak memory, GiB | written, GB |")
print(f"| {heads} | {vertices:,} | {faces:,} | {wall['read']:.1f} | {wall['prepare']:.1f} | {wall['cast']:.1f} | " +
      f"{making:.1f} | {3600 * faces / making:,.0f} | " +
      " | ".join(f"{seconds / faces:.4f}" for seconds in busy.values()) +
      f" | {timings['slowest']} | {timings['peak_memory_bytes'] / 2**30:.2f} | {size / 1e9:.2f} |")
PYTHON
rm -rf "$folder/crowd"
