// SPDX-License-Identifier: Apache-2.0
// What all 3D views have in common: camera, pose of the head, skin material and painted eyes.
import {
  BufferAttribute, Color, DoubleSide, Group, Matrix4, PerspectiveCamera, Scene, SRGBColorSpace, Vector3, WebGLRenderer,
} from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
import { drawsInSoftware, SmoothEdges } from './software.js';
import { extend, studioMaterial, surfaceWhere } from './studio.js';

const degreesOf = {
  front: 0, three_quarter: 35, profile: 90, back: 180, other_profile: -90, other_three_quarter: -35,
};

/// \param sky   whether the geometry has the attribute `sky`, the fraction of the sky that each vertex sees
/// \param side  DoubleSide; or FrontSide on pages that draw without a graphics card, where hidden triangles cost as much
///              as visible ones and the draft shows the back sides
export function skinMaterial({ sky = false, lightness, side = DoubleSide } = {}) {
  const material = studioMaterial('skin', { vertexColors: true, side }, lightness);
  if (sky) material.defines.HAS_SKY = '';
  return material;
}

/// Converts sRGB colours, three bytes each, to linear colours.
export function linearColours(bytes) {
  const linear = new Float32Array(bytes.length);
  const colour = new Color();
  for (let i = 0; i < bytes.length; i += 3) {
    colour.setRGB(bytes[i] / 255, bytes[i + 1] / 255, bytes[i + 2] / 255, SRGBColorSpace);
    linear.set([colour.r, colour.g, colour.b], i);
  }
  return linear;
}

/// The lightness of the skin in a texture (render/skin_specular.h): the 70th percentile of the texels' mean linear colour.
export function skinLightness(image) {
  const canvas = document.createElement('canvas');
  canvas.width = 64;
  canvas.height = 64;
  const context = canvas.getContext('2d');
  context.drawImage(image, 0, 0, canvas.width, canvas.height);
  const linear = linearColours(context.getImageData(0, 0, canvas.width, canvas.height).data.filter((_, i) => i % 4 < 3));
  const means = [];
  for (let i = 0; i < linear.length; i += 3) means.push((linear[i] + linear[i + 1] + linear[i + 2]) / 3);
  return means.sort((a, b) => a - b)[Math.floor(0.7 * means.length)];
}

/// Paints a round iris on eyeballs in the fragment shader, because a reduced mesh has too few vertices for a round iris.
export const eyeShader = {
  vertex: 'attribute vec3 eye;\nvarying vec3 vEye;',
  fragment: `
    varying vec3 vEye;
    uniform vec3 eyeRadii, eyeWhite, eyeColour;
    bool isEye() { return vEye.z > -1.5; }
    float beyond(float edge, float x) {
      return smoothstep(edge - eyeRadii.z, edge + eyeRadii.z, x);
    }
    vec3 eyeballColour() {
      float across = length(vEye.xy);
      float rim = clamp((across - eyeRadii.x) / (eyeRadii.y - eyeRadii.x), 0.0, 1.0);
      vec3 iris = eyeColour * (1.6 - 1.25 * rim * rim);
      vec3 inner = mix(vec3(0.008), iris, beyond(eyeRadii.x, across));
      return vEye.z > 0.0 ? mix(inner, eyeWhite, beyond(eyeRadii.y, across)) : eyeWhite;
    }`,
};

/// \param eyes  {pupil, iris, softness: radii relative to the eyeball's; white, colour: linear colours}
export function eyeUniforms(eyes) {
  return {
    eyeRadii: { value: new Vector3(eyes.pupil, eyes.iris, eyes.softness) },
    eyeWhite: { value: new Vector3(...eyes.white) },
    eyeColour: { value: new Vector3(...eyes.colour) },
  };
}

/// Paints the eyes where the material has no texture.
/// \param places  three numbers per vertex: position relative to the eyeball's centre, in radii of the eyeball; z below
///                −1.5 if the vertex is not on an eyeball
export function paintEyes(material, geometry, places, eyes) {
  geometry.setAttribute('eye', new BufferAttribute(places, 3));
  extend(material, (shader) => {
    Object.assign(shader.uniforms, eyeUniforms(eyes));
    shader.vertexShader = shader.vertexShader
      .replace('#include <common>', `#include <common>\n${eyeShader.vertex}`)
      .replace('#include <project_vertex>', 'vEye = eye;\n#include <project_vertex>');
    shader.fragmentShader = shader.fragmentShader
      .replace('#include <common>', `#include <common>\n${eyeShader.fragment}`)
      .replace('#include <color_fragment>', `#include <color_fragment>
        if (isEye() && !hasPicture()) diffuseColor.rgb = eyeballColour();`)
      .replace('#include <color_pars_fragment>', `#include <color_pars_fragment>
        bool hasPicture() {
          #if !defined(USE_MAP)
            return false;
          #elif defined(SOME_TEXTURED)
            return vTextured > 0.5;
          #else
            return true;
          #endif
        }`);
    surfaceWhere(shader, 'isEye()', 'eye');
  });
}

