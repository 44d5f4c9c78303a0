// SPDX-License-Identifier: Apache-2.0
// A second view beside the edited face, with another face and the same camera.
import { getJson, postForBinary } from '../api.js';
import { el } from '../dom.js';
import { linkViews } from '../linked_views.js';
import { dressedFace } from './exact.js';
import { HeadView } from './head_view.js';
import { Newest } from './newest.js';
import { coefficients, headAlone, targetShares, wire } from './recipe.js';

export class Beside {
  /// \param editor  job, view, heads, look, shelf.choices(), attempt, say
  constructor(editor) {
    Object.assign(this, { editor, on: false });
    this.stage = el('div', { class: 'stage other' });
    this.choice = el('select', {
      'aria-label': 'Face beside', title: 'The face that stands beside', onchange: () => this.choose(this.choice.value),
    });
    this.bar = el('div', { class: 'besidebar', hidden: true }, el('span', {}, 'Beside:'), this.choice,
      el('button', { 'aria-label': 'Close the face beside', onclick: () => this.setOn(false) }, '✕'));
    this.exact = new Newest({
      ask: async ({ document, key }) => {
        const recipe = wire(editor.job, document);
        const face = await dressedFace({ recipe, face: document.face, wears: editor.look.wears, expression: editor.look.expression });
        return { document, key, face, skin: await postForBinary('skin', { recipe }) };
      },
      show: (answer) => this.showExact(answer),
      fail: (error) => editor.say(error.message, true),
    });
  }

  setOn(on) {
    const { editor } = this;
    this.on = on;
    if (on && editor.photo.mode === 'beside') editor.photo.setMode('off');
    if (on && !this.view) this.open();
    this.bar.hidden = !on;
    editor.node.querySelector('.viewbox').classList.toggle('two', on);
    editor.look.beside = on ? editor.look.beside ?? '' : null;
    editor.remember();
    editor.viewTools.show();
    this.refresh();
  }

  /// Shows surfaces, distances or regions, as in the edited face's view. Textures of heads are shown there only.
  shown(show) { return show.startsWith('texture') ? 'surface' : show; }

  open() {
    const { editor } = this;
    this.view = new HeadView(editor.job, { ...editor.view.mesh });
    this.view.node.setAttribute('aria-label', 'The face beside');
    this.stage.append(this.view.node);
    editor.heads.forEach((head, h) => this.view.setHead(h, head));
    if (editor.light) this.view.setLight(editor.light);
    linkViews([editor.view, this.view]);
    new ResizeObserver(() => this.view.fit()).observe(this.stage);
    this.view.setShow(this.shown(editor.look.show));
    this.view.lookAs(editor.view);
  }

  /// Shows the chosen face, and lists the present faces.
  refresh() {
    if (!this.on) return;
    const { editor } = this;
    const { target } = editor.document.recipe;
    const offered = JSON.stringify([target, editor.kept.map(({ name }) => name)]);
    if (offered !== this.offered) {
      this.offered = offered;
      this.choices = new Map([[`target ${target}`, headAlone(editor.job, target, 'target')], ...editor.shelf.choices()]);
      this.choice.replaceChildren(...[...this.choices.keys()].map((name) => el('option', { value: name }, name)));
      this.choice.value = this.choices.has(editor.look.beside) ? editor.look.beside : `target ${target}`;
    }
    this.show();
  }

  choose(name) {
    const { editor } = this;
    editor.look.beside = name;
    editor.remember();
    this.show();
  }

  show() {
    const { editor, view } = this;
    const document = this.choices.get(this.choice.value);
    const shares = targetShares(editor.job, document.recipe);
    const key = JSON.stringify([document, editor.look.wears, editor.look.expression, editor.masksTurn]);
    if (key === this.key || shares.some((share, h) => share !== 0 && !editor.heads[h])) return;
    this.key = key;
    view.blender.unsettle();
    view.worn.node.visible = false;
    view.blend(coefficients(editor.job, document, editor.heads), shares);
    this.exact.ask({ document, key });
  }

  async showExact({ document, key, face, skin }) {
    if (key !== this.key) return;
    const { editor, view } = this;
    view.blend(coefficients(editor.job, document, editor.heads), targetShares(editor.job, document.recipe), face);
    view.wear(await Promise.all(face.worn.map(async (name) =>
      [await view.worn.prepare(name, () => getJson(`attachments/${name}`)), face[`worn ${name}`]])), face);
    view.worn.node.visible = true;
    await view.setSkin(skin);
    view.draw();
  }
}
