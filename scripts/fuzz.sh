#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Fuzzes the parsers, one after the other, with AddressSanitizer and UBSan, and prints how much of each parser's
# code the fuzzing inputs and the tests of its module reach. Inputs that fail are kept in build/fuzz/found; after
# the fix, move them to tests/fuzz/corpus, whose files a test reads.
#
#   scripts/fuzz.sh [SECONDS [PARSER …]]    processor time, by default 1200 s each of all parsers below. 0 s: coverage of what is there
set -euo pipefail
cd "$(dirname "$0")/.."
seconds=${1:-1200}
shift || true
parsers=("$@")
[ ${#parsers[@]} -gt 0 ] || parsers=(obj mask material yaml review edits pattern beside override plan cache ledger crowd_files
  scan landmarks points weights rig http morph)

# The source files of each parser, in src/crowdface or src/head_models. Shared files count for each parser.
declare -A sources=(
  [obj]='io/obj_file.cpp io/obj_scan.cpp'
  [mask]='io/image.cpp'
  [material]='io/material_files.cpp io/surface_materials.cpp'
  [yaml]='config/*_keys.cpp config/co*.cpp config/yaml*.cpp'
  [review]='config/review_keys.cpp config/yaml.cpp'
  [edits]='config/edits.cpp config/recipes_keys.cpp config/yaml.cpp'
  [pattern]='config/input_files.cpp'
  [beside]='config/head_tags.cpp config/attachments_keys.cpp config/traits_keys.cpp config/yaml.cpp'
  [override]='config/yaml_edit.cpp config/config_difference.cpp config/yaml.cpp'
  [plan]='crowd/plan_file.cpp'
  [cache]='heads/head_cache.cpp'
  [ledger]='crowd/ledger.cpp'
  [scan]='wrap/scan_*.cpp'
  [landmarks]='pick/landmark_file.cpp config/yaml.cpp'
  [http]='page/http_head.cpp'
  [crowd_files]='crowd/likeness_file.cpp crowd/shard.cpp'
  [points]='heads/load_points.cpp config/yaml.cpp'
  [weights]='region/vertex_weights.cpp io/npy_array.cpp'
  [morph]='morph/three_mesh.cpp morph/fitted_mesh.cpp'
  [rig]='io/gltf_rig.cpp io/glb_container.cpp'
)

tested=(io config crowd heads wrap pick region)  # modules

scripts/install_dependencies.sh --fuzz
scripts/build.sh fuzz $(printf 'crowdface_%s_fuzz ' "${parsers[@]}") \
  $(printf 'crowdface_%s_test ' "${tested[@]}")
out=$PWD/build/fuzz
mkdir -p "$out/found"
TMPDIR=$(mktemp -d /dev/shm/crowdface_fuzz.XXXXXX) # what a target writes stays in memory
export TMPDIR
trap 'rm -rf "$TMPDIR"' EXIT
rm -f "$out"/*_test.profraw
# The words that the parsers of configs, plans and reviews accept.
grep -oh '"[a-z_][a-z_]*"' src/crowdface/{config/*,crowd/*}.cpp src/head_models/morph/*.cpp | sort -u >"$out/words.dict"

# Seeds outside tests/fuzz.
more_seeds() {
  case $1 in
  yaml) echo configs configs/paper ;;
  mask) echo masks ;;
  esac
}

# Fuzzes a parser until it has used its processor time, even if other programs slow the machine.
fuzz() {
  local parser=$1 dictionary=() left=$seconds TIMEFORMAT='%U %S'
  case $parser in yaml | review | edits | beside | override | points | plan | crowd_files | morph) dictionary=(-dict="$out/words.dict") ;; esac
  : >"$out/$parser.log"
  while [ "$left" -gt 0 ]; do
    { time "$out/bin/crowdface_${parser}_fuzz" "$out/corpus/$parser" "tests/fuzz/corpus/$parser" \
      $(more_seeds "$parser") -max_total_time="$left" -max_len=65536 -rss_limit_mb=4096 \
      -timeout=60 -print_final_stats=1 "${dictionary[@]}" -artifact_prefix="$out/found/$parser-" \
      >>"$out/$parser.log" 2>&1; } 2>"$out/$parser.time" || return 1
    left=$((left - $(awk '{print int($1 + $2) + 1}' "$out/$parser.time")))
  done
}

# Measures once which lines the tests of a module reach.
test_profile() {
  local profile=$out/$1_test.profraw
  [ -e "$profile" ] || LLVM_PROFILE_FILE=$profile "$out/bin/crowdface_$1_test" \
    --gtest_filter="${2-*}" >"$out/$1_test.log" 2>&1
  echo "$profile"
}

# The lines of the parser's files that its inputs and the tests together reach, in percent.
coverage() {
  local parser=$1 program=$out/bin/crowdface_${parser}_fuzz names
  names=$(cd src/crowdface && printf '/%s ' ${sources[$parser]})
  LLVM_PROFILE_FILE=$out/$parser.profraw "$program" "$out/corpus/$parser" \
    "tests/fuzz/corpus/$parser" $(more_seeds "$parser") -runs=0 >"$out/$parser.replay.log" 2>&1
  llvm-profdata merge -o "$out/$parser.profdata" "$out/$parser.profraw" \
    "$(test_profile io)" "$(test_profile config)" "$(test_profile crowd)" \
    "$(test_profile heads '*Cache*:*MadeAnew*')" "$(test_profile wrap 'ScanFile*')" \
    "$(test_profile pick '*Landmark*')" "$(test_profile region)"
  local seen=("$program" -instr-profile="$out/$parser.profdata") module
  for module in "${tested[@]}"; do seen+=(-object "$out/bin/crowdface_${module}_test"); done
  llvm-cov show "${seen[@]}" >"$out/$parser.lines.txt"
  llvm-cov report "${seen[@]}" >"$out/$parser.files.txt"
  # Columns 8 and 9: lines of a file, and missed lines.
  awk -v names="$names" '
    BEGIN {count = split(names, name, " ")}
    {
      for (i = 1; i <= count; ++i) {
        if (length($1) >= length(name[i]) && \
            substr($1, length($1) - length(name[i]) + 1) == name[i]) {
          lines += $8
          missed += $9
        }
      }
    }
    END {printf "%.1f %% of %d", 100 * (lines - missed) / lines, lines}' "$out/$parser.files.txt"
}

status=0
for parser in "${parsers[@]}"; do
  mkdir -p "$out/corpus/$parser"
  start=$SECONDS
  touch "$out/$parser.log"
  if [ "$seconds" -eq 0 ] || fuzz "$parser"; then
    printf '%-8s %6d s %12s runs, nothing found, %s lines reached\n' "$parser" \
      $((SECONDS - start)) \
      "$(awk '/number_of_executed_units/ {runs += $2} END {print runs + 0}' "$out/$parser.log")" \
      "$(coverage "$parser")"
  else
    printf '%-8s %6d s FOUND, see %s\n' "$parser" $((SECONDS - start)) "build/fuzz/$parser.log"
    status=1
  fi
done
exit $status
