#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# What `cmake --install` puts in place is complete: the program runs from there, and a project of
# its own finds the package, builds against every module and runs.
#   install_test.sh SOURCE BUILD [CXX_FLAGS]
set -euo pipefail
source=$1 build=$2 flags=${3-}
place=$(mktemp -d)
trap 'rm -rf "$place"' EXIT

cmake --install "$build" --prefix "$place/prefix" >"$place/install.log" || {
  cat "$place/install.log"
  exit 1
}
for file in bin/crowdface include/crowdface/crowdface.h include/crowdface/core/version.h \
  share/crowdface/configs/demo.yaml share/man/man1/crowdface.1 share/bash-completion/completions/crowdface share/doc/crowdface/LICENSE share/doc/crowdface/config.md; do
  [ -e "$place/prefix/$file" ] || { echo "not installed: $file"; exit 1; }
done
# The public headers alone: crowdface.h includes neither of these.
for file in core/text.h run/mesh_writers.h; do
  [ ! -e "$place/prefix/include/crowdface/$file" ] || { echo "installed, and not public: $file"; exit 1; }
done
"$place/prefix/bin/crowdface" --version
# The Python module, if it is built.
if compgen -G "$build/python/crowdface/_crowdface.*.so" >/dev/null; then
  packages=$(dirname "$(dirname "$(find "$place/prefix" -name py.typed)")")
  PYTHONPATH=$packages PYTHONDONTWRITEBYTECODE=1 /usr/bin/python3 -c 'import crowdface; print("Python module", crowdface.__version__)'
fi
# What it loads for images lies where it looks.
"$place/prefix/bin/crowdface" synth -q -o "$place/heads" --count 2 --vertices 5000
"$place/prefix/bin/crowdface" init -q "$place/heads" -o "$place/crowd.yaml"
"$place/prefix/bin/crowdface" check -q "$place/crowd.yaml" --cache "$place/cache" >/dev/null

cmake -G Ninja -S "$source/tests/structure/consumer" -B "$place/build" \
  -DCMAKE_PREFIX_PATH="$place/prefix" -DCMAKE_CXX_FLAGS="$flags" >"$place/configure.log" 2>&1 || {
  cat "$place/configure.log"
  exit 1
}
cmake --build "$place/build" || exit 1
"$place/build/consumer" "$place/heads/synth_01.obj"
[ ! -e "$place/prefix/include/head_models" ] || { echo "head models are installed"; exit 1; }
