// SPDX-License-Identifier: Apache-2.0
// The library: pictures of heads, faces of the crowd and attachments, which can be dropped on the face, a region or the
// plane.
import { el } from '../dom.js';
import { AddedHeads } from './added_heads.js';
import { bandNames, takeOver, underAnchors } from './recipe.js';

const kindOfDrag = 'application/x-crowdface';
const mostShown = 400; // largest number of cards; the search finds the others
const pause = 100; // ms between two checks whether a drag has ended

export class Library {
  /// \param editor  job, look, board, document, commit(document, label), setTarget, open, wear, withRegions, headPlace(name),
  ///                facePicture(name), wornPicture(kind, name), remember, attempt
  constructor(editor) {
    this.editor = editor;
    const { job } = editor;
    this.shelves = new Map([
      ['Heads', job.heads.map(({ name }) => ({ kind: 'head', name }))],
      ...(job.crowd ? [['Faces', job.crowd.faces.map(({ id }) => ({ kind: 'face', name: id }))]] : []),
      ...Object.entries(job.attachments).map(([of, names]) => [of, ['draw', 'none', ...names].map((name) => ({ kind: 'wear', of, name }))]),
    ]);
    this.pictures = new Map();
    this.where = el('select', { 'aria-label': 'Where a click puts it', title: 'Where a click on a picture puts it' },
      el('option', { value: '' }, 'the face'), job.regions.map(({ name }) => el('option', { value: name }, name)));
    this.search = el('input', {
      type: 'text', placeholder: 'Find …', 'aria-label': 'Find by name', spellcheck: 'false', oninput: () => this.show(),
    });
    this.tabs = [...this.shelves.keys()].map((name) => el('button', {
      'data-shelf': name, title: `Pictures: ${name}`, onclick: () => {
        this.choose(this.shelf === name ? null : name);
        editor.remember();
      },
    }, name));
    this.cards = el('div', { class: 'cards', role: 'list' });
    this.tools = el('div', { class: 'choices' }, el('label', {}, 'click: onto ', this.where), this.search);
    this.hint = el('p', { class: 'muted' }, 'Drag a picture onto the face, a region or the plane.');
    this.node = el('section', { class: 'library', 'aria-label': 'Library' },
      el('header', {}, el('h2', {}, 'Library'), el('span', { class: 'grow' }), new AddedHeads(editor).node, el('span', { class: 'group' }, this.tabs)),
      this.tools, this.hint, this.cards);
    this.choose(this.shelves.has(editor.look.shelf) ? editor.look.shelf : null);
  }

  choose(name) {
    this.shelf = name;
    this.editor.look.shelf = name;
    for (const tab of this.tabs) {
      tab.classList.toggle('on', tab.dataset.shelf === name);
      tab.setAttribute('aria-pressed', String(tab.dataset.shelf === name));
    }
    for (const node of [this.tools, this.hint, this.cards]) node.hidden = !name;
    this.where.parentNode.hidden = this.shelves.get(name)?.[0].kind === 'wear';
    this.show();
  }

  show() {
    const words = this.search.value.trim().toLowerCase();
    const found = (this.shelves.get(this.shelf) ?? []).filter(({ name }) => name.toLowerCase().includes(words));
    this.cards.replaceChildren(...found.slice(0, mostShown).map((item) => this.card(item)),
      ...(found.length > mostShown ? [el('p', { class: 'muted' }, `and ${found.length - mostShown} more: type a part of the name`)] : []));
    this.editor.attempt(() => this.takePictures());
  }

  card(item) {
    const { kind, name } = item;
    const text = kind === 'wear' && name === 'draw' ? 'drawn' : name;
    const source = { head: `api/heads/${this.editor.job.heads.findIndex((head) => head.name === name)}/thumbnail`, face: `api/faces/${name}` }[kind];
    const image = el('img', {
      src: source ?? this.pictures.get(this.keyOf(item)), alt: '', loading: 'lazy', draggable: 'false',
      onerror: () => { // the crowd has no pictures
        if (kind === 'face') this.editor.attempt(async () => { image.src = await this.editor.facePicture(name); });
      },
    });
    return el('div', { class: 'card', role: 'listitem' }, el('button', {
      class: 'portrait', draggable: 'true', 'aria-label': `Put ${text} on`, 'data-name': name,
      title: `${text}: a click puts it where the list says; or drag it onto the face, a region or the plane`,
      onclick: () => this.editor.attempt(() => this.put(item, { region: this.where.value || null })),
      ondragstart: ({ dataTransfer }) => {
        dataTransfer.setData(kindOfDrag, JSON.stringify(item));
        dataTransfer.effectAllowed = 'copy';
      },
    }, image.src ? image : el('span', { class: 'blank' }), el('span', {}, text)));
  }

  keyOf({ of, name }) { return `${of} ${name}`; }

  /// Makes a picture of the present face with each attachment, one after another. Waits while the user drags something.
  async takePictures() {
    const { shelf } = this;
    for (const item of this.shelves.get(shelf) ?? []) {
      if (item.kind !== 'wear' || item.name === 'draw' || this.pictures.has(this.keyOf(item))) continue;
      while (this.editor.view.isHeld || this.editor.passing) await new Promise((done) => { setTimeout(done, pause); });
      if (this.shelf !== shelf || !this.editor.ready) return;
      this.pictures.set(this.keyOf(item), await this.editor.wornPicture(item.of, item.name));
      const button = this.cards.querySelector(`[data-name="${CSS.escape(item.name)}"]`);
      if (this.shelf === shelf) button?.firstChild.replaceWith(el('img', { src: this.pictures.get(this.keyOf(item)), alt: '', draggable: 'false' }));
    }
  }

  // -- drop targets --

  /// Makes an element accept dropped pictures.
  /// \param where  function of the event: {region}, {point} on the plane, or {} for the face
  takesDrops(node, where) {
    const isOurs = (event) => event.dataTransfer?.types.includes(kindOfDrag);
    node.addEventListener('dragover', (event) => {
      if (!isOurs(event)) return;
      event.preventDefault();
      event.stopPropagation();
      node.classList.add('dropping');
    });
    node.addEventListener('dragleave', () => node.classList.remove('dropping'));
    node.addEventListener('drop', (event) => {
      node.classList.remove('dropping');
      if (!isOurs(event)) return;
      event.preventDefault();
      event.stopPropagation();
      this.editor.attempt(() => this.put(JSON.parse(event.dataTransfer.getData(kindOfDrag)), where(event)));
    });
  }

  put({ kind, of, name }, { region = null, point = null }) {
    const { editor } = this;
    const { job, document } = editor;
    if (kind === 'wear') {
      editor.wear(of, name);
    } else if (kind === 'head' && region) {
      editor.commit(editor.withRegions(region, ({ weights, ...rest }) => ({ ...rest, position: [...editor.headPlace(name)] })), `${name} on ${region}`);
    } else if (kind === 'head' && point) {
      editor.commit(editor.board.withAnchor(name, point), `${name} moved`);
    } else if (kind === 'head') {
      editor.setTarget(name);
    } else if (region || point) {
      const isTaken = ({ name: other }) => (region ? other === region : !editor.isLocked(other));
      const parts = job.regions.filter(isTaken).flatMap(({ name: other }) => bandNames(job).map((band) => [other, band]));
      const from = underAnchors(job, editor.fromWire(job.crowd.faces.find(({ id }) => id === name)), document.anchors);
      editor.commit({ ...document, recipe: takeOver(job, parts, from.recipe, document.recipe) }, `${name} on ${region ?? 'the plane'}`);
    } else {
      editor.open(`face ${name}`);
    }
  }
}
