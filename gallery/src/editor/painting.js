// SPDX-License-Identifier: Apache-2.0
// Painting of the regions' masks on the head: brush, options and strokes. The page sends the brush positions; the program
// computes distances along the surface and the new masks.
import { Mesh, MeshBasicMaterial, RingGeometry, Vector3 } from 'three';
import { el } from '../dom.js';
import { post, postForBinary } from '../api.js';
import { showAddRegion, showProposeRegions } from './dialogs.js';

const pause = 30; // ms between two points of a stroke

export class Painting {
  /// \param editor  job, view, attempt, say, refresh, setShow, masksChanged(alpha).
  constructor(editor) {
    Object.assign(this, { editor, on: false, waiting: [], region: editor.job.regions[0].name, mode: 'paint' });
    this.ring = new Mesh(new RingGeometry(0.97, 1, 48), new MeshBasicMaterial({
      color: 0xffffff, transparent: true, opacity: 0.9, depthTest: false, toneMapped: false,
    }));
    this.ring.visible = false;
    editor.view.group.add(this.ring);
    this.node = this.panel();
    const { node } = editor.view;
    node.addEventListener('pointerdown', (event) => this.down(event), { capture: true });
    node.addEventListener('pointermove', (event) => this.move(event));
    for (const end of ['pointerup', 'pointercancel']) node.addEventListener(end, () => this.up());
    node.addEventListener('pointerleave', () => this.showRing(null));
  }

  panel() {
    const slider = (text, low, high, step, value) => {
      const input = el('input', { type: 'range', min: low, max: high, step, value, 'aria-label': text, onchange: () => this.editor.remember() });
      const number = el('span', {}, String(value));
      input.addEventListener('input', () => { number.textContent = input.value; });
      return { input, node: el('label', { class: 'control' }, el('span', {}, text), input, number) };
    };
    this.radius = slider('Radius, mm', 2, 60, 1, 15);
    this.strength = slider('Strength', 0.05, 1, 0.05, 0.5);
    this.falloff = slider('Falloff', 0, 1, 0.05, 0.7);
    this.mirror = el('input', { type: 'checkbox', checked: true, title: 'Paint both halves alike', onchange: () => this.editor.remember() });
    this.regionButtons = this.editor.job.regions.map((region) => {
      const dot = el('i', { class: 'regiondot' });
      dot.style.background = region.colour;
      return el('button', { 'data-region': region.name, title: `Paint ${region.name}`, onclick: () => this.choose({ region: region.name }) }, dot, region.name);
    });
    this.modeButtons = [['paint', 'Paint', 'Add skin to the region'], ['erase', 'Erase', 'Take skin out of the region'],
      ['smooth', 'Smooth', 'Soften its border'], ['grow', 'Grow', 'Move its border outwards']].map(([mode, text, title]) =>
      el('button', { 'data-mode': mode, title, onclick: () => this.choose({ mode }) }, text));
    const ask = (text, act, title = '') => el('button', { title, onclick: () => this.editor.attempt(act) }, text);
    const node = el('section', { class: 'painting', hidden: true, 'aria-label': 'Masks' },
      el('header', {}, el('h2', {}, 'Masks'), el('span', { class: 'grow' }),
        el('button', { title: 'Undo the last stroke (Ctrl+Z)', onclick: () => this.undo() }, 'Undo stroke'),
        this.editor.job.can_edit_config
          ? ask('Use masks', () => this.use({}), 'Saved as images, and named in the config')
          : ask('Save masks', () => this.save(), 'As images in the layout of the textures'),
        el('button', { onclick: () => this.setOn(false), 'aria-label': 'Stop painting' }, '✕')),
      el('div', { class: 'choices' },
        el('span', { class: 'choices', role: 'group', 'aria-label': 'Region to paint' }, this.regionButtons),
        this.editor.job.can_edit_config ? el('span', { class: 'group' },
          ask('Add …', () => showAddRegion(this), 'Another region'),
          ask('Remove', () => this.use({ remove: this.region }), 'Removes the chosen region; the others replace it'),
          ask('Propose …', () => showProposeRegions(this), 'Replaces these by regions detected from the heads’ shape')) : null),
      el('div', { class: 'choices' }, el('span', { class: 'group', role: 'group', 'aria-label': 'Brush' }, this.modeButtons),
        el('label', {}, this.mirror, ' mirror')),
      this.radius.node, this.strength.node, this.falloff.node,
      el('p', { class: 'muted' }, 'Paint on the head; drag beside it to turn it. Space paints in the middle of the view.'));
    this.choose = (change) => {
      Object.assign(this, change);
      this.editor.remember();
      const mark = (buttons, key, value) => buttons.forEach((button) => {
        button.classList.toggle('on', button.dataset[key] === value);
        button.setAttribute('aria-pressed', String(button.dataset[key] === value));
      });
      mark(this.regionButtons, 'region', this.region);
      mark(this.modeButtons, 'mode', this.mode);
    };
    this.choose({});
    return node;
  }

  setOn(on) {
    if (on && !this.on) this.shownBefore = this.editor.look.show;
    this.on = on;
    this.node.hidden = !on;
    this.editor.view.worn.node.visible = !on; // attachments would hide the skin
    this.editor.setShow(on ? 'regions' : this.shownBefore);
    this.showRing(null);
    if (on) this.node.scrollIntoView({ block: 'nearest' });
  }

  get numbers() { return { radius: this.radius, strength: this.strength, falloff: this.falloff }; }

