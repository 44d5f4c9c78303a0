// SPDX-License-Identifier: Apache-2.0
// The page of one crowd: a grid of faces, the plane, one face; filters, marks, keys.
import { el } from './dom.js';
import { chosenFaces, noFilters, readCrowd } from './crowd.js';
import { FacePage } from './face.js';
import { Grid } from './grid.js';
import { Plane } from './plane.js';
import { Review } from './review.js';
import { TraitPanel, wordsOf } from './traits.js';

function storage() {
  try {
    return window.localStorage;
  } catch {
    return null; // some browsers refuse it to pages from disk
  }
}

function stored(key, otherwise) {
  try {
    return JSON.parse(storage()?.getItem(key)) ?? otherwise;
  } catch {
    return otherwise;
  }
}

function store(key, value) {
  try {
    storage()?.setItem(key, JSON.stringify(value));
  } catch {
    // only a comfort: where nothing can be kept the page says so beside the export
  }
}

class Page {
  constructor(data) {
    this.crowd = readCrowd(data);
    this.review = new Review(this.crowd, storage());
    this.filters = { ...noFilters };
    this.cellKey = 'crowdface cell size';
    const call = {
      open: (face) => this.go(face),
      select: (face) => this.select(face),
    };
    this.grid = new Grid(this.crowd, this.review, call);
    this.plane = new Plane(this.crowd, this.review, call);
    this.face = new FacePage(this.crowd, this.review, (face) => this.go(face));
    this.main = el('main', { class: 'all' });
    this.summary = el('p', { class: 'summary' });
    this.message = el('div', { class: 'message', role: 'status', hidden: true });
    this.review.listeners.push((face) => this.marked(face));
    this.node = el('div', { class: 'shell' }, this.sidebar(), this.main, this.face.node, this.message);
    this.resize(stored(this.cellKey, 168));
    addEventListener('hashchange', () => this.route());
    addEventListener('keydown', (event) => this.key(event));
    this.apply();
    this.route();
    this.tell();
  }

  // -- the sidebar --

  sidebar() {
    const { crowd } = this;
    const select = (name, title, entries, tip = `Faces by ${title.toLowerCase()}`) => {
      const node = el('select', {
        name, title: tip, onchange: () => this.filter({ [name]: node.value }),
      }, entries.map(([value, text]) => el('option', { value }, text)));
      return el('label', {}, title, node);
    };
    this.search = el('input', {
      type: 'search', placeholder: 'Search (/)', 'aria-label': 'Search', title: 'Words in id, family, group, target, tags, attachments or notes (/)',
      oninput: () => this.filter({ search: this.search.value }),
    });
    const tags = crowd.tags.map((tag) => {
      const button = el('button', {
        class: 'tag', title: `Only faces tagged ${tag}`, onclick: () => {
          button.classList.toggle('on');
          this.filter({ tags: this.filters.tags.includes(tag)
            ? this.filters.tags.filter((other) => other !== tag) : [...this.filters.tags, tag] });
        },
      }, tag);
      return button;
    });
    this.size = el('input', {
      type: 'range', min: '84', max: '320', oninput: () => this.resize(Number(this.size.value)),
      'aria-label': 'Size of the pictures',
    });
    this.tabs = ['faces', 'plane'].map((name) => el('button', {
      class: 'tab', 'data-tab': name, title: name === 'faces' ? 'All faces (G)' : 'Where the faces lie on the plane (M)', onclick: () => { location.hash = `#/${name}`; },
    }, name === 'faces' ? 'Faces' : 'Plane'));
    this.counts = el('div', { class: 'counts' });
    return el('aside', {},
      el('h1', {}, crowd.name), el('p', { class: 'muted' },
        `${crowd.faces.length} faces from ${crowd.heads.length} heads, seed\u00a0${crowd.seed}`),
      el('nav', {}, this.tabs), this.search,
      select('sort', 'Order', [['plan', 'as planned'], ['id', 'by id'],
        ['distance', 'nearest neighbour first'], ['far', 'most distinct first'],
        ['head', 'nearest to a head first'], ['likeness', 'by likeness'], ['family', 'by family'],
        ...(crowd.groups.length > 0 ? [['group', 'by group']] : []),
        ...crowd.traits.flatMap(({ name }) => [[`+${name}`, `${wordsOf(name)}, least first`],
          [`-${name}`, `${wordsOf(name)}, greatest first`]])]),
      select('target', 'Target', [['', 'all'], ...crowd.targets.map((name) => [name, name])]),
      crowd.families.length > 0 ? select('family', 'Family', [['', 'all'],
        ...crowd.families.map((name) => [name, name]), ['·none', 'none']]) : null,
      crowd.groups.length > 0 ? select('group', 'Group', [['', 'all'],
        ...crowd.groups.map((name) => [name, name]), ['·none', 'none']]) : null,
      select('mark', 'Marks', [['any', 'any'], ['unmarked', 'not marked yet'], ['keep', 'kept'],
        ['reject', 'rejected'], ['locked', 'locked'], ['noted', 'with a note'],
        ['changed', 'with a change']]),
      tags.length > 0 ? el('div', { class: 'tags' }, tags) : null,
      crowd.traits.length > 0 ? new TraitPanel(crowd, (change) => this.filter(change)).node : null,
      el('label', {}, 'Size', this.size), this.summary,
      el('span', { class: 'grow' }), this.counts,
      el('button', { class: 'export', title: 'Saves the marks as a file for generate --review (E)', onclick: () => this.export() }, 'Export review.yaml'),
      el('button', { class: 'plain', title: 'All keys (?)', onclick: () => this.help() }, 'Keys (?)'));
  }

