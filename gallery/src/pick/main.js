// SPDX-License-Identifier: Apache-2.0
// The page of `crowdface wrap --pick`: landmarks are picked on template and scan, name by name.
import { getBinary, getJson, post, put } from '../api.js';
import { openDialog, showKeys } from '../dialog.js';
import { el } from '../dom.js';
import { History } from '../history.js';
import { linkViews } from '../linked_views.js';
import { ProgramPage } from '../program_page.js';
import { MeshView } from './mesh_view.js';
import { NameList } from './name_list.js';

const sides = ['template', 'scan'];
const fewest = 4;
const nothing = { template: {}, scan: {}, residuals: {}, pose: null };
const standardViews = [['front', 'Front'], ['three_quarter', 'Three-quarter'], ['other_three_quarter', 'Other side'], ['profile', 'Profile']];

class Picker extends ProgramPage {
  constructor(job, meshes) {
    super();
    this.job = job;
    this.where = new Map(job.names.map(({ name, where }) => [name, where]));
    const held = new Map(job.landmarks.map((landmark) => [landmark.name, landmark]));
    const landmarks = job.names.map(({ name }) => held.get(name) ?? { name, template: null, scan: null });
    landmarks.push(...job.landmarks.filter(({ name }) => !this.where.has(name)));
    this.history = new History({ landmarks });
    this.history.listeners.push(() => this.stepped());
    this.saved = this.wire();
    this.suggested = nothing;
    this.confirmed = new Set(); // names of outliers that the user has confirmed
    this.passing = null; // the document that is shown while a landmark is dragged
    this.asked = 0;
    this.linked = false;
    this.active = (landmarks.find((one) => !one.template || !one.scan) ?? landmarks[0]).name;
    this.views = {
      template: new MeshView('template', meshes[0], job.template.stands, '#c9a58f'),
      scan: new MeshView('scan', meshes[1], job.scan.stands, '#a9adb1'),
    };
    this.last = this.views.scan; // the view that keys act on
    this.build();
    for (const side of sides) this.listen(side);
    linkViews(Object.values(this.views), () => this.linked);
    addEventListener('keydown', (event) => this.key(event));
    addEventListener('beforeunload', (event) => { if (this.isChanged()) event.preventDefault(); });
    this.refresh();
    this.suggest();
  }

  build() {
    const button = (text, title, act, properties = {}) =>
      el('button', { title, onclick: () => this.attempt(act), ...properties }, text);
    this.undoButton = button('Undo', 'Undo (Ctrl+Z)', () => this.undo());
    this.redoButton = button('Redo', 'Redo (Ctrl+Shift+Z)', () => this.redo());
    this.linkButton = button('Link views', 'Turn both views together; three pairs align them (L)', () => this.link(!this.linked));
    this.count = el('span', { class: 'muted count' });
    this.saveButton = button('Save', 'Save the landmarks (Ctrl+S)', () => this.save(), { class: 'export' });
    this.list = new NameList(this);
    this.message = el('div', { class: 'message', role: 'alert', hidden: true });
    this.boxes = {};
    this.hint = el('div', { class: 'hint', role: 'status', 'aria-live': 'polite' });
    for (const side of sides) {
      const view = this.views[side];
      view.node.setAttribute('aria-label', `The ${side}. Arrows turn it, Space picks what is in the middle.`);
      const stage = el('div', { class: 'stage' }, view.node, view.marks, el('i', { class: 'cross' }));
      new ResizeObserver(() => view.fit()).observe(stage);
      this.boxes[side] = el('section', { class: 'viewbox', 'data-side': side, 'aria-label': side }, stage,
        el('div', { class: 'viewbar' }, el('span', { class: 'title' }, side === 'template' ? 'Template' : 'Scan', ' ', el('small', { class: 'muted' }, this.job[side].name)),
          side === 'scan' ? el('span', { class: 'group' },
            button('Roll', 'Turn the scan a quarter', () => view.roll()),
            button('Front is here', 'The scan’s face looks at you now', () => view.takeAsFront())) : null));
    }
    const { scans, number } = this.job;
    const walk = (way, text, title) => button(text, title, () => this.open(number + way), { disabled: !scans[number + way] });
    this.folder = scans.length < 2 ? null : el('span', { class: 'group', role: 'group', 'aria-label': 'Scans' },
      walk(-1, '‹', 'Save, and go to the previous scan'), el('span', { class: 'muted' }, `Scan ${number + 1} of ${scans.length}`),
      walk(1, 'Next scan', 'Save, and go to the next scan (])'));
    this.node = el('div', { class: 'picker' },
      el('header', { class: 'toolbar', role: 'toolbar', 'aria-label': 'Commands' },
        el('h1', { title: this.job.file }, this.job.file.split('/').pop()),
        this.folder, el('span', { class: 'group' }, this.undoButton, this.redoButton),
        el('span', { class: 'group', role: 'group', 'aria-label': 'Standard views' },
          standardViews.map(([name, text]) => button(text, `Both from ${text.toLowerCase()}`, () => this.view(name)))),
        this.linkButton, el('span', { class: 'grow' }), this.count, this.saveButton,
        button('?', 'All keys (?)', () => this.help(), { class: 'plain', 'aria-label': 'All keys' })),
      el('main', {}, this.list.node, this.boxes.template, this.boxes.scan, this.hint), this.message);
  }

