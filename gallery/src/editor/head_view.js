// SPDX-License-Identifier: Apache-2.0
// The 3D view of the edited face. The face is blended on the graphics card or on the processor, whichever is faster in a
// measurement, and shown with the colours of its surfaces, a texture, its distance to the target, or its regions.
import {
  BufferAttribute, BufferGeometry, Color, DoubleSide, FrontSide, Mesh, MeshBasicMaterial, Ray, Sphere, SRGBColorSpace, Texture,
  TextureLoader, Vector2, Vector3,
} from 'three';
import { eyeShader, eyeUniforms, linearColours, paintEyes, roughAtVertices, skinLightness, skinMaterial, Stage } from '../stage.js';
import { filtered } from '../software.js';
import { extend, surfaces } from '../studio.js';
import { CardBlend, fitsOnCard } from './card_blend.js';
import { Draft } from '../draft.js';
import { ProcessorBlend } from './processor_blend.js';
import { hairShade } from '../hair_shade.js';
import { hitTriangle } from '../hit.js';
import { Worn } from '../worn.js';
import { layoutOf, texelOf } from './surface.js';

const shows = ['surface', 'texture', 'distance', 'regions'];

/// Six colours of the Viridis palette (Smith and van der Walt), from small (dark) to large distances (light).
export const distanceColours = ['#440154', '#414487', '#2a788e', '#22a884', '#7ad151', '#fde725'];

/// Makes a material read positions and normals from the textures of the blend instead of attributes.
function fetchFace(material, uniforms, layout) {
  extend(material, (shader) => {
    Object.assign(shader.uniforms, uniforms);
    shader.vertexShader = shader.vertexShader
      .replace('#include <common>', `#include <common>
        uniform highp sampler2D facePoints, faceNormals;
        attribute vec3 regionColour;
        varying float vMoved;
        varying vec3 vRegion;
        ${texelOf(layout)}`)
      .replace('#include <beginnormal_vertex>', `
        vec3 objectNormal = texelFetch(faceNormals, texelOf(gl_VertexID), 0).xyz;`)
      .replace('#include <begin_vertex>', `
        vec4 facePoint = texelFetch(facePoints, texelOf(gl_VertexID), 0);
        vec3 transformed = facePoint.xyz;
        vMoved = facePoint.w;
        vRegion = regionColour;`);
    shader.fragmentShader = shader.fragmentShader
      .replace('#include <common>', `#include <common>
        uniform int faceShow;
        uniform float farthest;
        uniform vec3 distanceColours[${distanceColours.length}];
        varying float vMoved;
        varying vec3 vRegion;`)
      .replace('#include <color_fragment>', `#include <color_fragment>
        if (faceShow == 2) {
          float x = clamp(vMoved / farthest, 0.0, 1.0) * ${distanceColours.length - 1}.0;
          int low = min(int(x), ${distanceColours.length - 2});
          diffuseColor.rgb = mix(distanceColours[low], distanceColours[low + 1], x - float(low));
        } else if (faceShow == 3) {
          diffuseColor.rgb = mix(diffuseColor.rgb, vRegion, 0.72);
        }`);
  });
}

/// Makes a material use vertex colours where the mesh has no texture.
function mapWhereTextured(material) {
  material.defines.SOME_TEXTURED = '';
  extend(material, (shader) => {
    shader.vertexShader = shader.vertexShader
      .replace('#include <common>', '#include <common>\nattribute float textured;\nvarying float vTextured;')
      .replace('#include <project_vertex>', 'vTextured = textured;\n#include <project_vertex>');
    shader.fragmentShader = shader.fragmentShader
      .replace('#include <common>', '#include <common>\nvarying float vTextured;')
      .replace('#include <map_fragment>', `
        #ifdef USE_MAP
          diffuseColor *= mix(vec4(1.0), texture2D(map, vMapUv), vTextured);
        #endif`);
  });
}

async function textureOf(bytes, { colours }) {
  const bitmap = await createImageBitmap(new Blob([bytes], { type: 'image/jpeg' }), { imageOrientation: 'flipY' });
  const texture = new Texture(bitmap);
  texture.flipY = false; // the bitmap is already flipped
  if (colours) texture.colorSpace = SRGBColorSpace;
  texture.needsUpdate = true;
  return filtered(texture);
}

