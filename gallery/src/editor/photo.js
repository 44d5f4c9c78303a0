// SPDX-License-Identifier: Apache-2.0
// A reference photo behind or beside the head. Points that are clicked on both match the camera to the photo.
import { Vector3 } from 'three';
import { el } from '../dom.js';
import { arePictures } from './added_heads.js';
import { matchCamera } from './match_camera.js';
import { still } from './plane_board.js';

const fewest = 4; // smallest number of points that match a camera
const largest = 1600; // largest side of the stored photo, in pixels
const stored = 'crowdface photo';

export class Photo {
  /// \param editor  view, beside, node, job, say, attempt
  constructor(editor) {
    Object.assign(this, { editor, mode: 'off', pairs: [], matching: false, fit: null });
    this.image = el('img', { class: 'photo', alt: 'Reference photo', draggable: 'false' });
    this.marks = el('svg', { class: 'photomarks' });
    this.stage = el('div', { class: 'photostage', hidden: true }, this.image);
    this.file = el('input', {
      type: 'file', accept: 'image/*', hidden: true, 'aria-label': 'Photo', onchange: () => editor.attempt(() => this.load(this.file.files[0])),
    });
    this.modes = [['off', 'Off', 'No photo'], ['behind', 'Behind', 'The photo behind the head'],
      ['beside', 'Beside', 'The photo beside the head']].map(([mode, text, title]) => el('button', {
      'data-mode': mode, title, onclick: () => this.setMode(mode),
    }, text));
    this.opacity = el('input', {
      type: 'range', min: 0, max: 1, step: 0.05, value: 0.6, 'aria-label': 'Opacity of the head',
      title: 'How much the head covers of the photo behind it', oninput: () => this.show(),
    });
    this.matchButton = el('button', {
      title: `Click the same places on head and photo, at least ${fewest}: the camera looks as the photo’s did`,
      onclick: () => this.setMatching(!this.matching),
    }, 'Match points');
    this.again = el('button', { title: 'The camera goes back to where it matches the photo', onclick: () => this.lookAgain() }, 'Look from there');
    this.clear = el('button', { title: 'Forgets the points', onclick: () => this.forget() }, 'Clear points');
    this.hint = el('p', { class: 'muted', role: 'status' });
    this.tools = el('div', { hidden: true }, el('div', { class: 'choices' },
      el('span', { class: 'group', role: 'group', 'aria-label': 'Where the photo lies' }, this.modes), this.matchButton, this.again, this.clear),
    el('label', { class: 'control' }, el('span', {}, 'Head'), this.opacity), this.hint);
    this.node = el('section', { class: 'photobox', 'aria-label': 'Reference photo' },
      el('header', {}, el('h2', {}, 'Photo'), el('span', { class: 'grow' }), this.file,
        el('button', { title: 'A photo from this computer; or drop one onto the face', onclick: () => this.file.click() }, 'Choose …')), this.tools);
    this.listen();
  }

  listen() {
    const { view } = this.editor;
    let pressed = null;
    this.box = this.editor.stage.parentNode;
    this.box.prepend(this.stage); // behind the head
    this.box.append(this.marks);
    this.box.addEventListener('pointerdown', ({ button, clientX, clientY }) => { pressed = button === 0 ? [clientX, clientY] : null; }, { capture: true });
    this.box.addEventListener('pointerup', (event) => {
      const isClick = pressed && Math.hypot(event.clientX - pressed[0], event.clientY - pressed[1]) <= still;
      if (this.matching && isClick && event.target.matches('canvas, .stage, .photo, .photostage')) this.click(event.clientX, event.clientY);
    });
    this.box.addEventListener('dragover', (event) => { if (event.dataTransfer.types.includes('Files')) event.preventDefault(); });
    this.box.addEventListener('drop', (event) => {
      const files = [...event.dataTransfer.files];
      if (files.length === 0 || !arePictures(files)) return;
      event.preventDefault();
      this.editor.attempt(() => this.load(files[0]));
    });
    view.controls.addEventListener('change', () => this.place());
    new ResizeObserver(() => requestAnimationFrame(() => this.place())).observe(this.box); // after the view
  }

