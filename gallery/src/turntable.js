// SPDX-License-Identifier: Apache-2.0
// Reduced meshes in 3D. All faces of a crowd share one set of triangles, so a face is points and
// normals; where it stood before, the camera stays, so that two faces compare.
import {
  AmbientLight, BufferAttribute, BufferGeometry, Color, DirectionalLight, DoubleSide, Group,
  HemisphereLight, Mesh, MeshPhysicalMaterial, PerspectiveCamera, Scene, SRGBColorSpace, Vector3,
  WebGLRenderer, ACESFilmicToneMapping, Matrix4,
} from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
import { loadScript } from './dom.js';

function bytesOf(base64) {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; i += 1) bytes[i] = text.charCodeAt(i);
  return bytes;
}

/// Points: three whole numbers of 16 bits each, steps from the frame's low corner; then normals,
/// two numbers each on the unfolded octahedron (Meyer et al. 2010, "On floating-point normal
/// vectors").
export function unpackFace(base64, mesh) {
  const values = new Uint16Array(bytesOf(base64).buffer);
  const count = mesh.vertices;
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
  return { points, normals };
}

/// Eyeballs get a round iris, pixel by pixel: a reduced mesh has too few vertices for one.
function paintEyes(material, geometry, eyes) {
  const values = new Uint32Array(bytesOf(eyes.places).buffer);
  geometry.setAttribute('eye',
    new BufferAttribute(Float32Array.from(values, (value) => value / eyes.steps - 4), 3));
  material.onBeforeCompile = (shader) => {
    const { uniforms } = shader;
    uniforms.eyeRadii = { value: new Vector3(eyes.pupil, eyes.iris, eyes.softness) };
    uniforms.eyeWhite = { value: new Vector3(...eyes.white) };
    uniforms.eyeColour = { value: new Vector3(...eyes.colour) };
    shader.vertexShader = shader.vertexShader
      .replace('#include <common>', '#include <common>\nattribute vec3 eye;\nvarying vec3 vEye;')
      .replace('#include <begin_vertex>', '#include <begin_vertex>\nvEye = eye;');
    shader.fragmentShader = shader.fragmentShader
      .replace('#include <common>', `#include <common>
        varying vec3 vEye;
        uniform vec3 eyeRadii, eyeWhite, eyeColour;
        bool isEye() { return vEye.z > -1.5; }
        float beyond(float edge, float x) {
          return smoothstep(edge - eyeRadii.z, edge + eyeRadii.z, x);
        }`)
      .replace('#include <color_fragment>', `#include <color_fragment>
        if (isEye()) {
          float across = length(vEye.xy);
          float rim = clamp((across - eyeRadii.x) / (eyeRadii.y - eyeRadii.x), 0.0, 1.0);
          vec3 iris = eyeColour * (1.6 - 1.25 * rim * rim);
          vec3 inner = mix(vec3(0.008), iris, beyond(eyeRadii.x, across));
          diffuseColor.rgb = vEye.z > 0.0 ? mix(inner, eyeWhite, beyond(eyeRadii.y, across)) : eyeWhite;
        }`)
      .replace('#include <roughnessmap_fragment>', `#include <roughnessmap_fragment>
        if (isEye()) roughnessFactor = 0.25;`);
  };
}

export class Turntable {
  /// \throws if the browser has no WebGL.
  constructor() {
    this.renderer = new WebGLRenderer({ antialias: true, alpha: true });
    this.renderer.outputColorSpace = SRGBColorSpace;
    this.renderer.toneMapping = ACESFilmicToneMapping;
    this.renderer.toneMappingExposure = 1.05;
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.node = this.renderer.domElement;
    this.node.className = 'turntable';
    this.scene = new Scene();
    this.camera = new PerspectiveCamera(20, 1, 0.1, 100);
    this.lights();
    this.controls = new OrbitControls(this.camera, this.node);
    this.controls.enablePan = false;
    this.controls.enableDamping = false;
    this.controls.minDistance = 2.2;
    this.controls.maxDistance = 14;
    this.controls.addEventListener('change', () => this.draw());
    this.frames = 0;
  }

