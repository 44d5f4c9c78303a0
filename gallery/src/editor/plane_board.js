// SPDX-License-Identifier: Apache-2.0
// The weight plane (Fig. 8) with heads at their anchors and one controller per region. Heads and controllers can be
// dragged.
import { el, short } from '../dom.js';
import { anchorMark, planeFrame, side } from '../plane.js';
import { anchorsOf, headIndex, weightsOf } from './recipe.js';

const finger = 14.5; // pixels: radius of the elements that can be dragged, on a board of any size
const letterWidth = 7.2; // mean width of a letter in a name, pixels
export const still = 4; // pixels; a press that moves less is a click
const reach = 2; // largest distance of a controller from the middle of the heads, in half-widths of the heads' bounding box

/// A letter for each region: the first letter of its name that no other region has.
function lettersOf(names) {
  const used = new Set();
  return new Map(names.map((name) => {
    const free = [...name.toUpperCase(), ...'ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789'].find((letter) => /[\p{L}\p{N}]/u.test(letter) && !used.has(letter)) ?? '';
    used.add(free);
    return [name, free];
  }));
}

function isDark(hex) {
  const [r, g, b] = [1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16) / 255);
  return 0.2126 * r ** 2.2 + 0.7152 * g ** 2.2 + 0.0722 * b ** 2.2 < 0.25;
}

export class PlaneBoard {
  /// \param editor  job, document, preview(document), commit(document, label, options), linked(name),
  ///                setTarget(name), gather(head).
  constructor(editor) {
    this.editor = editor;
    this.letters = lettersOf(editor.job.regions.map(({ name }) => name));
    this.heads = el('g', {});
    this.leads = el('g', {});
    this.handles = el('g', {});
    this.svg = el('svg', {
      viewBox: `0 0 ${side} ${side}`, class: 'board', role: 'group', 'aria-label': 'Plane of heads and controllers',
    }, this.heads, this.leads, this.handles);
    this.node = el('div', { class: 'boardbox' }, this.svg);
    this.handleNodes = new Map(editor.job.regions.map((region) => [region.name, this.handleNode(region)]));
    this.handles.append(...this.handleNodes.values());
    this.sizeAnew(1);
    new ResizeObserver(([{ contentRect }]) => {
      if (contentRect.width > 0) this.sizeAnew(side / Math.min(contentRect.width, contentRect.height));
    }).observe(this.svg);
  }

  /// Sizes handles and names, which have the same size on any screen.
  /// \param unit  size of a screen pixel, in the board's units
  sizeAnew(unit) {
    if (unit === this.unit) return;
    this.unit = unit;
    this.knobRadius = finger * unit;
    this.ring = 1.9 * this.knobRadius; // radius at which controllers with the same position are spread, so that each can be dragged
    this.headRadius = Math.min(30, Math.max(finger * unit, (0.2 * side) / Math.sqrt(this.editor.job.heads.length)));
    this.svg.style.setProperty('--unit', `${unit}px`);
    this.headNodes = this.editor.job.heads.map((head, h) => this.headNode(head, h));
    this.heads.replaceChildren(...this.headNodes);
    for (const node of this.handleNodes.values()) {
      for (const circle of node.querySelectorAll('circle')) circle.setAttribute('r', this.knobRadius * (circle.matches('.grab') ? 1.3 : 1));
    }
    this.frameAnew();
    this.show();
  }

  /// The visible part of the plane, constant during a drag. Controllers far outside are shown at its edge.
  frameAnew() {
    const { editor } = this;
    const { job, document } = editor;
    const [low, high] = this.limits();
    const points = [...anchorsOf(job, document.anchors),
      ...job.regions.map(({ name }) => editor.numbersOf(name).position).filter(Boolean)
        .map((place) => place.map((value, axis) => Math.min(Math.max(value, low[axis]), high[axis])))];
    this.frame = planeFrame(points);
  }

  /// Corners [low, high] of the box in which controllers can be placed; farther away, weights hardly change.
  limits() {
    const anchors = anchorsOf(this.editor.job, this.editor.document.anchors);
    const ends = [0, 1].map((axis) => {
      const values = anchors.map((anchor) => anchor[axis]);
      return [Math.min(...values), Math.max(...values)];
    });
    const half = Math.max(...ends.map(([low, high]) => high - low), 1) / 2;
    return [-1, 1].map((way) => ends.map(([low, high]) => Number(((low + high) / 2 + way * reach * half).toFixed(4))));
  }

  headNode(head, h) {
    const mark = anchorMark({ name: head.name, picture: `api/heads/${h}/thumbnail` }, this.headRadius);
    mark.append(el('circle', { r: this.headRadius + 6, class: 'targetring' }));
    const node = el('g', { class: 'head', tabindex: '0', role: 'button', 'data-head': head.name }, mark);
    this.makeDraggable(node, {
      from: () => anchorsOf(this.editor.job, this.editor.document.anchors)[h],
      to: (point) => this.withAnchor(head.name, point),
      label: `${head.name} moved`,
      click: () => this.editor.setTarget(head.name),
    });
    node.addEventListener('pointerenter', () => {
      if (!this.drag && this.heads.lastChild !== node) this.heads.append(node); // drawn over the heads that it overlaps
    });
    node.addEventListener('dblclick', () => this.editor.gather(head.name));
    return node;
  }