  resize(px) {
    this.size.value = px;
    document.documentElement.style.setProperty('--cell', `${px}px`);
    store(this.cellKey, px);
  }

  filter(change) {
    Object.assign(this.filters, change);
    this.apply();
  }

  apply() {
    this.faces = chosenFaces(this.crowd, this.filters, (face) => this.review.of(face));
    this.grid.show(this.faces);
    this.plane.show(this.faces);
    const all = this.crowd.faces.length;
    this.summary.textContent = this.faces.length === all ? '' : `${this.faces.length} of ${all} shown`;
    if (this.selected && !this.faces.includes(this.selected)) this.select(null);
  }

  tell() {
    const kept = this.review.count('keep');
    const rejected = this.review.count('reject');
    this.counts.replaceChildren(
      el('span', { class: 'keep' }, `${kept} kept`), el('span', { class: 'reject' }, `${rejected} rejected`),
      el('span', { class: 'muted' }, `${this.crowd.faces.length - kept - rejected} to go`));
    if (!this.review.kept) this.say('This browser keeps no marks for pages from disk: export them before you leave.');
  }

  // -- where we are --

  route() {
    const [, where, id] = location.hash.match(/^#\/(faces|plane|face)\/?(.*)$/) ?? [null, 'faces', ''];
    const face = where === 'face' ? this.crowd.byId.get(decodeURIComponent(id)) : null;
    this.where = face ? 'face' : where === 'plane' ? 'plane' : 'faces';
    this.main.hidden = this.where === 'face';
    this.face.node.hidden = this.where !== 'face';
    this.node.classList.toggle('single', this.where === 'face');
    for (const tab of this.tabs) tab.classList.toggle('on', tab.dataset.tab === this.where);
    document.title = face ? `${face.id} · ${this.crowd.name}` : `${this.crowd.name} · crowdface`;
    if (face) {
      this.select(face);
      this.face.show(face, this.faces.includes(face) ? this.faces : this.crowd.faces);
      this.back = this.back ?? 'faces';
    } else {
      this.back = this.where;
      this.main.replaceChildren(this.where === 'plane' ? this.plane.node : this.grid.node);
      this.select(this.selected);
    }
  }

  go(face) {
    location.hash = face ? `#/face/${encodeURIComponent(face.id)}` : `#/${this.back ?? 'faces'}`;
  }

  select(face) {
    this.selected = face;
    this.grid.select(face);
    this.plane.mark(face);
  }

  marked(face) {
    this.grid.showMark(face);
    this.plane.showMark(face);
    this.face.showMark(face);
    this.tell();
  }

  say(text) {
    clearTimeout(this.timer);
    this.message.hidden = !text;
    this.message.textContent = text ?? '';
    if (text) this.timer = setTimeout(() => { this.message.hidden = true; }, 5000);
  }

  export() {
    const link = el('a', {
      download: 'review.yaml',
      href: URL.createObjectURL(new Blob([this.review.toYaml()], { type: 'application/yaml' })),
    });
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 10000);
    this.say(`review.yaml holds your marks: crowdface generate CONFIG --review review.yaml`);
  }

