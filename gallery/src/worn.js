// SPDX-License-Identifier: Apache-2.0
// Hair, glasses and the like beside a face. Each stands once in the data, its triangles and pictures;
// a face brings its positions.
import {
  BufferAttribute, BufferGeometry, ClampToEdgeWrapping, Color, DataTexture, DoubleSide, Group, Mesh, RepeatWrapping, ShaderMaterial,
  SRGBColorSpace, TextureLoader, Vector3,
} from 'three';
import { bytesOf } from './bytes.js';
import { normalsOf } from './normals.js';
import { keyShare, lightIn, studioMaterial, surfaces, withBounces } from './studio.js';

const cheapTexels = 512;
const typicalAlbedo = 0.3; // of light that bounces
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

/// Colours and holes in one small picture, looked up without filters.
function cheapTextureOf({ map, alphaMap }) {
  const { width, height } = (map ?? alphaMap).image;
  const scale = Math.min(1, cheapTexels / Math.max(width, height));
  const canvas = document.createElement('canvas');
  canvas.width = Math.max(1, Math.round(scale * width));
  canvas.height = Math.max(1, Math.round(scale * height));
  const context = canvas.getContext('2d', { willReadFrequently: true });
  const read = ({ image }) => {
    context.drawImage(image, 0, 0, canvas.width, canvas.height);
    return context.getImageData(0, 0, canvas.width, canvas.height);
  };
  const pixels = map ? read(map) : new ImageData(new Uint8ClampedArray(4 * canvas.width * canvas.height).fill(255), canvas.width);
  if (alphaMap) {
    const { data } = read(alphaMap);
    for (let i = 0; i < data.length; i += 4) pixels.data[i + 3] = data[i + 1];
  }
  const texture = new DataTexture(pixels.data, canvas.width, canvas.height);
  texture.flipY = true;
  texture.colorSpace = SRGBColorSpace;
  texture.wrapS = (map ?? alphaMap).wrapS;
  texture.wrapT = texture.wrapS;
  texture.needsUpdate = true;
  return texture;
}

/// The same in one pass, lit at vertices: where no graphics card draws, pixels are dear.
function cheapMaterialOf(look) {
  const plain = look.tint ?? (look.map ? new Color(1, 1, 1) : look.colour);
  return new ShaderMaterial({
    side: DoubleSide,
    defines: look.map || look.alphaMap ? { WITH_PICTURE: '' } : {},
    uniforms: { plain: { value: plain }, picture: { value: look.map || look.alphaMap ? cheapTextureOf(look) : null } },
    vertexShader: `
      attribute vec3 shade;
      varying vec3 vLight;
      varying vec2 vPlace;
      void main() {
        #ifdef WITH_PICTURE
          vPlace = uv;
        #endif
        vLight = 2.0 * shade;
        gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
      }`,
    fragmentShader: `
      varying vec3 vLight;
      varying vec2 vPlace;
      uniform vec3 plain;
      uniform sampler2D picture;
      void main() {
        vec3 light = plain * vLight;
        #ifdef WITH_PICTURE
          vec4 texel = texture2D(picture, vPlace);
          if (texel.a < ${solid.toFixed(1)}) discard;
          light *= texel.rgb;
        #endif
        gl_FragColor = vec4(light, 1.0);
        #include <colorspace_fragment>
      }`,
  });
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
  const cheap = new Mesh(geometry, cheapMaterialOf(look));
  cheap.name = 'cheap';
  object.add(cheap);
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
    this.cheap = false;
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

  /// \param on  whether all is drawn in the cheap form
  setCheap(on) {
    this.cheap = on;
    for (const part of this.node.children) {
      for (const mesh of part.children) mesh.visible = (mesh.name === 'cheap') === on;
    }
  }

  /// Lights the cheap form.
  shade(camera, group) {
    const light = lightIn(camera, group, 'attachment');
    const { sky } = surfaces.attachment;
    const [key, open] = [keyShare(sky), withBounces(sky, typicalAlbedo)];
    const ahead = camera.getWorldDirection(new Vector3()).transformDirection(group.matrixWorld.clone().invert());
    const sum = [0, 0, 0];
    for (const { children: [{ geometry }] } of this.node.children) {
      const normals = geometry.getAttribute('normal').array;
      const shades = geometry.getAttribute('shade') ?? new BufferAttribute(new Uint8Array(normals.length), 3, true);
      for (let i = 0; i < normals.length; i += 3) {
        const [x, y, z] = [normals[i], normals[i + 1], normals[i + 2]];
        const side = x * ahead.x + y * ahead.y + z * ahead.z > 0 ? -1 : 1; // that is seen
        light(side * x, side * y, side * z, sky, key, open, sum);
        for (let c = 0; c < 3; c += 1) shades.array[i + c] = Math.min(127.5 * sum[c], 255);
      }
      shades.needsUpdate = true;
      geometry.setAttribute('shade', shades);
    }
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
    this.setCheap(this.cheap);
  }
}
