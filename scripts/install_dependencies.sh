#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Installs the missing Debian packages of those that crowdface needs; prints nothing if none is missing. Works as root and
# with sudo. Without permission to install, lists the missing packages and exits with 69. Tested on Debian 12 (bookworm),
# Debian 13 (trixie) and Debian testing (forky, November 2026); Ubuntu 24.04 has the same package names.
#
#   scripts/install_dependencies.sh          packages for building and for most tests
#   scripts/install_dependencies.sh --test   also the browser for the tests of the gallery, Doxygen, and packages of the Python module
#   scripts/install_dependencies.sh --package  also packages for scripts/package.sh and the Python module
#   scripts/install_dependencies.sh --farm   only the programs that the tests of farms start: Slurm, GNU parallel, sshd
#   scripts/install_dependencies.sh --docs   also packages for scripts/docs.sh
#   scripts/install_dependencies.sh --check  also packages for scripts/lint.sh and scripts/format.sh
#   scripts/install_dependencies.sh --fuzz   also packages for scripts/fuzz.sh and scripts/bits.sh
#   scripts/install_dependencies.sh --releases  only packages for scripts/releases.sh
#   scripts/install_dependencies.sh --list   prints the packages for building and for most tests; installs nothing
set -euo pipefail
cd "$(dirname "$0")/.."

packages=(
  # compiler and build
  g++ cmake ninja-build pkg-config
  # libraries, see cmake/CrowdfaceDependencies.cmake
  libeigen3-dev libtbb-dev libtinyobjloader-dev libyaml-cpp-dev nlohmann-json3-dev libcli11-dev
  libspdlog-dev libxxhash-dev librandom123-dev libembree-dev libhwy-dev
  libmeshoptimizer-dev libdraco-dev libassimp-dev libpng-dev
  # required by OpenImageIO's CMake package
  libopenimageio-dev openimageio-tools
  # for the labels of contact sheets
  libfreetype-dev fonts-dejavu-core
  # tests and benchmarks
  libgtest-dev libgmock-dev libbenchmark-dev libopenmesh-dev libtinygltf-dev libcpp-httplib-dev
)
python=(pybind11-dev python3-dev python3-numpy)
# For the gallery's page. Skipped if npm is already installed, for example with a node that is not a Debian package.
command -v npm >/dev/null || packages+=(nodejs npm)
case "${1-}" in
  "") ;;
  --test) packages+=(chromium doxygen "${python[@]}" python3-pytest mypy) ;;
  --package) packages+=("${python[@]}" dpkg-dev) ;;
  --docs) packages+=(doxygen) ;;
  --check) packages+=(clang-format clang-tidy) ;;
  --farm) packages=(slurmctld slurmd slurm-client munge parallel openssh-server openssh-client) ;;
  --fuzz) packages+=(clang llvm libclang-rt-dev) ;;
  --releases) packages=(mmdebstrap debian-archive-keyring) ;;
  --list) printf '%s\n' "${packages[@]}"; exit 0 ;;
  *) echo "usage: scripts/install_dependencies.sh [--test | --package | --farm | --docs | --check | --fuzz | --releases | --list]" >&2; exit 64 ;;
esac

# Lists the dependencies by names that do not depend on the distribution.
by_cmake_names() {
  local found='cmake/CrowdfaceDependencies.cmake'
  echo "On this system ($system) nobody has tested crowdface. It needs g++ or clang++ with C++20, CMake 3.25, Ninja and"
  echo "pkg-config; CMake looks for these packages:"
  echo "  $(sed -n 's/^find_package(\([^ )]*\).*/\1/p' $found | grep -v PkgConfig | paste -sd' ')"
  echo "and pkg-config for these:"
  echo "  $(sed -n 's/^pkg_check_modules([^ ]* REQUIRED IMPORTED_TARGET \(.*\))/\1/p' $found | paste -sd' ')"
  echo "and the headers of Random123; the tests need GTest, benchmark, OpenMesh and TinyGLTF, and the labels the font DejaVu Sans."
}

# shellcheck source=/dev/null
system=$(. /etc/os-release 2>/dev/null && echo "${ID-} ${VERSION_ID-${VERSION_CODENAME-}}") || system=unknown
cannot() {
  {
    echo "crowdface needs packages that are not installed:"
    echo "  ${missing[*]}"
    echo "$1 With Debian's names:"
    echo "  apt-get update && apt-get install --no-install-recommends ${missing[*]}"
    case "$system" in "debian 12" | "debian 13" | "debian forky") ;; *) by_cmake_names ;; esac
  } >&2
  exit 69
}

if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
  missing=("${packages[@]}")
  cannot "This system has no apt-get; its packages may have other names."
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
apt update || true  # a package source may be unreachable; install fails if it is needed
apt install -y --no-install-recommends "${missing[@]}" || {
  tail -n 20 "$log" >&2
  cannot "apt-get could not install them (its last words are above)."
}