  listen(side) {
    const view = this.views[side];
    view.onpick = (ray) => this.attempt(() => this.pick(side, ray));
    view.onmark = (name, event) => this.attempt(() => this.pressMark(side, name, event));
    view.onhover = (name) => this.hover(name);
    view.node.addEventListener('pointerdown', () => { this.last = view; });
    view.node.addEventListener('focus', () => { this.last = view; });
  }

  // -- picking --

  /// The document: {landmarks: [{name, template, scan}]}, never changed in place.
  get document() {
    return this.passing ?? this.history.now;
  }

  landmark(name = this.active) {
    return this.document.landmarks.find((one) => one.name === name);
  }

  withPlaces(name, places) {
    return { landmarks: this.history.now.landmarks.map((one) => (one.name === name ? { ...one, ...places } : one)) };
  }

  commit(document, label) {
    this.passing = null;
    this.history.commit(document, label);
    this.refresh();
  }

  stepped() {
    this.refresh();
    this.suggest();
  }

  step(change, text) {
    const before = new Map(this.history.now.landmarks.map((one) => [one.name, JSON.stringify(one)]));
    this.passing = null;
    if (!change()) {
      this.say(text);
      return;
    }
    const other = this.history.now.landmarks.find((one) => before.get(one.name) !== JSON.stringify(one));
    if (other) this.choose(other.name);
    if (!this.landmark()) this.choose(this.history.now.landmarks[0].name);
  }

  undo() { this.step(() => this.history.undo(), 'Nothing to undo.'); }
  redo() { this.step(() => this.history.redo(), 'Nothing to redo.'); }

  async ask(ray) {
    return (await post('pick', ray)).place;
  }

  /// Handles a click: picks the selected landmark there. A click on the scan also accepts the point suggested on the
  /// template.
  async pick(side, ray) {
    const { active: name } = this;
    const place = await this.ask(ray);
    if (!place) {
      this.say(side === 'template' ? 'The template has no skin there.' : 'The scan has no surface there.');
      return;
    }
    const places = { [side]: place };
    if (side === 'scan' && !this.landmark(name).template && this.suggested.template[name]) places.template = this.suggested.template[name];
    this.commit(this.withPlaces(name, places), `${name} on the ${side}`);
    this.goOn(name);
  }

