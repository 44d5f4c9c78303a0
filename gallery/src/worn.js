// SPDX-License-Identifier: Apache-2.0
// Attachments of a face, such as hair and glasses. The page's data have the triangles and textures of each attachment
// once; each face has the positions of its attachments.
import {
  BufferAttribute, BufferGeometry, ClampToEdgeWrapping, Color, DoubleSide, Group, Mesh, RepeatWrapping, SRGBColorSpace, TextureLoader,
} from 'three';
import { bytesOf } from './bytes.js';
import { Draft } from './draft.js';
import { normalsOf } from './normals.js';
import { filtered } from './software.js';
import { extend, studioMaterial } from './studio.js';

const mostPairs = 4e6; // largest number of pairs (attachment vertex, skin vertex) whose distance nearestOf computes
// Attachments are drawn this much nearer to the camera, in scene units (about 0.6 mm), because the skin of a reduced mesh
// may lie too far out.
const nearer = 0.004;
const opaqueBelowSoft = 0.85; // smallest opacity of the texels that the first of two passes draws as opaque

export async function pictureAt(address, { colours, repeated }) {
  const texture = await new TextureLoader().loadAsync(address);
  if (colours) texture.colorSpace = SRGBColorSpace;
  texture.wrapS = repeated ? RepeatWrapping : ClampToEdgeWrapping;
  texture.wrapT = texture.wrapS;
  return filtered(texture);
}

/// Materials of an attachment. If it has an opacity texture, it is drawn in two passes, so that no triangle need be
/// sorted by depth: first the mostly opaque texels as opaque, then all texels blended over them.
function materialsOf(look) {
  const plain = { color: look.tint ?? (look.map ? new Color(1, 1, 1) : look.colour), map: look.map, side: DoubleSide };
  if (!look.alphaMap) {
    const seen = look.share < 1 ? { transparent: true, depthWrite: false, opacity: look.share } : {};
    return [studioMaterial('attachment', { ...plain, ...seen })];
  }
  const holes = { ...plain, alphaMap: look.alphaMap, opacity: look.share };
  return [
    studioMaterial('attachment', { ...holes, alphaTest: opaqueBelowSoft * look.share, alphaToCoverage: true }),
    studioMaterial('attachment', { ...holes, alphaTest: 0.02, transparent: true, depthWrite: false }),
  ];
}

/// Approximate opacity at each vertex.
function hidesAt({ share, alphaMap }, geometry, vertices) {
  const hides = new Float32Array(vertices).fill(share);
  if (!alphaMap) return hides;
  const size = 128;
  const context = new OffscreenCanvas(size, size).getContext('2d');
  context.drawImage(alphaMap.image, 0, 0, size, size);
  const { data } = context.getImageData(0, 0, size, size);
  const uvs = geometry.getAttribute('uv').array;
  const texel = (at) => Math.min(size - 1, Math.floor((at - Math.floor(at)) * size));
  return hides.map((own, v) => (own * data[4 * (texel(1 - uvs[2 * v + 1]) * size + texel(uvs[2 * v])) + 1]) / 255);
}

/// Prepares the part of an attachment that has one material. All faces use the same part, one after another.
/// \param software  whether the page draws without a graphics card: moving parts are then drawn as a draft
async function preparePart(data, software) {
  const numbers = (text) => new Uint32Array(bytesOf(text).buffer);
  const geometry = new BufferGeometry();
  const triangles = numbers(data.triangles);
  geometry.setIndex(new BufferAttribute(triangles, 1));
  const look = { colour: new Color(...data.colour), share: data.share };
  if (data.tint) look.tint = new Color(...data.tint); // factor on the linear colours of the texture
  if (data.uvs) {
    const uvs = new Float32Array(bytesOf(data.uvs).buffer);
    geometry.setAttribute('uv', new BufferAttribute(uvs, 2));
    const repeated = uvs.some((value) => value < 0 || value > 1);
    [look.map, look.alphaMap] = await Promise.all([
      data.picture ? pictureAt(data.picture, { colours: true, repeated }) : null,
      data.opacity ? pictureAt(data.opacity, { repeated }) : null]);
  }
  const part = { object: new Group(), geometry, triangles, twins: numbers(data.twins), vertices: data.vertices, hides: hidesAt(look, geometry, data.vertices) };
  if (software) return { ...part, ...formsOf(part, numbers(data.draft), look) };
  for (const material of materialsOf(look)) {
    extend(material, (shader) => {
      shader.vertexShader = shader.vertexShader.replace('#include <project_vertex>', `#include <project_vertex>
        gl_Position = projectionMatrix * (mvPosition + vec4(0.0, 0.0, ${nearer}, 0.0));`);
    });
    part.object.add(new Mesh(geometry, material));
  }
  return part;
}