  // -- the photo --

  async load(file) {
    if (!file) return;
    const bitmap = await createImageBitmap(file).catch(() => { throw new Error(`${file.name} is not a picture that this browser can show.`); });
    const scale = Math.min(1, largest / Math.max(bitmap.width, bitmap.height));
    const canvas = el('canvas', { width: Math.round(scale * bitmap.width), height: Math.round(scale * bitmap.height) });
    canvas.getContext('2d').drawImage(bitmap, 0, 0, canvas.width, canvas.height);
    this.pairs = [];
    this.fit = null;
    await this.take(canvas.toDataURL('image/jpeg', 0.9));
    this.setMode(this.mode === 'off' ? 'behind' : this.mode);
  }

  async take(source) {
    this.image.src = source;
    await this.image.decode();
    this.tools.hidden = false;
  }

  /// Stores the photo and its points until this tab is closed.
  keep() {
    const { mode, pairs, fit, from } = this;
    try {
      sessionStorage.setItem(stored, JSON.stringify({ source: this.image.src, opacity: this.opacity.value, mode, pairs, fit, from }));
    } catch {
      // without storage, the photo is lost at a reload
    }
  }

  async restore() {
    const kept = JSON.parse(sessionStorage.getItem(stored) ?? 'null');
    if (!kept) return;
    Object.assign(this, { pairs: kept.pairs, fit: kept.fit, from: kept.from });
    this.opacity.value = kept.opacity;
    await this.take(kept.source);
    this.setMode(kept.mode);
  }

  setMode(mode) {
    this.mode = mode;
    if (mode === 'beside' && this.editor.beside.on) this.editor.beside.setOn(false);
    this.box.classList.toggle('two', mode === 'beside' || this.editor.beside.on);
    if (mode === 'off') this.setMatching(false);
    this.editor.view.fit();
    this.show();
  }

  show() {
    const { mode, matching } = this;
    for (const button of this.modes) {
      button.classList.toggle('on', button.dataset.mode === mode);
      button.setAttribute('aria-pressed', String(button.dataset.mode === mode));
    }
    this.stage.hidden = mode === 'off';
    this.stage.classList.toggle('right', mode === 'beside');
    this.opacity.disabled = mode !== 'behind';
    this.matchButton.disabled = mode === 'off';
    this.matchButton.classList.toggle('on', matching);
    this.matchButton.setAttribute('aria-pressed', String(matching));
    this.again.disabled = !this.from;
    this.clear.disabled = this.pairs.length === 0;
    // If photo and head overlap, show the one that is to be clicked next.
    const waits = this.pairs.at(-1)?.photo === null;
    const shares = mode !== 'behind' ? 1 : matching ? (waits ? 0.08 : 1) : Number(this.opacity.value);
    this.editor.view.node.style.opacity = shares;
    this.hint.textContent = !matching ? '' : waits ? `Point ${this.pairs.length}: click the same place on the photo.`
      : `Click a place on the head, such as the corner of an eye. ${this.pairs.length} points so far${this.pairs.length < fewest ? `, at least ${fewest}` : ''}.`;
    this.place();
    this.keep();
  }

  // -- points --

  setMatching(on) {
    if (this.pairs.at(-1)?.photo === null) this.pairs.pop();
    this.matching = on;
    this.show();
  }

  forget() {
    Object.assign(this, { pairs: [], fit: null, from: null });
    this.show();
  }

  click(x, y) {
    const { view } = this.editor;
    const last = this.pairs.at(-1);
    if (last?.photo === null) {
      const at = this.photoAt(x, y);
      if (!at) return;
      last.photo = at;
      if (this.pairs.length >= fewest) this.match();
    } else {
      const hit = view.hit(x, y);
      if (!hit) return;
      this.pairs.push({ head: hit.point, photo: null });
    }
    this.show();
  }