  /// Accepts the suggested points of the selected landmark.
  accept() {
    const { name, template, scan } = this.landmark();
    const places = {};
    if (!template && this.suggested.template[name]) places.template = this.suggested.template[name];
    if (!scan && this.suggested.scan[name]) places.scan = this.suggested.scan[name];
    if (Object.keys(places).length === 0) {
      this.say(template && scan ? 'It is picked on both.' : 'Nothing is suggested: click the place.');
      return;
    }
    this.commit(this.withPlaces(name, places), `${name} as suggested`);
    this.goOn(name);
  }

  /// If the selected landmark is picked on both meshes, selects the next one that is not.
  goOn(name) {
    const { landmarks } = this.history.now;
    const at = landmarks.findIndex((one) => one.name === name);
    if (!landmarks[at].template || !landmarks[at].scan) return;
    const next = [...landmarks.slice(at + 1), ...landmarks.slice(0, at)].find((one) => !one.template || !one.scan);
    if (next) this.choose(next.name);
  }

  remove(name = this.active) {
    const { template, scan } = this.landmark(name);
    if (template || scan) {
      this.commit(this.withPlaces(name, { template: null, scan: null }), `${name} removed`);
    } else if (!this.where.has(name)) {
      this.commit({ landmarks: this.history.now.landmarks.filter((one) => one.name !== name) }, `${name} removed`);
      if (this.active === name) this.choose(this.history.now.landmarks[0].name);
    }
  }

  addName(name) {
    if (!this.landmark(name)) {
      this.commit({ landmarks: [...this.history.now.landmarks, { name, template: null, scan: null }] }, `${name} added`);
    }
    this.choose(name);
    document.activeElement.blur();
    return true;
  }

  choose(name) {
    this.active = name;
    this.refresh();
  }

  walk(way) {
    const { landmarks } = this.document;
    const at = landmarks.findIndex((one) => one.name === this.active);
    this.choose(landmarks[(at + way + landmarks.length) % landmarks.length].name);
  }

  /// Selects a picked landmark, and drags it while the button is down. Rings, which show suggestions, do not receive
  /// pointer events.
  pressMark(side, name, event) {
    this.choose(name);
    const view = this.views[side];
    const begun = [event.clientX, event.clientY];
    let wanted = null;
    let moved = null;
    let asking = null;
    const look = async () => { // one request at a time, always for the newest point
      while (wanted) {
        const ray = wanted;
        wanted = null;
        const place = await this.ask(ray);
        if (!place) continue;
        moved = this.withPlaces(name, { [side]: place });
        this.passing = moved;
        this.refresh();
      }
      asking = null;
    };
    const move = (now) => {
      if (!wanted && !moved && !asking && Math.hypot(now.clientX - begun[0], now.clientY - begun[1]) < 3) return;
      wanted = view.ray(now.clientX, now.clientY);
      asking ??= this.attempt(look);
    };
    const up = async () => {
      removeEventListener('pointermove', move);
      removeEventListener('pointerup', up);
      removeEventListener('pointercancel', up);
      await asking;
      if (moved) this.commit(moved, `${name} moved on the ${side}`);
    };
    addEventListener('pointermove', move);
    addEventListener('pointerup', up);
    addEventListener('pointercancel', up);
  }

  // -- answers of the program --

  /// The landmarks in the program's format.
  wire() {
    return this.history.now.landmarks.filter(({ template, scan }) => template || scan).map(({ name, template, scan }) => ({
      name, template: template?.vertex ?? null, scan: scan ? scan.vertex ?? scan.point : null,
    }));
  }

  async suggest() {
    this.asked += 1;
    const turn = this.asked;
    const answer = await this.attempt(() => post('suggest', { landmarks: this.wire() }));
    if (!answer || turn !== this.asked) return;
    this.suggested = answer;
    this.answered = turn;
    if (this.linked) this.align();
    this.refresh();
  }

  isChanged() {
    return JSON.stringify(this.wire()) !== JSON.stringify(this.saved);
  }

