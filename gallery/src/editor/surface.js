// SPDX-License-Identifier: Apache-2.0
// The face on the screen as two textures, one texel a vertex: points with the distance to the
// target, and normals. What blends (on the card or on the processor) writes them; the vertex shader
// reads them.
import { DataTexture, FloatType, NearestFilter, RGBAFormat } from 'three';

/// How vertices lie in a texture: row by row, a power of two in each.
export function layoutOf(vertices, largest = 4096) {
  const width = Math.min(largest, 1 << Math.ceil(Math.log2(Math.sqrt(Math.max(vertices, 1)))));
  return { width, height: Math.max(1, Math.ceil(vertices / width)) };
}

export function floatTexture({ width, height }, values = new Float32Array(4 * width * height)) {
  const texture = new DataTexture(values, width, height, RGBAFormat, FloatType);
  texture.minFilter = NearestFilter;
  texture.magFilter = NearestFilter;
  texture.needsUpdate = true;
  return texture;
}

/// Three numbers a vertex as four.
export function padded(values, { width, height }) {
  const result = new Float32Array(4 * width * height);
  for (let v = 0; 3 * v < values.length; v += 1) {
    result[4 * v] = values[3 * v];
    result[4 * v + 1] = values[3 * v + 1];
    result[4 * v + 2] = values[3 * v + 2];
  }
  return result;
}

/// B = Σ τ_h B_h, three numbers a vertex.
export function targetPositions(heads, shares) {
  let result = null;
  shares.forEach((share, h) => {
    if (share === 0) return;
    const { positions } = heads[h];
    if (share === 1) {
      result = positions;
      return;
    }
    result ??= new Float32Array(positions.length);
    for (let i = 0; i < positions.length; i += 1) result[i] += share * positions[i];
  });
  return result;
}

/// Where the texel of a vertex is found, in shaders. Widths are powers of two, because dividing whole
/// numbers is slow where no graphics card draws.
export function texelOf({ width }) {
  return `
  ivec2 texelOf(int vertex) { return ivec2(vertex & ${width - 1}, vertex >> ${Math.log2(width)}); }`;
}
