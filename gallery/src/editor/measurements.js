// SPDX-License-Identifier: Apache-2.0
// Sliders for the measurements of the face: the program finds the weights that give the wanted value.
import { post } from '../api.js';
import { el, sliderNode } from '../dom.js';
import { wordsOf } from '../traits.js';
import { Newest } from './newest.js';
import { wire, withWeights } from './recipe.js';

const steps = 200; // steps of a slider
const near = 0.02; // difference that counts as reached, as a fraction of the slider's range

const numberOf = ({ unit }, value) => value.toFixed(unit ? 1 : 3);
const textOf = (trait, value) => `${numberOf(trait, value)}${trait.unit === ' degrees' ? '°' : trait.unit}`;

export class Measurements {
  /// \param editor  job, document, preview, commit(document, label), say, tell(measures), look, remember, lockedNames
  constructor(editor) {
    Object.assign(this, { editor, rows: new Map() });
    this.node = el('div', { class: 'traits' });
    this.steering = new Newest({
      ask: async (asked) => ({ asked, answer: await post('steer', asked.body) }),
      show: ({ asked, answer }) => this.came(asked, answer),
      fail: (error) => {
        this.from = null;
        editor.preview(null);
        editor.say(error.message, true);
      },
    });
  }

  /// \param all  the measurements, as in the program's answer
  show(all) {
    if (all.map(({ name }) => name).join() !== [...this.rows.keys()].join()) this.build(all);
    for (const trait of all) {
      const { slider, value, more } = this.rows.get(trait.name);
      if (this.held !== slider) {
        slider.min = Math.min(trait.low, trait.value);
        slider.max = Math.max(trait.high, trait.value);
        slider.step = (trait.high - trait.low) / steps || 'any';
        slider.value = trait.value;
      }
      slider.setAttribute('aria-valuetext', textOf(trait, trait.value));
      value.textContent = textOf(trait, trait.value);
      more.textContent = `${trait.more < 0 ? '−' : '+'}${numberOf(trait, Math.abs(trait.more))}`;
    }
  }

  build(all) {
    const { editor } = this;
    this.rows = new Map(all.map((trait) => {
      const node = sliderNode({
        'aria-label': wordsOf(trait.name),
        title: `Changes what heads lend to regions that are not locked; from ${textOf(trait, trait.low)} to ${textOf(trait, trait.high)}, as on the heads`,
      }, (value) => {
        this.held = node;
        this.steer(trait, value, false);
      }, (value) => this.steer(trait, value, true));
      return [trait.name, { slider: node, value: el('td', {}), more: el('td', {}) }];
    }));
    this.node.replaceChildren(...(all.length === 0 ? [] : [el('details', {
      open: editor.look.measurements ?? true,
      ontoggle: (event) => {
        editor.look.measurements = event.target.open;
        editor.remember();
      },
    }, el('summary', {}, 'Measurements'), el('table', {},
      el('tr', {}, el('th', {}, ''), el('th', {}, ''), el('th', {}, ''), el('th', { title: "difference to the heads' mean" }, 'to mean')),
      all.map(({ name, symbol }) => {
        const { slider, value, more } = this.rows.get(name);
        return el('tr', { title: symbol }, el('td', {}, wordsOf(name)), el('td', {}, slider), value, more);
      })))]));
  }

  steer(trait, value, ends) {
    const { editor } = this;
    this.from ??= editor.document;
    const { from } = this;
    const recipe = wire(editor.job, from);
    this.steering.ask({
      trait, value, ends, from, recipe, body: { recipe, face: from.face, trait: trait.name, value, locked: editor.lockedNames() },
    });
  }

  came({ trait, value, ends, from, recipe }, answer) {
    const { editor } = this;
    const document = withWeights(editor.job, from, recipe, answer.recipe);
    if (!ends) {
      editor.preview(document);
      editor.tell(answer);
      return;
    }
    if (!this.steering.next) this.from = null;
    this.held = null;
    editor.commit(document, wordsOf(trait.name), { joins: true });
    editor.tell(answer);
    const reached = answer.traits.find(({ name }) => name === trait.name).value;
    if (Math.abs(reached - value) > near * (trait.high - trait.low)) {
      editor.say(`${wordsOf(trait.name)}: ${textOf(trait, reached)} is as near to ${textOf(trait, value)} as the heads allow${
        editor.lockedNames().length > 0 ? ' with these regions locked' : ''}.`);
    }
  }
}