  match() {
    const { view, job } = this.editor;
    const points = this.pairs.map(({ head }) => new Vector3(...head).applyMatrix4(view.group.matrix));
    const { position, similarity, error } = matchCamera(points, this.pairs.map(({ photo }) => photo), view.controls.target);
    view.camera.position.copy(position);
    view.controls.update();
    view.draw();
    this.fit = similarity;
    this.from = view.place();
    const mm = (error / view.group.matrix.getMaxScaleOnAxis()) * job.mm_per_unit;
    this.editor.say(`The camera matches ${this.pairs.length} points to ${mm.toFixed(1)} mm.`);
  }

  lookAgain() { this.editor.view.restore(this.from); }

  // -- placement --

  /// The middle of the view, and the number of pixels per unit of length at distance 1.
  frame() {
    const { clientWidth, clientHeight } = this.stage;
    const { camera } = this.editor.view;
    return { x: clientWidth / 2, y: clientHeight / 2, unit: clientHeight / 2 / Math.tan((camera.fov * Math.PI) / 360) };
  }

  /// The map from the photo's pixels to the stage: [a, b, x, y] for z ↦ (a + ib) z + (x + iy).
  placement() {
    const { x, y, unit } = this.frame();
    const { naturalWidth: width, naturalHeight: height } = this.image;
    if (this.fit) {
      const [a, b, u, v] = this.fit;
      return [unit * a, -unit * b, x + unit * u, y - unit * v];
    }
    const scale = Math.min((2 * x) / width, (2 * y) / height);
    return [scale, 0, x - (scale * width) / 2, y - (scale * height) / 2];
  }

  /// Draws the photo at its place on the page.
  /// \param left  left edge of the picture, in the window
  paint(context, left) {
    if (this.mode === 'off') return;
    const [a, b, x, y] = this.placement();
    const stage = this.stage.getBoundingClientRect();
    context.save();
    context.translate(stage.left - left, 0);
    context.beginPath();
    context.rect(0, 0, stage.width, stage.height);
    context.clip();
    context.transform(a, b, -b, a, x, y);
    context.drawImage(this.image, 0, 0);
    context.restore();
  }

  photoAt(clientX, clientY) {
    const box = this.stage.getBoundingClientRect();
    const [a, b, x, y] = this.placement();
    const [u, v] = [clientX - box.left - x, clientY - box.top - y];
    const at = [(a * u + b * v) / (a * a + b * b), (a * v - b * u) / (a * a + b * b)];
    const isOn = at[0] >= 0 && at[1] >= 0 && at[0] <= this.image.naturalWidth && at[1] <= this.image.naturalHeight;
    return isOn ? at : null;
  }

  place() {
    if (this.mode === 'off' || !this.image.naturalWidth) {
      this.marks.replaceChildren();
      return;
    }
    const [a, b, x, y] = this.placement();
    this.image.style.transform = `matrix(${a}, ${b}, ${-b}, ${a}, ${x}, ${y})`;
    const { view } = this.editor;
    const box = this.box.getBoundingClientRect();
    const [ofHead, ofPhoto] = [view.node, this.stage].map((node) => node.getBoundingClientRect());
    const mark = (kind, number, left, top) => el('g', { class: kind, transform: `translate(${left - box.left} ${top - box.top})` },
      el('circle', { r: 6 }), el('text', { x: 9, y: 5 }, String(number)));
    this.marks.replaceChildren(...(this.matching ? this.pairs.flatMap(({ head, photo }, i) => {
      const at = new Vector3(...head).applyMatrix4(view.group.matrix).project(view.camera);
      return [mark('ofhead', i + 1, ofHead.left + ((at.x + 1) / 2) * ofHead.width, ofHead.top + ((1 - at.y) / 2) * ofHead.height),
        ...(photo ? [mark('ofphoto', i + 1, ofPhoto.left + a * photo[0] - b * photo[1] + x, ofPhoto.top + b * photo[0] + a * photo[1] + y)] : [])];
    }) : []));
  }
}