/// Takes the roughness from the attribute `rough`, except on painted eyes. Call paintEyes first.
export function roughAtVertices(material) {
  extend(material, (shader) => {
    shader.vertexShader = shader.vertexShader
      .replace('#include <common>', '#include <common>\nattribute float rough;\nvarying float vRough;')
      .replace('#include <project_vertex>', 'vRough = rough;\n#include <project_vertex>');
    shader.fragmentShader = shader.fragmentShader
      .replace('#include <common>', '#include <common>\nvarying float vRough;')
      .replace('#include <roughnessmap_fragment>', '#include <roughnessmap_fragment>\nroughnessFactor = vRough;');
  });
}

const field = 20; // vertical field of view, degrees
const narrow = 0.8; // width / height of a view below which the vertical field of view is larger
const rest = 60; // ms without a move, after which all is drawn in full; longer than 40 ms, the time between two repeats of a held key
const slow = 18; // ms to draw a frame while something moves; as long again takes the page
const fast = 12;
const fewest = 0.35; // smallest resolution while something moves, as a fraction of the full resolution
const atFirst = 0.5; // smallest resolution when a move begins, as a fraction of the full resolution

/// A view of a head that the user can turn. In the scene, up is +Y, front is +Z, and the bounding box of all heads is
/// two units large.
export class Stage {
  /// \throws if the browser has no WebGL.
  constructor({ pan = false } = {}) {
    this.software = drawsInSoftware();
    this.renderer = new WebGLRenderer({ antialias: !this.software, alpha: true });
    this.edges = this.software ? new SmoothEdges() : null;
    this.renderer.outputColorSpace = SRGBColorSpace;
    this.fullRatio = Math.min(devicePixelRatio, 2);
    this.movingRatio = this.fullRatio;
    this.setRatio(this.fullRatio);
    this.moving = false;
    this.node = this.renderer.domElement;
    this.node.className = 'turntable';
    this.scene = new Scene();
    this.group = new Group();
    this.scene.add(this.group);
    this.camera = new PerspectiveCamera(field, 1, 0.1, 100);
    this.scene.add(this.camera);
    this.controls = new OrbitControls(this.camera, this.node);
    this.controls.enablePan = pan;
    this.controls.enableDamping = false;
    this.controls.minDistance = pan ? 0.8 : 2.2;
    this.controls.maxDistance = 14;
    this.controls.addEventListener('change', () => {
      this.movedAt = performance.now();
      if (!this.isStepping) this.draw();
    });
    this.isHeld = false; // whether the user is turning the head with the pointer
    for (const [event, isHeld] of [['start', true], ['end', false]]) {
      this.controls.addEventListener(event, () => {
        this.isHeld = isHeld;
        this.setMoving(isHeld);
      });
    }
    this.frames = 0;
  }

  setRatio(ratio) {
    this.ratio = ratio;
    this.renderer.setPixelRatio(ratio);
  }

  /// Begins or ends a move. Without a graphics card, moving heads are drawn as a draft, at the resolution that the speed
  /// of drawing allows; when the move ends, the head is drawn in full.
  setMoving(on) {
    if (!this.software || (!on && (!this.moving || this.isHeld))) return;
    clearTimeout(this.resting);
    this.resting = null;
    if (on) this.movedAt = performance.now();
    if (!on) this.resting = setTimeout(() => this.drawCheaply(false), rest - (performance.now() - this.movedAt));
    else if (!this.moving) this.drawCheaply(true);
  }

  drawCheaply(on) {
    this.moving = on;
    this.resting = null;
    this.worn?.setForm(on ? 'draft' : 'whole');
    this.showDraft(on);
    if (on) this.movingRatio = Math.max(this.movingRatio, atFirst * this.fullRatio);
    this.setRatio(on ? this.movingRatio : this.fullRatio);
    this.draw();
    this.node.ariaBusy = String(on);
  }

  /// \param on  whether the draft is drawn instead of the whole mesh
  showDraft(on) {
    if (!this.draft) return;
    this.object.visible = !on;
    this.draft.setBehind(!on);
  }

  /// Makes a single camera step, such as a repeat of a key that is held down.
  /// \param act  moves the camera
  step(act) {
    this.isStepping = true;
    act();
    this.isStepping = false;
    const keepsMoving = this.moving && !this.resting;
    if (this.moving || !this.software) this.draw();
    this.setMoving(true);
    if (!keepsMoving) this.setMoving(false);
  }

