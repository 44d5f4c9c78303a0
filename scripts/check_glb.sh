#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Runs the Khronos glTF validator on GLB files; fails if it reports errors or warnings. scripts/build.sh fetches the
# validator, a package of gallery/package.json; if the validator is missing, exits with 69.
#
#   scripts/check_glb.sh FILE.glb …
set -euo pipefail
modules=$(cd "$(dirname "$0")/.." && pwd)/build/gallery/node_modules

[ $# -gt 0 ] || { echo "usage: scripts/check_glb.sh FILE.glb …" >&2; exit 64; }
if ! command -v node >/dev/null || [ ! -d "$modules/gltf-validator" ]; then
  echo "no glTF validator: scripts/build_gallery.sh fetches it, with npm from its registry" >&2
  exit 69
fi

NODE_PATH=$modules node - "$@" <<'JS'
const validator = require('gltf-validator');
const fs = require('fs');
async function check(file) {
  const bytes = new Uint8Array(fs.readFileSync(file));
  // Tangents are left to the reader, which computes those of MikkTSpace.
  const ignoredIssues = ['MESH_PRIMITIVE_GENERATED_TANGENT_SPACE'];
  const { issues } = await validator.validateBytes(bytes, { uri: file, maxIssues: 0, ignoredIssues });
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
