#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Checks form and finds unclear code; changes nothing.
#
#   scripts/lint.sh                         clang-format and clang-tidy over everything
#   scripts/lint.sh --format                only clang-format: seconds
#   scripts/lint.sh --tidy [FILE.cpp …]     only clang-tidy, over everything or these files
#   scripts/lint.sh --tidy --since COMMIT   clang-tidy over what changed since then
set -euo pipefail
cd "$(dirname "$0")/.."

usage() {
  sed -n '5,8s/^#   //p' "$0" >&2
  exit 64
}

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

# The .cpp files that a change may concern: those changed themselves, and those that include a
# changed header, directly or through others. Everything, if the rules themselves changed.
changed_since() {
  local changed all
  mapfile -t all < <(sources 'src/*.cpp' 'tests/*.cpp')
  changed=$(git diff --name-only "$1" -- && git ls-files --others --exclude-standard)
  if grep -qxE '\.clang-tidy|scripts/lint\.sh' <<<"$changed"; then
    printf '%s\n' "${all[@]}"
    return
  fi
  local headers seen='' next
  headers=$(grep -E '^(src|tests)/.*\.h$' <<<"$changed" | sed -E 's,^(src|tests)/,,' || true)
  while [ -n "$headers" ]; do  # headers that include a changed header count as changed
    seen+=$headers$'\n'
    next=$(sources 'src/*.h' 'tests/*.h' | xargs grep -lFf <(printf '"%s"\n' $headers) |
      sed -E 's,^(src|tests)/,,' || true)
    headers=$(grep -vxFf <(printf '%s' "$seen") <<<"$next" || true)
  done
  {
    grep -E '^(src|tests)/.*\.cpp$' <<<"$changed" || true
    if [ -n "$seen" ]; then
      printf '%s\n' "${all[@]}" | xargs grep -lFf <(printf '"%s"\n' $seen) || true
    fi
  } | sort -u | while read -r file; do [ ! -f "$file" ] || echo "$file"; done
}

check_tidy() {
  local files
  if [ "${1-}" = --since ]; then
    [ -n "${2-}" ] || usage
    mapfile -t files < <(changed_since "$2")
  elif [ $# -gt 0 ]; then
    files=("$@")
  else
    mapfile -t files < <(sources 'src/*.cpp' 'tests/*.cpp')
  fi
  # tests/structure/consumer is a project of its own.
  mapfile -t files < <(printf '%s\n' "${files[@]}" | grep -v -e '^$' -e '^tests/structure/' || true)
  [ ${#files[@]} -gt 0 ] || { echo "clang-tidy: nothing to check"; return; }
  mkdir -p build/lint
  cmake -G Ninja -B build/lint -DCMAKE_BUILD_TYPE=Release >build/lint/configure.log 2>&1 || {
    cat build/lint/configure.log >&2
    return 1
  }
  printf '%s\0' "${files[@]}" |
    xargs -0 -n 1 -P "$(nproc)" clang-tidy -p build/lint --quiet 2>build/lint/tidy.log || {
    # What clang-tidy says on the error stream beside its counts of suppressed warnings.
    grep -vE '^[0-9]+ warnings? generated|^$' build/lint/tidy.log >&2 || true
    return 1
  }
  echo "clang-tidy: ${#files[@]} files without a warning"
}

mode=${1-}
[ $# -eq 0 ] || shift
case "$mode" in
  "" | --format | --tidy) ;;
  *) usage ;;
esac
scripts/install_dependencies.sh --check
case "$mode" in
  "") check_format; check_tidy ;;
  --format) check_format ;;
  --tidy) check_tidy "$@" ;;
esac
