#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Configures and builds a preset of CMakePresets.json, quietly.
#
#   scripts/build.sh PRESET [TARGET …]      into build/PRESET; without a target, everything
set -euo pipefail
cd "$(dirname "$0")/.."
preset=${1:?"usage: scripts/build.sh PRESET [TARGET …]"}
shift

options=()
command -v ccache >/dev/null && options+=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
# Let ccache cache sources that use a precompiled header (cmake/CrowdfaceModule.cmake).
export CCACHE_SLOPPINESS=pch_defines,time_macros
targets=()
[ $# -gt 0 ] && targets=(--target "$@")

mkdir -p "build/$preset"
log=build/$preset/build.log
quietly() {
  "$@" >"$log" 2>&1 </dev/null || {
    tail -n 60 "$log" >&2
    echo "failed: $* (everything it said: $log)" >&2
    exit 1
  }
}

# Compiling several sources together takes up to a gigabyte of memory.
jobs=$(awk -v most="$(nproc)" '/^MemAvailable/ { room = int($2 / 1048576) }
  END { print room < 1 ? 1 : room < most ? room : most }' /proc/meminfo)

start=$SECONDS
echo "configuring build/$preset"
quietly cmake --preset "$preset" "${options[@]}"
echo "building build/$preset (some minutes the first time)"
if [ -t 1 ]; then
  cmake --build --preset "$preset" --parallel "$jobs" "${targets[@]}"
else
  quietly cmake --build --preset "$preset" --parallel "$jobs" "${targets[@]}"
fi
# Also build the gallery. It is optional: without npm or without its registry, the rest works.
case " $* " in
  "  " | *" crowdface "*)
    scripts/build_gallery.sh "$preset" || echo "no gallery's page (crowds get none until it is built)"
    ;;
esac
echo "built in $((SECONDS - start)) s"
