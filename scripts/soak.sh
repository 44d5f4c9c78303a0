#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Runs the tests of docs/reliability.md with large numbers, and a long run with a check of its memory and open
# files; prints a summary table at the end. Takes hours on a small machine.
#
#   scripts/soak.sh                    all tests and the long run
#   scripts/soak.sh 'Disturbed*'       only tests that match this GoogleTest filter
#   scripts/soak.sh long               only the long run
#   SOAK_FACES=200 scripts/soak.sh     a shorter long run (default: 1000 faces)
set -euo pipefail
cd "$(dirname "$0")/.."

filter=${1:-*}
faces=${SOAK_FACES:-1000}
preset=${PRESET:-release}
scripts/install_dependencies.sh
scripts/build.sh "$preset" crowdface crowdface_reliability_test
bin=$PWD/build/$preset/bin
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
table=()
status=0

run_tests() {
  local name names start result=passed
  "$bin/crowdface_reliability_test" --gtest_filter="$filter" --gtest_list_tests >"$work/tests" ||
    { echo "crowdface_reliability_test cannot list its tests" >&2; exit 1; }
  names=$(awk '/^[^ ]/ {suite = $1} /^ / {print suite $1}' "$work/tests")
  [ -n "$names" ] || { echo "no test matches $filter" >&2; exit 1; }
  for name in $names; do
    start=$SECONDS result=passed
    CROWDFACE_SOAK=1 "$bin/crowdface_reliability_test" --gtest_filter="$name" >"$work/log" 2>&1 ||
      { result=FAILED status=1; tail -n 40 "$work/log"; }
    table+=("$(printf '%-62s %-7s %6d s' "$name" "$result" $((SECONDS - start)))")
    echo "${table[-1]}"
  done
}

# Every two seconds, prints a process's resident memory in KiB, its number of open descriptors, and "sheets" or
# "faces": whether the crowd already has the folder `sheets`.
watch_process() {
  while kill -0 "$1" 2>/dev/null; do
    echo "$(awk '/^VmRSS/ {print $2}' "/proc/$1/status" 2>/dev/null || echo 0)" \
      "$(ls "/proc/$1/fd" 2>/dev/null | wc -l)" "$([ -d "$2/sheets" ] && echo sheets || echo faces)"
    sleep 2
  done
}

# Test 17: while the run makes faces, after the first tenth of the time, memory may grow by at most a twentieth, and
# open descriptors by at most four. The table also shows the memory of the sheets, which are made at the end; it has
# no limit, because the sheets' index shows all faces.
long_run() {
  local start=$SECONDS result=passed
  "$bin/crowdface" synth -q -o "$work/heads" --count 6 --vertices 5000 --seed 1
  "$bin/crowdface" init -q "$work/heads" -o "$work/crowd.yaml"
  "$bin/crowdface" generate -q "$work/crowd.yaml" --cache "$work/cache" --out "$work/crowd" \
    --count "$faces" --set diversity.min_distance=0mm --set diversity.min_distance_to_faces=0mm &
  local process=$!
  watch_process $process "$work/crowd" >"$work/watched"
  wait $process || result=FAILED
  "$bin/crowdface" verify -q "$work/crowd" >/dev/null || result=FAILED
  cp "$work/watched" "build/$preset/soak_watched.txt"
  read -r early late fds_early fds_late sheets < <(awk '
    $1 > 0 && $3 == "faces" {rss[++n] = $1; fd[n] = $2}
    $1 > 0 && $3 == "sheets" && $1 > e {e = $1}
    END {
      tenth = int(n / 10) + 1
      for (i = 1; i <= n; ++i) {
        if (i >= tenth && i < 3 * tenth) { if (rss[i] > a) a = rss[i]; if (fd[i] > c) c = fd[i] }
        if (i > n - 2 * tenth) { if (rss[i] > b) b = rss[i]; if (fd[i] > d) d = fd[i] }
      }
      print a, b, c, d, e + 0
    }' "$work/watched")
  [ "$late" -le $((early + early / 20)) ] && [ "$fds_late" -le $((fds_early + 4)) ] || result=FAILED
  [ "$result" = passed ] || status=1
  table+=("$(printf '%-62s %-7s %6d s' "$faces faces: $((early / 1024)) then $((late / 1024)) MiB, sheets $((sheets / 1024)) MiB, $fds_early then $fds_late descriptors" \
    "$result" $((SECONDS - start)))")
}

[ "$filter" = long ] || run_tests
case $filter in '*' | long) long_run ;; esac
echo
printf '%s\n' "${table[@]}"
exit $status
