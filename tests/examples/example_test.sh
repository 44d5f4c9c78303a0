#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Runs one program of examples/ and checks what it leaves and says.
#   example_test.sh EXAMPLE BIN HEADS
set -euo pipefail
bin=$2
heads=$3
first=$heads/synth_01.obj second=$heads/synth_02.obj
place=$(mktemp -d)
trap 'rm -rf "$place"' EXIT
export XDG_CACHE_HOME=$place/cache

fail() {
  echo "$1" >&2
  exit 1
}
# expect_more A B WHAT: A is the larger number.
expect_more() {
  awk -v a="$1" -v b="$2" 'BEGIN { exit !(a > b) }' || fail "$3: expected more than $2, found $1"
}
distance() {
  local said
  said=$("$bin/distance_between_heads" "$1" "$2")
  [[ $said =~ ^[0-9.e-]+\ mm$ ]] || fail "expected a distance in mm, found '$said'"
  echo "${said% mm}"
}

case $1 in
  BlendTwoHeads)
    "$bin/blend_two_heads" "$first" "$second" "$place/face.obj" | grep -q 'a face of [0-9]* vertices'
    cmp <(grep -v '^vn\? ' "$first") <(grep -v '^vn\? ' "$place/face.obj") ||
      fail 'expected nothing but positions and normals to differ'
    from_target=$(distance "$first" "$place/face.obj")
    from_source=$(distance "$second" "$place/face.obj")
    between_heads=$(distance "$second" "$first")
    expect_more "$from_target" 0.3 'mm from the target'
    expect_more "$between_heads" "$from_source" 'mm between the heads, against face and source'
    ;;
  CrowdOfTen)
    "$bin/crowd_of_ten" "$heads" "$place/ten" | grep -qE '[1-9][0-9]* files, all whole$'
    [ "$(find "$place/ten/meshes" -name 'ten_*.obj' | wc -l)" -eq 10 ] || fail 'expected ten meshes'
    "$bin/crowdface" verify "$place/ten"
    ;;
  SmoothToFiveLevels)
    "$bin/smooth_to_five_levels" "$first" "$place" >"$place/said"
    "$bin/crowdface" smooth "$first" --iterations 10,50,250,1000,10000 -o "$place/expected.obj"
    before=0
    for level in 10 50 250 1000 10000; do
      cmp "$place/smooth_$level.obj" "$place/expected_$level.obj"
      moved=$(sed -nE "s/.*smooth_$level\.obj: moved by up to ([0-9.]+) units/\1/p" "$place/said")
      expect_more "$moved" "$before" "moved by $level iterations"
      before=$moved
    done
    ;;
  DistanceBetweenHeads)
    itself=$(distance "$first" "$first")
    expect_more 1e-9 "$itself" 'mm from a head to itself, at most'
    there=$(distance "$first" "$second")
    expect_more "$there" 1 'two heads, in mm'
    # A head that was moved rigidly (x, y, z to y + 3, -x, z - 2) is as far as before.
    awk '/^v / { print "v", $3 + 3, -$2, $4 - 2; next } { print }' "$second" >"$place/moved.obj"
    moved=$(distance "$first" "$place/moved.obj")
    awk -v a="$there" -v b="$moved" 'BEGIN { d = a - b; exit !(d * d < 1e-6 * a * a) }' ||
      fail "expected $there mm from a head that was moved too, found $moved mm"
    ;;
  *) fail "no such example: $1" ;;
esac