export class HeadView extends Stage {
  /// \param job   the server's answer to api/job
  /// \param mesh  the server's answer to api/mesh
  constructor(job, mesh) {
    super({ pan: true });
    Object.assign(this, { job, mesh, show: 'surface', showMm: 6, textures: new Map(), loaded: [] });
    this.uniforms = {
      facePoints: { value: null },
      faceNormals: { value: null },
      faceShow: { value: 0 },
      farthest: { value: this.showMm / job.mm_per_unit },
      distanceColours: { value: distanceColours.map((hex) => new Color(hex)) },
    };
    this.blender = new ProcessorBlend(mesh, job.regions.length);
    this.geometry = this.makeGeometry();
    this.skinLightness = { value: 0 };
    this.material = skinMaterial({ sky: true, lightness: this.skinLightness, side: this.software ? FrontSide : DoubleSide });
    const layout = layoutOf(mesh.vertices);
    mapWhereTextured(this.material);
    fetchFace(this.material, this.uniforms, layout);
    if (mesh.eyes) paintEyes(this.material, this.geometry, mesh.eyes, mesh.head.eyes);
    roughAtVertices(this.material);
    this.object = new Mesh(this.geometry, this.material);
    this.object.frustumCulled = false;
    const lines = new MeshBasicMaterial({
      color: 0x101214, wireframe: true, transparent: true, opacity: 0.55, side: DoubleSide, toneMapped: false,
    });
    fetchFace(lines, { ...this.uniforms, faceShow: { value: 0 } }, layout);
    this.material.polygonOffset = true;
    this.material.polygonOffsetFactor = 1;
    this.material.polygonOffsetUnits = 1;
    this.lines = new Mesh(this.geometry, lines);
    this.lines.frustumCulled = false;
    this.lines.visible = this.wireframe = false;
    this.worn = new Worn(this.software);
    this.group.add(this.object, this.lines, this.worn.node);
    if (this.software) this.prepareDraft();
    this.stand({ up: job.up, front: job.front, box: [mesh.low, mesh.high] });
    this.take(this.blender);
    this.view('front');
  }

  makeGeometry() {
    const { mesh } = this;
    const geometry = new BufferGeometry();
    geometry.setIndex(new BufferAttribute(mesh.triangles, 1));
    const { vertices } = mesh;
    this.isTextured = mesh.textured ?? new Uint8Array(vertices);
    geometry.setAttribute('textured', new BufferAttribute(this.isTextured, 1));
    geometry.setAttribute('rough', new BufferAttribute(new Float32Array(vertices).fill(surfaces.skin.roughness), 1));
    geometry.setAttribute('sky', new BufferAttribute(new Float32Array(vertices).fill(1), 1));
    this.surfaceColours = linearColours(mesh.colours);
    geometry.setAttribute('color', new BufferAttribute(this.surfaceColours.slice(), 3));
    if (mesh.uv) geometry.setAttribute('uv', new BufferAttribute(mesh.uv, 2));
    // Three.js makes wireframes and bounds from this attribute; drawing takes the positions from textures.
    geometry.setAttribute('position', new BufferAttribute(new Float32Array(3 * mesh.vertices), 3));
    geometry.boundingSphere = new Sphere(new Vector3(), 1e6);
    this.colourRegions(geometry);
    return geometry;
  }

  prepareDraft() {
    const { mesh } = this;
    this.draft = new Draft({
      triangles: mesh.draft, uvs: mesh.uv, kind: 'skin', looks: 2, isDouble: [false, true],
      lookOf: (v) => (mesh.part?.[v] ? 1 : 0), // lashes are visible from both sides
      eyes: mesh.eyes && { places: mesh.eyes, uniforms: eyeUniforms(mesh.head.eyes), ...eyeShader },
    });
    this.draftLines = this.draft.edges(0x101214, 0.55);
    this.draft.addInside();
    this.draftLines.visible = false;
    this.group.add(this.draft.node, this.draftLines);
  }

  /// \param light  per vertex: square root of the visible fraction of the sky, times 255
  setLight(light) {
    this.open = Float32Array.from(light, (root) => (root / 255) ** 2);
    this.shadeSkin();
    this.draw();
  }

  /// Updates the fraction of the sky that each skin vertex sees past the attachments.
  shadeSkin() {
    const { open, shade } = this;
    if (!open) return;
    const sky = shade ? open.map((share, v) => share * shade[v]) : open;
    this.geometry.setAttribute('sky', new BufferAttribute(sky, 1));
    this.draft?.setSky(sky);
  }

