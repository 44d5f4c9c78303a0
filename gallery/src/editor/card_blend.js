// SPDX-License-Identifier: Apache-2.0
// Eq. 7 on the graphics card: one pass for positions and one for normals, one texel per vertex. A change uploads only
// the coefficients.
import {
  DataArrayTexture, DataTexture, FloatType, GLSL3, NearestFilter, RawShaderMaterial, RGBAFormat,
  RGBAIntegerFormat, RGIntegerFormat, ShortType, UnsignedIntType, WebGLRenderTarget,
} from 'three';
import { FullScreenQuad } from 'three/examples/jsm/postprocessing/Pass.js';
import { cornersAround } from './corners.js';
import { floatTexture, layoutOf, padded, targetPositions, texelOf } from './surface.js';

const start = `
  precision highp float;
  precision highp int;
  precision highp isampler2DArray;
  precision highp sampler2DArray;
  precision highp usampler2D;
  out vec4 result;`;

const pointShader = `${start}
  uniform isampler2DArray fields;
  uniform sampler2DArray masks;
  uniform sampler2D factors, base, moved;
  uniform int count, groups;
  void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    vec4 alpha[4];
    for (int g = 0; g < groups; ++g) alpha[g] = texelFetch(masks, ivec3(at, g), 0);
    vec3 added = vec3(0.0);
    for (int i = 0; i < count; ++i) {
      float factor = 0.0;
      for (int g = 0; g < groups; ++g) {
        factor += dot(alpha[g], texelFetch(factors, ivec2(1 + g, i), 0));
      }
      if (factor == 0.0) continue;
      int layer = int(texelFetch(factors, ivec2(0, i), 0).x);
      added += factor * vec3(texelFetch(fields, ivec3(at, layer), 0).xyz);
    }
    added += texelFetch(moved, at, 0).xyz;
    result = vec4(texelFetch(base, at, 0).xyz + added, length(added));
  }`;

const cornerRow = 2048;

const normalShader = (layout) => `${start}
  ${texelOf(layout)}
  uniform sampler2D points, turned;
  uniform usampler2D ends, corners;
  vec3 pointOf(uint vertex) { return texelFetch(points, texelOf(int(vertex)), 0).xyz; }
  void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    uvec4 own = texelFetch(ends, at, 0);
    vec3 here = texelFetch(points, at, 0).xyz;
    vec3 sum = vec3(0.0);
    for (uint i = own.x; i < own.y; ++i) {
      uvec4 corner = texelFetch(corners, ivec2(int(i) & ${cornerRow - 1}, int(i) >> ${Math.log2(cornerRow)}), 0);
      sum += cross(pointOf(corner.x) - here, pointOf(corner.y) - here);
    }
    float size = length(sum);
    result = vec4((size > 0.0 ? sum / size : vec3(0.0)) + texelFetch(turned, at, 0).xyz, 0.0);
  }`;

const differenceShader = `${start}
  uniform sampler2D plus, minus, more;
  void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    result = vec4((texelFetch(plus, at, 0) - texelFetch(minus, at, 0) + texelFetch(more, at, 0)).xyz, 0.0);
  }`;

function material(fragmentShader, names) {
  return new RawShaderMaterial({
    glslVersion: GLSL3, depthTest: false, depthWrite: false, fragmentShader,
    vertexShader: 'in vec3 position; void main() { gl_Position = vec4(position, 1.0); }',
    uniforms: Object.fromEntries(names.map((name) => [name, { value: null }])),
  });
}

function pairs(values, width) {
  const height = Math.max(1, Math.ceil(values.length / 2 / width));
  const all = new Uint32Array(2 * width * height);
  all.set(values);
  const texture = new DataTexture(all, width, height, RGIntegerFormat, UnsignedIntType);
  texture.internalFormat = 'RG32UI';
  texture.needsUpdate = true;
  return texture;
}

/// Whether the graphics card has textures large enough for the data of these heads.
export function fitsOnCard(renderer, regions, heads) {
  const gl = renderer.getContext();
  const layers = heads.reduce((sum, head) => sum + head.rank, 0);
  return regions <= 16 && renderer.extensions.has('EXT_color_buffer_float') &&
    layers <= gl.getParameter(gl.MAX_ARRAY_TEXTURE_LAYERS);
}

export class CardBlend {
  /// \param heads  all heads; they are uploaded once
  constructor(renderer, mesh, regions, heads) {
    Object.assign(this, { renderer, mesh, regions, heads, name: 'card' });
    this.layout = layoutOf(mesh.vertices);
    this.groups = Math.ceil(regions / 4);
    this.quad = new FullScreenQuad();
    const { width, height } = this.layout;
    const target = () => new WebGLRenderTarget(width, height, {
      type: FloatType, format: RGBAFormat, minFilter: NearestFilter, magFilter: NearestFilter, depthBuffer: false,
    });
    this.points = target();
    this.normals = target();
    this.moved = target();
    this.spare = target();
    this.turned = target();
    this.nothing = floatTexture({ width, height });
    this.point = material(pointShader, ['fields', 'masks', 'factors', 'base', 'moved', 'count', 'groups']);
    this.normal = material(normalShader(this.layout), ['points', 'turned', 'ends', 'corners']);
    this.difference = material(differenceShader, ['plus', 'minus', 'more']);
    this.putFields();
    this.putCorners();
    this.setMasks(mesh.alpha);
    this.unsettle();
  }

  get pointTexture() { return this.points.texture; }
  get normalTexture() { return this.normals.texture; }