  // -- keys --

  help() {
    const keys = [['← → ↑ ↓', 'walk through the faces'], ['Enter', 'open'], ['Esc', 'back'],
      ['K, R', 'keep, reject; again: remove the mark'], ['1 2 3 …', 'lock a region or band and redraw the rest'],
      ['N', 'note'], ['/', 'search'], ['G, M', 'faces, plane'], ['F, Q, P', 'front, three-quarter, profile'],
      [', .', 'turn'], ['T, C', 'switch to the target, to the nearest face, and back'], ['S', 'side by side'], ['E', 'export review.yaml']];
    const dialog = el('dialog', { onclick: () => dialog.close(), onclose: () => dialog.remove() },
      el('h2', {}, 'Keys'), el('dl', {}, keys.map(([key, does]) =>
        [el('dt', {}, el('kbd', {}, key)), el('dd', {}, does)])));
    document.body.append(dialog);
    dialog.showModal();
  }

  walk(by) {
    const at = this.faces.indexOf(this.selected);
    const end = this.faces.length - 1;
    const next = at < 0 && by < Infinity ? 0 : Math.max(0, Math.min(end, at + by));
    if (this.faces[next]) this.select(this.faces[next]);
  }

  key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey || document.querySelector('dialog[open]')) return;
    const typing = event.target.matches('textarea, select, input:not([type=range])') ||
      (event.target.matches('input[type=range]') && event.key.startsWith('Arrow'));
    if (typing) {
      if (event.key === 'Escape') event.target.blur();
      return;
    }
    if (this.anyKey(event) || (this.where === 'face' ? this.face.key(event) : this.gridKey(event))) {
      event.preventDefault();
    }
  }

  anyKey(event) {
    const face = this.selected;
    const part = this.crowd.locks[Number(event.key) - 1];
    if (face && part) {
      this.say(this.review.lock(face, part));
      return true;
    }
    const keys = {
      k: () => face && this.say(this.review.verdict(face, 'keep')),
      r: () => face && this.say(this.review.verdict(face, 'reject')),
      e: () => this.export(),
      g: () => { location.hash = '#/faces'; },
      m: () => { location.hash = '#/plane'; },
      '?': () => this.help(),
      '/': () => { if (this.where === 'face') this.go(null); this.search.focus(); },
    };
    const act = keys[event.key];
    act?.();
    return Boolean(act);
  }

  gridKey(event) {
    const row = this.where === 'faces' ? this.grid.columns() : 10;
    const keys = {
      ArrowRight: () => this.walk(1), ArrowLeft: () => this.walk(-1),
      ArrowDown: () => this.walk(row), ArrowUp: () => this.walk(-row),
      Home: () => this.walk(-Infinity), End: () => this.walk(Infinity),
      Enter: () => this.selected && this.go(this.selected),
      n: () => this.selected && (this.go(this.selected),
        setTimeout(() => this.face.side.querySelector('textarea')?.focus(), 50)),
    };
    const act = keys[event.key];
    act?.();
    return Boolean(act);
  }
}

const place = document.getElementById('page');
const data = window.crowdface?.crowd;
if (data) {
  window.crowdface.page = new Page(data);
  place.replaceWith(window.crowdface.page.node);
  window.crowdface.page.face.turntable?.fit();
} else {
  place.replaceChildren(el('p', { class: 'waiting' }, 'data/crowd.js is missing beside this page.'));
}