  /// Shows the textures of the face.
  /// \param picture, normals  JPEG files of the atlas; may be missing
  /// \param rough, colours    numbers per vertex; may be missing
  async setSkin({ picture, normals, rough, colours }) {
    const [map, relief] = await Promise.all([picture ? textureOf(picture, { colours: true }) : null,
      normals ? textureOf(normals, { colours: false }) : null]);
    for (const texture of [this.skin?.map, this.skin?.relief]) texture?.dispose();
    this.skin = { map, relief };
    if (map) this.skinLightness.value = skinLightness(map.image);
    if (colours) this.surfaceColours.set(linearColours(colours));
    if (rough) {
      this.geometry.setAttribute('rough', new BufferAttribute(Float32Array.from(rough, (value) => value / 255), 1));
    }
    if (this.show === 'surface') this.setShow('surface');
  }

  colourRegions(geometry = this.geometry) {
    const { mesh, job } = this;
    const count = job.regions.length;
    const colours = job.regions.map((region) => new Color(region.colour));
    const mixed = new Float32Array(3 * mesh.vertices);
    for (let v = 0; v < mesh.vertices; v += 1) {
      for (let k = 0; k < count; k += 1) {
        const alpha = mesh.alpha[v * count + k];
        mixed[3 * v] += alpha * colours[k].r;
        mixed[3 * v + 1] += alpha * colours[k].g;
        mixed[3 * v + 2] += alpha * colours[k].b;
      }
    }
    geometry.setAttribute('regionColour', new BufferAttribute(mixed, 3));
  }

  setMasks(alpha) {
    this.blender.setMasks(alpha);
    this.colourRegions();
  }

  take(blender) {
    this.blender = blender;
    this.uniforms.facePoints.value = blender.pointTexture;
    this.uniforms.faceNormals.value = blender.normalTexture;
  }

  setHead(h, head) {
    this.loaded[h] = head;
    this.blender.setHead?.(h, head);
  }

  /// Measures a blend on the graphics card and on the processor, and takes the faster. All heads must be loaded. Without
  /// a graphics card, shaders would run on the processor, which is slower than typed arrays.
  /// \param change  (strength) => [lists, shares]: coefficients that depend on the strength
  /// \param wanted  'card' or 'processor': takes this one without a measurement
  chooseBlend(change, wanted) {
    if (wanted === 'processor' || (this.software && wanted !== 'card')) return;
    if (!fitsOnCard(this.renderer, this.job.regions.length, this.loaded)) return;
    const processor = this.blender;
    let card;
    try {
      card = new CardBlend(this.renderer, this.mesh, this.job.regions.length, this.loaded);
      card.blend(...change(1));
      if (this.renderer.getContext().getError() !== 0) throw new Error('the graphics card has too little memory');
    } catch {
      card?.dispose();
      return; // keep blending on the processor
    }
    this.measured = this.measure([processor, card], change);
    const slower = wanted !== 'card' && this.measured.processor < this.measured.card ? card : processor;
    this.take(slower === card ? processor : card);
    slower.dispose();
    if (this.blender !== card) return;
    this.showDraft(false);
    this.draft.node.visible = false;
    this.material.side = DoubleSide;
    this.draft = null; // the draft reads the processor's arrays
  }

