#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The API page is made without a warning and shows shapes as the headers write them. Skipped (77) without Doxygen.
#   api_page_test.sh ROOT
set -euo pipefail
cd "$1"
command -v doxygen >/dev/null || {
  echo "SKIPPED: no Doxygen: scripts/install_dependencies.sh --test installs it"
  exit 77
}
scripts/docs.sh
grep -rqF '#V by 3' build/docs/html --include='*.html' || {
  echo "expected shapes such as '#V by 3' on the pages, found none"
  exit 1
}
