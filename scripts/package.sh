#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Makes Debian packages for this system's Debian release, and a source tarball of the last commit, in build/packages.
#
#   scripts/package.sh           builds the preset `release` and packs it
#   scripts/package.sh --test    then installs the packages in a fresh system and makes a crowd of two faces there
#
# crowdface             the program, with manual page, completions and documentation
# libcrowdface-dev      the libraries, headers and the CMake package
# python3-crowdface     the Python module
# crowdface-blender     the Blender add-on
set -euo pipefail
cd "$(dirname "$0")/.."
test=
if [ "${1-}" = --test ]; then
  test=1
elif [ $# -gt 0 ]; then
  echo "usage: scripts/package.sh [--test]" >&2
  exit 64
fi

version=$(sed -nE 's/^project\(crowdface VERSION ([^ ]+).*/\1/p' CMakeLists.txt)
architecture=$(dpkg --print-architecture)
packages=$PWD/build/packages
place=$(mktemp -d)
trap 'rm -rf "$place"' EXIT

# The packages that programs need to link the libraries; see cmake/crowdfaceConfig.cmake.in.
library_needs() {
  local package
  for package in $(scripts/install_dependencies.sh --list); do
    case $package in
      libgtest-dev | libgmock-dev | libbenchmark-dev | libopenmesh-dev | libtinygltf-dev | libcpp-httplib-dev) ;;  # tests
      libcli11-dev | librandom123-dev | libopenimageio-dev | libassimp-dev) ;;  # used only inside the libraries
      lib*-dev | nlohmann-json3-dev | pkg-config) echo "$package" ;;
    esac
  done
}

# install_component COMPONENT PACKAGE: installs the component into usr/ in the package's folder.
install_component() {
  cmake --install build/release --prefix "$place/$2/usr" --component "$1" --strip >/dev/null
}

# needs_of PACKAGE: the packages of the shared libraries with which the package's files are linked.
needs_of() {
  mkdir -p "$place/shlibdeps/debian"
  echo "Source: crowdface" >"$place/shlibdeps/debian/control"
  local files
  mapfile -t files < <(find "$place/$1" -type f \( -name '*.so' -o -path '*/bin/*' \))
  (cd "$place/shlibdeps" && dpkg-shlibdeps -O "${files[@]}" 2>/dev/null) | sed -n 's/^shlibs:Depends=//p'
}

# pack PACKAGE ARCHITECTURE SUMMARY FIELD …: fields are lines such as "Depends: python3".
pack() {
  local package=$1 root=$place/$1 name=$1_${version}_$2.deb
  mkdir -p "$root/DEBIAN" "$root/usr/share/doc/$package"
  {
    printf '%s\n' "Package: $package" "Version: $version" "Architecture: $2" "Section: graphics" "Priority: optional" \
      "Maintainer: the crowdface authors <crowdface@localhost>" "Installed-Size: $(du -sk "$root/usr" | cut -f1)" "${@:4}"
    printf 'Description: %s\n' "$3"
    echo " crowdface makes a crowd of new faces from a few scanned heads that share one topology."
  } >"$root/DEBIAN/control"
  cp LICENSE "$root/usr/share/doc/$package/copyright"
  find "$root" -type d -exec chmod 755 {} +
  dpkg-deb --root-owner-group --build "$root" "$packages/$name" >/dev/null
  echo "build/packages/$name"
}

scripts/install_dependencies.sh --package
scripts/build.sh release crowdface crowdface_python
rm -rf "$packages"
mkdir -p "$packages"