  stand({ up, front, box: [low, high] }) {
    const u = new Vector3(...up);
    const f = new Vector3(...front);
    const turn = new Matrix4().makeBasis(u.clone().cross(f), u, f).transpose();
    const centre = new Vector3(...low.map((value, axis) => (value + high[axis]) / 2));
    const scale = 2 / Math.max(...high.map((value, axis) => value - low[axis]));
    this.group.matrixAutoUpdate = false;
    this.group.matrix.copy(new Matrix4().makeScale(scale, scale, scale)).multiply(turn)
      .multiply(new Matrix4().makeTranslation(-centre.x, -centre.y, -centre.z));
  }

  view(name) {
    this.step(() => {
      const angle = ((degreesOf[name] ?? 0) * Math.PI) / 180;
      this.controls.target.set(0, 0, 0);
      this.camera.position.set(6.4 * Math.sin(angle), 0, 6.4 * Math.cos(angle));
      this.controls.update();
    });
  }

  /// Copies the camera of another view.
  lookAs({ camera, controls }) {
    this.step(() => {
      this.camera.position.copy(camera.position);
      this.controls.target.copy(controls.target);
      this.controls.update();
    });
  }

  turn(degrees) {
    this.step(() => {
      this.camera.position.sub(this.controls.target)
        .applyAxisAngle(new Vector3(0, 1, 0), (degrees * Math.PI) / 180).add(this.controls.target);
      this.controls.update();
    });
  }

  /// Angle between the camera's direction and the front, in degrees.
  angle() {
    const { position } = this.camera;
    const { target } = this.controls;
    return (Math.atan2(position.x - target.x, position.z - target.z) * 180) / Math.PI;
  }

  nearer(factor) {
    this.step(() => {
      const { camera, controls } = this;
      const away = camera.position.clone().sub(controls.target);
      away.setLength(Math.min(Math.max(away.length() * factor, controls.minDistance), controls.maxDistance));
      camera.position.copy(controls.target).add(away);
      controls.update();
    });
  }

  /// Handles an arrow key: turns the head or, if `across`, moves it sideways.
  arrow(key, across) {
    const [x, y] = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[key];
    const { camera, controls } = this;
    if (x !== 0 && !across) {
      this.turn(-10 * x);
      return;
    }
    this.step(() => {
      if (across) {
        const right = new Vector3().setFromMatrixColumn(camera.matrix, 0).multiplyScalar(-0.06 * x);
        const move = right.add(new Vector3().setFromMatrixColumn(camera.matrix, 1).multiplyScalar(-0.06 * y));
        camera.position.add(move);
        controls.target.add(move);
      } else {
        const away = camera.position.clone().sub(controls.target);
        const axis = new Vector3(0, 1, 0).cross(away).normalize();
        const steep = (Math.asin(away.y / away.length()) * 180) / Math.PI;
        if (Math.abs(steep + 8 * y) < 85) away.applyAxisAngle(axis, (-8 * y * Math.PI) / 180);
        camera.position.copy(controls.target).add(away);
      }
      controls.update();
    });
  }

  /// Sets the camera's aspect ratio. The whole head is visible in narrow views, too.
  setAspect(aspect) {
    const { camera } = this;
    camera.aspect = aspect;
    camera.fov = (Math.atan(Math.tan((field * Math.PI) / 360) * Math.max(1, narrow / aspect)) * 360) / Math.PI;
    camera.updateProjectionMatrix();
  }

  fit() {
    const box = this.node.parentElement?.getBoundingClientRect();
    if (!box || box.width === 0) return;
    this.renderer.setSize(box.width, box.height);
    this.setAspect(box.width / box.height);
    this.draw();
  }

  drawInFull() {
    clearTimeout(this.resting);
    if (this.moving) this.drawCheaply(false);
    else this.draw();
  }

  draw() {
    const began = performance.now();
    if (this.moving && this.ratio !== this.movingRatio && !this.silent) this.setRatio(this.movingRatio);
    this.worn?.shade(this.camera, this.group);
    this.renderer.render(this.scene, this.camera);
    if (!this.moving) this.edges?.apply(this.renderer);
    this.frames += 1;
    if (!this.moving && !this.onframe) return;
    const gl = this.renderer.getContext();
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4)); // waits until the frame is drawn
    this.frameMs = performance.now() - began;
    this.onframe?.(this.frameMs);
    if (!this.moving) return;
    this.adaptRatio();
  }

  /// Adapts the resolution to the speed of drawing, in few large steps, because resizing the canvas takes about as long
  /// as a frame.
  adaptRatio() {
    const { frameMs, movingRatio, fullRatio } = this;
    if (frameMs > slow) this.movingRatio = Math.max(Math.min(0.85, Math.max(0.6, Math.sqrt(slow / frameMs))) * movingRatio, fewest * fullRatio);
    else if (frameMs < fast) this.movingRatio = Math.min(fullRatio, 1.2 * movingRatio);
  }
}