  /// A key light from the upper left, a weak fill, two rims; they go with the camera.
  lights() {
    const lamp = (colour, strength, x, y, z) => {
      const light = new DirectionalLight(colour, strength);
      light.position.set(x, y, z);
      this.camera.add(light);
      this.camera.add(light.target);
      light.target.position.set(0, 0, -6);
    };
    lamp(0xfff1de, 2.6, -4.2, 4.2, 0);
    lamp(0xd9e6ff, 0.45, 5, 0.4, 0);
    lamp(0xe6edff, 1.3, 4.5, 2, -9.5);
    lamp(0xffffff, 0.6, -5, 1.5, -9.5);
    this.scene.add(this.camera, new HemisphereLight(0xe8edf4, 0x4c4640, 0.75),
      new AmbientLight(0xffffff, 0.08));
  }

  /// The triangles and colours that all faces share.
  async prepare() {
    if (this.mesh) return;
    await loadScript('data/mesh.js');
    const mesh = window.crowdface.mesh;
    const geometry = new BufferGeometry();
    const bytes = bytesOf(mesh.triangles);
    geometry.setIndex(new BufferAttribute(new Uint32Array(bytes.buffer), 1));
    const shades = bytesOf(mesh.colours);
    const linear = new Float32Array(shades.length);
    const colour = new Color();
    for (let i = 0; i < shades.length; i += 3) {
      colour.setRGB(shades[i] / 255, shades[i + 1] / 255, shades[i + 2] / 255, SRGBColorSpace);
      linear.set([colour.r, colour.g, colour.b], i);
    }
    geometry.setAttribute('color', new BufferAttribute(linear, 3));
    const material = new MeshPhysicalMaterial({
      vertexColors: true, roughness: 0.56, side: DoubleSide, sheen: 0.25, sheenRoughness: 0.6,
      sheenColor: new Color(0.9, 0.5, 0.4), specularIntensity: 0.7,
    });
    if (mesh.eyes) paintEyes(material, geometry, mesh.eyes);
    this.object = new Mesh(geometry, material);
    this.group = new Group();
    this.group.add(this.object);
    this.scene.add(this.group);
    this.mesh = mesh;
    this.stand();
    this.view('front');
  }

  /// Up becomes +Y, front +Z, and the frame of all heads a box of two units.
  stand() {
    const { up, front, box: [low, high] } = this.mesh;
    const u = new Vector3(...up);
    const f = new Vector3(...front);
    const turn = new Matrix4().makeBasis(u.clone().cross(f), u, f).transpose();
    const centre = new Vector3(...low.map((value, axis) => (value + high[axis]) / 2));
    const scale = 2 / Math.max(...high.map((value, axis) => value - low[axis]));
    this.group.matrixAutoUpdate = false;
    this.group.matrix.copy(new Matrix4().makeScale(scale, scale, scale)).multiply(turn)
      .multiply(new Matrix4().makeTranslation(-centre.x, -centre.y, -centre.z));
  }

  /// \param path  of the face's data; \param name  under which it then stands.
  async show(path, name) {
    await this.prepare();
    await loadScript(path);
    const { points, normals } = unpackFace(window.crowdface.faces[name], this.mesh);
    const { geometry } = this.object;
    geometry.setAttribute('position', new BufferAttribute(points, 3));
    geometry.setAttribute('normal', new BufferAttribute(normals, 3));
    geometry.computeBoundingSphere();
    this.shown = name;
    this.draw();
  }

  view(name) {
    const degrees = { front: 0, three_quarter: 35, profile: 90 }[name] ?? 0;
    const angle = (degrees * Math.PI) / 180;
    this.controls.target.set(0, 0, 0);
    this.camera.position.set(6.4 * Math.sin(angle), 0, 6.4 * Math.cos(angle));
    this.controls.update();
    this.draw();
  }

  turn(degrees) {
    this.camera.position.applyAxisAngle(new Vector3(0, 1, 0), (degrees * Math.PI) / 180);
    this.controls.update();
    this.draw();
  }

  /// How far the camera stands turned from the front, in degrees.
  angle() {
    return (Math.atan2(this.camera.position.x, this.camera.position.z) * 180) / Math.PI;
  }

  fit() {
    const box = this.node.parentElement?.getBoundingClientRect();
    if (!box || box.width === 0) return;
    this.renderer.setSize(box.width, box.height);
    this.camera.aspect = box.width / box.height;
    this.camera.updateProjectionMatrix();
    this.draw();
  }

  draw() {
    if (!this.object?.geometry.attributes.position) return;
    this.renderer.render(this.scene, this.camera);
    this.frames += 1;
  }
}
