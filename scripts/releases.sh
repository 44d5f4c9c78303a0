#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Runs the two commands of the README on fresh Debian systems. For each release, makes a minimal system with
# mmdebstrap, copies the working tree into it, and runs scripts/demo.sh and scripts/test.sh there.
#
#   scripts/releases.sh [--short] [RELEASE …]     default: bookworm trixie; forky is testing
#   scripts/releases.sh arm64                     64-bit ARM: cross-built on trixie, run under qemu-user
#
# --short runs only the tests that depend on compilers and libraries (minutes instead of an hour); arm64 implies --short.
# The script first runs the demo on this system; the plans and meshes of all systems must have the same bytes. Writes logs
# and hashes to build/releases/RELEASE. Works as root, or as a user who may create user namespaces.
set -euo pipefail
cd "$(dirname "$0")/.."
short=
if [ "${1-}" = --short ]; then
  short=1
  shift
fi
releases=("$@")
[ ${#releases[@]} -gt 0 ] || releases=(bookworm trixie)

# Modules whose results depend most on compilers and libraries: kernels, images, YAML, and whole crowds with golden hashes.
first_tests='smooth blend cast validity texture render config run'

# hashes DIRECTORY: prints the hashes of its plan and meshes, which must not depend on the system.
hashes() { (cd "$1" && sha256sum plan.jsonl meshes/*.*); }

# Fails if the last build printed warnings; does nothing with --short, which CI runs.
refuse_warnings() { [ -n "$short" ] || ! grep --max-count=20 'warning:' build/release/build.log; }

# run_first_tests BUILD [RUNNER]: runs the tests of `first_tests`; of the module run, only tests of golden hashes.
run_first_tests() {
  local test
  for test in $first_tests; do
    [ "$test" != run ] || export GTEST_FILTER='*Golden*'
    ${2-} "$1/bin/crowdface_${test}_test" --gtest_brief=1
  done
}

# Runs the two commands, in a fresh system.
native() {
  scripts/demo.sh
  refuse_warnings
  if [ -n "$short" ]; then
    scripts/build.sh release $(printf 'crowdface_%s_test ' $first_tests)
    run_first_tests build/release
  else
    scripts/test.sh | tail -n 40
  fi
  refuse_warnings
}

# Runs demo and tests for arm64. Uses this system's heads, because making their textures would take half an hour under emulation.
cross() {
  export DEBIAN_FRONTEND=noninteractive
  apt-get update
  local package packages=(g++-aarch64-linux-gnu qemu-user-static)
  for package in $(scripts/install_dependencies.sh --list); do
    case $package in
      g++ | nodejs | npm) continue ;;
      lib* | openimageio-tools)  # libraries for arm64, unless the package has only tools or headers and is the same for all processors
        [ -z "$(apt-cache show "$package:arm64" 2>/dev/null)" ] || package+=:arm64
        ;;
    esac
    packages+=("$package")
  done
  apt-get install -y --no-install-recommends "${packages[@]}"
  cmake --preset arm64
  cmake --build --preset arm64 --target crowdface $(printf 'crowdface_%s_test ' $first_tests)
  run_first_tests build/arm64 qemu-aarch64-static
  local head
  local crowdface='qemu-aarch64-static build/arm64/bin/crowdface'
  $crowdface synth -o out/arm_heads --count 16 --vertices 20000 --seed 1 --textures 64 --hair
  for head in out/arm_heads/*.obj; do cmp <(grep ^v "$head") <(grep ^v "out/demo_heads/${head##*/}"); done
  $crowdface generate configs/demo.yaml
}

scripts/install_dependencies.sh --releases
inside=$(mktemp)
tree=$(mktemp)
trap 'rm -f "$inside" "$tree"' EXIT
git ls-files -z --cached --others --exclude-standard |
  tar --create --file "$tree" --null --ignore-failed-read --files-from - 2>/dev/null

# in_fresh_root RELEASE ARCHITECTURES COMMAND RESULT: runs COMMAND in a system that mmdebstrap makes and removes at the end. Copies
# this system's certificates, for networks with their own certificates. Accepts expired indices of mirrors (testing's expire after a
# week), because an old state of the archive suffices for a test; apt still checks signatures.
in_fresh_root() {
  {
    echo 'set -euo pipefail; cd /crowdface; export LANG=C.UTF-8'
    declare -p short first_tests
    declare -f hashes refuse_warnings run_first_tests native cross
    echo "$3"
    echo 'hashes out/demo >result/demo.sha256'
  } >"$inside"
  mmdebstrap --quiet --variant=minbase --architectures="$2" --include=ca-certificates --format=null \
    --aptopt='Acquire::Check-Valid-Until "false"' \
    --customize-hook='mkdir -p "$1/crowdface/result"' \
    --customize-hook="tar-in $tree /crowdface" \
    --customize-hook="upload $inside /inside" \
    --customize-hook="upload /etc/ssl/certs/ca-certificates.crt /etc/ssl/certs/ca-certificates.crt" \
    --chrooted-customize-hook="bash /inside" \
    --customize-hook="sync-out /crowdface/result $4" \
    "$1" /dev/null
}

mkdir -p build/releases
scripts/demo.sh >build/releases/demo.log 2>&1 || { tail -n 40 build/releases/demo.log >&2; exit 1; }
hashes out/demo >build/releases/demo.sha256
processor=$(dpkg --print-architecture)

status=0
for release in "${releases[@]}"; do
  result=build/releases/$release
  mkdir -p "$result"
  start=$SECONDS
  echo "$release: a fresh root, then the two commands (log: $result/log)"
  case $release in
    arm64)
      root=(trixie "$processor,arm64" cross "$result")
      tar --append --file "$tree" out/demo_heads
      ;;
    *) root=("$release" "$processor" native "$result") ;;
  esac
  outcome=passed
  in_fresh_root "${root[@]}" >"$result/log" 2>&1 || outcome=FAILED
  grep -E 'tests passed|Total Test time|new faces from|PASSED' "$result/log" || true
  if [ "$outcome" = passed ] && ! diff build/releases/demo.sha256 "$result/demo.sha256" >>"$result/log" 2>&1; then
    outcome='FAILED: the plan and the meshes of the demo differ from those of this system'
  fi
  if [ "$outcome" != passed ]; then
    tail -n 40 "$result/log" >&2
    status=1
  fi
  echo "$release: $outcome ($((SECONDS - start)) s)"
done
exit $status