  putFields() {
    const { width, height } = this.layout;
    const count = this.mesh.vertices;
    this.layers = [];
    let layers = 0;
    for (const head of this.heads) {
      this.layers.push(layers);
      layers += head.rank;
    }
    const all = new Int16Array(4 * width * height * Math.max(layers, 1));
    this.heads.forEach((head, h) => {
      for (let p = 0; p < head.rank; p += 1) {
        const to = 4 * width * height * (this.layers[h] + p);
        const from = 3 * count * p;
        for (let v = 0; v < count; v += 1) {
          for (let c = 0; c < 3; c += 1) all[to + 4 * v + c] = head.fields[from + 3 * v + c];
        }
      }
    });
    const texture = new DataArrayTexture(all, width, height, Math.max(layers, 1));
    Object.assign(texture, { format: RGBAIntegerFormat, type: ShortType, internalFormat: 'RGBA16I' });
    texture.onUpdate = () => { texture.source.data.data = null; };
    texture.needsUpdate = true;
    this.point.uniforms.fields.value = texture;
    this.factors = floatTexture({ width: 1 + this.groups, height: Math.max(layers, 1) });
    this.point.uniforms.factors.value = this.factors;
    this.point.uniforms.groups.value = this.groups;
    this.base = floatTexture(this.layout);
    this.point.uniforms.base.value = this.base;
  }

  putCorners() {
    const { vertices, triangles, twin } = this.mesh;
    const { first, next, after, place } = cornersAround(vertices, triangles, twin);
    const ends = new Uint32Array(2 * vertices);
    for (let v = 0; v < vertices; v += 1) ends.set([first[place[v]], first[place[v] + 1]], 2 * v);
    const corners = new Uint32Array(2 * next.length);
    for (let i = 0; i < next.length; i += 1) corners.set([next[i], after[i]], 2 * i);
    this.normal.uniforms.ends.value = pairs(ends, this.layout.width);
    this.normal.uniforms.corners.value = pairs(corners, cornerRow);
  }

  setMasks(alpha) {
    this.mesh.alpha = alpha;
    const { width, height } = this.layout;
    const all = new Float32Array(4 * width * height * this.groups);
    for (let v = 0; v < this.mesh.vertices; v += 1) {
      for (let k = 0; k < this.regions; k += 1) {
        all[4 * (width * height * (k >> 2) + v) + (k & 3)] = alpha[v * this.regions + k];
      }
    }
    this.point.uniforms.masks.value?.dispose();
    const texture = new DataArrayTexture(all, width, height, this.groups);
    Object.assign(texture, { format: RGBAFormat, type: FloatType });
    texture.needsUpdate = true;
    this.point.uniforms.masks.value = texture;
  }

  pass(step, target) {
    this.quad.material = step;
    this.renderer.setRenderTarget(target);
    this.quad.render(this.renderer);
    this.renderer.setRenderTarget(null);
  }

  /// \param lists   per region {head, field, value}; \param shares  τ_h, one a head.
  blend(lists, shares) {
    const key = shares.join();
    if (key !== this.key) {
      this.key = key;
      this.base.image.data.set(padded(targetPositions(this.heads, shares), this.layout));
      this.base.needsUpdate = true;
    }
    const rows = new Map();
    const wide = 4 * (1 + this.groups);
    const values = this.factors.image.data;
    lists.forEach((list, k) => {
      for (const { head, field, value } of list) {
        const layer = this.layers[head] + field;
        if (!rows.has(layer)) {
          rows.set(layer, rows.size);
          const row = wide * rows.get(layer);
          values.fill(0, row, row + wide);
          values[row] = layer;
        }
        values[wide * rows.get(layer) + 4 + k] = value * this.heads[head].scale[field];
      }
    });
    this.factors.needsUpdate = true;
    this.point.uniforms.count.value = rows.size;
    this.finish();
  }

  finish() {
    this.point.uniforms.moved.value = this.moved.texture;
    this.pass(this.point, this.points);
    this.shade(this.points.texture, this.turned.texture);
  }

  shade(points, turned) {
    this.normal.uniforms.points.value = points;
    this.normal.uniforms.turned.value = turned;
    this.pass(this.normal, this.normals);
  }

  subtract(plus, minus, more, target) {
    const { uniforms } = this.difference;
    uniforms.plus.value = plus;
    uniforms.minus.value = minus;
    uniforms.more.value = more;
    this.pass(this.difference, target);
  }

  /// See ProcessorBlend.settle.
  settle(positions, given) {
    const exact = floatTexture(this.layout, padded(positions, this.layout));
    const exactNormals = floatTexture(this.layout, padded(given, this.layout));
    this.subtract(exact, this.points.texture, this.moved.texture, this.spare);
    [this.moved, this.spare] = [this.spare, this.moved];
    this.shade(exact, this.nothing);
    this.subtract(exactNormals, this.normals.texture, this.nothing, this.turned);
    this.finish();
    exact.dispose();
    exactNormals.dispose();
  }

  unsettle() {
    for (const target of [this.moved, this.turned]) this.subtract(this.nothing, this.nothing, this.nothing, target);
  }

  read() {
    const { width, height } = this.layout;
    const all = new Float32Array(4 * width * height);
    this.renderer.readRenderTargetPixels(this.points, 0, 0, width, height, all);
    return Float32Array.from({ length: 3 * this.mesh.vertices }, (_, i) => all[4 * Math.floor(i / 3) + (i % 3)]);
  }

  dispose() {
    for (const target of [this.points, this.normals, this.moved, this.spare, this.turned]) target.dispose();
    for (const step of [this.point, this.normal, this.difference]) {
      for (const { value } of Object.values(step.uniforms)) value?.dispose?.();
      step.dispose();
    }
  }
}
