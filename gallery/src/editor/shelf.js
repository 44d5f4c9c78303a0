// SPDX-License-Identifier: Apache-2.0
// Kept states for comparison, proposals of faces, and interpolation between two faces.
import { el, short } from '../dom.js';
import { post } from '../api.js';
import { between, headAlone, takeOver, underAnchors } from './recipe.js';

const mostKept = 12;
const mostOffered = 400; // largest number of the crowd's faces in the menus; other faces must be opened and kept first

export class Shelf {
  /// \param editor  job, document, preview, commit(document, label), pictureOf(document),
  ///                dressedPicture(document), say(text), compare(index),
  ///                kept: [{name, document, picture}], locked(), like().
  constructor(editor) {
    this.editor = editor;
    this.turn = 0; // counts calls of offer()
    this.keptNode = el('div', { class: 'cards', role: 'list' });
    this.pickNode = el('div', { class: 'cards', role: 'list' });
    this.amount = el('input', {
      type: 'range', min: 0.05, max: 1, step: 0.05, value: 0.3, 'aria-label': 'How far from this face',
    });
    this.picks = el('section', { class: 'picks', hidden: true },
      el('header', {}, el('h2', {}, 'Pick one'), el('label', {}, 'unlike ', this.amount),
        el('button', { title: 'Draw six others (L)', onclick: () => this.offer() }, 'Six more'),
        el('button', { onclick: () => this.closePicks(), 'aria-label': 'Close the faces to pick from' }, '✕')),
      this.pickNode);
    this.path = this.betweenNode();
    this.node = el('div', { class: 'shelf' }, this.picks, this.path,
      el('section', {}, el('header', {}, el('h2', {}, 'Kept'), el('span', { class: 'grow' }),
        el('button', { onclick: () => this.keep(), title: 'Keep this face to compare with (K)' }, 'Keep this')),
      this.keptNode));
    this.show();
  }

  // -- kept states --

  keep(document = this.editor.document, picture = this.editor.pictureOf(document)) {
    const { editor } = this;
    const used = new Set(editor.kept.map((entry) => entry.name));
    let number = editor.kept.length + 1;
    while (used.has(`kept ${number}`)) number += 1;
    editor.kept.push({ name: `kept ${number}`, document, picture });
    if (editor.kept.length > mostKept) editor.kept.shift();
    editor.comparedWith = editor.kept.length - 1;
    this.show();
    editor.remember();
  }

  show() {
    const { editor } = this;
    this.keptNode.replaceChildren(...editor.kept.map((entry, index) => {
      const shown = editor.comparing === index;
      return el('div', { class: 'card', role: 'listitem' },
        el('button', {
          class: `portrait ${shown ? 'on' : ''}`, 'aria-pressed': String(shown), 'aria-label': `Compare with ${entry.name}`,
          title: 'Compare: show this one, and again to go back (B)', onclick: () => editor.compare(index),
        }, entry.picture ? el('img', { src: entry.picture, alt: '' }) : null),
        el('input', {
          type: 'text', value: entry.name, maxlength: 64, 'aria-label': `Caption of ${entry.name}`,
          onchange: (event) => {
            entry.name = event.target.value.trim() || entry.name;
            this.show();
            editor.remember();
          },
        }),
        el('div', { class: 'cardfoot' },
          el('button', {
            class: 'plain', 'aria-label': `Go on from ${entry.name}`, title: 'Go on from this one',
            onclick: () => editor.commit(entry.document, `back to ${entry.name}`),
          }, 'use'),
          el('button', {
            class: 'plain', 'aria-label': `Forget ${entry.name}`, title: 'Forget it',
            onclick: () => {
              editor.compare(null);
              editor.kept.splice(index, 1);
              this.show();
              editor.remember();
            },
          }, '✕')));
    }));
    if (editor.kept.length === 0) {
      this.keptNode.append(el('p', { class: 'muted' }, 'Keep a face, change it, and compare the two with B.'));
    }
  }

  // -- faces drawn --

  /// One face within the config's limits; locked regions stay.
  async draw() {
    const { editor } = this;
    const { recipes } = await post('draw', {
      recipe: editor.wire(), locked: editor.lockedNames(), count: 1, like: null, amount: 1,
    });
    editor.commit(this.drawn(recipes[0], editor.document), 'a face drawn');
  }

