#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# What the program writes as GLB passes the Khronos validator. Skipped (69) where npm could not
# fetch that.
#   glb_validator_test.sh PROGRAM ROOT
set -euo pipefail
program=$1 root=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"$program" synth -o "$folder/heads" --count 2 --vertices 5000 --textures 64 --body --quiet
cat >"$folder/config.yaml" <<YAML
schema: 1
crowd: {name: mob, count: 2}
faces: {directory: heads, units: cm}
shapes: {neutral: heads/synth_01.obj, directory: heads}
output: {directory: out, meshes: [glb], contact_sheet: none}
YAML
"$program" generate "$folder/config.yaml" --cache "$folder/cache" --quiet
"$root/scripts/check_glb.sh" "$folder"/out/meshes/*.glb

# The same on a body: with its own texture, and with a texture of each face, also at a level of detail.
for texture in "" ", body_texture: heads/body/body.png"; do
  sed "s|^output: {directory: out|neck: {body: heads/body/body.obj, write_body: true$texture}\noutput: {directory: on_body, lods: [30 %]|" \
    "$folder/config.yaml" >"$folder/on_body.yaml"
  "$program" generate "$folder/on_body.yaml" --cache "$folder/cache" --force --quiet
  [ "$(grep -l '"name":"body"' "$folder"/on_body/meshes/*.glb | wc -l)" -eq 4 ] || { echo "not all files contain the body"; exit 1; }
  "$root/scripts/check_glb.sh" "$folder"/on_body/meshes/*.glb
done

# The same with a rig: two joints put into the first of these files, as a rigger's program would.
cat >"$folder/bind.mjs" <<'JS'
import { readFileSync, writeFileSync } from 'node:fs';
const [from, to] = process.argv.slice(2);
const bytes = readFileSync(from);
const length = bytes.readUInt32LE(12);
const scene = JSON.parse(bytes.subarray(20, 20 + length));
let buffer = bytes.subarray(28 + length);
const add = (array, componentType, type, count) => {
  scene.bufferViews.push({ buffer: 0, byteOffset: buffer.length, byteLength: array.byteLength });
  buffer = Buffer.concat([buffer, Buffer.from(array.buffer)]);
  scene.accessors.push({ bufferView: scene.bufferViews.length - 1, componentType, type, count });
  return scene.accessors.length - 1;
};
const joint = scene.nodes.length;
scene.nodes.push({ name: 'neck', children: [joint + 1] }, { name: 'jaw', translation: [0, 0.05, 0.02] });
const face = scene.nodes.findIndex((node) => 'mesh' in node);
scene.nodes[face].skin = 0;
// A skin holds its mesh by the joints alone, so the inverse bind matrices have the scale of the mesh's node.
const scale = scene.nodes.find((node) => 'scale' in node).scale[0];
const held = (x, y, z) => [scale, 0, 0, 0, 0, scale, 0, 0, 0, 0, scale, 0, x, y, z, 1];
const matrices = Float32Array.from([...held(0, 0, 0), ...held(0, -0.05, -0.02)]);
scene.skins = [{ joints: [joint, joint + 1], inverseBindMatrices: add(matrices, 5126, 'MAT4', 2) }];
scene.scenes[0].nodes.push(joint);
for (const primitive of scene.meshes[scene.nodes[face].mesh].primitives) {
  const { count } = scene.accessors[primitive.attributes.POSITION];
  const joints = new Uint16Array(4 * count), weights = new Float32Array(4 * count);
  for (let v = 0; v < count; ++v) joints.set([0, 1], 4 * v), weights.set([0.75, 0.25], 4 * v);
  primitive.attributes.JOINTS_0 = add(joints, 5123, 'VEC4', count);
  primitive.attributes.WEIGHTS_0 = add(weights, 5126, 'VEC4', count);
}
scene.buffers[0].byteLength = buffer.length;
let json = Buffer.from(JSON.stringify(scene));
json = Buffer.concat([json, Buffer.alloc(-json.length & 3, ' ')]);
const header = (...numbers) => Buffer.from(Uint32Array.from(numbers).buffer);
writeFileSync(to, Buffer.concat([header(0x46546c67, 2, 28 + json.length + buffer.length),
  header(json.length, 0x4e4f534a), json, header(buffer.length, 0x004e4942), buffer]));
JS
node "$folder/bind.mjs" "$folder/out/meshes/mob_0001.glb" "$folder/rig.glb"
echo "rig: rig.glb" >>"$folder/config.yaml"
"$program" generate "$folder/config.yaml" --cache "$folder/cache" --quiet --set output.directory=rigged
for file in "$folder"/rigged/meshes/*.glb; do
  grep -q '"inverseBindMatrices"' "$file" || { echo "$file: no rig"; exit 1; }
done
"$root/scripts/check_glb.sh" "$folder"/rigged/meshes/*.glb
