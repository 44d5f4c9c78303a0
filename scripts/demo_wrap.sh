#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Makes a coloured crowd from coloured scans: uses four synthetic heads as scans (with textures and picked
# landmarks, in another topology than the template), fits a fifth head, the template, to each scan, and generates
# a crowd from the results. May be run again at any time.
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/build.sh release crowdface
crowdface=build/release/bin/crowdface
out=out/demo_wrap
mkdir -p "$out"

"$crowdface" synth -o "$out/template" --count 1 --vertices 20000 --seed 1 --textures 1024 --quiet
"$crowdface" synth -o "$out/scans" --count 5 --vertices 12000 --seed 1 --textures 1024 --quiet
# The first scan shows the same person as the template, so fitting to it would be too easy.
rm -f "$out"/scans/synth_01*

# With the same seed, synth makes the same persons at every resolution. The landmarks are some vertices of the
# coarse mesh of the template's person; their positions also lie on the fine mesh.
vertices="300 900 1500 2100 2700 3300 4200 5100 6000 7000 8000 9000"
"$crowdface" synth -o "$out/landmarks" --count 1 --vertices 12000 --seed 1 --textures 64 --quiet
place() { grep '^v ' "$1" | sed -n "$(($2 + 1))s/^v \([^ ]*\) \([^ ]*\) \([^ ]*\).*/[\1, \2, \3]/p"; }
{
  echo "template:"
  for v in $vertices; do echo "  v$v: $(place "$out/landmarks/synth_01.obj" "$v")"; done
} >"$out/template.yaml"
for scan in "$out"/scans/*.obj; do
  {
    echo "scan:"
    for v in $vertices; do echo "  v$v: $v"; done
  } >"${scan%.obj}.yaml"
done

"$crowdface" wrap --batch "$out/scans" --template "$out/template/synth_01.obj" \
  --landmarks "$out/template.yaml" --texture 1024 -o "$out/heads"
cp "$out"/template/synth_01* "$out/heads"
"$crowdface" init "$out/heads" -o "$out/crowd.yaml" --force
"$crowdface" generate "$out/crowd.yaml" --set crowd.count=6 --set believability=none --out "$out/crowd" --force

echo
echo "  wrapped heads  $PWD/$out/heads/, with textures; what came of each scan in reports/"
echo "  a crowd        $PWD/$out/crowd/sheets/"
