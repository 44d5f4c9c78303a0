// SPDX-License-Identifier: Apache-2.0
// The values of each region, as sliders and as number fields.
import { el, short, sliderNode } from '../dom.js';
import { amountAt, amountOf, bandNames, levelOf, unitOf, withAmount } from './recipe.js';

const digits = { '%': 1, mm: 2, iterations: 0 };

export class RegionPanel {
  /// \param editor  job, band, showBand(band), numbersOf(name), withRegions(name, change), preview, commit, toggleLink(name),
  ///                toggleLock(name), isLinked(name), isLocked(name), weightText(name).
  constructor(editor) {
    this.editor = editor;
    this.cards = new Map(editor.job.regions.map((region) => [region.name, this.card(region)]));
    this.bands = new Map(bandNames(editor.job).filter(Boolean).map((band) => [band, el('button', {
      class: 'toggle', 'data-band': band, title: `Show ${band} on plane and sliders`, onclick: () => editor.showBand(band),
    }, band)]));
    this.node = el('div', { class: 'regions' },
      this.bands.size > 0 ? el('div', { class: 'bands', role: 'group', 'aria-label': 'Bands of detail' }, [...this.bands.values()]) : null,
      [...this.cards.values()].map((card) => card.node));
    this.show();
  }

  /// A slider that previews while it is dragged, and makes a step when it is released.
  slider(label, options, change) {
    return sliderNode({ 'aria-label': label, ...options }, (value) => this.editor.preview(change(value)),
      (value) => this.editor.commit(change(value), label, { joins: true }));
  }

  /// A number field. Unreadable input is replaced by the former value; clamped input is reported.
  /// \param limits  () => [smallest, largest]
  number(label, change, limits) {
    const node = el('input', {
      type: 'number', step: 'any', 'aria-label': label,
      onchange: () => {
        const typed = parseFloat(node.value);
        const [least, most] = limits();
        const value = Math.min(Math.max(typed, least), most);
        if (Number.isFinite(typed)) this.editor.commit(change(value), label, { joins: true });
        if (Number.isFinite(typed) && value !== typed) {
          this.editor.say(`${label.replace(', typed', '')}: ${typed} is outside ${short(least)} to ${short(most)}, so it is ${short(value)}.`);
        }
        this.show(node);
      },
    });
    return node;
  }

  card(region) {
    const { name } = region;
    const { editor } = this;
    const { levels } = editor.job;
    const every = (change) => editor.withRegions(name, change);
    const unit = () => unitOf(editor.numbersOf(name));
    const setLevel = (level) => every((value) =>
      withAmount(value, unit(), Number(amountAt(level, unit(), levels).toFixed(digits[unit()] + 2))));
    const setPlace = (axis) => (value) => every(({ weights, ...rest }, other) => {
      const position = [...editor.board.placeOf(other)];
      position[axis] = value;
      return { ...rest, position };
    });
    const placeLimits = (axis) => () => editor.board.limits().map((corner) => corner[axis]);
    const setStrength = (value) => every((old) => ({ ...old, extrapolation: value }));
    const strength = region.extrapolation ?? { min: 1, max: 1 };
    const card = {
      smooth: this.slider(`Smoothness of ${name}`, { min: 0, max: 1, step: 0.002 }, setLevel),
      amount: this.number(`Smoothness of ${name}, typed`, (value) =>
        every((old) => withAmount(old, unit(), value)), () => [0, amountAt(1, unit(), levels)]),
      unit: el('select', {
        'aria-label': `Unit of ${name}'s smoothness`,
        onchange: () => editor.commit(every((old) => withAmount(old, card.unit.value,
          Number(amountAt(levelOf(old, levels), card.unit.value, levels).toFixed(digits[card.unit.value])))),
        `${name} in ${card.unit.value}`),
      }, Object.keys(digits).map((text) => el('option', { value: text }, text === 'iterations' ? 'iter.' : text))),
      strength: this.slider(`Strength of ${name}`, {
        min: Math.min(0, strength.min), max: Math.max(2, strength.max), step: 0.01,
      }, setStrength),
      factor: this.number(`Strength of ${name}, typed`, setStrength, () => [-4, 4]),
      x: this.number(`${name}, to the right`, setPlace(0), placeLimits(0)),
      y: this.number(`${name}, up`, setPlace(1), placeLimits(1)),
      lends: el('p', { class: 'lends' }),
      link: el('button', { class: 'toggle', onclick: () => editor.toggleLink(name) }, 'link'),
      lock: el('button', { class: 'toggle lock', onclick: () => editor.toggleLock(name) }, 'lock'),
    };
    const dot = el('i', { class: 'regiondot' });
    dot.style.background = region.colour;
    card.node = el('section', { class: 'regioncard', 'data-region': name, 'aria-label': name },
      el('header', {}, dot, el('h3', {}, name), el('span', { class: 'grow' }), card.link, card.lock),
      el('div', { class: 'control' }, el('span', {}, 'Smoothness'), card.smooth, card.amount, card.unit),
      el('div', { class: 'control' }, el('span', {}, 'Strength'), card.strength, card.factor),
      el('div', { class: 'control place' }, el('span', {}, 'Place'), card.x, card.y), card.lends);
    return card;
  }

  /// \param typed  the field that the user has just edited: it shows the resulting value
  show(typed = null) {
    const { editor } = this;
    for (const [band, button] of this.bands) {
      button.classList.toggle('on', band === editor.band);
      button.setAttribute('aria-pressed', String(band === editor.band));
    }
    for (const [name, card] of this.cards) {
      const region = editor.numbersOf(name);
      const unit = unitOf(region);
      const put = (input, value) => {
        if (document.activeElement !== input || input.type === 'range' || input === typed) input.value = value;
      };
      put(card.smooth, levelOf(region, editor.job.levels));
      put(card.amount, short(amountOf(region), digits[unit]));
      card.smooth.setAttribute('aria-valuetext', `${short(amountOf(region), digits[unit])} ${unit}`);
      card.unit.value = unit;
      put(card.strength, region.extrapolation ?? 1);
      put(card.factor, short(region.extrapolation ?? 1));
      const [x, y] = editor.board.placeOf(name);
      put(card.x, short(x, 3));
      put(card.y, short(y, 3));
      card.lends.textContent = editor.weightText(name);
      const set = (button, on, title) => {
        button.classList.toggle('on', on);
        button.setAttribute('aria-pressed', String(on));
        button.title = title;
      };
      set(card.link, editor.isLinked(name), 'Linked regions take the same values');
      set(card.lock, editor.isLocked(name), 'Locked regions stay when a face is drawn');
    }
  }

  firstSlider() { return this.node.querySelector('input'); }

  focus(name) {
    this.cards.get(name)?.node.scrollIntoView({ block: 'nearest' });
  }
}
