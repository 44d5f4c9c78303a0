// SPDX-License-Identifier: Apache-2.0
// 3D views of reduced meshes. All faces of a crowd share one list of triangles, so the data of a face are positions and
// normals. The camera stays the same from face to face, for comparison.
import { BufferAttribute, BufferGeometry, DoubleSide, FrontSide, Mesh } from 'three';
import { bytesOf } from './bytes.js';
import { loadScript } from './dom.js';
import { Draft } from './draft.js';
import { hairShade } from './hair_shade.js';
import { normalsOf } from './normals.js';
import { eyeShader, eyeUniforms, linearColours, paintEyes, roughAtVertices, skinLightness, skinMaterial, Stage } from './stage.js';
import { pictureAt, pointsOf, Worn } from './worn.js';

/// Unpacks the data of a face: per vertex three 16-bit numbers, steps from the low corner of the bounding box; then per
/// vertex a normal as two numbers on the unfolded octahedron (Meyer et al. 2010, "On floating-point normal vectors");
/// then, in some files, one byte of roughness per vertex.
export function unpackFace(base64, mesh) {
  const bytes = bytesOf(base64);
  const count = mesh.vertices;
  const values = new Uint16Array(bytes.buffer, 0, 5 * count);
  const points = new Float32Array(3 * count);
  const normals = new Float32Array(3 * count);
  for (let i = 0; i < 3 * count; i += 1) points[i] = mesh.low[i % 3] + mesh.step * values[i];
  for (let i = 0; i < count; i += 1) {
    let x = (values[3 * count + 2 * i] / 65535) * 2 - 1;
    let y = (values[3 * count + 2 * i + 1] / 65535) * 2 - 1;
    const z = 1 - Math.abs(x) - Math.abs(y);
    if (z < 0) {
      [x, y] = [(1 - Math.abs(y)) * (x < 0 ? -1 : 1), (1 - Math.abs(x)) * (y < 0 ? -1 : 1)];
    }
    const length = Math.hypot(x, y, z);
    normals.set([x / length, y / length, z / length], 3 * i);
  }
  const roughness = bytes.length > 10 * count ? Float32Array.from(bytes.subarray(10 * count), (value) => value / 255) : null;
  return { points, normals, roughness };
}

/// The face's expression shapes: for each shape its number, the vertices that it moves (the same in all faces) and their
/// displacements.
export function unpackMoves(base64, mesh) {
  const moves = new Int16Array(bytesOf(base64).buffer);
  let at = 0;
  return mesh.moved.map((text, s) => {
    const vertices = new Uint32Array(bytesOf(text).buffer);
    const begin = at;
    at += 3 * vertices.length;
    return [s, { vertices, moves: moves.subarray(begin, at) }];
  });
}

/// The expression shapes of attachments: for each shape first the vertices, then their displacements.
function unpackSome(base64) {
  const bytes = bytesOf(base64);
  const count = bytes.length / 10;
  return { vertices: new Uint32Array(bytes.buffer, 0, count), moves: new Int16Array(bytes.buffer, 4 * count) };
}

/// Positions with weighted shapes added.
/// \param shapes  pairs [number of the shape, shape]
/// \param values  weight of each shape, by number
/// \param step    length of a displacement of 1, in the unit of the points
export function inShapes(points, shapes, values, step) {
  const moved = points.slice();
  shapes.forEach(([s, { vertices, moves }]) => {
    if (!values[s]) return;
    for (let i = 0; i < vertices.length; i += 1) {
      for (let c = 0; c < 3; c += 1) moved[3 * vertices[i] + c] += values[s] * step * moves[3 * i + c];
    }
  });
  return moved;
}

function unit(v) {
  for (let i = 0; i < v.length; i += 3) {
    const length = Math.hypot(v[i], v[i + 1], v[i + 2]) || 1;
    for (let c = 0; c < 3; c += 1) v[i + c] /= length;
  }
  return v;
}

