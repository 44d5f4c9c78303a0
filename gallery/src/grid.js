// SPDX-License-Identifier: Apache-2.0
import { el, short } from './dom.js';
import { nearestMm } from './crowd.js';

const verdictNames = { keep: 'kept', reject: 'rejected' };

/// The picture of a face or head: the first of the views that stand side by side in its file.
export function picture(subject, name) {
  if (!subject?.picture) return el('div', { class: 'portrait blank' }, name);
  const image = el('img', {
    src: subject.picture, alt: name, loading: 'lazy', decoding: 'async', draggable: 'false',
  });
  image.onerror = () => image.replaceWith(el('div', { class: 'blank' }, name));
  return el('div', { class: 'portrait' }, image);
}

/// All faces as cells, made once and put in order again and again.
export class Grid {
  /// \param open, select  are called with a face.
  constructor(crowd, review, { open, select }) {
    this.review = review;
    this.node = el('div', { class: 'grid', role: 'list' });
    this.cells = new Map(crowd.faces.map((face) => [face.id, this.cell(face, open, select)]));
    this.faces = [];
    for (const face of crowd.faces) this.showMark(face);
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
    this.node.replaceChildren(
      ...(faces.length > 0
        ? faces.map((face) => this.cells.get(face.id))
        : [el('p', { class: 'nothing' }, 'No face passes these filters.')]));
  }

  select(face) {
    this.node.querySelector('.selected')?.classList.remove('selected');
    const cell = face && this.cells.get(face.id);
    cell?.classList.add('selected');
    cell?.scrollIntoView({ block: 'nearest' });
  }

  showMark(face) {
    const cell = this.cells.get(face.id);
    const mark = this.review.of(face);
    cell.classList.toggle('keep', mark?.verdict === 'keep');
    cell.classList.toggle('reject', mark?.verdict === 'reject');
    const badges = [];
    if (mark?.verdict) badges.push(el('i', { class: mark.verdict }, verdictNames[mark.verdict]));
    if (mark?.lock) badges.push(el('i', { class: 'lock' }, `lock ${mark.lock.join(', ')}`));
    if (mark?.note) badges.push(el('i', { class: 'note', title: mark.note }, 'note'));
    cell.querySelector('.badges').replaceChildren(...badges);
  }

  /// How many cells stand side by side, for the arrow keys.
  columns() {
    const cells = [...this.node.children];
    const next = cells.findIndex((cell) => cell.offsetTop > cells[0].offsetTop);
    return next > 0 ? next : Math.max(1, cells.length);
  }
}
