// SPDX-License-Identifier: Apache-2.0
// Which triangles meet at a vertex, in order of vertices, and normals by them on the processor.

/// \param triangles  three vertices each.
/// \param twin       of each vertex the first one at its place: those that a texture's seam splits
///                   share their triangles, so that the seam does not show. May be missing.
/// \return           `first`, where each vertex's corners begin, and one more; `next` and `after`, the
///                   two other vertices of each corner.
export function cornersAround(vertices, triangles, twin) {
  const place = twin ?? Uint32Array.from({ length: vertices }, (_, v) => v);
  const count = new Uint32Array(vertices + 1);
  for (const v of triangles) count[place[v] + 1] += 1;
  for (let v = 0; v < vertices; v += 1) count[v + 1] += count[v];
  const at = count.slice();
  const next = new Uint32Array(triangles.length);
  const after = new Uint32Array(triangles.length);
  for (let t = 0; t < triangles.length; t += 3) {
    for (let c = 0; c < 3; c += 1) {
      const slot = at[place[triangles[t + c]]];
      at[place[triangles[t + c]]] += 1;
      next[slot] = triangles[t + ((c + 1) % 3)];
      after[slot] = triangles[t + ((c + 2) % 3)];
    }
  }
  return { first: count, next, after, place };
}

/// Normals as means of the triangles' by their areas. Points and normals have four numbers a vertex.
export function normalsOf(points, triangles, twin, normals) {
  normals.fill(0);
  for (let t = 0; t < triangles.length; t += 3) {
    const a = 4 * triangles[t];
    const b = 4 * triangles[t + 1];
    const c = 4 * triangles[t + 2];
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
      const v = 4 * (twin ? twin[triangles[t + k]] : triangles[t + k]);
      normals[v] += nx;
      normals[v + 1] += ny;
      normals[v + 2] += nz;
    }
  }
  for (let v = 0; v < normals.length; v += 4) {
    const from = twin ? 4 * twin[v / 4] : v;
    const length = Math.hypot(normals[from], normals[from + 1], normals[from + 2]) || 1;
    if (from !== v) { // the twin stands before and is of unit length by now
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