  /// Saves the landmarks. Outliers, such as a swapped left and right, must be confirmed first.
  async save() {
    const landmarks = this.wire();
    const far = landmarks.filter(({ name, template, scan }) =>
      template !== null && scan !== null && this.suggested.residuals[name]?.outlier && !this.confirmed.has(name));
    if (far.length > 0) {
      await new Promise((done) => { this.confirmOutliers(far.map(({ name }) => name), done); });
      if (far.some(({ name }) => !this.confirmed.has(name))) return false;
    }
    const { file, pairs } = await put('landmarks', { landmarks });
    this.saved = landmarks;
    this.job.loses_comments = false;
    this.refresh();
    this.say(`Saved: ${file}, ${pairs} pairs${pairs < fewest ? `; wrapping takes at least ${fewest}` : ''}`);
  }

  /// \param done  called when the question is answered
  confirmOutliers(names, done) {
    const dialog = openDialog('Far from the others',
      el('ul', {}, names.map((name) => el('li', { class: 'outlier' }, `${name}: ${this.suggested.residuals[name].mm.toFixed(1)} mm`))),
      el('p', {}, 'These landmarks lie far from where the others put them. Are left and right swapped?'),
      el('div', { class: 'choices' },
        el('button', { class: 'export', title: 'Picks them again', onclick: () => { this.choose(names[0]); dialog.close(); } }, 'Look at them'),
        el('button', {
          title: 'They are right',
          onclick: () => {
            for (const name of names) this.confirmed.add(name);
            dialog.close();
          },
        }, 'Save all the same')));
    dialog.addEventListener('close', done);
  }

  /// Saves this scan's landmarks, and opens another scan of the folder.
  async open(scan) {
    if (!this.job.scans[scan]) return;
    if (this.isChanged() && await this.save() === false) return;
    await post('open', { scan });
    location.reload();
  }

  // -- display --

  align() {
    if (this.suggested.pose) this.views.scan.alignTo(this.views.template, this.suggested.pose);
  }

  view(name) {
    this.align();
    for (const side of sides) this.views[side].view(name);
  }

  link(on) {
    this.linked = on;
    if (on) {
      this.align();
      this.last.controls.dispatchEvent({ type: 'change' });
    }
    this.refresh();
  }

  hover(name) {
    for (const side of sides) this.views[side].hover(name);
  }

  refresh() {
    const { landmarks } = this.document;
    const { residuals } = this.suggested;
    for (const side of sides) {
      const list = [];
      for (const one of landmarks) {
        const place = one[side] ?? this.suggested[side][one.name];
        if (!place) continue;
        list.push({
          name: one.name, place, kind: one[side] ? 'picked' : 'ghost', active: one.name === this.active,
          outlier: Boolean(one.template && one.scan && residuals[one.name]?.outlier),
        });
      }
      for (const [name, place] of Object.entries(this.suggested[side])) {
        if (!landmarks.some((one) => one.name === name)) list.push({ name, place, kind: 'ghost', active: false });
      }
      this.views[side].show(list);
    }
    this.list.show();
    this.undoButton.disabled = this.history.past.length === 0;
    this.redoButton.disabled = this.history.future.length === 0;
    this.undoButton.title = this.undoButton.disabled ? 'Undo (Ctrl+Z)' : `Undo: ${this.history.label} (Ctrl+Z)`;
    this.linkButton.classList.toggle('on', this.linked);
    this.linkButton.setAttribute('aria-pressed', String(this.linked));
    const pairs = landmarks.filter(({ template, scan }) => template && scan).length;
    this.count.textContent = `${pairs} pairs${pairs < fewest ? ` (at least ${fewest})` : ''}${this.isChanged() ? ', not saved' : ''}`;
    this.saveButton.disabled = !this.isChanged();
    this.showHint();
  }

