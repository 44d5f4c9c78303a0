// SPDX-License-Identifier: Apache-2.0
// The draft: a coarser mesh that is drawn while something moves on pages without a graphics card. Shaders run on the
// processor there, so light is computed once per vertex, in typed arrays, and a pixel takes one texel and one product,
// both as sRGB values (tones).
import {
  BufferAttribute, BufferGeometry, Color, DataTexture, DoubleSide, FrontSide, LinearFilter, LinearMipmapNearestFilter, Mesh, MeshBasicMaterial,
  NoColorSpace, ShaderMaterial, Sphere, Vector3,
} from 'three';
import { keyShare, lightIn, shoulder, surfaces, withBounces } from './studio.js';

const depth = 0.02; // scene units, about 3 mm
const innerSide = '0.4';
const largest = 512; // largest side of a draft's texture, in texels
const steps = 4096;
const brightest = 2;
const typicalAlbedo = 0.3; // mean albedo of the surfaces that reflect light to each other
const darkest = 0.03; // smallest texel tone by which light is divided
const solid = 128; // smallest alpha byte of a texel that hides the surfaces behind it

const toneOf = (light) => (light <= 0.0031308 ? 12.92 * light : 1.055 * light ** (1 / 2.4) - 0.055);
const lightOf = (tone) => (tone <= 0.04045 ? tone / 12.92 : ((tone + 0.055) / 1.055) ** 2.4);
const tones = Float32Array.from({ length: steps + 1 }, (_, i) => toneOf(Math.min(shoulder((i * brightest) / steps), 1)));
const lights = Float32Array.from({ length: 256 }, (_, i) => lightOf(i / 255));
const toneAt = (light) => tones[Math.min(steps, Math.round((light * steps) / brightest))];

/// Combines colour and opacity textures in one small image.
function smallPicture(map, alphaMap) {
  const { width, height } = (map ?? alphaMap).image;
  const scale = Math.min(1, largest / Math.max(width, height));
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
  return pixels;
}

/// \param isSeenSmall  whether to make mipmaps, which thin hair needs
function textureOf({ data, width, height }, { flipY, wrapS, wrapT }, isSeenSmall) {
  const texture = new DataTexture(data, width, height);
  Object.assign(texture, {
    flipY, wrapS, wrapT, minFilter: isSeenSmall ? LinearMipmapNearestFilter : LinearFilter, magFilter: LinearFilter,
    generateMipmaps: isSeenSmall, colorSpace: NoColorSpace, needsUpdate: true,
  });
  return texture;
}

/// \param behind  {value}: distance by which the draft is drawn farther from the camera, in scene units
/// \param eyes    GLSL of painted eyes, or null
function materialOf(side, behind, eyes) {
  return new ShaderMaterial({
    side,
    uniforms: { picture: { value: null }, paintsEyes: { value: true }, least: { value: 0.5 }, behind, share: { value: 1 }, ...eyes?.uniforms },
    vertexShader: `
      attribute vec4 shade;
      attribute float away;
      varying vec4 vShade;
      varying vec2 vPlace;
      varying float vAway;
      uniform float behind;
      ${eyes?.vertex ?? ''}
      void main() {
        vShade = shade;
        #ifdef WITH_INSIDE
          vAway = away;
        #endif
        #ifdef WITH_PICTURE
          vPlace = uv;
        #endif
        #ifdef WITH_EYES
          vEye = eye;
        #endif
        vec4 place = modelViewMatrix * vec4(position, 1.0);
        place.z -= behind;
        gl_Position = projectionMatrix * place;
      }`,
    fragmentShader: `
      varying vec4 vShade;
      varying vec2 vPlace;
      varying float vAway;
      uniform sampler2D picture;
      uniform bool paintsEyes;
      uniform float least, share;
      ${eyes?.fragment ?? ''}
      void main() {
        #ifdef WITH_INSIDE
          if (!gl_FrontFacing) {
            if (vAway < ${innerSide}) discard;
            gl_FragColor = vec4(0.13, 0.11, 0.1, 1.0);
            return;
          }
        #endif
        vec3 tone = 2.0 * vShade.rgb;
        #ifdef WITH_PICTURE
          #ifdef WITH_HOLES
            vec4 texel = texture2D(picture, vPlace, -1.0);  // keeps strands apart on slanted hair cards
            if (texel.a < least) discard;
          #else
            vec4 texel = texture2D(picture, vPlace);
          #endif
          tone *= mix(vec3(1.0), texel.rgb, vShade.a);
        #endif
        #ifdef WITH_EYES
          if (paintsEyes && isEye() && vShade.a < 0.5) tone *= sRGBTransferOETF(vec4(eyeballColour(), 1.0)).rgb;
        #endif
        #ifdef SOFT
          gl_FragColor = vec4(tone, share * texel.a);
        #else
          gl_FragColor = vec4(tone, share);
        #endif
      }`,
  });
}

