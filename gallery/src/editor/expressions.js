// SPDX-License-Identifier: Apache-2.0
// Sliders for the config's expressions. Another face keeps the weights. Saved meshes show the neutral face.
import { el, sliderNode } from '../dom.js';

export class Expressions {
  /// \param editor  job.shapes, look.expression: weights above zero by name; express(shares, isMoving), remember
  constructor(editor) {
    this.editor = editor;
    const { shapes = [] } = editor.job;
    this.sliders = new Map(shapes.map((name) => [name, sliderNode({
      min: 0, max: 1, step: 0.01, value: editor.look.expression[name] ?? 0, 'aria-label': name, title: `Expression ${name}`,
    }, () => this.changed(true), () => this.changed(false))]));
    this.rest = el('button', { title: 'All expressions to zero', onclick: () => {
      for (const node of this.sliders.values()) node.value = 0;
      this.changed(false);
    } }, 'At rest');
    this.node = el('div', { class: 'expressions' }, shapes.length === 0 ? [] : el('details', {
      open: editor.look.expressions ?? true,
      ontoggle: (event) => {
        editor.look.expressions = event.target.open;
        editor.remember();
      },
    }, el('summary', {}, 'Expressions'), this.rest,
    shapes.map((name) => el('label', {}, el('span', {}, name), this.sliders.get(name)))));
    this.show();
  }

  changed(isMoving) {
    const shares = [...this.sliders].map(([name, { value }]) => [name, Number(value)]).filter(([, share]) => share > 0);
    this.editor.express(Object.fromEntries(shares), isMoving);
    this.show();
  }

  show() {
    this.rest.disabled = Object.keys(this.editor.look.expression).length === 0;
  }
}
