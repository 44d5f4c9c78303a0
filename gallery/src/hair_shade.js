// SPDX-License-Identifier: Apache-2.0
// How much light hair keeps from the skin: a depth map for each of some directions of light tells which parts of the
// skin lie behind something worn.
import { Matrix3, Vector3 } from 'three';

const side = 96; // cells of a direction's map
const half = 1.2; // half of the map, where a head is two units high
const cell = (2 * half) / side;
const clear = 0.04; // anything nearer to the skin, such as brows, casts no shade
const solid = 0.3; // anything more transparent, such as a lens, casts no shade
const opacity = 0.8; // of hair, on average
// x right, y up, z front; most light comes from above.
const ways = [[-0.62, 0.62, 0.62], [0.62, 0.62, 0.62], [0, 0.75, 0.66], [0, 0, 1], [-0.95, 0.3, 0.1], [0.95, 0.3, 0.1]];

/// For each cell, how far towards the light something worn reaches; −∞ where there is nothing.
function depthsOf(parts, u, v, way, middle) {
  const depths = new Float32Array(side * side).fill(-Infinity);
  const cellLength = cell / u.length(); // in the units of the points
  const [a, b, c, p] = [new Vector3(), new Vector3(), new Vector3(), new Vector3()];
  for (const { own, triangles, hides } of parts) {
    for (let t = 0; t < triangles.length; t += 3) {
      if (hides[triangles[t]] + hides[triangles[t + 1]] + hides[triangles[t + 2]] < 3 * solid) continue;
      [a, b, c].forEach((corner, k) => corner.fromArray(own, 3 * triangles[t + k]).sub(middle));
      const steps = Math.min(8, Math.max(1, Math.ceil(Math.max(a.distanceTo(b), b.distanceTo(c), c.distanceTo(a)) / cellLength)));
      for (let i = 0; i <= steps; i += 1) {
        for (let j = 0; j <= steps - i; j += 1) {
          p.copy(a).addScaledVector(b, i / steps).addScaledVector(a, -(i + j) / steps).addScaledVector(c, j / steps);
          const x = Math.floor((p.dot(u) + half) / cell);
          const y = Math.floor((p.dot(v) + half) / cell);
          if (x < 0 || y < 0 || x >= side || y >= side) continue;
          depths[y * side + x] = Math.max(depths[y * side + x], p.dot(way));
        }
      }
    }
  }
  return depths;
}

/// \param points, normals  of the skin, three numbers a vertex
/// \param parts            {own: places, triangles, hides: a share for each place} of what is worn
/// \param matrix           from the places to a head of two units, whose middle is 0
/// \return                 per vertex the share of light that is left; null if nothing is worn
export function hairShade(points, normals, parts, matrix) {
  if (parts.length === 0) return null;
  const turn = new Matrix3().setFromMatrix4(matrix);
  const toPlaces = turn.clone().transpose(); // of a rotation and a scale
  const scale = new Vector3(1, 0, 0).applyMatrix3(turn).length();
  const middle = new Vector3().applyMatrix4(matrix.clone().invert());
  const count = points.length / 3;
  const lit = new Float32Array(count);
  const sum = new Float32Array(count);
  const p = new Vector3();
  for (const direction of ways) {
    const inHead = new Vector3(...direction).normalize();
    const flat = new Vector3(inHead.z, 0, -inHead.x).normalize();
    const [way, u, v] = [inHead, flat, inHead.clone().cross(flat)].map((axis) => axis.applyMatrix3(toPlaces)); // scaled, too
    const depths = depthsOf(parts, u, v, way, middle);
    const blocked = (x, y, depth) => (x < 0 || y < 0 || x >= side || y >= side ? 0 : Number(depths[y * side + x] > depth + clear));
    for (let i = 0; i < count; i += 1) {
      const facing = (normals[3 * i] * way.x + normals[3 * i + 1] * way.y + normals[3 * i + 2] * way.z) / scale;
      if (facing <= 0) continue;
      p.set(points[3 * i], points[3 * i + 1], points[3 * i + 2]).sub(middle);
      const [x, y, depth] = [(p.dot(u) + half) / cell - 0.5, (p.dot(v) + half) / cell - 0.5, p.dot(way)];
      const [left, low] = [Math.floor(x), Math.floor(y)];
      const [s, t] = [x - left, y - low];
      const share = (1 - t) * ((1 - s) * blocked(left, low, depth) + s * blocked(left + 1, low, depth)) +
        t * ((1 - s) * blocked(left, low + 1, depth) + s * blocked(left + 1, low + 1, depth));
      sum[i] += facing;
      lit[i] += facing * (1 - opacity * share);
    }
  }
  return lit.map((light, i) => (sum[i] > 0 ? light / sum[i] : 1));
}
