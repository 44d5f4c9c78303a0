// SPDX-License-Identifier: Apache-2.0
// Reduced meshes in 3D. All faces of a crowd share one set of triangles, so a face is points and
// normals; where it stood before, the camera stays, so that two faces compare.
import { BufferAttribute, BufferGeometry, Mesh } from 'three';
import { loadScript } from './dom.js';
import { linearColours, paintEyes, skinMaterial, Stage } from './stage.js';

function bytesOf(base64) {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; i += 1) bytes[i] = text.charCodeAt(i);
  return bytes;
}

/// Points: three whole numbers of 16 bits each, steps from the frame's low corner; then normals,
/// two numbers each on the unfolded octahedron (Meyer et al. 2010, "On floating-point normal
/// vectors"); where the face has textures a colour for each point, three bytes.
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
  const colours = bytes.length > 10 * count ? linearColours(bytes.subarray(10 * count)) : null;
  return { points, normals, colours };
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
    const material = skinMaterial();
    if (mesh.eyes) {
      const places = new Uint32Array(bytesOf(mesh.eyes.places).buffer);
      paintEyes(material, geometry,
        Float32Array.from(places, (value) => value / mesh.eyes.steps - 4), mesh.eyes);
    }
    this.object = new Mesh(geometry, material);
    this.group.add(this.object);
    this.mesh = mesh;
    this.stand(mesh);
    this.view('front');
  }

  /// \param path  of the face's data; \param name  under which it then stands.
  async show(path, name) {
    await this.prepare();
    await loadScript(path);
    const { points, normals, colours } = unpackFace(window.crowdface.faces[name], this.mesh);
    const { geometry } = this.object;
    geometry.setAttribute('position', new BufferAttribute(points, 3));
    geometry.setAttribute('normal', new BufferAttribute(normals, 3));
    geometry.setAttribute('color', new BufferAttribute(colours ?? this.colours, 3));
    geometry.computeBoundingSphere();
    this.shown = name;
    this.draw();
  }

  draw() {
    if (this.object?.geometry.attributes.position) super.draw();
  }
}
