// SPDX-License-Identifier: Apache-2.0
// Hair, glasses and the like beside a face. Each stands once in the data, its triangles and pictures;
// a face brings its positions.
import {
  BufferAttribute, BufferGeometry, ClampToEdgeWrapping, Color, DoubleSide, Group, Mesh, RepeatWrapping, SRGBColorSpace,
  TextureLoader,
} from 'three';
import { bytesOf } from './bytes.js';
import { normalsOf } from './normals.js';
import { studioMaterial } from './studio.js';

const solid = 0.5; // from here on a texel hides what is behind it

export async function pictureAt(address, { colours, repeated }) {
  const texture = await new TextureLoader().loadAsync(address);
  if (colours) texture.colorSpace = SRGBColorSpace;
  texture.wrapS = repeated ? RepeatWrapping : ClampToEdgeWrapping;
  texture.wrapT = texture.wrapS;
  texture.anisotropy = 4;
  return texture;
}

/// Where there is a picture of holes strands are drawn twice: what is there for the most part as if it were
/// whole, its edges by shares of a pixel; then, over it, what is hardly there. Nothing need be sorted by depth.
function materialsOf(look) {
  const plain = { color: look.tint ?? (look.map ? new Color(1, 1, 1) : look.colour), map: look.map, side: DoubleSide };
  if (!look.alphaMap) {
    const seen = look.share < 1 ? { transparent: true, depthWrite: false, opacity: look.share } : {};
    return [studioMaterial('attachment', { ...plain, ...seen })];
  }
  const holes = { ...plain, alphaMap: look.alphaMap, opacity: look.share };
  return [
    studioMaterial('attachment', { ...holes, alphaTest: solid * look.share, alphaToCoverage: true }),
    studioMaterial('attachment', { ...holes, alphaTest: 0.02, transparent: true, depthWrite: false }),
  ];
}

/// A part of one material, to be put on one face after the other.
async function preparePart(data) {
  const numbers = (text) => new Uint32Array(bytesOf(text).buffer);
  const geometry = new BufferGeometry();
  const triangles = numbers(data.triangles);
  geometry.setIndex(new BufferAttribute(triangles, 1));
  const look = { colour: new Color(...data.colour), share: data.share };
  if (data.tint) look.tint = new Color(...data.tint); // a factor on the picture's light
  if (data.uvs) {
    const uvs = new Float32Array(bytesOf(data.uvs).buffer);
    geometry.setAttribute('uv', new BufferAttribute(uvs, 2));
    const repeated = uvs.some((value) => value < 0 || value > 1);
    [look.map, look.alphaMap] = await Promise.all([
      data.picture ? pictureAt(data.picture, { colours: true, repeated }) : null,
      data.opacity ? pictureAt(data.opacity, { repeated }) : null]);
  }
  const object = new Group();
  for (const material of materialsOf(look)) object.add(new Mesh(geometry, material));
  return { object, geometry, triangles, twins: numbers(data.twins), vertices: data.vertices };
}

/// \param packed  steps from the frame's low corner: three numbers of 16 bits a vertex.
export function pointsOf(packed, { low, step }) {
  return Float32Array.from(new Uint16Array(bytesOf(packed).buffer), (value, i) => low[i % 3] + step * value);
}

export class Worn {
  constructor() {
    this.node = new Group();
    this.kept = new Map();
  }

  /// Of what was prepared once pictures and triangles stay.
  /// \param load  gives its data, or a promise of it.
  prepare(name, load) {
    if (!this.kept.has(name)) {
      const parts = Promise.resolve(load()).then((data) => Promise.all(data.map(preparePart)));
      parts.catch(() => this.kept.delete(name)); // to be tried again
      this.kept.set(name, parts);
    }
    return this.kept.get(name);
  }

  /// \param all  [parts, points] of each that a face wears; points as `pointsOf` gives them.
  show(all) {
    this.node.clear();
    for (const [parts, points] of all) {
      let at = 0;
      for (const { object, geometry, triangles, twins, vertices } of parts) {
        const own = points.slice(at, at + 3 * vertices);
        at += own.length;
        const normals = new Float32Array(own.length);
        normalsOf(own, triangles, twins, normals, 3);
        geometry.setAttribute('position', new BufferAttribute(own, 3));
        geometry.setAttribute('normal', new BufferAttribute(normals, 3));
        geometry.computeBoundingSphere();
        this.node.add(object);
      }
    }
  }
}