  /// Milliseconds per frame with each blender, drawn with few pixels because drawing costs the same with both.
  measure(blenders, change) {
    const gl = this.renderer.getContext();
    const pixel = new Uint8Array(4);
    const best = {};
    const { ratio } = this;
    this.setRatio(0.1 * ratio);
    for (let i = 0; i < 6; i += 1) { // alternately, because other programs may take time in between
      for (const blender of blenders) {
        this.take(blender);
        const coefficients = change(1 + 0.001 * (i + 1));
        const began = performance.now();
        blender.blend(...coefficients);
        this.draw();
        gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel); // waits until the card is done
        const ms = performance.now() - began;
        if (i > 0) best[blender.name] = Math.min(best[blender.name] ?? ms, ms); // the first frame compiles shaders
      }
    }
    this.setRatio(ratio);
    return best;
  }

  /// \param exact  the program's face for the same coefficients, or null: the difference between the program's last face
  ///               and the page's blend is then kept
  blend(lists, shares, exact = null) {
    this.blended = [lists, shares];
    this.isBehind = Boolean(this.moving && this.draft && !exact);
    if (this.isBehind) this.blender.blendDraft(lists, shares);
    else this.blender.blend(lists, shares);
    if (exact) this.blender.settle(exact.positions, exact.normals);
    this.isPlaced = false;
    this.draw();
  }

  /// Blends the whole mesh, if only the draft was blended during a move.
  catchUp() {
    if (!this.isBehind) return;
    this.isBehind = false;
    this.blender.blend(...this.blended);
  }

  /// Shows the program's face while the page has not loaded the heads that a blend needs.
  standAs({ positions, normals }) {
    this.isBehind = false;
    this.blender.place(positions, normals);
    this.isPlaced = false;
    this.draw();
  }

  showDraft(on) {
    super.showDraft(on);
    this.showLines();
  }

  /// Draws nothing until the next picture in full, or until something moves again; the draft stays on the screen.
  hold() { this.isHolding = this.moving; }

  setMoving(on) {
    if (on) this.isHolding = false;
    super.setMoving(on);
  }

  drawCheaply(on) {
    this.isHolding = false;
    super.drawCheaply(on);
  }

  showLines() {
    const isDraft = Boolean(this.moving && this.draft);
    this.lines.visible = this.wireframe && !isDraft;
    if (this.draftLines) this.draftLines.visible = this.wireframe && isDraft;
  }

  draw() {
    if (this.isPlaced === undefined || this.silent || this.isHolding) return; // isPlaced is undefined before the first face
    if (!this.moving) this.catchUp();
    if (this.draft) {
      this.placeDraft();
      this.draft.light(this.camera, this.group, this.blender.normals, 4, (v, colour) => this.surfaceAt(v, colour),
        this.show === 'surface' || this.show === 'texture');
    }
    super.draw();
  }

  /// Moves the draft to the blended face. Attachments follow the skin until the program has sent their positions.
  placeDraft() {
    if (this.isPlaced) return;
    this.isPlaced = true;
    this.draft.place(this.blender.points, 4);
    if (this.worn.skin) this.worn.follow(this.draft.positions.array);
  }

  /// Shows the attachments of the blended face.
  /// \param all   as in Worn.show
  /// \param face  positions and normals of the face
  wear(all, { positions, normals }) {
    this.isPlaced = true;
    this.draft?.place(this.blender.points, 4);
    this.worn.show(all, this.draft?.positions.array);
    this.shade = hairShade(positions, normals, this.worn.parts, this.group.matrix);
    this.shadeSkin();
  }

  /// Writes the albedo of a vertex without texture to `colour`.
  surfaceAt(v, colour) {
    const { show, surfaceColours } = this;
    if (show === 'distance') {
      const palette = this.uniforms.distanceColours.value;
      const place = Math.min(this.blender.points[4 * v + 3] / this.uniforms.farthest.value, 1) * (palette.length - 1);
      const low = Math.min(Math.floor(place), palette.length - 2);
      palette[low].toArray(colour);
      const more = place - low;
      [palette[low + 1].r, palette[low + 1].g, palette[low + 1].b].forEach((value, c) => { colour[c] += more * (value - colour[c]); });
      return;
    }
    const part = show === 'regions' ? 0.72 : 0;
    const regions = this.geometry.getAttribute('regionColour').array;
    for (let c = 0; c < 3; c += 1) {
      const own = surfaceColours[3 * v + c];
      colour[c] = own + part * (regions[3 * v + c] - own);
    }
  }

  setShow(show, mm = this.showMm) {
    this.show = show;
    this.showMm = mm;
    this.uniforms.faceShow.value = shows.indexOf(show);
    this.uniforms.farthest.value = mm / this.job.mm_per_unit;
    if (show === 'texture') this.setMap(this.material.map, null);
    else if (show === 'surface' && this.skin) this.setMap(this.skin.map, this.skin.relief);
    else this.setMap(null, null);
    this.draw();
  }

  /// \param map, relief  colour texture and normal map of the atlas, or null
  setMap(map, relief) {
    const { material } = this;
    if (Boolean(material.map) !== Boolean(map) || Boolean(material.normalMap) !== Boolean(relief)) material.needsUpdate = true;
    material.map = map;
    material.normalMap = relief;
    const colours = this.geometry.getAttribute('color');
    colours.array.set(this.surfaceColours);
    if (map) this.isTextured.forEach((is, v) => { if (is) colours.array.fill(1, 3 * v, 3 * v + 3); });
    colours.needsUpdate = true;
    for (const look of [0, 1]) this.draft?.setPicture(look, map, { shows: (v) => this.isTextured[v] === 1 });
  }

  setWireframe(on) {
    this.wireframe = on;
    this.showLines();
    this.draw();
  }

  /// Shows the texture of a head, loading it once.
  async setTexture(h) {
    this.setShow('texture');
    this.wanted = h;
    if (!this.textures.has(h)) {
      this.textures.set(h, new TextureLoader().loadAsync(`api/heads/${h}/texture`).then((texture) => {
        texture.colorSpace = SRGBColorSpace;
        return filtered(texture);
      }));
    }
    const texture = await this.textures.get(h);
    if (this.show !== 'texture' || this.wanted !== h) return;
    this.setMap(texture, null);
    this.draw();
  }

  /// A small picture of the face from the front, with the colours of its surfaces or its texture.
  picture(size = 224) {
    const { camera, controls, renderer } = this;
    const kept = { place: this.place() };
    this.silent = true;
    this.showDraft(false);
    if (this.draft) this.draft.node.visible = false; // the draft may show another face
    this.lines.visible = false;
    const { faceShow } = this.uniforms;
    const shown = faceShow.value;
    if (this.show !== 'texture') faceShow.value = 0;
    this.scene.background = new Color('#64666a');
    renderer.setPixelRatio(1);
    renderer.setSize(size, size, false);
    this.setAspect(1);
    this.middle ??= this.faceMiddle();
    controls.target.set(0, this.middle, 0);
    camera.position.set(0, this.middle, 4.8);
    controls.update();
    super.draw();
    this.scene.background = null;
    const url = renderer.domElement.toDataURL('image/jpeg', 0.85);
    if (this.draft) this.draft.node.visible = true;
    this.showDraft(this.moving);
    this.showLines();
    faceShow.value = shown;
    renderer.setPixelRatio(this.ratio);
    this.restore(kept.place);
    this.silent = false;
    this.fit();
    return url;
  }

  /// Height of the middle of the face in the scene: a little below the eyes, if the mesh has eyes.
  faceMiddle() {
    const { eyes, vertices } = this.mesh;
    const positions = this.loaded.find(Boolean)?.positions;
    if (!eyes || !positions) return 0.1;
    const sum = new Vector3();
    let count = 0;
    for (let v = 0; v < vertices; v += 1) {
      if (eyes[3 * v + 2] <= -1.5) continue;
      sum.add(new Vector3(positions[3 * v], positions[3 * v + 1], positions[3 * v + 2]));
      count += 1;
    }
    return count > 0 ? sum.divideScalar(count).applyMatrix4(this.group.matrix).y - 0.12 : 0.1;
  }

  /// The positions of the face, three numbers per vertex.
  read() {
    this.catchUp();
    return this.blender.read();
  }

  /// The point of the skin at a pixel of the window; null beside the skin.
  /// \param points  positions of the preview mesh
  hit(x, y, points = this.read()) {
    const box = this.node.getBoundingClientRect();
    const at = new Vector2(((x - box.left) / box.width) * 2 - 1, 1 - ((y - box.top) / box.height) * 2);
    this.camera.updateMatrixWorld();
    const origin = new Vector3().setFromMatrixPosition(this.camera.matrixWorld);
    const way = new Vector3(at.x, at.y, 0.5).unproject(this.camera).sub(origin).normalize();
    const ray = new Ray(origin, way).applyMatrix4(this.group.matrixWorld.clone().invert());
    return hitTriangle(ray.origin.toArray(), ray.direction.toArray(), points, this.mesh.triangles, this.mesh.part);
  }

  /// The region with the largest weight at a pixel of the window; null beside the head.
  regionAt(x, y) {
    const hit = this.hit(x, y);
    if (!hit) return null;
    const { alpha, triangles } = this.mesh;
    const { regions } = this.job;
    const corners = triangles.subarray(3 * hit.triangle, 3 * hit.triangle + 3);
    const shares = regions.map((_, k) => corners.reduce((sum, v) => sum + alpha[v * regions.length + k], 0));
    return regions[shares.indexOf(Math.max(...shares))].name;
  }

  /// Position and target of the camera, six numbers, for `restore`.
  place() {
    return [...this.camera.position.toArray(), ...this.controls.target.toArray()];
  }

  restore(place) {
    if (!Array.isArray(place) || place.length !== 6) return;
    this.camera.position.fromArray(place);
    this.controls.target.fromArray(place, 3);
    this.controls.update();
    this.draw();
  }
}
