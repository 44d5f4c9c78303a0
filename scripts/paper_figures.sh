#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Makes our version of the paper's figures from configs/paper/, for any set of at least six heads. Writes pictures to
# out/paper/NAME/figures. docs/paper.md shows the pictures for synthetic heads and ICT heads.
#
#   scripts/paper_figures.sh                            synthetic heads, 40,000 vertices
#   scripts/paper_figures.sh NAME HEADS_DIR [MASK]      your heads (OBJ, centimetres, +Y up, facing +Z);
#                                                       MASK: an image of three regions, may contain <UDIM>
#   CROWDFACE=PROGRAM scripts/paper_figures.sh …        PROGRAM instead of the release build's program
#   scripts/paper_figures.sh --table [VERTICES]         only Table 1: time per face by number of heads (1,200,000)
set -euo pipefail
cd "$(dirname "$0")/.."
program=${CROWDFACE:-$PWD/build/release/bin/crowdface}
[ -x "$program" ] || { echo "paper_figures: build first, scripts/build.sh release crowdface" >&2; exit 69; }

# Measures the time of blending alone with 2 to 15 heads of one size. With 320 faces, the extra time of the first
# faces (for fresh memory) hardly matters.
table() {
  local vertices=$1 faces=320 folder=out/paper/table
  mkdir -p "$folder"
  "$program" synth --force -o "$folder/heads" --count 15 --vertices "$vertices" --seed 3 --quiet
  echo '{"vertices": '"$vertices"', "faces": '"$faces"', "heads": {' >"$folder/times.json"
  local separator=''
  for heads in 2 4 7 10 13 15; do
    mkdir -p "$folder/heads_$heads"
    rm -f "$folder/heads_$heads"/*
    for i in $(seq 1 "$heads"); do
      ln -s "../heads/$(printf 'synth_%02d' "$i").obj" "$folder/heads_$heads/"
    done
    # Take the shortest of three runs: other programs only lengthen a run.
    local least=''
    for _ in 1 2 3; do
      "$program" generate configs/paper/table1.yaml --quiet --force --count "$faces" \
        --set "faces.directory=$PWD/$folder/heads_$heads" --out "$folder/crowd"
      rm -f "$folder/crowd/ledger.jsonl"
      least=$(sed -n 's/.*"blend": *\([0-9.]*\).*/\1/p' "$folder/crowd/timings.json" | head -n 1 |
        awk -v least="$least" '{ print least == "" || $1 < least ? $1 : least }')
    done
    echo "$separator\"$heads\": $least" >>"$folder/times.json"
    separator=,
  done
  echo '}}' >>"$folder/times.json"
  scripts/plot_table1.py "$folder/times.json" "$folder/table1.svg"
  echo "$folder/table1.svg"
}

if [ "${1-}" = --table ]; then
  table "${2:-1200000}"
  exit 0
fi

name=${1:-synth}
folder=out/paper/$name
heads=$folder/heads
mask=$PWD/masks/synth_bands.png
rm -rf "$heads" && mkdir -p "$heads" "$folder/figures"
if [ $# -eq 0 ]; then
  "$program" synth --force -o "$folder/made" --count 8 --vertices 40000 --seed 3 --quiet
  given=$folder/made
else
  given=${2:?"usage: scripts/paper_figures.sh [NAME HEADS_DIR [MASK]]"}
  mask=${3:+$(realpath -m "$3")}
fi
number=0
for file in "$given"/*.obj; do
  number=$((number + 1))
  ln -s "$(realpath "$file")" "$heads/head_$number.obj"
done
[ "$number" -ge 6 ] || { echo "paper_figures: six heads or more are needed, found $number" >&2; exit 66; }

# figure NAME [--set KEY=VALUE …]: makes the sheet of one config.
figure() {
  local figure=$1
  shift
  "$program" generate "configs/paper/$figure.yaml" --quiet --force \
    --set "faces.directory=$PWD/$heads" "$@" --out "$folder/$figure"
  cp "$folder/$figure/sheets/sheet_001.png" "$folder/figures/$figure.png"
  echo "$folder/figures/$figure.png"
}
figure fig02
figure fig04
figure fig05
figure fig06
if [ -n "$mask" ]; then
  "$program" check configs/paper/fig07.yaml --quiet --set "faces.directory=$PWD/$heads" \
    --set "regions.mask=$mask" --masks "$folder/fig07"
  cp "$folder/fig07/all.png" "$folder/figures/fig07.png"
  echo "$folder/figures/fig07.png"
  figure fig09 --set "regions.mask=$mask"
  figure fig10 --set "regions.mask=$mask"
fi
figure fig11
figure bands
figure fig12_exact
for levels in cubic basis; do
  figure "fig12_$levels" --set "output.contact_sheet.compare=$PWD/$folder/fig12_exact"
done

# Compare our method with the method of Yoon, Lewis and Rhee: pictures and a table, figures/multiscale.md.
multiscale=${program%/*}/multiscale_figures
if [ -x "$multiscale" ]; then
  "$multiscale" "$heads" "$folder" "$folder/figures" ${mask:+"$mask"}
else
  echo "paper_figures: not compared with other methods: scripts/build.sh release multiscale_figures" >&2
fi
