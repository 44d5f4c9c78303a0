// SPDX-License-Identifier: Apache-2.0
import { el, short } from './dom.js';
import { bandsOf } from './crowd.js';
import { picture } from './grid.js';

// Colours that colour-blind people can distinguish (Okabe & Ito 2008), then lighter ones.
const colours = ['#56b4e9', '#e69f00', '#3fbf96', '#d98cb8', '#f0e442', '#5a8fd6', '#e07b4f',
  '#a8c686', '#b79be0', '#8fd3d1', '#d6c3a5', '#c7667f'];
/// A different colour for each index: first the colours above, then hues a golden angle apart, alternately lighter and
/// darker.
export const colourOf = (k) => colours[k] ??
  `hsl(${((k * 137.508) % 360).toFixed(1)} ${k % 2 ? 75 : 45}% ${[72, 52, 62][k % 3]}%)`;
const markColours = { keep: '#86bd92', reject: '#d17a6e' };
export const side = 460;

/// The map from the part of the weight plane that contains these points, with a margin, to a square of `side` pixels, and
/// its inverse.
export function planeFrame(points, room = 1.36) {
  const xs = points.map((p) => p[0]);
  const ys = points.map((p) => p[1]);
  const low = [Math.min(...xs), Math.min(...ys)];
  const high = [Math.max(...xs), Math.max(...ys)];
  const half = Math.max(high[0] - low[0], high[1] - low[1], 1e-9) / 2 * room;
  const centre = [(low[0] + high[0]) / 2, (low[1] + high[1]) / 2];
  const middle = side / 2;
  return {
    at: (p) => [middle + ((p[0] - centre[0]) / half) * middle, middle - ((p[1] - centre[1]) / half) * middle],
    back: ([x, y]) => [centre[0] + ((x - middle) / middle) * half, centre[1] - ((y - middle) / middle) * half],
  };
}

/// Text that keeps its size on the screen when the plane is zoomed.
function legible(svg) {
  new ResizeObserver(([{ contentRect: { width } }]) => {
    if (width > 0) svg.style.setProperty('--unit', `${side / width}px`);
  }).observe(svg);
  return svg;
}

/// A head's picture in a ring, centred at the origin.
export function anchorMark(head, radius = 17) {
  const id = `clip ${head.name} ${Math.random()}`.replace(/[^\w]/g, '_');
  const size = 2 * radius + 4;
  const children = head.picture
    ? [el('clipPath', { id }, el('circle', { r: radius })),
      el('image', {
        href: head.picture, x: -size / 2, y: -size / 2, width: size, height: size,
        preserveAspectRatio: 'xMinYMid slice', 'clip-path': `url(#${id})`,
      })]
    : [];
  return el('g', { class: 'anchor' }, ...children, el('circle', { r: radius }),
    el('text', { y: radius + 11 }, head.name));
}

/// The positions of all faces on the weight plane: one diagram for each region or band.
export class Plane {
  constructor(crowd, review, { open, select }) {
    Object.assign(this, { crowd, review, open, select });
    this.colourBy = 'target';
    this.dots = new Map();
    this.tip = el('div', { class: 'tip', hidden: true });
    this.legend = el('div', { class: 'legend' });
    this.node = el('div', { class: 'plane' });
    this.build();
  }

  build() {
    const { at } = planeFrame(this.crowd.heads.map((head) => head.anchor).concat(
      this.crowd.onPlane.flatMap((face) => Object.values(face.regions)
        .flatMap((region) => bandsOf(this.crowd, region).map(([, numbers]) => numbers.position)).filter(Boolean))));
    const choose = el('select', { title: 'What the colours of the dots say', onchange: () => this.recolour(choose.value) },
      el('option', { value: 'target' }, 'target'), el('option', { value: 'family' }, 'family'),
      el('option', { value: 'mark' }, 'mark'));
    const regions = this.crowd.regions.length > 0 ? this.crowd.regions : ['all'];
    this.node.append(
      el('div', { class: 'planebar' }, el('label', {}, 'Colour by ', choose), this.legend,
        this.crowd.onPlane.length < this.crowd.faces.length
          ? el('span', { class: 'muted' }, `${this.crowd.onPlane.length} of ${this.crowd.faces.length} faces, evenly from the plan`) : null),
      el('div', { class: 'panels' }, regions.flatMap((name) => (this.crowd.bands.length > 0
        ? this.crowd.bands.map((band) => this.panel(name, at, band)) : [this.panel(name, at)]))), this.tip);
    this.recolour('target');
  }

