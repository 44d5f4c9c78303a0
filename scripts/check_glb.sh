#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Runs the Khronos glTF validator on GLB files; an error or a warning fails. Installs the validator
# (npm's gltf-validator) into build/gltf-validator when it is not there; needs node and npm.
#
#   scripts/check_glb.sh FILE.glb …
#   scripts/check_glb.sh --installed FILE.glb …   installs nothing; exits with 77 if there is none
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
place=$root/build/gltf-validator

install=yes
if [ "${1-}" = --installed ]; then
  install=no
  shift
fi
[ $# -gt 0 ] || { echo "usage: scripts/check_glb.sh [--installed] FILE.glb …" >&2; exit 64; }
if ! command -v node >/dev/null || [ ! -d "$place/node_modules/gltf-validator" ]; then
  if [ $install = no ]; then
    echo "no glTF validator: scripts/check_glb.sh FILE.glb installs it"
    exit 77
  fi
  command -v node >/dev/null && command -v npm >/dev/null || {
    echo "node and npm are needed: apt-get install nodejs npm" >&2
    exit 69
  }
  mkdir -p "$place"
  npm install --silent --no-audit --no-fund --prefix "$place" gltf-validator@2.0.0-dev.3.10 >&2
fi

NODE_PATH=$place/node_modules node - "$@" <<'JS'
const validator = require('gltf-validator');
const fs = require('fs');
async function check(file) {
  const bytes = new Uint8Array(fs.readFileSync(file));
  const { issues } = await validator.validateBytes(bytes, { uri: file, maxIssues: 0 });
  console.log(`${file}: ${issues.numErrors} errors, ${issues.numWarnings} warnings`);
  // Severity 0 is an error, 1 a warning; the rest is for information.
  for (const issue of issues.messages.filter((issue) => issue.severity < 2).slice(0, 20)) {
    console.log(`  ${issue.code} at ${issue.pointer ?? 'the file'}: ${issue.message}`);
  }
  return issues.numErrors + issues.numWarnings === 0;
}
(async () => {
  let all = true;
  for (const file of process.argv.slice(2)) all = (await check(file)) && all;
  process.exit(all ? 0 : 1);
})();
JS