/// The two forms of a part on pages that draw without a graphics card: the whole mesh and the draft, which is drawn
/// while something moves. Both compute light at vertices.
/// \param coarse  triangles of the draft
function formsOf({ object, geometry, triangles }, coarse, look) {
  const plain = (look.tint ?? (look.map ? new Color(1, 1, 1) : look.colour)).toArray();
  const [whole, draft] = [triangles, coarse].map((all) => {
    const form = new Draft({ triangles: all, uvs: geometry.getAttribute('uv')?.array, kind: 'attachment', isDouble: [true] });
    form.setPicture(0, look.map ?? null, { alphaMap: look.alphaMap ?? null, factor: plain });
    form.behind.value = -nearer;
    const [material] = form.materials;
    if (!look.alphaMap && look.share < 1) {
      Object.assign(material, { transparent: true, depthWrite: false });
      material.uniforms.share.value = look.share;
    }
    object.add(form.node);
    return form;
  });
  draft.node.name = 'draft';
  if (look.alphaMap) {
    const [solidly] = whole.materials;
    const soft = solidly.clone();
    Object.assign(soft, { transparent: true, depthWrite: false });
    soft.defines.SOFT = '';
    soft.uniforms = { ...solidly.uniforms, least: { value: 0.02 }, share: { value: look.share } };
    solidly.uniforms.least.value = opaqueBelowSoft;
    object.add(new Mesh(whole.geometry, soft));
  }
  return { whole, draft, colourAt: (_, colour) => plain.forEach((value, c) => { colour[c] = value; }) };
}

/// Unpacks positions.
/// \param packed  three 16-bit numbers per vertex: steps from the low corner of the bounding box
export function pointsOf(packed, { low, step }) {
  return Float32Array.from(new Uint16Array(bytesOf(packed).buffer), (value, i) => low[i % 3] + step * value);
}

/// For each vertex: index in `skin` of the x coordinate of the nearest skin position. If there are many pairs, only
/// some skin positions are compared.
function nearestOf(vertices, points, skin) {
  const step = 3 * Math.max(1, Math.round((vertices.length * (skin.length / 3)) / mostPairs));
  return Uint32Array.from(vertices, (v) => {
    const [x, y, z] = [points[3 * v], points[3 * v + 1], points[3 * v + 2]];
    let nearest = 0;
    let least = Infinity;
    for (let s = 0; s < skin.length; s += step) {
      const square = (skin[s] - x) ** 2 + (skin[s + 1] - y) ** 2 + (skin[s + 2] - z) ** 2;
      if (square < least) [least, nearest] = [square, s];
    }
    return nearest;
  });
}

export class Worn {
  /// \param software  whether the page draws without a graphics card
  constructor(software) {
    this.software = software;
    this.node = new Group();
    this.kept = new Map();
    this.parts = [];
    this.shown = [];
    this.form = 'whole';
  }

  /// Prepares the parts of an attachment, once for each name.
  /// \param load  returns the attachment's data, or a promise of the data
  prepare(name, load) {
    if (!this.kept.has(name)) {
      const parts = Promise.resolve(load()).then((data) => Promise.all(data.map((part) => preparePart(part, this.software))));
      parts.catch(() => this.kept.delete(name)); // so that the next call tries again
      this.kept.set(name, parts);
    }
    return this.kept.get(name);
  }

  /// Selects the form that is drawn.
  /// \param form  'draft' or 'whole'
  setForm(form) {
    this.form = form;
    for (const { object } of this.parts) {
      for (const mesh of object.children) mesh.visible = (mesh.name === 'draft') === (form === 'draft');
    }
  }

  /// Computes the light at the vertices of the form that is drawn.
  shade(camera, group) {
    if (!this.node.visible) return;
    for (const { whole, draft, normals, colourAt } of this.parts) (this.form === 'draft' ? draft : whole)?.light(camera, group, normals, 3, colourAt);
  }

  /// Moves each vertex of the drafts by the displacement of the nearest skin vertex since `show`.
  /// \param skin  positions of the same skin vertices as in `show`
  follow(skin) {
    for (const part of this.parts) {
      const { draft, own } = part;
      part.near ??= nearestOf(draft.vertices, own, this.skin);
      const to = draft.positions.array;
      draft.vertices.forEach((v, i) => {
        for (let c = 0; c < 3; c += 1) to[3 * i + c] = own[3 * v + c] + skin[part.near[i] + c] - this.skin[part.near[i] + c];
      });
      draft.positions.needsUpdate = true;
    }
  }

  /// Shows the attachments of a face.
  /// \param all   [parts, points] of each attachment; points as `pointsOf` returns them
  /// \param skin  positions of the skin vertices that `follow` takes; may be missing
  show(all, skin) {
    this.node.clear();
    this.parts = [];
    this.shown = all;
    this.skin = skin?.slice();
    for (const [parts, points] of all) {
      let at = 0;
      for (const part of parts) {
        const { object, geometry, triangles, twins, vertices } = part;
        const own = points.slice(at, at + 3 * vertices);
        at += own.length;
        const normals = new Float32Array(own.length);
        normalsOf(own, triangles, twins, normals, 3);
        geometry.setAttribute('position', new BufferAttribute(own, 3));
        geometry.setAttribute('normal', new BufferAttribute(normals, 3));
        geometry.computeBoundingSphere();
        for (const form of [part.whole, part.draft]) form?.place(own, 3);
        this.parts.push(Object.assign(part, { own, normals, near: null }));
        this.node.add(object);
      }
    }
    this.setForm(this.form);
  }
}
