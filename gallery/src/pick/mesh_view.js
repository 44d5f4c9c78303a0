// SPDX-License-Identifier: Apache-2.0
// A 3D view of a reduced mesh with named landmarks. The program finds the point at the pointer on the whole mesh.
import {
  BufferAttribute, BufferGeometry, Color, Matrix4, Mesh, Raycaster, Vector2, Vector3,
} from 'three';
import { el } from '../dom.js';
import { hitTriangle } from '../hit.js';
import { linearColours, skinMaterial, Stage } from '../stage.js';

const hides = 0.004; // a landmark is hidden if it lies deeper than this behind the surface, as a fraction of its distance
const still = 4; // pixels; a press that moves less is a click

export class MeshView extends Stage {
  /// \param kind    'template' or 'scan'
  /// \param mesh    the reduced mesh from the program
  /// \param stands  {up, front}: axes of the mesh
  constructor(kind, mesh, stands, colour) {
    super({ pan: true });
    Object.assign(this, { kind, mesh, stands, markers: new Map() });
    this.middle = new Vector3(...mesh.head.origin);
    const geometry = new BufferGeometry();
    geometry.setIndex(new BufferAttribute(mesh.triangles, 1));
    geometry.setAttribute('position', new BufferAttribute(mesh.positions, 3));
    geometry.setAttribute('normal', new BufferAttribute(mesh.normals, 3, true));
    const colours = mesh.colours ? linearColours(mesh.colours) : new Float32Array(mesh.positions.length);
    const shades = [new Color(colour), new Color('#e4e2dd')];
    for (let v = 0; v < mesh.part.length && !mesh.colours; v += 1) shades[mesh.part[v]].toArray(colours, 3 * v);
    geometry.setAttribute('color', new BufferAttribute(colours, 3));
    this.group.add(new Mesh(geometry, skinMaterial()));
    this.standAs(stands);
    this.marks = el('svg', { class: 'marks' });
    this.raycaster = new Raycaster();
    this.node.tabIndex = 0;
    this.node.setAttribute('role', 'img');
    this.node.addEventListener('pointerdown', (event) => { this.pressed = event.button === 0 ? [event.clientX, event.clientY] : null; });
    this.node.addEventListener('pointerup', (event) => this.released(event));
    this.view('front');
  }

  standAs(stands) {
    this.stands = stands;
    this.stand({ ...stands, box: [this.mesh.head.low, this.mesh.head.high] });
  }

  /// Moves the mesh to the place of another view's mesh.
  /// \param to    the other view
  /// \param pose  the similarity from the other mesh to this one: scale, rotation, translation
  alignTo(to, { scale, rotation, translation }) {
    const move = new Matrix4().set(
      ...rotation[0].map((x) => scale * x), translation[0], ...rotation[1].map((x) => scale * x), translation[1],
      ...rotation[2].map((x) => scale * x), translation[2], 0, 0, 0, 1);
    const { x, y, z } = to.middle;
    this.group.matrix.copy(to.group.matrix).multiply(new Matrix4().makeTranslation(-x, -y, -z))
      .multiply(move.invert()).multiply(new Matrix4().makeTranslation(this.middle.x, this.middle.y, this.middle.z));
    this.draw();
  }

  /// Turns the mesh a quarter around the line of sight, for scans that lie on their side.
  roll() {
    const way = this.camera.position.clone().sub(this.controls.target).normalize();
    const turn = new Matrix4().makeTranslation(this.controls.target)
      .multiply(new Matrix4().makeRotationAxis(way, Math.PI / 2))
      .multiply(new Matrix4().makeTranslation(this.controls.target.clone().negate()));
    this.group.matrix.premultiply(turn);
    this.draw();
  }

  /// Makes the present direction the front of the standard views.
  takeAsFront() {
    const back = new Matrix4().extractRotation(this.camera.matrixWorld).invert();
    const away = this.camera.position.distanceTo(this.controls.target);
    const turn = back.multiply(new Matrix4().makeTranslation(this.controls.target.clone().negate()));
    this.group.matrix.premultiply(turn);
    this.controls.target.set(0, 0, 0);
    this.camera.position.set(0, 0, away);
    this.controls.update();
    this.draw();
  }