  /// A drawn recipe as a document: heads stay where they were moved to, and what is locked is as it was.
  drawn(told, from) {
    const { editor } = this;
    const document = underAnchors(editor.job, editor.fromWire(told), from.anchors);
    const recipe = takeOver(editor.job, editor.lockedParts(), from.recipe, document.recipe);
    return { ...document, recipe: { ...recipe, id: from.recipe.id } };
  }

  /// Six like this one, to pick from.
  async offer() {
    const { editor } = this;
    this.picks.hidden = false;
    this.turn += 1;
    const { turn } = this;
    this.pickNode.replaceChildren(el('p', { class: 'muted' }, 'Drawing …'));
    const recipe = editor.wire();
    const { recipes, mm } = await post('draw', {
      recipe, locked: editor.lockedNames(), count: 6, like: recipe, amount: Number(this.amount.value),
    });
    if (this.turn !== turn) return;
    this.pickNode.replaceChildren();
    const start = editor.document;
    for (const [index, told] of recipes.entries()) {
      const document = { ...this.drawn(told, start), face: start.face }; // the hair of the open face
      const picture = await editor.dressedPicture(document);
      if (this.turn !== turn) return;
      this.pickNode.append(el('div', { class: 'card', role: 'listitem' },
        el('button', {
          class: 'portrait', 'aria-label': `Take face ${index + 1}`, title: 'Go on from this one',
          onclick: () => editor.commit(document, 'one like it'),
        }, el('img', { src: picture, alt: '' })),
        el('div', { class: 'cardfoot' }, el('span', { title: 'Distance from the face' }, `${short(mm[index])} mm`),
          el('button', { class: 'plain', 'aria-label': `Keep face ${index + 1}`, title: 'Keep it, to compare and with a caption', onclick: () => this.keep(document, picture) }, 'keep'))));
    }
    this.pickNode.querySelector('button')?.focus();
  }

  closePicks() {
    this.picks.hidden = true;
  }

  // -- between two --

  betweenNode() {
    this.from = el('select', { 'aria-label': 'Between this', onchange: () => this.travel() });
    this.to = el('select', { 'aria-label': 'and that', onchange: () => this.travel() });
    this.way = el('input', {
      type: 'range', min: 0, max: 1, step: 0.01, value: 0.5, 'aria-label': 'Position between the two', oninput: () => this.travel(),
    });
    return el('section', { class: 'path', hidden: true },
      el('header', {}, el('h2', {}, 'Between two'), el('span', { class: 'grow' }),
        el('button', { class: 'on', title: 'Go on from this one', onclick: () => this.endTravel(true) }, 'Take it'),
        el('button', { onclick: () => this.endTravel(false), 'aria-label': 'Leave it as it was' }, '✕')),
      el('div', { class: 'ends' }, this.from, this.way, this.to));
  }

  /// [name, document] of the faces that there are beside the edited one.
  choices() {
    const { editor } = this;
    return [...editor.kept.map((entry) => [entry.name, entry.document]),
      ...(editor.job.crowd?.faces ?? []).slice(0, mostOffered).map((face) => [face.id, editor.fromWire(face, face.id)]),
      ...editor.job.heads.map((head) => [head.name, headAlone(editor.job, head.name, editor.document.recipe.id)])];
  }

  startTravel() {
    const { editor } = this;
    this.ends = new Map([['this face', editor.document], ...this.choices()]);
    for (const select of [this.from, this.to]) {
      select.replaceChildren(...[...this.ends.keys()].map((name) => el('option', { value: name }, name)));
    }
    this.to.selectedIndex = this.ends.size > 1 ? 1 : 0;
    this.path.hidden = false;
    this.path.scrollIntoView({ block: 'nearest' });
    this.way.focus();
    this.travel();
  }

  travel() {
    const { editor } = this;
    const { anchors } = this.ends.get('this face');
    const [from, to] = [this.from, this.to].map(({ value }) => underAnchors(editor.job, this.ends.get(value), anchors));
    const mixed = between(editor.job, from, to, Number(this.way.value));
    const stay = this.ends.get('this face');
    const recipe = takeOver(editor.job, editor.lockedParts(), stay.recipe, mixed.recipe);
    editor.preview({ ...mixed, recipe: { ...recipe, id: stay.recipe.id } });
  }

  endTravel(take) {
    const { editor } = this;
    this.path.hidden = true;
    if (take) editor.commit(editor.document, `between ${this.from.value} and ${this.to.value}`);
    else editor.preview(null);
  }
}
