// SPDX-License-Identifier: Apache-2.0
import { el, short } from './dom.js';
import { nearestMm } from './crowd.js';

const verdictNames = { keep: 'kept', reject: 'rejected' };

/// The picture of a face or head: the first of the views in its image file, which are side by side.
export function picture(subject, name) {
  if (!subject?.picture) return el('div', { class: 'portrait blank' }, name);
  const image = el('img', {
    src: subject.picture, alt: name, loading: 'lazy', decoding: 'async', draggable: 'false',
  });
  image.onerror = () => image.replaceWith(el('div', { class: 'blank' }, name));
  return el('div', { class: 'portrait' }, image);
}

/// A grid of cells with faces. A large crowd is shown in pages, any other crowd on one page.
export class Grid {
  /// \param open, select  called with a face
  constructor(crowd, review, { open, select }) {
    Object.assign(this, { review, open, select_: select });
    this.length = crowd.faces_per_page ?? Infinity;
    this.page = 0;
    this.cells = new Map(); // cells of the visible page, by id
    this.grid = el('div', { class: 'grid', role: 'list' });
    this.place = el('span', {});
    const turn = (by, text, title) => el('button', { onclick: () => this.turn(this.page + by), title }, text);
    this.before = turn(-1, '‹ Earlier', 'The previous page');
    this.after = turn(1, 'Later ›', 'The next page');
    this.pages = el('nav', { class: 'pages', hidden: true }, this.before, this.place, this.after);
    this.node = el('div', {}, this.pages, this.grid);
    this.faces = [];
  }

  cellOf(face) {
    if (!this.cells.has(face.id)) {
      this.cells.set(face.id, this.cell(face, this.open, this.select_));
      this.showMark(face);
    }
    return this.cells.get(face.id);
  }

  /// Shows a page of the faces, from 0.
  turn(page) {
    const pages = Math.max(1, Math.ceil(this.faces.length / this.length));
    this.page = Math.max(0, Math.min(pages - 1, page));
    const first = pages > 1 ? this.page * this.length : 0;
    const shown = pages > 1 ? this.faces.slice(first, first + this.length) : this.faces;
    if (this.length < Infinity) this.cells.clear();
    this.pages.hidden = pages === 1;
    this.place.textContent = `${first + 1} to ${first + shown.length} of ${this.faces.length}`;
    this.before.disabled = this.page === 0;
    this.after.disabled = this.page === pages - 1;
    this.grid.replaceChildren(
      ...(shown.length > 0
        ? shown.map((face) => this.cellOf(face))
        : [el('p', { class: 'nothing' }, 'No face passes these filters.')]));
    if (this.selected) this.cells.get(this.selected.id)?.classList.add('selected');
    if (pages > 1) this.node.parentNode?.scrollTo(0, 0);
  }

  cell(face, open, select) {
    const near = nearestMm(face);
    const text = [face.target, Number.isFinite(near) ? `${short(near)} mm` : null]
      .filter(Boolean).join(' · ');
    return el('div', {
      class: 'cell', role: 'listitem', 'data-id': face.id, title: this.tip(face),
      onclick: () => select(face), ondblclick: () => open(face),
    }, picture(face, face.id),
    el('div', { class: 'badges' }),
    el('button', { class: 'open', tabindex: '-1', onclick: () => open(face), title: 'Open (Enter)' }, 'Open'),
    el('div', { class: 'caption' }, el('b', {}, face.id), el('span', {}, text)));
  }

  tip(face) {
    const near = face.near[0];
    const lines = [`${face.id}, built on ${face.target}`];
    if (face.family) lines.push(`family ${face.family}`);
    if (near) lines.push(`nearest face ${near.id}, ${short(near.mm)} mm`);
    if (face.nearest) lines.push(`nearest head ${face.nearest.face}, ${short(face.nearest.face_mm)} mm`);
    return lines.join('\n');
  }

  show(faces) {
    this.faces = faces;
    this.turn(0);
  }

  select(face) {
    this.grid.querySelector('.selected')?.classList.remove('selected');
    this.selected = face;
    const at = face && this.length < Infinity ? this.faces.indexOf(face) : -1;
    if (at >= 0 && Math.floor(at / this.length) !== this.page) this.turn(Math.floor(at / this.length));
    const cell = face && this.cells.get(face.id);
    cell?.classList.add('selected');
    cell?.scrollIntoView({ block: 'nearest' });
  }

  showMark(face) {
    const cell = this.cells.get(face.id);
    if (!cell) return;
    const mark = this.review.of(face);
    cell.classList.toggle('keep', mark?.verdict === 'keep');
    cell.classList.toggle('reject', mark?.verdict === 'reject');
    const badges = [];
    if (mark?.verdict) badges.push(el('i', { class: mark.verdict }, verdictNames[mark.verdict]));
    if (mark?.lock) badges.push(el('i', { class: 'lock' }, `lock ${mark.lock.join(', ')}`));
    if (mark?.note) badges.push(el('i', { class: 'note', title: mark.note }, 'note'));
    cell.querySelector('.badges').replaceChildren(...badges);
  }

  /// Number of cells in a row, for the arrow keys.
  columns() {
    const cells = [...this.grid.children];
    const next = cells.findIndex((cell) => cell.offsetTop > cells[0].offsetTop);
    return next > 0 ? next : Math.max(1, cells.length);
  }
}
