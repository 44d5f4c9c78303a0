#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Measures a run at full size, from heads on disk to meshes, points and contact sheets. Prints the time of each
# stage next to its floor (a lower bound, measured just after the run), and one line of a table. Floors: for
# reading, `cat` of the heads; for blending, the benchmark of blending alone (only for 15 heads, and if
# scripts/bench.sh has built it); for writing and for the whole run, `dd conv=fsync` of as many bytes.
#
#   scripts/bench_crowd.sh [HEADS [VERTICES [FACES [OPTION …]]]]      default: 15 1200000 200
#   scripts/bench_crowd.sh --dressed [JOB …]
#
# --dressed measures jobs with textures and hair instead, and prints the wall-clock and processor seconds of whole
# commands; a first run of each job fills the cache. JOBs (default: all): demo film plan version synth. Floors: `cat`
# of the heads' meshes and maps; libdeflate at level 1 (one thread) on one face's maps after PNG filtering; `dd
# conv=fsync` of one face's files.
#
# OPTIONs are those of `crowdface generate`, such as --memory "4 GiB". All files are
# written to out/bench_crowd. The crowd is removed at the end (200 faces of 1.2 million vertices take
# 30 GB); the heads are kept for the next run.
set -euo pipefail
cd "$(dirname "$0")/.."

crowdface=build/release/bin/crowdface
folder=out/bench_crowd
[ -x "$crowdface" ] || { scripts/install_dependencies.sh; scripts/build.sh release crowdface; }
mkdir -p "$folder"
seconds() {  # COMMAND…: its wall-clock seconds
  local start=$EPOCHREALTIME
  "$@" > /dev/null 2>&1
  echo "$EPOCHREALTIME $start" | awk '{ print $1 - $2 }'
}

