#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Every command of docs/tutorial.md works, in the order of the page, and the crowd is what the brief asks for.
# A YAML block is saved under the last file name `….yaml` above it. The Blender command is left out, with a
# message, where Blender is not installed.
#   tutorial_test.sh PROGRAM ROOT
# KEEP=DIR works in the empty folder DIR and keeps it.
set -euo pipefail
program=$(realpath "$1") root=$(realpath "$2")
page=$root/docs/tutorial.md
if [ -n "${KEEP-}" ]; then
  mkdir -p "$KEEP"
  folder=$(realpath "$KEEP")
else
  folder=$(mktemp -d)
  trap 'rm -rf "$folder"' EXIT
fi
mkdir "$folder/blocks" "$folder/market"
PATH=$(dirname "$program"):$PATH
export PATH XDG_CACHE_HOME=$folder/cache
fail() {
  echo "FAILED: $*"
  exit 1
}

# Blocks become 01.sh, 02.sh, 03.yaml, …; the first line of a YAML file is the name to save it under.
awk -v folder="$folder/blocks" '
  /^```/ && inside { inside = 0; close(file); next }
  /^```(sh|yaml)$/ {
    inside = 1
    kind = substr($0, 4)
    file = sprintf("%s/%02d.%s", folder, ++count, kind)
    if (kind == "yaml") print name > file
    next
  }
  /^```/ { print "a block of another kind, line " FNR > "/dev/stderr"; exit 1 }
  inside { print > file; next }
  { for (rest = $0; match(rest, /`[a-z]+\.yaml`/); rest = substr(rest, RSTART + RLENGTH))
      name = substr(rest, RSTART + 1, RLENGTH - 2) }' "$page"

has_blender() { command -v blender && /usr/bin/python3 -c 'import numpy'; } >/dev/null 2>&1

cd "$folder/market"
meshes_of_review=$folder/before_review
for block in "$folder"/blocks/*; do
  case $block in
    *.yaml)
      name=$(head -n 1 "$block")
      echo "== $name"
      tail -n +2 "$block" >"$name"
      ;;
    *)
      if grep -q '^blender ' "$block" && ! has_blender; then
        echo "== SKIPPED, no Blender (Debian's packages blender and python3-numpy have it):"
        cat "$block"
        continue
      fi
      if grep -q -e --review "$block"; then (cd out/market/meshes && sha256sum -- *.glb *.usda) >"$meshes_of_review"; fi
      echo "== $(cat "$block")"
      start=$SECONDS
      bash -euo pipefail "$block" >"$folder/log" 2>&1 || {
        cat "$folder/log"
        fail "$(cat "$block")"
      }
      tail -n 3 "$folder/log"
      echo "== $((SECONDS - start)) s"
      ;;
  esac
done

# column NAME: that column of the table of the crowd, after the id.
column() {
  tr -d '\r' <out/market/crowd.csv | awk -F, -v name="$1" '
    NR == 1 { for (i = 1; i <= NF; i++) if ($i == name) wanted = i; next }
    { print $1, $wanted }'
}
count() { grep -c -- "$1" || true; }

echo "== the brief"
[ "$(column target | wc -l)" = 24 ] || fail "expected 24 people"
elderly=$(column group | count ' elderly_')
[ "$elderly" = 8 ] || fail "expected 8 elderly people, found $elderly"
for line in 'market_smith_mother elderly_women' 'market_smith_father elderly_men' 'market_smith_01 women' \
  'market_smith_son_01 men'; do
  column group | grep -qx "$line" || fail "not in the table: $line"
done
children=$(count '"parents":{"mother":"market_smith_mother","father":"market_smith_father"}' <out/market/plan.jsonl)
[ "$children" = 2 ] || fail "expected 2 children, found $children"
for format in glb usda; do
  files=$(find out/market/meshes -maxdepth 1 -name "*.$format" | wc -l)
  [ "$files" = 24 ] || fail "expected 24 .$format files, found $files"
done
# A haircut of the wardrobe, in the table and in the face's own file.
while read -r id worn; do
  hair=''
  for item in ${worn//;/ }; do
    ! grep -q "name: $item, kind: hair" heads/attachments/attachments.yaml || hair=$item
  done
  [ -n "$hair" ] || fail "$id has no hair: '$worn'"
  grep -qa "\"name\":\"$hair\"" "out/market/meshes/$id.glb" || fail "$id.glb has no node $hair"
done < <(column attachments)
! column tags | grep bald || fail "the tutorial's crowd has bald people"
for page in sheets/heads_001.png sheets/family_smith_son.png sheets/sheet_001.png gallery/index.html; do
  [ -s "out/market/$page" ] || { [ "${page%%/*}" = gallery ] && echo "no gallery: its page was not built"; } ||
    fail "not there: $page"
done
[ -s out/trial/sheets/heads_001.png ] || fail "no sheet of the heads"

echo "== the review"
redrawn=$(awk '/(mark: reject|lock:)/ { sub(":", "", $1); print $1 }' review.yaml | sort)
(cd out/market/meshes && sha256sum -- *.glb *.usda) >"$folder/after_review"
# Both files of a face have other bytes.
changed=$( (diff "$meshes_of_review" "$folder/after_review" || true) |
  sed -n 's/^> [0-9a-f]*  \(.*\)\.[a-z]*$/\1/p' | sort | uniq -d)
[ -n "$redrawn" ] || fail "nothing is rejected in review.yaml"
[ "$redrawn" = "$changed" ] || fail "expected other bytes of ${redrawn//$'\n'/, }, found other bytes of ${changed//$'\n'/, }"
others=$( (diff "$meshes_of_review" "$folder/after_review" || true) | grep -c '^[<>]' || true)
[ "$others" = $((4 * $(wc -w <<<"$redrawn"))) ] || fail "other files were changed, too"
crowdface plan -q market.yaml --set review=review.yaml --out out/again
cmp out/again/plan.jsonl out/market/plan.jsonl || fail "review: review.yaml in the config gives another crowd"

! has_blender || [ -s market.blend ] || fail "no market.blend"
echo "all right"