  showHint() {
    const { name, template, scan } = this.landmark();
    const ghost = { template: !template && this.suggested.template[name], scan: !scan && this.suggested.scan[name] };
    const outlier = template && scan && this.suggested.residuals[name]?.outlier;
    let act = 'Picked on both. Drag a mark or click again to move it.';
    if (outlier) act = 'Far from the place that the others suggest: left and right swapped?';
    else if (!template && !scan && ghost.scan && ghost.template) act = 'Enter takes the rings; or click the places.';
    else if (!scan && ghost.scan) act = 'Enter takes the ring on the scan; or click the place.';
    else if (!scan && ghost.template) act = 'Click it on the scan: this also takes the ring on the template.';
    else if (!template && ghost.template) act = 'Enter takes the ring on the template; or click the place.';
    else if (!template) act = 'Click it on the template.';
    else if (!scan) act = 'Click it on the scan.';
    this.hint.classList.toggle('bad', Boolean(outlier));
    this.hint.replaceChildren(el('b', {}, name), this.where.has(name) ? `: ${this.where.get(name)}. ` : '. ', act);
  }

  // -- keys --

  help() {
    showKeys([['↑ ↓', 'previous name, next name; on a view: turn it'], ['Enter', 'accept the suggestion for the name'],
      ['Delete', 'remove the landmark from both'], ['Space', 'on a view: pick what is in its middle'], ['N', 'another name'],
      ['Ctrl+Z, Ctrl+Shift+Z', 'undo, redo'], ['Ctrl+S', 'save'], ['F, Q, P', 'front, three-quarter, profile'],
      [', . + −', 'turn, zoom in, zoom out'], ['L', 'link the views'], ['[ ]', 'in a folder: previous scan, next scan'], ['Tab', 'next control'], ['Esc', 'leave a field']]);
  }

  key(event) {
    if (document.querySelector('dialog[open]')) return;
    const letter = event.key.toLowerCase();
    const typing = event.target.matches('input, textarea, select');
    if (event.ctrlKey || event.metaKey) {
      const held = {
        z: () => (event.shiftKey ? this.redo() : this.undo()), y: () => this.redo(), s: () => this.attempt(() => this.save()),
      }[letter];
      if (held && (!typing || letter === 's')) {
        held();
        event.preventDefault();
      }
      return;
    }
    if (event.altKey) return;
    if (typing) {
      if (event.key === 'Escape') event.target.blur();
      return;
    }
    if (event.target.matches('button') && ['Enter', ' '].includes(event.key)) return;
    const act = this.actOf(event, letter);
    if (!act) return;
    this.attempt(act);
    event.preventDefault();
  }

  actOf(event, letter) {
    const side = sides.find((one) => event.target === this.views[one].node);
    const view = side ? this.views[side] : this.last;
    if (side && event.key.startsWith('Arrow')) return () => view.arrow(event.key, event.shiftKey);
    return {
      arrowup: () => this.walk(-1), arrowdown: () => this.walk(1), enter: () => this.accept(),
      delete: () => this.remove(), backspace: () => this.remove(), n: () => this.list.field.focus(),
      f: () => this.view('front'), q: () => this.view('three_quarter'), p: () => this.view('profile'),
      ',': () => view.turn(-10), '.': () => view.turn(10), '+': () => view.nearer(0.85), '=': () => view.nearer(0.85),
      '-': () => view.nearer(1 / 0.85), '[': () => this.open(this.job.number - 1), ']': () => this.open(this.job.number + 1), l: () => this.link(!this.linked), '?': () => this.help(),
      ...(side ? { ' ': () => this.pick(side, view.middleRay()) } : {}),
    }[letter];
  }
}

async function start() {
  const place = document.getElementById('page');
  try {
    const [job, ...meshes] = await Promise.all([getJson('job'), getBinary('mesh/template'), getBinary('mesh/scan')]);
    document.title = `${job.scan.name} · crowdface wrap --pick`;
    const picker = new Picker(job, meshes);
    window.crowdface = { picker };
    place.replaceWith(picker.node);
    for (const side of sides) picker.views[side].fit();
    if (job.loses_comments) picker.say(`Saving keeps only the comments at the beginning of ${job.file}.`);
  } catch (error) {
    place.replaceChildren(el('p', { class: 'waiting' }, error.message));
  }
}

start();
