#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# unnamed_names.sh finds a function that would be taken for that of a header, and no other.
#   unnamed_names_test.sh ROOT
set -euo pipefail
check=$1/tests/structure/unnamed_names.sh
root=$(mktemp -d)
trap 'rm -rf "$root"' EXIT
module=$root/src/crowdface/module
mkdir -p "$module"
cat >"$module/bytes.h" <<'HEADER'
void append_number(std::string& out, std::uint32_t number);
HEADER
cat >"$module/binary.cpp" <<'SOURCE'
void write(std::string& out) {
  append_number(out, 1);
}
SOURCE
text() {  # the function of another source, by this name
  cat >"$module/text.cpp" <<SOURCE
namespace {
void $1(std::string& out, std::uint32_t number) {
  out += concat(number);
}
}  // namespace
SOURCE
}
text append_digits
"$check" "$root"
text append_number
if "$check" "$root" >/dev/null; then
  echo "expected append_number to be refused"
  exit 1
fi