install_component program crowdface
gzip -9n "$place"/crowdface/usr/share/man/man1/*.1
mkdir -p "$place/crowdface/usr/share/zsh/vendor-completions"  # the folder in which Debian's zsh searches
mv "$place"/crowdface/usr/share/zsh/{site-functions,vendor-completions}/_crowdface
rmdir "$place/crowdface/usr/share/zsh/site-functions"
pack crowdface "$architecture" "crowds of believable faces from a handful of scanned heads" \
  "Depends: $(needs_of crowdface), fonts-dejavu-core"

install_component library libcrowdface-dev
pack libcrowdface-dev "$architecture" "crowds of believable faces (development files)" \
  "Depends: crowdface (= $version), $(library_needs | paste -sd, | sed 's/,/, /g')"

install_component python python3-crowdface
python=$(basename "$place"/python3-crowdface/usr/lib/python3.*)
mkdir "$place/python3-crowdface/usr/lib/python3"
mv "$place/python3-crowdface/usr/lib/$python/dist-packages" "$place/python3-crowdface/usr/lib/python3"
rmdir "$place/python3-crowdface/usr/lib/$python"
minor=${python#python3.}
pack python3-crowdface "$architecture" "crowds of believable faces (Python module)" \
  "Depends: crowdface (= $version), python3 (>= 3.$minor), python3 (<< 3.$((minor + 1))), python3-numpy, $(needs_of python3-crowdface)"

addons=$place/crowdface-blender/usr/share/blender/scripts/addons
mkdir -p "$addons"
cp -r blender/crowdface_blender "$addons"
find "$addons" -name __pycache__ -exec rm -rf {} +
pack crowdface-blender all "crowds of believable faces (Blender add-on)" \
  "Depends: crowdface (>= $version)" "Recommends: blender"

if git rev-parse HEAD >/dev/null 2>&1; then
  git archive --prefix="crowdface-$version/" HEAD | gzip -9n >"$packages/crowdface-$version.tar.gz"
  echo "build/packages/crowdface-$version.tar.gz"
fi
[ -n "$test" ] || exit 0

# The test, which runs in a fresh system.
try() {
  export DEBIAN_FRONTEND=noninteractive
  apt-get update -q
  apt-get install -q -y --no-install-recommends /packages/*.deb
  crowdface --version
  crowdface synth -q -o heads --count 4 --vertices 5000 --textures 64 --hair
  crowdface init -q heads -o crowd.yaml
  crowdface generate -q crowd.yaml --count 2
  crowdface verify "$(echo out/*)"
  python3 -c '
import crowdface
crowd = crowdface.generate("crowd.yaml", settings={"crowd.count": 2}, out="by_python")
print(crowd, [face.mesh().name for face in crowd.values()])'
  diff -r "$(echo out/*)/meshes" by_python/meshes
  [ -e "$(echo out/*)/gallery/index.html" ]
  [ -e /usr/share/man/man1/crowdface.1.gz ] || ls -l /usr/share/man/man1 /usr/share/doc/crowdface
  [ -e /usr/share/blender/scripts/addons/crowdface_blender/__init__.py ]
  apt-get install -q -y --no-install-recommends g++ cmake ninja-build
  cmake -G Ninja -S /consumer -B /consumer/build
  cmake --build /consumer/build
  /consumer/build/consumer heads/synth_01.obj
  apt-get purge -q -y crowdface
  [ ! -e /usr/bin/crowdface ]
}
scripts/install_dependencies.sh --releases
# shellcheck source=/dev/null
release=$(. /etc/os-release && echo "$VERSION_CODENAME")
# Unset CMAKE_… variables, which may name programs that the fresh system does not have.
# shellcheck disable=SC2016
{ echo 'set -euxo pipefail; unset "${!CMAKE_@}"; cd "$(mktemp -d)"'; declare -f try; echo try; } >"$place/inside"
tar --create --file "$place/consumer.tar" -C tests/structure consumer
tar --create --file "$place/packages.tar" -C build packages
echo "$release: a fresh root (log: build/packages/test.log)"
mmdebstrap --quiet --variant=minbase --include=ca-certificates --format=null --aptopt='Acquire::Check-Valid-Until "false"' \
  --customize-hook="tar-in $place/packages.tar /" --customize-hook="tar-in $place/consumer.tar /" \
  --customize-hook="upload $place/inside /inside" \
  --customize-hook="upload /etc/ssl/certs/ca-certificates.crt /etc/ssl/certs/ca-certificates.crt" \
  --chrooted-customize-hook="bash /inside" "$release" /dev/null >"$packages/test.log" 2>&1 || {
  tail -n 40 "$packages/test.log" >&2
  exit 1
}
echo "$release: passed"