  handleNode(region) {
    const knob = el('circle', { class: 'knob' });
    knob.style.fill = region.colour;
    const letter = el('text', {}, this.letters.get(region.name));
    letter.style.fill = isDark(region.colour) ? '#fff' : '#17181a';
    const node = el('g', { class: 'handle', tabindex: '0', role: 'slider', 'data-region': region.name },
      el('circle', { class: 'grab' }), knob, letter);
    this.makeDraggable(node, {
      from: () => this.placeOf(region.name),
      to: (point) => this.withPosition(region.name, point),
      label: `${region.name} moved`,
      click: () => this.editor.focusRegion(region.name),
    });
    return node;
  }

  /// Position of a region's controller. If the region has weights instead of a position: the weighted mean of the heads'
  /// anchors.
  placeOf(name) {
    const { job, document } = this.editor;
    const { position } = this.editor.numbersOf(name);
    if (position) return position;
    const anchors = anchorsOf(job, document.anchors);
    const weights = weightsOf(job, document, name, this.editor.band);
    return [0, 1].map((axis) => weights.reduce((sum, weight, h) => sum + weight * anchors[h][axis], 0));
  }

  /// Moves the anchor of a head, and returns the changed document. With the normalization `printed`, recipes contain
  /// positions, which refer to the config's anchors; so anchors cannot be moved, and the document stays as it is.
  withAnchor(name, point) {
    const { document, job } = this.editor;
    if (job.normalization === 'printed') {
      this.editor.say('With the printed normalization heads stay where the config puts them.');
      return document;
    }
    return { ...document, anchors: { ...document.anchors, [name]: point } };
  }

  withPosition(name, point) {
    return this.editor.withRegions(name, ({ weights, ...region }) => ({ ...region, position: point }));
  }

  // -- dragging, and arrows --

