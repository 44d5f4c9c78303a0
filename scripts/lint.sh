#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Checks form and finds unclear code; changes nothing.
#
#   scripts/lint.sh                         clang-format and clang-tidy over everything
#   scripts/lint.sh --format                only clang-format: seconds
#   scripts/lint.sh --tidy [FILE.cpp …]     only clang-tidy, over everything or these files
#   scripts/lint.sh --tidy --since COMMIT   clang-tidy over what changed since then
#
# clang-tidy takes 5 to 30 seconds a file. TIDY_SECONDS=300 begins no further file after that time
# and says how many are left.
set -euo pipefail
cd "$(dirname "$0")/.."

# sources PATTERN …: our files, tracked or new, that are there.
sources() {
  git ls-files --cached --others --exclude-standard -- "$@" | while read -r file; do
    [ ! -f "$file" ] || echo "$file"
  done
}

check_format() {
  local files
  mapfile -t files < <(sources 'src/*.h' 'src/*.cpp' 'tests/*.h' 'tests/*.cpp')
  clang-format --dry-run -Werror "${files[@]}"
  echo "clang-format: ${#files[@]} files in form"
}

# The .cpp files that changed, and for every header that changed one that includes it: its own, or
# the first. (clang-tidy reports on our headers, too.)
changed_since() {
  local file
  {
    git diff --name-only "$1" -- src tests
    git ls-files --others --exclude-standard -- src tests
  } | while read -r file; do
    [ -f "$file" ] || continue
    case "$file" in
      *.cpp) echo "$file" ;;
      *.h)
        if [ -f "${file%.h}.cpp" ]; then
          echo "${file%.h}.cpp"
        else
          sources 'src/*.cpp' 'tests/*.cpp' | xargs grep -lF "\"${file#*/}\"" | sed -n 1p || true
        fi
        ;;
    esac
  done | sort -u
}

tidy_one() {
  if [ -n "${TIDY_SECONDS-}" ] && [ "$(date +%s)" -ge "$((TIDY_START + TIDY_SECONDS))" ]; then
    echo "$1" >>build/lint/left
    return
  fi
  local said
  # The build's flags are for g++; clang does not know them all.
  said=$(clang-tidy -p build/lint --quiet --extra-arg=-Wno-unknown-warning-option "$1" 2>&1) &&
    return
  # Counts of what was suppressed in the libraries' headers are of no interest.
  grep -vE '^[0-9]+ warnings? generated' <<<"$said"
  return 1
}

check_tidy() {
  local files
  if [ "${1-}" = --since ]; then
    mapfile -t files < <(changed_since "${2:?--since needs a commit}")
  elif [ $# -gt 0 ]; then
    files=("$@")
  else
    mapfile -t files < <(sources 'src/*.cpp' 'tests/*.cpp')
  fi
  # tests/structure/consumer is a project of its own.
  mapfile -t files < <(printf '%s\n' "${files[@]}" | grep -v -e '^$' -e '^tests/structure/')
  if [ ${#files[@]} -eq 0 ]; then
    echo "clang-tidy: nothing to check"
    return
  fi
  mkdir -p build/lint
  rm -f build/lint/left
  cmake -G Ninja -B build/lint -DCMAKE_BUILD_TYPE=Release >build/lint/configure.log 2>&1 || {
    cat build/lint/configure.log >&2
    return 1
  }
  export -f tidy_one
  TIDY_START=$(date +%s)
  export TIDY_START
  # shellcheck disable=SC2016
  printf '%s\0' "${files[@]}" |
    xargs -0 -n 1 -P "$(nproc)" bash -c 'tidy_one "$1"' tidy || return 1
  local left=0
  [ ! -f build/lint/left ] || left=$(wc -l <build/lint/left)
  echo "clang-tidy: $((${#files[@]} - left)) files without a warning"
  [ "$left" -eq 0 ] || echo "clang-tidy: no time for $left more; scripts/lint.sh --tidy checks all"
}

case "${1-}" in
  "" | --format | --tidy) ;;
  *)
    sed -n '5,8s/^#   //p' "$0" >&2
    exit 64
    ;;
esac
scripts/install_dependencies.sh --check
case "${1-}" in
  "") check_format; check_tidy ;;
  --format) check_format ;;
  --tidy) shift; check_tidy "$@" ;;
esac