export class Draft {
  /// \param triangles  triangles of the coarser mesh: vertices of the whole mesh
  /// \param uvs        two numbers per vertex, or null
  /// \param kind       a key of `surfaces`
  /// \param lookOf     function of a vertex: number of the vertex's material
  /// \param looks      number of materials
  /// \param isDouble   per material: whether both sides are visible, lit as the side that faces the camera
  /// \param eyes       {places, uniforms, vertex, fragment} as in paintEyes, or null
  constructor({ triangles, uvs, kind, lookOf = () => 0, looks = 1, isDouble = [], eyes = null }) {
    const numbers = new Map();
    const index = [];
    const groups = Array.from({ length: looks }, () => []);
    for (let t = 0; t < triangles.length; t += 3) groups[lookOf(triangles[t])].push(t);
    const geometry = new BufferGeometry();
    groups.forEach((starts, look) => {
      geometry.addGroup(index.length, 3 * starts.length, look);
      for (const t of starts) {
        for (const v of triangles.subarray(t, t + 3)) {
          if (!numbers.has(v)) numbers.set(v, numbers.size);
          index.push(numbers.get(v));
        }
      }
    });
    this.vertices = Uint32Array.from(numbers.keys());
    const count = this.vertices.length;
    const of = (values, size) => Float32Array.from({ length: size * count }, (_, i) => values[size * this.vertices[Math.floor(i / size)] + (i % size)]);
    Object.assign(this, { kind, geometry, looks: Uint8Array.from(this.vertices, lookOf) });
    this.isDouble = this.looks.map((look) => (isDouble[look] ? 1 : 0));
    geometry.setIndex(new BufferAttribute(Uint32Array.from(index), 1));
    geometry.boundingSphere = new Sphere(new Vector3(), 1e6);
    this.positions = new BufferAttribute(new Float32Array(3 * count), 3);
    this.shades = new BufferAttribute(new Uint16Array(4 * count), 4, true);
    geometry.setAttribute('position', this.positions);
    geometry.setAttribute('shade', this.shades);
    if (uvs) geometry.setAttribute('uv', new BufferAttribute(of(uvs, 2), 2));
    if (eyes) geometry.setAttribute('eye', new BufferAttribute(of(eyes.places, 3), 3));
    this.isEye = Uint8Array.from(this.vertices, (v) => (eyes && eyes.places[3 * v + 2] > -1.5 ? 1 : 0));
    this.white = eyes?.uniforms.eyeWhite.value.toArray();
    this.behind = { value: 0 };
    this.materials = groups.map((_, look) => {
      const material = materialOf(isDouble[look] ? DoubleSide : FrontSide, this.behind, eyes);
      if (this.looks.some((own, i) => own === look && this.isEye[i])) material.defines.WITH_EYES = '';
      return material;
    });
    this.pictures = groups.map(() => null);
    this.texels = new Float32Array(3 * count); // linear colours of the textures at the vertices
    this.tones = new Float32Array(3 * count); // the same as sRGB values
    this.inPicture = new Uint8Array(count);
    this.factor = [1, 1, 1];
    this.node = new Mesh(geometry, this.materials);
    this.setSky(null);
  }

  /// Draws the inner side of the skin dark; but not where the smooth normals point to the camera, because triangles at
  /// outlines only seem to face away.
  addInside() {
    this.away = new BufferAttribute(new Float32Array(this.vertices.length), 1);
    this.geometry.setAttribute('away', this.away);
    for (const material of this.materials) {
      if (material.side === DoubleSide) continue;
      material.side = DoubleSide;
      material.defines.WITH_INSIDE = '';
    }
  }

  /// \param on  whether the whole mesh is drawn: the draft is then drawn a little behind it and closes cracks between
  ///            triangles
  setBehind(on) {
    this.behind.value = on ? depth : 0;
  }

  /// The draft's edges as lines, drawn over the surface.
  edges(colour, opacity) {
    const lines = new Mesh(this.geometry, new MeshBasicMaterial({ color: new Color(colour), wireframe: true, transparent: true, opacity }));
    for (const material of this.materials) Object.assign(material, { polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 });
    return lines;
  }

  /// \param sky  per vertex of the whole mesh: fraction of the sky that is visible; null: the value of the surface kind
  setSky(sky) {
    this.sky = Float32Array.from(this.vertices, (v) => sky?.[v] ?? surfaces[this.kind].sky);
    this.lit = this.sky.map(keyShare);
    this.open = this.sky.map((share) => withBounces(share, typicalAlbedo));
  }