  makeDraggable(node, { from, to, label, click }) {
    node.addEventListener('pointerdown', (event) => {
      if (event.button !== 0) return;
      event.preventDefault();
      node.focus();
      node.setPointerCapture(event.pointerId);
      this.drag = {
        node, x: event.clientX, y: event.clientY, start: this.frame.at(from()), moved: false,
      };
    });
    node.addEventListener('pointermove', (event) => {
      const { drag } = this;
      if (drag?.node !== node) return;
      const dx = event.clientX - drag.x;
      const dy = event.clientY - drag.y;
      if (!drag.moved && Math.hypot(dx, dy) < still) return;
      drag.moved = true;
      node.classList.add('dragged');
      this.editor.preview(to(this.moved(drag.start, dx, dy)));
    });
    const end = (event) => {
      const { drag } = this;
      if (drag?.node !== node) return;
      this.drag = null;
      node.classList.remove('dragged');
      if (drag.moved) this.editor.commit(this.editor.document, label);
      else if (event.type === 'pointerup') click();
    };
    node.addEventListener('pointerup', end);
    node.addEventListener('pointercancel', end);
    node.addEventListener('keydown', (event) => {
      const arrows = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowDown: [0, -1], ArrowUp: [0, 1] };
      const way = arrows[event.key];
      if (way && !event.ctrlKey && !event.altKey) {
        const step = this.step() * (event.shiftKey ? 0.1 : 1);
        const [low, high] = this.limits();
        const point = from().map((value, axis) => Number(
          Math.min(Math.max(value + step * way[axis], low[axis]), high[axis]).toFixed(4)));
        this.editor.commit(to(point), label, { joins: true });
      } else if (event.key === 'Enter' || event.key === ' ') {
        click();
      } else {
        return;
      }
      event.preventDefault();
      event.stopPropagation();
    });
  }

  /// The point of the plane at an offset in screen pixels from a point of the board.
  moved(start, dx, dy, frame = this.frame) {
    const inside = (value) => Math.min(Math.max(value, 4), side - 4);
    const point = frame.back([inside(start[0] + this.unit * dx), inside(start[1] + this.unit * dy)]);
    return point.map((value) => Number(value.toFixed(4)));
  }

  /// The point of the plane at a pixel of the window.
  placeAt(x, y) {
    const at = new DOMPoint(x, y).matrixTransform(this.svg.getScreenCTM().inverse());
    return this.frame.back([at.x, at.y]).map((value) => Number(value.toFixed(4)));
  }

  /// Begins a drag of a region's controller from outside the board.
  /// \return  (dx, dy) => document; offsets in pixels, as on the board
  dragOf(name) {
    const { frame } = this;
    const start = frame.at(this.placeOf(name));
    return (dx, dy) => this.withPosition(name, this.moved(start, dx, dy, frame));
  }

  /// Moves by one press of an arrow key: a fortieth of the visible part.
  step() {
    const [a, b] = [this.frame.back([0, 0]), this.frame.back([side, 0])];
    return (b[0] - a[0]) / 40;
  }

  // -- drawing --

  show() {
    if (!this.drag) this.frameAnew();
    this.showHeads();
    this.showHandles();
  }

  /// Changes nothing if the heads have not moved, because drawing their pictures takes long.
  showHeads() {
    const { job, document } = this.editor;
    const places = anchorsOf(job, document.anchors).map((anchor) => this.frame.at(anchor));
    const key = JSON.stringify([places, document.recipe.target, document.anchors, this.unit]);
    if (key === this.headsKey) return;
    this.headsKey = key;
    const named = this.headsWithRoom(places);
    places.forEach((place, h) => {
      const node = this.headNodes[h];
      const { name } = job.heads[h];
      const target = document.recipe.target === name;
      node.setAttribute('transform', `translate(${place})`);
      node.classList.toggle('target', target);
      node.classList.toggle('crowded', !named.has(h));
      node.querySelector('text').setAttribute('y', this.nameAt(named.get(h)?.side ?? 1));
      node.classList.toggle('away', Boolean(document.anchors?.[name]));
      node.setAttribute('aria-pressed', String(target));
      node.setAttribute('aria-label', target ? `${name}, the target` : `${name}: make it the target`);
    });
  }

  /// Vertical position of a name in its head's mark.
  /// \param side  1 below the picture, -1 above
  nameAt(side) { return side > 0 ? this.headRadius + 11 : -(this.headRadius + 11 + 3 * this.unit); }

  /// The heads whose names overlap no other name and no picture. The target's name is placed first, and may be above its
  /// picture if controllers are below. The other heads show their names when the pointer is on them.
  headsWithRoom(places) {
    const { headRadius, unit } = this;
    const { job, document } = this.editor;
    const touch = (a, b) => a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
    const around = ([x, y], half, top, bottom) => ({ left: x - half, right: x + half, top: y + top, bottom: y + bottom });
    const pictures = places.map((place) => around(place, 0.8 * headRadius, -0.8 * headRadius, 0.8 * headRadius));
    const target = headIndex(job, document.recipe.target);
    const named = new Map();
    for (const h of [target, ...places.keys()].filter((number) => number >= 0)) {
      const half = 0.5 * letterWidth * unit * job.heads[h].name.length;
      const sides = (h === target ? [1, -1] : [1]).map((way) => ({ side: way, ...around(places[h], half, this.nameAt(way) - 5 * unit, this.nameAt(way) + 8 * unit) }));
      const free = sides.find((name) => !pictures.some((picture, other) => other !== h && touch(name, picture)) && ![...named.values()].some((other) => touch(name, other)));
      if (free && !named.has(h)) named.set(h, free);
    }
    return named;
  }

  showHandles() {
    const { job, document } = this.editor;
    const inside = (value) => Math.min(Math.max(value, this.knobRadius), side - this.knobRadius);
    const places = job.regions.map(({ name }) => ({ name, at: this.frame.at(this.placeOf(name)).map(inside) }));
    const heads = anchorsOf(job, document.anchors).map((anchor) => ({ at: this.frame.at(anchor) }));
    const { ring, knobRadius } = this;
    const shares = (a, b) => Math.hypot(a.at[0] - b.at[0], a.at[1] - b.at[1]) < ring;
    this.leads.replaceChildren();
    places.forEach((place) => {
      const node = this.handleNodes.get(place.name);
      const here = places.filter((other) => shares(place, other));
      let [x, y] = place.at;
      const onHead = heads.some((head) => shares(head, place)); // the controller must not hide the head's picture
      if ((here.length > 1 || onHead) && this.drag?.node !== node) {
        const away = onHead ? this.headRadius + knobRadius / 2 : ring;
        // A few controllers stand side by side above the head, many all around.
        const step = Math.min(2 * Math.asin(knobRadius * 1.2 / away), (2 * Math.PI) / here.length);
        const angle = (here.indexOf(place) - (here.length - 1) / 2) * step - Math.PI / 2;
        x += away * Math.cos(angle);
        y += away * Math.sin(angle);
        const line = el('line', { x1: place.at[0], y1: place.at[1], x2: x, y2: y, class: 'lead' });
        this.leads.append(line);
      }
      node.setAttribute('transform', `translate(${x} ${y})`);
      node.classList.toggle('byhand', !this.editor.numbersOf(place.name).position);
      const [px, py] = this.placeOf(place.name);
      node.setAttribute('aria-label', `Controller of ${place.name}`);
      node.setAttribute('aria-valuenow', short(px));
      node.setAttribute('aria-valuetext', `${short(px)}, ${short(py)}: ${this.editor.weightText(place.name)}`);
    });
  }

  focusHandle(name) {
    this.handleNodes.get(name)?.focus();
  }
}
