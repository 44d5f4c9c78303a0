#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Installs the Debian 12 packages that crowdface needs and that are not there yet. Silent and quick
# when none is missing. Works as root and with sudo; where it may not install, it says what is
# missing and exits with 69.
#
#   scripts/install_dependencies.sh          what building needs, and most tests
#   scripts/install_dependencies.sh --test   and the browser that the gallery is tested in, and Doxygen
#   scripts/install_dependencies.sh --farm   only what the tests of farms start: Slurm, GNU parallel, sshd
#   scripts/install_dependencies.sh --docs   and what scripts/docs.sh needs
#   scripts/install_dependencies.sh --check  and what scripts/lint.sh and scripts/format.sh need
#   scripts/install_dependencies.sh --fuzz   and what scripts/fuzz.sh and scripts/bits.sh need
set -euo pipefail

packages=(
  # compiler and build
  g++ cmake ninja-build pkg-config
  # libraries, see cmake/CrowdfaceDependencies.cmake
  libeigen3-dev libtbb-dev libtinyobjloader-dev libyaml-cpp-dev nlohmann-json3-dev libcli11-dev
  libspdlog-dev libxxhash-dev librandom123-dev libembree-dev libhwy-dev
  libmeshoptimizer-dev libcpp-httplib-dev libpng-dev
  # OpenImageIO's CMake package insists on its command-line tools
  libopenimageio-dev openimageio-tools
  # the labels of contact sheets
  libfreetype-dev fonts-dejavu-core
  # tests and benchmarks
  libgtest-dev libgmock-dev libbenchmark-dev libopenmesh-dev libtinygltf-dev
)
# The gallery's page; node may have come from elsewhere, with npm in it.
command -v npm >/dev/null || packages+=(nodejs npm)
case "${1-}" in
  "") ;;
  --test) packages+=(chromium doxygen) ;;
  --docs) packages+=(doxygen) ;;
  --check) packages+=(clang-format clang-tidy) ;;
  --farm) packages=(slurmctld slurmd slurm-client munge parallel openssh-server openssh-client) ;;
  --fuzz) packages+=(clang llvm-14 libclang-rt-14-dev) ;;
  *) echo "usage: scripts/install_dependencies.sh [--test | --farm | --docs | --check | --fuzz]" >&2; exit 64 ;;
esac

cannot() {
  {
    echo "crowdface needs Debian packages that are not installed:"
    echo "  ${missing[*]}"
    echo "$1 Install them with:"
    echo "  apt-get update && apt-get install --no-install-recommends ${missing[*]}"
  } >&2
  exit 69
}

if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
  missing=("${packages[@]}")
  cannot "This system has no apt-get; the packages have other names here."
fi

installed=$(dpkg-query -W -f '${db:Status-Status} ${Package}\n' "${packages[@]}" 2>/dev/null || true)
missing=()
for package in "${packages[@]}"; do
  grep -qx "installed $package" <<<"$installed" || missing+=("$package")
done
[ ${#missing[@]} -eq 0 ] && exit 0

as_root=(env)
if [ "$(id -u)" -ne 0 ]; then
  if ! command -v sudo >/dev/null; then
    cannot "You are not root and there is no sudo."
  elif sudo -n true 2>/dev/null; then
    as_root=(sudo -n env)
  elif [ -t 0 ]; then
    echo "sudo may ask for your password to install packages."
    as_root=(sudo env)
  else
    cannot "You are not root, and sudo cannot ask for a password without a terminal."
  fi
fi

log=$(mktemp)
trap 'rm -f "$log"' EXIT
apt() {
  "${as_root[@]}" DEBIAN_FRONTEND=noninteractive apt-get -q -o DPkg::Lock::Timeout=300 "$@" \
    >>"$log" 2>&1 </dev/null
}
echo "installing ${missing[*]}"
[ "${as_root[0]}" = env ] || "${as_root[@]}" true  # the password, before the output is hidden
apt update || true  # some other source may be out of reach; whether it matters, install finds out
apt install -y --no-install-recommends "${missing[@]}" || {
  tail -n 20 "$log" >&2
  cannot "apt-get could not install them (its last words are above)."
}
