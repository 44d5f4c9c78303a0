// SPDX-License-Identifier: Apache-2.0
// Eq. 7 on the processor, in typed arrays. Without a graphics card this is faster than shaders, because a change of a
// region computes only this region's sums again.
import { normalsOf } from '../normals.js';
import { floatTexture, layoutOf, padded, targetPositions } from './surface.js';

const block = 512; // vertices per block; the sums of a block stay in the first-level cache while all fields are added

/// The corners of triangles and their twins, ascending.
function verticesOf(triangles, twin) {
  const vertices = new Set(triangles);
  if (twin) for (const v of triangles) vertices.add(twin[v]);
  return Uint32Array.from(vertices).sort();
}

export class ProcessorBlend {
  /// \param mesh  vertices, triangles, twin, alpha (#vertices by #regions) and, if there is one, draft: the triangles of a
  ///              coarser mesh with the same vertices
  constructor(mesh, regions) {
    Object.assign(this, { mesh, regions, name: 'processor', heads: [] });
    this.layout = layoutOf(mesh.vertices);
    const formOf = (triangles, vertices) => ({ triangles, vertices, turned: new Float32Array(3 * mesh.vertices) });
    this.whole = formOf(mesh.triangles, Uint32Array.from({ length: mesh.vertices }, (_, v) => v));
    this.draft = mesh.draft ? formOf(mesh.draft, verticesOf(mesh.draft, mesh.twin)) : null;
    this.points = new Float32Array(4 * this.layout.width * this.layout.height);
    this.normals = new Float32Array(this.points.length);
    this.moved = new Float32Array(3 * mesh.vertices);
    this.pointTexture = floatTexture(this.layout, this.points);
    this.normalTexture = floatTexture(this.layout, this.normals);
    this.setMasks(mesh.alpha);
  }

  setMasks(alpha) {
    this.mesh.alpha = alpha;
    for (const form of [this.whole, this.draft]) {
      if (!form) continue;
      form.parts = Array.from({ length: this.regions }, (_, k) => {
        const vertices = form.vertices.filter((v) => alpha[v * this.regions + k] !== 0);
        return {
          vertices,
          alpha: Float32Array.from(vertices, (v) => alpha[v * this.regions + k]),
          sums: new Float32Array(3 * vertices.length),
          key: '',
        };
      });
    }
  }

  setHead(h, head) {
    this.heads[h] = head;
  }

  /// \param lists   per region {head, field, value}; \param shares  τ_h, one a head.
  blend(lists, shares) {
    this.blendForm(this.whole, lists, shares);
  }

  /// Blends only the vertices of the draft.
  blendDraft(lists, shares) {
    if (this.isWhole) this.keepNormals();
    this.blendForm(this.draft, lists, shares);
  }

  /// Stores the difference between the normals of the whole mesh and those of the draft's larger triangles.
  keepNormals() {
    const { points, normals, draft: { triangles, vertices, turned } } = this;
    const fine = normals.slice();
    normalsOf(points, triangles, this.mesh.twin, normals, 4, vertices);
    for (const v of vertices) {
      for (let c = 0; c < 3; c += 1) turned[3 * v + c] = fine[4 * v + c] - normals[4 * v + c];
    }
  }

  blendForm(form, lists, shares) {
    const { points } = this;
    const base = targetPositions(this.heads, shares);
    if (!base) return;
    this.base = base;
    lists.forEach((list, k) => this.sum(form.parts[k], list));
    for (const v of form.vertices) {
      for (let c = 0; c < 3; c += 1) points[4 * v + c] = base[3 * v + c];
    }
    for (const { vertices, alpha, sums } of form.parts) {
      for (let i = 0; i < vertices.length; i += 1) {
        const to = 4 * vertices[i];
        points[to] += alpha[i] * sums[3 * i];
        points[to + 1] += alpha[i] * sums[3 * i + 1];
        points[to + 2] += alpha[i] * sums[3 * i + 2];
      }
    }
    this.finish(form);
  }

  /// Computes Σ c_f · field_f at a region's vertices, unless the coefficients have not changed.
  sum(part, list) {
    const key = list.map(({ head, field, value }) => `${head} ${field} ${value}`).join(';');
    if (key === part.key) return;
    part.key = key;
    const { vertices, sums } = part;
    sums.fill(0);
    const { vertices: count } = this.mesh;
    for (let begin = 0; begin < vertices.length; begin += block) {
      const end = Math.min(begin + block, vertices.length);
      for (const { head, field, value } of list) {
        const { fields, scale } = this.heads[head];
        const factor = value * scale[field];
        const offset = 3 * field * count;
        for (let i = begin; i < end; i += 1) {
          const from = offset + 3 * vertices[i];
          sums[3 * i] += factor * fields[from];
          sums[3 * i + 1] += factor * fields[from + 1];
          sums[3 * i + 2] += factor * fields[from + 2];
        }
      }
    }
  }

  /// Adds the stored differences (the program's last face minus its blend) to the positions; computes normals and
  /// distances to the target.
  finish(form) {
    const { points, normals, base, moved } = this;
    const { triangles, vertices, turned } = form;
    this.isWhole = form === this.whole;
    for (const v of vertices) {
      let square = 0;
      for (let c = 0; c < 3; c += 1) {
        points[4 * v + c] += moved[3 * v + c];
        square += (points[4 * v + c] - base[3 * v + c]) ** 2;
      }
      points[4 * v + 3] = Math.sqrt(square);
    }
    normalsOf(points, triangles, this.mesh.twin, normals, 4, vertices);
    for (const v of vertices) {
      for (let c = 0; c < 3; c += 1) normals[4 * v + c] += turned[3 * v + c];
    }
    this.pointTexture.needsUpdate = true;
    this.normalTexture.needsUpdate = true;
  }

  /// Shows the program's face in place of the last blend, and stores the differences for the next blends.
  settle(positions, given) {
    const { mesh, points, normals, moved, whole } = this;
    const exact = padded(positions, this.layout);
    for (let v = 0; v < mesh.vertices; v += 1) {
      for (let c = 0; c < 3; c += 1) {
        moved[3 * v + c] += positions[3 * v + c] - points[4 * v + c];
        points[4 * v + c] = positions[3 * v + c] - moved[3 * v + c];
      }
    }
    normalsOf(exact, mesh.triangles, mesh.twin, normals, 4, whole.vertices);
    for (let v = 0; v < mesh.vertices; v += 1) {
      for (let c = 0; c < 3; c += 1) whole.turned[3 * v + c] = given[3 * v + c] - normals[4 * v + c];
    }
    this.finish(whole);
  }

  /// Shows the program's face while the heads for a blend are not loaded.
  place(positions, given) {
    this.points.set(padded(positions, this.layout));
    this.normals.set(padded(given, this.layout));
    this.isWhole = true;
    this.pointTexture.needsUpdate = true;
    this.normalTexture.needsUpdate = true;
  }

  /// Clears the stored differences, because the target has changed.
  unsettle() {
    this.moved.fill(0);
    this.whole.turned.fill(0);
  }

  /// The positions that are shown, three numbers per vertex.
  read() {
    const result = new Float32Array(3 * this.mesh.vertices);
    for (let i = 0; i < result.length; i += 1) result[i] = this.points[4 * Math.floor(i / 3) + (i % 3)];
    return result;
  }

  dispose() {
    this.pointTexture.dispose();
    this.normalTexture.dispose();
  }
}
