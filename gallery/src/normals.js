// SPDX-License-Identifier: Apache-2.0
/// Computes unit normals of vertices: area-weighted means of the normals of triangles.
/// \param twin      per vertex: a vertex at the same position, as in cornersAround; null: there are none
/// \param normals   receives the normals
/// \param stride    numbers per vertex in points and normals
/// \param vertices  the corners and their twins, ascending; null: all vertices
export function normalsOf(points, triangles, twin, normals, stride = 4, vertices = null) {
  const count = vertices ? vertices.length : normals.length / stride;
  for (let i = 0; i < count; i += 1) {
    const v = stride * (vertices ? vertices[i] : i);
    normals[v] = 0;
    normals[v + 1] = 0;
    normals[v + 2] = 0;
  }
  for (let t = 0; t < triangles.length; t += 3) {
    const a = stride * triangles[t];
    const b = stride * triangles[t + 1];
    const c = stride * triangles[t + 2];
    const ux = points[b] - points[a];
    const uy = points[b + 1] - points[a + 1];
    const uz = points[b + 2] - points[a + 2];
    const vx = points[c] - points[a];
    const vy = points[c + 1] - points[a + 1];
    const vz = points[c + 2] - points[a + 2];
    const nx = uy * vz - uz * vy;
    const ny = uz * vx - ux * vz;
    const nz = ux * vy - uy * vx;
    for (let k = 0; k < 3; k += 1) {
      const v = stride * (twin ? twin[triangles[t + k]] : triangles[t + k]);
      normals[v] += nx;
      normals[v + 1] += ny;
      normals[v + 2] += nz;
    }
  }
  for (let i = 0; i < count; i += 1) {
    const v = stride * (vertices ? vertices[i] : i);
    const from = twin ? stride * twin[v / stride] : v;
    const length = Math.hypot(normals[from], normals[from + 1], normals[from + 2]) || 1;
    if (from !== v) { // the twin comes earlier, so its normal has unit length already
      normals[v] = normals[from];
      normals[v + 1] = normals[from + 1];
      normals[v + 2] = normals[from + 2];
    } else {
      normals[v] /= length;
      normals[v + 1] /= length;
      normals[v + 2] /= length;
    }
  }
}
