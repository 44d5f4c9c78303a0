// SPDX-License-Identifier: Apache-2.0
// Whether all points on the editor's screen are points of a mesh, to 0.1 mm.
//   node compare_points.mjs RESULT_JSON MESH.obj UNIT_IN_0.1_MM
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';

const [resultFile, meshFile, within] = process.argv.slice(2);
const { points } = JSON.parse(readFileSync(resultFile, 'utf8'));
const cell = Number(within);
const key = (p) => p.map((value) => Math.round(value / cell)).join();
const mesh = new Map();
for (const line of readFileSync(meshFile, 'utf8').split('\n')) {
  if (!line.startsWith('v ')) continue;
  const point = line.split(/\s+/).slice(1, 4).map(Number);
  if (!mesh.has(key(point))) mesh.set(key(point), []);
  mesh.get(key(point)).push(point);
}
assert.ok(mesh.size > 100, `${meshFile} holds points`);
let most = 0;
for (let i = 0; i < points.length; i += 3) {
  const point = points.slice(i, i + 3);
  let nearest = Infinity;
  const [x, y, z] = point.map((value) => Math.round(value / cell));
  for (let n = 0; n < 27; n += 1) {
    const around = [x + (n % 3) - 1, y + (Math.floor(n / 3) % 3) - 1, z + Math.floor(n / 9) - 1].join();
    for (const other of mesh.get(around) ?? []) {
      nearest = Math.min(nearest, Math.hypot(...other.map((value, c) => value - point[c])));
    }
  }
  most = Math.max(most, nearest);
}
assert.ok(most < cell, `a point on the screen is ${most} from every point of the mesh`);
console.log(`${points.length / 3} points on the screen, none farther than ${most.toExponential(1)} from one of the mesh`);
