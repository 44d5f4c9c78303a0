// SPDX-License-Identifier: Apache-2.0
// Lists, for each vertex of a mesh, the triangles around it.

/// \param triangles  three vertices per triangle
/// \param twin       per vertex: the first vertex at the same position. Vertices that a texture seam splits have all
///                   triangles of their twins, so that normals do not show the seam. May be missing.
/// \return           `first`: per vertex the index of its first corner, and the total number; `next` and `after`: the
///                   two other vertices of each corner
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
