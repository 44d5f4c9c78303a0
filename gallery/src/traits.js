// SPDX-License-Identifier: Apache-2.0
import { el, short } from './dom.js';

const bins = 24;
const size = { width: 200, height: 56 };

/// Formats the name of a measurement, such as "nose_width", as words.
export const wordsOf = (name) => name.replaceAll('_', ' ');

/// Formats a value with its unit.
export const traitText = (trait, value) => `${short(value, trait.unit ? 1 : 3)}${trait.unit ?? ''}`;

/// The mean of a measurement over the heads.
export function headsMean(crowd, name) {
  return crowd.heads.reduce((sum, head) => sum + head.traits[name], 0) / crowd.heads.length;
}

/// The measurements of a crowd in the sidebar: a menu, a histogram of the faces, the heads as lines below the histogram,
/// and the two ends of a filter.
export class TraitPanel {
  /// \param change  called with {traits: ranges} when the filter changes
  constructor(crowd, change) {
    Object.assign(this, { crowd, change, ranges: {} });
    this.choice = el('select', { name: 'trait', title: 'Which measurement the histogram and the filter are about', onchange: () => this.draw() },
      crowd.traits.map(({ name }) => el('option', { value: name }, wordsOf(name))));
    const end = (at, text) => el('input', {
      type: 'number', step: 'any', placeholder: text, 'aria-label': text, 'data-end': text,
      oninput: (event) => this.set(at, event.target.value),
    });
    this.ends = [end(0, 'from'), end(1, 'to')];
    this.chart = el('svg', { class: 'histogram', viewBox: `0 0 ${size.width} ${size.height}` });
    this.text = el('small', { class: 'muted' });
    this.node = el('section', { class: 'traits' }, el('label', {}, 'Trait', this.choice), this.chart,
      this.text, el('div', { class: 'ends' }, this.ends));
    this.draw();
  }

  get trait() { return this.crowd.traits.find(({ name }) => name === this.choice.value); }

  set(at, text) {
    const { name } = this.trait;
    const range = this.ranges[name] ?? [null, null];
    range[at] = text === '' ? null : Number(text);
    this.ranges[name] = range;
    if (range.every((value) => value === null)) delete this.ranges[name];
    this.change({ traits: this.ranges });
    this.draw();
  }

  draw() {
    const { name } = this.trait;
    const faces = this.crowd.faces.map((face) => face.traits?.[name]).filter((value) => value !== undefined);
    const heads = this.crowd.heads.map((head) => head.traits[name]);
    const low = Math.min(...heads, ...faces.slice(0, 10000));
    const high = Math.max(...heads, ...faces.slice(0, 10000));
    const place = (value) => (high > low ? (size.width * (value - low)) / (high - low) : size.width / 2);
    const counts = new Array(bins).fill(0);
    for (const value of faces) {
      counts[Math.max(0, Math.min(bins - 1, Math.floor((bins * place(value)) / size.width)))] += 1;
    }
    const most = Math.max(...counts, 1);
    const base = size.height - 10;
    this.chart.replaceChildren(
      ...counts.map((count, at) => el('rect', {
        class: 'faces', x: (at * size.width) / bins, width: size.width / bins - 1,
        y: base * (1 - count / most), height: (base * count) / most,
      }, el('title', {}, `${count} faces`))),
      ...heads.map((value, at) => el('line', {
        class: 'heads', x1: place(value), x2: place(value), y1: base + 1, y2: size.height,
      }, el('title', {}, `${this.crowd.heads[at].name}: ${traitText(this.trait, value)}`))));
    this.text.textContent = `${traitText(this.trait, low)} to ${traitText(this.trait, high)}; lines: heads`;
    for (const option of this.choice.options) { // a dot where a filter is set
      option.textContent = `${this.ranges[option.value] ? '• ' : ''}${wordsOf(option.value)}`;
    }
    const range = this.ranges[name] ?? [null, null];
    this.ends.forEach((end, at) => { if (document.activeElement !== end) end.value = range[at] ?? ''; });
  }
}