export class Turntable extends Stage {
  /// The triangles and colours that all faces share.
  async prepare() {
    if (this.mesh) return;
    await loadScript('data/mesh.js');
    const mesh = window.crowdface.mesh;
    const geometry = new BufferGeometry();
    const bytes = bytesOf(mesh.triangles);
    geometry.setIndex(new BufferAttribute(new Uint32Array(bytes.buffer), 1));
    this.colours = linearColours(bytesOf(mesh.colours));
    this.twins = new Uint32Array(bytesOf(mesh.twins).buffer);
    this.light = Float32Array.from(bytesOf(mesh.light), (share) => share / 255);
    if (mesh.uvs) geometry.setAttribute('uv', new BufferAttribute(new Float32Array(bytesOf(mesh.uvs).buffer), 2));
    const looks = mesh.looks ?? [0];
    looks.forEach((first, l) => {
      geometry.addGroup(3 * first, 3 * ((looks[l + 1] ?? geometry.index.count / 3) - first), l);
    });
    const eyes = mesh.eyes
      ? Float32Array.from(new Uint32Array(bytesOf(mesh.eyes.places).buffer), (value) => value / mesh.eyes.steps - 4) : null;
    this.skinLightness = { value: 0 };
    this.materials = looks.map(() => {
      const material = skinMaterial({ sky: true, lightness: this.skinLightness, side: this.software ? FrontSide : DoubleSide });
      if (eyes) paintEyes(material, geometry, eyes, mesh.eyes);
      roughAtVertices(material);
      return material;
    });
    this.evenly = new Float32Array(mesh.vertices).fill(this.materials[0].roughness);
    this.object = new Mesh(geometry, this.materials);
    this.worn = new Worn(this.software);
    this.group.add(this.object, this.worn.node);
    if (this.software) this.prepareDraft(mesh, looks, eyes);
    if (mesh.widest) {
      this.opened = Float32Array.from(bytesOf(mesh.widest.light), (open, v) => open / 255 / Math.max(this.light[v], 1 / 255));
    }
    this.mesh = mesh;
    this.stand(mesh);
    this.view('front');
  }

  prepareDraft(mesh, looks, eyes) {
    const lookOf = new Uint8Array(mesh.vertices);
    const { groups, index } = this.object.geometry;
    groups.forEach(({ start, count, materialIndex }) => {
      for (const v of index.array.subarray(start, start + count)) lookOf[v] = materialIndex;
    });
    this.draft = new Draft({
      triangles: new Uint32Array(bytesOf(mesh.draft).buffer), uvs: this.object.geometry.getAttribute('uv')?.array, kind: 'skin',
      lookOf: (v) => lookOf[v], looks: looks.length,
      eyes: eyes && { places: eyes, uniforms: eyeUniforms(mesh.eyes), ...eyeShader },
    });
    this.draft.addInside();
    this.group.add(this.draft.node);
  }

  /// \param path  path of the script with the face's data
  /// \param name  key under which the script stores the data
  async show(path, name) {
    this.wanted = name;
    await this.prepare();
    await loadScript(path);
    const face = window.crowdface.faces[name];
    const texturesOf = async (layer, colours) => {
      const pictures = await Promise.all((layer?.pictures ?? []).map((address) => pictureAt(address, { colours, repeated: true })));
      return { pictures, ofLook: layer?.of_look ?? [] };
    };
    const [worn, skin, relief] = await Promise.all([this.attachments(face.worn), texturesOf(face.skin, true), texturesOf(face.relief, false)]);
    if (this.wanted !== name) return;
    const { points, normals, roughness } = unpackFace(face.points, this.mesh);
    this.face = { points, normals, worn, shapes: face.moves ? unpackMoves(face.moves, this.mesh) : [] };
    this.wear(skin, relief, face.colours);
    this.object.geometry.setAttribute('rough', new BufferAttribute(roughness ?? this.evenly, 1));
    this.shown = name;
    this.shade = null;
    this.act(this.values);
  }