row() {  # NAME COMMAND…: a line of the table
  local name=$1 TIMEFORMAT='%R %U %S' wall user system
  shift
  { time "$@" > "$folder/log" 2>&1; } 2> "$folder/time" || { cat "$folder/log" >&2; exit 1; }
  read -r wall user system < "$folder/time"
  awk -v n="$name" -v w="$wall" -v u="$user" -v s="$system" 'BEGIN { printf "| %s | %.2f | %.2f |\n", n, w, u + s }'
}
heads_of() {  # NAME OPTION…: makes synthetic heads, unless they exist
  [ -e "$folder/$1/regions.png" ] || "$crowdface" synth -q -o "$folder/$1" --force --seed 1 "${@:2}"
}
crowd_of() {  # NAME FACES: writes a config for these heads
  cat > "$folder/$1.yaml" <<YAML
schema: 1
crowd: {name: bench, count: $2, seed: 7}
faces: {directory: $1, units: cm}
regions: {names: [top, middle, bottom], mask: $1/regions.png}
sampling: {max_sources: 3, smoothness: [0.15, 0.7], extrapolation: [0.9, 1.2]}
YAML
  cat >> "$folder/$1.yaml"
}
make() {  # NAME FACES: generates the whole crowd; from the second call on, with a full cache
  rm -rf "$folder/crowd"
  row "$1, $2 faces" "$crowdface" generate -q --count "$2" --out "$folder/crowd" "$folder/$1.yaml"
}
floors() {  # NAME: lower bounds of the time for the files of these heads and of one face
  local face bytes
  face=$(find "$folder/crowd/meshes" -name '*_0001*')
  bytes=$(echo "$face" | xargs cat | wc -c)
  echo "| floor: $1, reading | $(seconds cat "$folder/$1"/*.{obj,png}) | |"
  echo "| floor: $1, writing a face | $(seconds dd if=/dev/zero of="$folder/floor" bs=1M count=$((bytes / 1048576 + 1)) conv=fsync) | |"
  echo "$face" | python3 -c '
import ctypes, sys, time, zlib
library = ctypes.CDLL("libdeflate.so.0")
library.libdeflate_alloc_compressor.restype = ctypes.c_void_p
library.libdeflate_deflate_compress.restype = ctypes.c_size_t
library.libdeflate_deflate_compress.argtypes = [ctypes.c_void_p] + 2 * [ctypes.c_char_p, ctypes.c_size_t]
compressor, spent = library.libdeflate_alloc_compressor(1), 0.0
for path in sys.stdin.read().split():
    if not path.endswith(".png"): continue
    png, at, packed = open(path, "rb").read(), 8, b""
    while at < len(png):  # chunks: length, type, data, checksum
        size = int.from_bytes(png[at:at + 4], "big")
        if png[at + 4:at + 8] == b"IDAT": packed += png[at + 8:at + 8 + size]
        at += size + 12
    rows = zlib.decompress(packed)
    out = ctypes.create_string_buffer(len(rows))
    start = time.perf_counter()
    library.libdeflate_deflate_compress(compressor, rows, len(rows), out, len(rows))
    spent += time.perf_counter() - start
print(f"| floor: {sys.argv[1]}, packing the maps of a face | {spent:.4f} | |")' "$1"
  rm -rf "$folder/crowd" "$folder/floor"
}
job_demo() {
  heads_of demo --count 16 --vertices 20000 --textures 1024 --hair
  crowd_of demo 1 <<< "attachments: {from: demo/attachments}"
  make demo 1 > /dev/null
  for faces in 24 200; do make demo $faces; done
  floors demo
}
job_film() {
  heads_of film --count 5 --vertices 1200000 --textures 4096
  crowd_of film 1 <<< "output: {meshes: [obj], contact_sheet: none}"
  make film 1 > /dev/null
  for faces in 1 5; do make film $faces; done
  floors film
}
job_plan() {
  heads_of plan --count 16
  crowd_of plan 1 <<< "diversity: {min_distance: 0.5 mm}"
  "$crowdface" prepare -q "$folder/plan.yaml"
  rm -rf "$folder/crowd"
  row "plan of 100,000 faces" "$crowdface" plan -q --count 100000 --out "$folder/crowd" "$folder/plan.yaml"
}
job_version() { row "crowdface --version" "$crowdface" --version; }
job_synth() {
  row "synth --textures 4096, a head" "$crowdface" synth -q -o "$folder/synth" --count 1 --textures 4096 --force
  rm -rf "$folder/synth"
}
if [ "${1:-}" = --dressed ]; then
  shift
  [ $# -gt 0 ] || set -- demo film plan version synth
  echo "| job | seconds | processor seconds |"
  for job in "$@"; do "job_$job"; done
  exit
fi

heads=${1:-15} vertices=${2:-1200000} faces=${3:-200}
shift $(($# < 3 ? $# : 3))
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
making = wall.get("setup", 0) + wall["build"] + wall.get("sheets", 0)
write_floor *= size / 1e6 / megabytes / faces
rows = [("read, s", wall["read"], read_floor), ("write, s a face", busy["write"] / faces, write_floor),
        ("set-up, build and sheets, s a face", making / faces, write_floor)]
if blend_floor:
    rows.insert(1, ("blend, s a face", busy["blend"] / faces, blend_floor / 1e3 * vertices / 1.2e6))
print("| stage | took | floor | ratio |")
for stage, took, floor in rows:
    print(f"| {stage} | {took:.4f} | {floor:.4f} | {took / floor:.1f} |")
print("\n| heads | vertices | faces | read, s | prepare, s | cast, s | set-up, build and sheets, s | faces an hour | " +
      " | ".join(f"{part}, s a face" for part in busy) + " | slowest | peak memory, GiB | written, GB |")
print(f"| {heads} | {vertices:,} | {faces:,} | {wall['read']:.1f} | {wall['prepare']:.1f} | {wall['cast']:.1f} | " +
      f"{making:.1f} | {3600 * faces / making:,.0f} | " +
      " | ".join(f"{seconds / faces:.4f}" for seconds in busy.values()) +
      f" | {timings['slowest']} | {timings['peak_memory_bytes'] / 2**30:.2f} | {size / 1e9:.2f} |")
PYTHON
rm -rf "$folder/crowd"