  panel(name, at, band = '') {
    const dots = el('g', {});
    let missing = 0;
    for (const face of this.crowd.onPlane) {
      const region = face.regions[name];
      const position = region && new Map(bandsOf(this.crowd, region)).get(band).position;
      if (!position) {
        missing += 1;
        continue;
      }
      const [x, y] = at(position);
      const dot = el('circle', {
        cx: x, cy: y, r: 4, class: 'dot', 'data-id': face.id,
        onpointerenter: (event) => this.hover(face, event),
        onpointerleave: () => this.hover(null),
        onclick: () => this.select(face), ondblclick: () => this.open(face),
      });
      if (!this.dots.has(face.id)) this.dots.set(face.id, []);
      this.dots.get(face.id).push(dot);
      dots.append(dot);
    }
    const heads = el('g', {}, this.crowd.heads.map((head) =>
      el('g', { transform: `translate(${at(head.anchor)})` }, anchorMark(head))));
    return el('figure', {}, el('figcaption', {}, band ? `${name}, ${band}` : name,
      missing > 0 ? el('small', {}, ` · ${missing} ${missing === 1 ? 'has' : 'have'} no place on the plane`) : null),
    legible(el('svg', { viewBox: `0 0 ${side} ${side}` }, heads, dots)));
  }

  recolour(by) {
    this.colourBy = by;
    const names = by === 'target' ? this.crowd.targets : by === 'family' ? this.crowd.families : [];
    const colour = (name) => (names.indexOf(name) < 0 ? '#8d8c88'
      : colourOf(names.indexOf(name)));
    this.colour = (face) => (by === 'mark'
      ? markColours[this.review.of(face)?.verdict] ?? '#8d8c88'
      : colour(by === 'target' ? face.target : face.family));
    const entries = by === 'mark' ? Object.entries(markColours) : names.map((n) => [n, colour(n)]);
    this.legend.replaceChildren(...entries.map(([name, value]) =>
      el('span', {}, el('i', { style: `background:${value}` }), name)));
    for (const face of this.crowd.onPlane) this.showMark(face);
  }

  showMark(face) {
    for (const dot of this.dots.get(face.id) ?? []) dot.style.fill = this.colour(face);
  }

  show(faces) {
    const shown = new Set(faces.map((face) => face.id));
    for (const [id, dots] of this.dots) {
      for (const dot of dots) dot.classList.toggle('away', !shown.has(id));
    }
  }

  mark(face) {
    for (const dot of this.node.querySelectorAll('.dot.selected')) {
      dot.classList.remove('selected');
      dot.setAttribute('r', 4);
    }
    for (const dot of (face && this.dots.get(face.id)) ?? []) {
      dot.classList.add('selected');
      dot.setAttribute('r', 7);
      dot.parentNode.append(dot);
    }
  }

  hover(face, event) {
    for (const dot of this.node.querySelectorAll('.dot.near')) dot.classList.remove('near');
    this.tip.hidden = !face;
    if (!face) return;
    for (const dot of this.dots.get(face.id)) dot.classList.add('near');
    const weights = Object.entries(face.regions).map(([name, region]) =>
      `${name}: smoothness ${short(region.smoothness)}, strength ${short(region.extrapolation)}`);
    this.tip.replaceChildren(picture(face, face.id), el('b', {}, face.id),
      el('span', {}, `on ${face.target}`), ...weights.map((line) => el('small', {}, line)));
    const box = event.target.getBoundingClientRect();
    this.tip.style.left = `${Math.min(box.right + 12, innerWidth - 210)}px`;
    this.tip.style.top = `${Math.min(box.top, innerHeight - 270)}px`;
  }
}
