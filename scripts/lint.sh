#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Checks the format, and runs clang-tidy; changes nothing.
#
#   scripts/lint.sh                         clang-format and clang-tidy over everything
#   scripts/lint.sh --format                only clang-format; takes seconds
#   scripts/lint.sh --tidy [FILE.cpp …]     only clang-tidy, over everything or these files
#   scripts/lint.sh --tidy --since COMMIT   clang-tidy over the files changed since COMMIT, then over the
#                                           other files, beginning with a different file at each commit
#
# clang-tidy takes 5 to 30 seconds per file. Files that passed are skipped until the file, one of our headers that it
# includes, or .clang-tidy changes (build/lint/passed). With TIDY_SECONDS=300, the script starts no further file after
# 300 seconds, and prints the number of unchecked files.
set -euo pipefail
cd "$(dirname "$0")/.."

# sources PATTERN …: our existing files, tracked or new.
sources() {
  git ls-files --cached --others --exclude-standard -- "$@" | while read -r file; do
    [ ! -f "$file" ] || echo "$file"
  done
}

cpp=('src/*.cpp' 'tests/*.cpp' 'examples/*.cpp')
all=("${cpp[@]}" 'src/*.h' 'tests/*.h' 'python/*.h' 'python/*.cpp')

check_format() {
  local files
  mapfile -t files < <(sources "${all[@]}")
  clang-format --dry-run -Werror "${files[@]}"
  echo "clang-format: ${#files[@]} files in form"
}

# The changed .cpp files, and for each changed header one .cpp file that includes it: the file of the same name, or
# else the first file. (clang-tidy also checks our headers.)
changed_since() {
  local file
  {
    git diff --name-only "$1" -- src tests examples
    git ls-files --others --exclude-standard -- src tests examples
  } | while read -r file; do
    [ -f "$file" ] || continue
    case "$file" in
      *.cpp) echo "$file" ;;
      *.h)
        if [ -f "${file%.h}.cpp" ]; then
          echo "${file%.h}.cpp"
        else
          sources "${cpp[@]}" | xargs grep -lF "\"${file#*/}\"" | sed -n 1p || true
        fi
        ;;
    esac
  done | sort -u
}

# The files in the order of --since: the changed files, then all others. The first of the others moves by 40 files
# with each commit, about as many as clang-tidy checks in a few minutes.
by_turns() {
  local others
  changed_since "$1"
  mapfile -t others < <(sources "${cpp[@]}" | grep -vxF -f <(changed_since "$1") || true)
  local start=$((40 * $(git rev-list --count HEAD) % (${#others[@]} + 1)))
  printf '%s\n' "${others[@]:start}" "${others[@]:0:start}"
}

# Lines "FILE KEY". The key is a hash of the file, of our headers that it includes directly or indirectly, and of
# clang-tidy's settings.
with_keys() {
  local settings
  settings=$(clang-tidy --version | cat - .clang-tidy tests/.clang-tidy CMakeLists.txt cmake/* | sha256sum)
  {
    sources "${all[@]}" | xargs sha256sum
    sources "${all[@]}" | xargs grep -HE '^ *# *include *"'
    printf '%s\n' "$@"
  } | awk '
    NF == 2 && length($1) == 64 { sum[$2] = $1; next }
    /^[^ ]*: *# *include/ {
      from = $0; sub(/:.*/, "", from)
      to = $0; sub(/^[^"]*"/, "", to); sub(/".*/, "", to)
      includes[from] = includes[from] " src/" to " tests/" to
      next
    }
    function collect(file,   i, count, next_ones) {
      if (file in seen || !(file in sum)) return
      seen[file]
      all = all sum[file]
      count = split(includes[file], next_ones, " ")
      for (i = 1; i <= count; ++i) collect(next_ones[i])
    }
    { delete seen; all = ""; collect($1); print $1, all }' |
    while read -r file sums; do
      echo "$file $(sha256sum <<<"$settings$file$sums" | cut -c 1-32)"
    done
}

# tidy_one FILE KEY
tidy_one() {
  [ ! -f "build/lint/passed/$2" ] || return 0
  if [ -n "${TIDY_SECONDS-}" ] && [ "$(date +%s)" -ge "$((TIDY_START + TIDY_SECONDS))" ]; then
    echo "$1" >>build/lint/unseen
    return
  fi
  local said
  # The build's flags are for g++; clang does not know all of them.
  if said=$(clang-tidy -p build/lint --quiet --extra-arg=-Wno-unknown-warning-option "$1" 2>&1); then
    touch "build/lint/passed/$2"
    return
  fi
  # Drop the numbers of suppressed warnings in headers of libraries.
  grep -vE '^[0-9]+ warnings? generated' <<<"$said"
  return 1
}

check_tidy() {
  local files
  if [ "${1-}" = --since ]; then
    mapfile -t files < <(by_turns "${2:?--since needs a commit}")
  elif [ $# -gt 0 ]; then
    files=("$@")
  else
    mapfile -t files < <(sources "${cpp[@]}")
  fi
  # tests/structure/consumer is a separate project.
  mapfile -t files < <(printf '%s\n' "${files[@]}" | grep -v -e '^$' -e '^tests/structure/')
  mkdir -p build/lint/passed
  : >build/lint/unseen
  cmake -G Ninja -B build/lint -DCMAKE_BUILD_TYPE=Release -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON \
    >build/lint/configure.log 2>&1 || {
    cat build/lint/configure.log >&2
    return 1
  }
  export -f tidy_one
  TIDY_START=$(date +%s)
  export TIDY_START
  # shellcheck disable=SC2016
  with_keys "${files[@]}" | xargs -n 2 -P "$(nproc)" bash -c 'tidy_one "$1" "$2"' tidy || return 1
  local unseen
  unseen=$(wc -l <build/lint/unseen)
  echo "clang-tidy: $((${#files[@]} - unseen)) of ${#files[@]} files without a warning, $unseen not seen"
  [ "$unseen" -eq 0 ] || echo "clang-tidy: those are in build/lint/unseen; scripts/lint.sh --tidy sees all"
}

case "${1-}" in
  "" | --format | --tidy) ;;
  *)
    sed -n '5,9s/^#   //p' "$0" >&2
    exit 64
    ;;
esac
scripts/install_dependencies.sh --check
case "${1-}" in
  "") check_format; check_tidy ;;
  --format) check_format ;;
  --tidy) shift; check_tidy "$@" ;;
esac