  /// Sets the textures of a material.
  /// \param shows  function of a vertex of the whole mesh: whether the texture covers the vertex
  setPicture(look, map, { alphaMap = null, shows = () => true, factor = [1, 1, 1] } = {}) {
    const picture = map ?? alphaMap;
    const own = [map, alphaMap];
    if (this.pictures[look]?.every((texture, k) => texture === own[k])) return;
    const material = this.materials[look];
    material.uniforms.picture.value?.dispose();
    this.pictures[look] = own;
    this.factor = factor;
    const { WITH_PICTURE, WITH_HOLES, ...defines } = material.defines;
    material.defines = { ...defines, ...(picture && { WITH_PICTURE: '' }), ...(alphaMap && { WITH_HOLES: '' }) };
    material.needsUpdate = true;
    const pixels = picture ? smallPicture(map, alphaMap) : null;
    material.uniforms.picture.value = pixels && textureOf(pixels, picture, alphaMap !== null);
    const mean = pixels && alphaMap ? this.meanOf(pixels) : null;
    const uvs = this.geometry.getAttribute('uv')?.array;
    this.vertices.forEach((v, i) => {
      if (this.looks[i] !== look) return;
      this.inPicture[i] = picture && shows(v) ? 1 : 0;
      if (!this.inPicture[i]) return;
      const at = mean ? 0 : this.texelAt(pixels, picture.flipY, uvs[2 * i], uvs[2 * i + 1]);
      for (let c = 0; c < 3; c += 1) {
        const byte = mean ? mean[c] : pixels.data[at + c];
        this.texels[3 * i + c] = lights[byte] * factor[c];
        this.tones[3 * i + c] = Math.max(byte / 255, darkest);
      }
    });
  }

  texelAt({ width, height }, flipY, u, v) {
    const whole = (share, size) => Math.min(size - 1, Math.floor((share - Math.floor(share)) * size));
    return 4 * (whole(flipY ? 1 - v : v, height) * width + whole(u, width));
  }

  /// Mean colour of the texels that hide the surfaces behind them, three bytes.
  meanOf({ data }) {
    const sum = [0, 0, 0];
    let count = 0;
    for (let i = 0; i < data.length; i += 4) {
      if (data[i + 3] < solid) continue;
      for (let c = 0; c < 3; c += 1) sum[c] += data[i + c];
      count += 1;
    }
    return sum.map((value) => Math.round(value / Math.max(count, 1)));
  }

  /// \param points  positions of the whole mesh, `stride` numbers per vertex
  place(points, stride) {
    const to = this.positions.array;
    this.vertices.forEach((v, i) => {
      for (let c = 0; c < 3; c += 1) to[3 * i + c] = points[stride * v + c];
    });
    this.positions.needsUpdate = true;
  }

  /// Computes the light at each vertex.
  /// \param normals     normals of the whole mesh, `stride` numbers per vertex
  /// \param colourAt    (vertex, sum): writes the albedo of a vertex without texture to `sum`
  /// \param paintsEyes  true: eyes are painted; false: eyes have the colours of `colourAt`
  light(camera, group, normals, stride, colourAt, paintsEyes = true) {
    for (const { uniforms } of this.materials) uniforms.paintsEyes.value = paintsEyes;
    const { diffuse, gloss } = lightIn(camera, group, this.kind);
    const ahead = camera.getWorldDirection(new Vector3()).transformDirection(group.matrixWorld.clone().invert());
    const { vertices, isDouble, isEye, white, inPicture, texels, tones: own, sky, lit, open } = this;
    const to = this.shades.array;
    const sum = [0, 0, 0];
    const albedo = [0, 0, 0];
    for (let i = 0; i < vertices.length; i += 1) {
      const v = vertices[i];
      const from = stride * v;
      const [x, y, z] = [normals[from], normals[from + 1], normals[from + 2]];
      if (this.away) this.away.array[i] = x * ahead.x + y * ahead.y + z * ahead.z;
      const side = isDouble[i] && x * ahead.x + y * ahead.y + z * ahead.z > 0 ? -1 : 1; // the side that faces the camera
      diffuse(side * x, side * y, side * z, sky[i], lit[i], open[i], sum);
      const eye = paintsEyes && isEye[i] === 1 && !inPicture[i];
      if (inPicture[i]) for (let c = 0; c < 3; c += 1) albedo[c] = texels[3 * i + c];
      else if (eye) for (let c = 0; c < 3; c += 1) albedo[c] = white[c];
      else colourAt(v, albedo);
      for (let c = 0; c < 3; c += 1) sum[c] *= albedo[c];
      gloss(side * x, side * y, side * z, sky[i], lit[i], (albedo[0] + albedo[1] + albedo[2]) / 3, sum);
      to[4 * i + 3] = inPicture[i] ? 65535 : 0;
      for (let c = 0; c < 3; c += 1) {
        const base = inPicture[i] ? own[3 * i + c] : eye ? toneOf(white[c]) : 1;
        to[4 * i + c] = Math.min(65535, (32767.5 * toneAt(sum[c])) / base);
      }
    }
    this.shades.needsUpdate = true;
    if (this.away) this.away.needsUpdate = true;
  }

  dispose() {
    this.geometry.dispose();
    for (const material of this.materials) {
      material.uniforms.picture.value?.dispose();
      material.dispose();
    }
  }
}
