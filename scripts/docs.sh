#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Makes the API page, build/docs/html/index.html, with Doxygen from the comments in the headers. Fails if Doxygen warns.
set -euo pipefail
cd "$(dirname "$0")/.."

command -v doxygen >/dev/null || scripts/install_dependencies.sh --docs
mkdir -p build/docs
doxygen cmake/Doxyfile
echo build/docs/html/index.html