  /// The ray at a pixel of the window, in the coordinates of the mesh file.
  ray(x, y) {
    const box = this.node.getBoundingClientRect();
    this.camera.updateMatrixWorld();
    this.raycaster.setFromCamera(new Vector2(2 * (x - box.left) / box.width - 1, 1 - 2 * (y - box.top) / box.height), this.camera);
    const back = this.group.matrix.clone().invert();
    const origin = this.raycaster.ray.origin.clone().applyMatrix4(back);
    const direction = this.raycaster.ray.direction.clone().transformDirection(back);
    return { mesh: this.kind, origin: origin.add(this.middle).toArray(), direction: direction.toArray() };
  }

  middleRay() {
    const box = this.node.getBoundingClientRect();
    return this.ray(box.left + box.width / 2, box.top + box.height / 2);
  }

  released(event) {
    const begun = this.pressed;
    this.pressed = null;
    if (!begun || Math.hypot(event.clientX - begun[0], event.clientY - begun[1]) > still) return;
    this.onpick?.(this.ray(event.clientX, event.clientY));
  }

  /// The pixel at which a point is visible, and whether the point lies in front of the camera.
  project({ point }) {
    const at = new Vector3(...point).sub(this.middle).applyMatrix4(this.group.matrix).project(this.camera);
    const { clientWidth, clientHeight } = this.node;
    return { x: (at.x + 1) / 2 * clientWidth, y: (1 - at.y) / 2 * clientHeight, ahead: at.z < 1 };
  }

  /// When nothing moves any more, dims the landmarks that the mesh hides.
  dimHidden() {
    const camera = this.camera.position.clone().applyMatrix4(this.group.matrix.clone().invert());
    const enough = hides * camera.distanceTo(new Vector3(...this.mesh.head.low).add(new Vector3(...this.mesh.head.high)).divideScalar(2));
    for (const { name, place } of this.list) {
      const way = new Vector3(...place.point).sub(this.middle).sub(camera);
      const hit = hitTriangle(camera.toArray(), way.toArray(), this.mesh.positions, this.mesh.triangles);
      const behind = hit !== null && new Vector3(...hit.point).sub(camera).length() < way.length() - enough;
      this.markers.get(name).node.classList.toggle('behind', behind);
    }
  }

  /// \param list  {name, place, kind: 'picked' | 'ghost', active, outlier}
  show(list) {
    this.list = list;
    const wanted = new Set(list.map(({ name }) => name));
    for (const [name, marker] of this.markers) {
      if (wanted.has(name)) continue;
      marker.node.remove();
      this.markers.delete(name);
    }
    for (const entry of list) {
      if (!this.markers.has(entry.name)) this.addMarker(entry.name);
      const { node } = this.markers.get(entry.name);
      const behind = node.classList.contains('behind') ? 'behind' : '';
      node.setAttribute('class', ['mark', entry.kind, entry.active ? 'active' : '', entry.outlier ? 'outlier' : '', behind].join(' '));
      if (entry.active) this.marks.append(node); // drawn over the others
    }
    this.place();
  }

  addMarker(name) {
    const node = el('g', { 'data-name': name }, el('circle', { class: 'grab', r: 8 }), el('circle', { class: 'dot', r: 4.5 }),
      el('text', { x: 10, y: 4 }, name));
    node.addEventListener('pointerdown', (event) => {
      if (event.button !== 0) return;
      event.preventDefault();
      event.stopPropagation();
      this.onmark?.(name, event);
    });
    node.addEventListener('pointerenter', () => this.onhover?.(name));
    node.addEventListener('pointerleave', () => this.onhover?.(null));
    this.markers.set(name, { node });
    this.marks.append(node);
  }

  hover(name) {
    for (const [other, { node }] of this.markers) node.classList.toggle('hovered', other === name);
  }

  place() {
    if (!this.list) return;
    for (const { name, place } of this.list) {
      const { node } = this.markers.get(name);
      const { x, y, ahead } = this.project(place);
      node.setAttribute('transform', `translate(${x.toFixed(1)} ${y.toFixed(1)})`);
      node.style.display = ahead ? '' : 'none';
    }
    clearTimeout(this.dimming);
    this.dimming = setTimeout(() => this.dimHidden(), 120);
  }

  draw() {
    if (!this.marks) return;
    super.draw();
    this.place();
  }
}