  /// The state that the page keeps across a reload.
  state() {
    const numbers = Object.entries(this.numbers).map(([name, { input }]) => [name, input.value]);
    return {
      on: this.on, shownBefore: this.shownBefore, region: this.region, mode: this.mode, mirror: this.mirror.checked,
      numbers: Object.fromEntries(numbers),
    };
  }

  restore({ on, shownBefore, region, mode, mirror, numbers }) {
    const isThere = this.editor.job.regions.some(({ name }) => name === region);
    this.choose({ mode, ...(isThere ? { region } : {}) });
    this.mirror.checked = mirror;
    for (const [name, { input }] of Object.entries(this.numbers)) {
      input.value = numbers[name];
      input.dispatchEvent(new Event('input'));
    }
    if (!on) return;
    this.setOn(true);
    this.shownBefore = shownBefore;
  }

  // -- the brush --

  /// The point of the head at a pixel; null beside the head.
  at(x, y) {
    const { view } = this.editor;
    this.points ??= view.read();
    return view.hit(x, y, this.points);
  }

  showRing(hit) {
    const { view, job } = this.editor;
    const shown = this.on && hit !== null;
    if (!shown && !this.ring.visible) return;
    this.ring.visible = shown;
    if (shown) {
      this.ring.position.fromArray(hit.point);
      this.ring.quaternion.setFromUnitVectors(new Vector3(0, 0, 1), new Vector3(...hit.normal));
      this.ring.scale.setScalar(Number(this.radius.input.value) / job.mm_per_unit);
    }
    view.draw();
  }

  down(event) {
    if (!this.on || event.button !== 0) return;
    this.points = null;
    const hit = this.at(event.clientX, event.clientY);
    if (!hit) return;
    event.stopImmediatePropagation(); // the view does not turn
    this.editor.view.node.setPointerCapture(event.pointerId);
    this.begin(hit);
  }

  begin(hit) {
    this.stroke = { last: performance.now() };
    this.waiting.push({ ...hit, begin: true });
    this.send();
  }

  move(event) {
    if (!this.on) return;
    const hit = this.at(event.clientX, event.clientY);
    this.showRing(hit);
    if (!this.stroke || !hit || performance.now() - this.stroke.last < pause) return;
    this.stroke.last = performance.now();
    this.waiting.push({ ...hit, begin: false });
    this.send();
  }

  up() {
    this.stroke = null;
    this.points = null;
  }

  /// The space key paints at the middle of the view, for users without a pointer.
  paintMiddle() {
    const box = this.editor.view.node.getBoundingClientRect();
    this.points = null;
    const hit = this.at(box.left + box.width / 2, box.top + box.height / 2);
    this.showRing(hit);
    if (hit) this.begin(hit);
    this.up();
  }

  undo() {
    this.waiting.push({ undo: true });
    this.send();
  }

  /// While painting, Ctrl+Z first undoes strokes, then changes of regions and heads. Strokes cannot be redone.
  heldKeys(event) {
    const { editor } = this;
    const isOfConfig = (way) => editor.history[way].length > 0 && !editor.hasConfigOf(editor.history[way].at(-1).document);
    const redo = () => (isOfConfig('future') ? editor.redo()
      : editor.say('A stroke that was undone cannot be redone: paint it again.'));
    const undo = () => {
      if (editor.job.painted || this.waiting.length > 0 || this.sending) this.undo();
      else if (isOfConfig('past')) editor.undo();
      else editor.say('No stroke to undo. The button Undo takes back the steps of the face.');
    };
    return { z: () => (event.shiftKey ? redo() : undo()), y: redo };
  }

  /// Sends one request at a time. Points painted meanwhile are sent with the next request, up to the beginning or the
  /// undoing of a stroke.
  async send() {
    if (this.sending || this.waiting.length === 0) return;
    const another = this.waiting.findIndex((point, i) => i > 0 && (point.begin || point.undo));
    const [first, ...others] = this.waiting.splice(0, another < 0 ? this.waiting.length : another);
    this.sending = true;
    await this.editor.attempt(async () => {
      const { alpha, painted } = await (first.undo ? postForBinary('masks/undo', {}) : this.paint([first, ...others]));
      this.editor.job.painted = painted;
      this.editor.masksChanged(alpha);
    });
    this.sending = false;
    this.send();
  }

  paint(points) {
    return postForBinary('masks/stroke', {
      region: this.region, mode: this.mode, mirror: this.mirror.checked, begin: points[0].begin,
      points: points.map(({ triangle, u, v }) => ({ triangle, u, v })),
      radius_mm: Number(this.radius.input.value), strength: Number(this.strength.input.value),
      falloff: Number(this.falloff.input.value),
    });
  }

  /// Writes the regions to the config, and opens the config again.
  /// \param change  {add: name}, {remove: name}, {propose: names}, or {} for the painted masks only
  async use(change) {
    const { editor } = this;
    const label = change.add ? `region ${change.add} added` : change.remove ? `region ${change.remove} removed`
      : change.propose ? 'regions proposed' : 'painted masks used';
    editor.say('Opening again with these regions …');
    await editor.openAgain('regions', change, ({ regions }) =>
      editor.history.commit({ ...editor.history.now, config_regions: regions }, label));
  }

  /// Saves the masks as images in the texture layout, which a config can name.
  async save() {
    const { files } = await post('masks/save', {});
    this.editor.say(`Saved. In the config: regions: {mask: ${files.length === 1 ? files[0] : `[${files.join(', ')}]`}}`);
  }
}

/// The painting panel; null if the program cannot paint masks.
export function openPainting(editor) {
  return editor.job.can_paint ? new Painting(editor) : null;
}
