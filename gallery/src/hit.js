// SPDX-License-Identifier: Apache-2.0

/// The first triangle that a ray meets, by Möller & Trumbore (1997), or null.
/// \param points  three numbers per vertex
/// \param part    per vertex: nonzero if it is not skin; triangles of such vertices are skipped
/// \return        triangle, barycentric coordinates u and v of its second and third corner, point, normal
export function hitTriangle(origin, way, points, triangles, part) {
  let best = null;
  let nearest = Infinity;
  const [ox, oy, oz] = origin;
  const [dx, dy, dz] = way;
  for (let t = 0; t < triangles.length; t += 3) {
    const a = 3 * triangles[t];
    if (part?.[triangles[t]]) continue;
    const b = 3 * triangles[t + 1];
    const c = 3 * triangles[t + 2];
    const e1x = points[b] - points[a];
    const e1y = points[b + 1] - points[a + 1];
    const e1z = points[b + 2] - points[a + 2];
    const e2x = points[c] - points[a];
    const e2y = points[c + 1] - points[a + 1];
    const e2z = points[c + 2] - points[a + 2];
    const px = dy * e2z - dz * e2y;
    const py = dz * e2x - dx * e2z;
    const pz = dx * e2y - dy * e2x;
    const det = e1x * px + e1y * py + e1z * pz;
    if (det <= 1e-12) continue; // the triangle faces away
    const sx = ox - points[a];
    const sy = oy - points[a + 1];
    const sz = oz - points[a + 2];
    const u = (sx * px + sy * py + sz * pz) / det;
    if (u < 0 || u > 1) continue;
    const qx = sy * e1z - sz * e1y;
    const qy = sz * e1x - sx * e1z;
    const qz = sx * e1y - sy * e1x;
    const v = (dx * qx + dy * qy + dz * qz) / det;
    if (v < 0 || u + v > 1) continue;
    const far = (e2x * qx + e2y * qy + e2z * qz) / det;
    if (far <= 0 || far >= nearest) continue;
    nearest = far;
    const normal = [e1y * e2z - e1z * e2y, e1z * e2x - e1x * e2z, e1x * e2y - e1y * e2x];
    const length = Math.hypot(...normal);
    best = {
      triangle: t / 3, u, v, point: [ox + far * dx, oy + far * dy, oz + far * dz], normal: normal.map((n) => n / length),
    };
  }
  return best;
}