  /// Sets the textures. Vertices of a material with a colour texture become white.
  /// \param skin, relief  {pictures, ofLook}: colour textures and normal maps
  /// \param own           the face's vertex colours; null: the colours that all faces share
  wear(skin, relief, own) {
    for (const picture of this.pictures ?? []) picture.dispose();
    this.pictures = [...skin.pictures, ...relief.pictures];
    const textureOf = ({ pictures, ofLook }, look) => pictures[ofLook[look]] ?? null;
    const colours = own ? linearColours(bytesOf(own)) : this.colours.slice();
    const { groups, index } = this.object.geometry;
    groups.forEach(({ start, count, materialIndex }) => {
      const material = this.materials[materialIndex];
      material.map = textureOf(skin, materialIndex);
      material.normalMap = textureOf(relief, materialIndex);
      material.needsUpdate = true;
      this.draft?.setPicture(materialIndex, material.map);
      if (!material.map) return;
      for (const v of index.array.subarray(start, start + count)) colours.fill(1, 3 * v, 3 * v + 3);
    });
    this.skinLightness.value = skin.pictures.length > 0 ? skinLightness(skin.pictures[0].image) : 0;
    this.face.colours = colours;
  }

  /// The attachments of a face: [parts, positions, shapes] of each.
  attachments(worn = {}) {
    return Promise.all(Object.entries(worn).map(async ([item, packed]) => {
      await loadScript(`data/attachments/${item}.js`);
      const { points, moves = {} } = packed.points ? packed : { points: packed };
      return [await this.worn.prepare(item, () => window.crowdface.attachments[item]), pointsOf(points, this.mesh),
        Object.entries(moves).map(([s, text]) => [s, unpackSome(text)])];
    }));
  }

  /// \param values  weight of each expression shape; null: the neutral face
  act(values = []) {
    this.values = values;
    if (!this.face) return;
    const { geometry } = this.object;
    const { shapes } = this.face;
    let { points, normals } = this.face;
    this.worn.show(this.face.worn.map(([parts, at, own]) => [parts, inShapes(at, own, values, this.mesh.step)]));
    if (shapes.some(([s]) => values[s])) {
      points = inShapes(points, shapes, values, this.mesh.step);
      // Rotate the whole mesh's normals as the shapes rotate those of the reduced mesh.
      const triangles = geometry.index.array;
      const ofReduced = (at) => {
        const rough = new Float32Array(at.length);
        normalsOf(at, triangles, this.twins, rough, 3);
        return rough;
      };
      this.face.rough ??= ofReduced(this.face.points);
      const { rough } = this.face;
      normals = unit(ofReduced(points).map((value, i) => value - rough[i] + this.face.normals[i]));
    }
    geometry.setAttribute('position', new BufferAttribute(points, 3));
    geometry.setAttribute('normal', new BufferAttribute(normals, 3));
    geometry.setAttribute('color', new BufferAttribute(this.face.colours, 3));
    this.shade ??= hairShade(this.face.points, this.face.normals, this.worn.parts, this.group.matrix) ?? [];
    const sky = this.skyIn(values[this.mesh.widest?.shape]).map((open, v) => open * (this.shade[v] ?? 1));
    geometry.setAttribute('sky', new BufferAttribute(sky, 1));
    geometry.computeBoundingSphere();
    this.draft?.setSky(sky);
    this.draft?.place(points, 3);
    this.draw();
  }

  /// The visible fraction of the sky at each vertex, which shapes that open the mouth increase.
  /// \param share  largest weight of these shapes
  skyIn(share = 0) {
    return this.light.map((light, v) => Math.min(1, (light * (1 + share * ((this.opened?.[v] ?? 1) - 1))) ** 2));
  }

  draw() {
    if (!this.object?.geometry.attributes.position) return;
    const { colours } = this.face;
    this.draft?.light(this.camera, this.group, this.object.geometry.getAttribute('normal').array, 3, (v, colour) => {
      for (let c = 0; c < 3; c += 1) colour[c] = colours[3 * v + c];
    });
    super.draw();
  }
}
