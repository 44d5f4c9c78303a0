// SPDX-License-Identifier: Apache-2.0
// The list of landmarks, and whether each is picked on template and scan.
import { el } from '../dom.js';

export class NameList {
  constructor(picker) {
    this.picker = picker;
    this.rows = new Map();
    this.list = el('ul', { class: 'names', role: 'listbox', tabindex: 0, 'aria-label': 'Landmarks' });
    const field = el('input', {
      type: 'text', maxlength: 64, placeholder: 'Another name', 'aria-label': 'Another name', spellcheck: 'false',
      onkeydown: (event) => { if (event.key === 'Enter') add(); },
    });
    const add = () => {
      const name = field.value.trim();
      if (name && picker.addName(name)) field.value = '';
    };
    this.field = field;
    this.node = el('aside', { 'aria-label': 'Landmarks' }, this.list,
      el('div', { class: 'addname' }, field, el('button', { onclick: add }, 'Add')));
  }

  row(name) {
    const state = el('span', { class: 'state' });
    const mm = el('span', { class: 'mm' });
    const node = el('li', {
      role: 'option', 'data-name': name, title: this.picker.where.get(name) ?? '',
      onclick: () => this.picker.choose(name), onpointerenter: () => this.picker.hover(name), onpointerleave: () => this.picker.hover(null),
    }, state, el('span', { class: 'label' }, name), mm,
    el('button', {
      class: 'plain remove', title: 'Remove it from both (Delete)', 'aria-label': `Remove ${name} from both`, tabindex: -1,
      onclick: (event) => { event.stopPropagation(); this.picker.remove(name); },
    }, '✕'));
    return { node, state, mm };
  }

  show() {
    const { landmarks } = this.picker.document;
    const names = landmarks.map(({ name }) => name);
    for (const [name, { node }] of this.rows) {
      if (names.includes(name)) continue;
      node.remove();
      this.rows.delete(name);
    }
    landmarks.forEach(({ name, template, scan }, i) => {
      if (!this.rows.has(name)) this.rows.set(name, this.row(name));
      const { node, state, mm } = this.rows.get(name);
      if (this.list.children[i] !== node) this.list.insertBefore(node, this.list.children[i] ?? null);
      const residual = this.picker.suggested.residuals[name];
      const active = name === this.picker.active;
      node.classList.toggle('active', active);
      node.setAttribute('aria-selected', String(active));
      node.classList.toggle('outlier', Boolean(residual?.outlier));
      node.classList.toggle('empty', !template && !scan);
      state.textContent = `${template ? '●' : '○'}${scan ? '●' : '○'}`;
      state.title = `${template ? 'picked' : 'missing'} on the template, ${scan ? 'picked' : 'missing'} on the scan`;
      mm.textContent = residual && template && scan ? `${residual.mm.toFixed(1)} mm` : '';
      if (active && this.scrolled !== name) {
        node.scrollIntoView({ block: 'nearest' });
        this.scrolled = name;
      }
    });
  }
}
