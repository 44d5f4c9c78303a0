// SPDX-License-Identifier: Apache-2.0
// The row of buttons at the top, and those over the 3D view.
import { el } from '../dom.js';
import { distanceColours } from './head_view.js';

const mostListed = 400; // faces in a list; of more one types the id

function openList(editor, faces) {
  const list = el('select', {
    'aria-label': 'Open a face', title: 'Open a face of the crowd, or a head ([ and ])',
    onchange: () => { editor.open(list.value); },
  }, el('option', { value: '' }, 'Open …'),
  faces.length > 0 ? el('optgroup', { label: 'Faces of the crowd' },
    faces.map((face) => el('option', { value: `face ${face.id}` }, face.id))) : null,
  el('optgroup', { label: 'Heads unblended' },
    editor.job.heads.map((head) => el('option', { value: `head ${head.name}` }, head.name))));
  list.show = (face) => { list.value = face ? `face ${face}` : ''; };
  return list;
}

function openField(editor, faces) {
  const ids = new Set(faces.map((face) => face.id));
  const field = el('input', {
    type: 'text', class: 'name', placeholder: 'Open …', 'aria-label': 'Open a face or a head by its name', spellcheck: 'false',
    title: `${faces.length} faces, from ${faces[0].id} to ${faces[faces.length - 1].id}, and the heads ([ and ])`,
    onchange: () => {
      const name = field.value.trim();
      if (ids.has(name)) editor.open(`face ${name}`);
      else if (editor.job.heads.some((head) => head.name === name)) editor.open(`head ${name}`);
      else editor.say(`There is no face and no head called ${name}.`, true);
    },
  });
  field.show = (face) => { field.value = face ?? ''; };
  return field;
}

export function toolbar(editor) {
  const { job } = editor;
  const button = (text, title, act, properties = {}) =>
    el('button', { title, onclick: () => editor.attempt(act), ...properties }, text);
  const faces = job.crowd?.faces ?? [];
  const open = faces.length <= mostListed ? openList(editor, faces) : openField(editor, faces);
  const name = el('input', {
    type: 'text', class: 'name', 'aria-label': 'Name of the face', title: 'Its name in files and in the config',
    maxlength: 64, spellcheck: 'false', onchange: () => editor.rename(name.value),
  });
  const format = el('select', { 'aria-label': 'Format of the mesh' },
    job.formats.map((word) => el('option', { value: word }, word.toUpperCase())));
  const undo = button('Undo', 'Undo (Ctrl+Z)', () => editor.undo());
  const redo = button('Redo', 'Redo (Ctrl+Shift+Z)', () => editor.redo());
  const compare = button('A/B', 'Compare with what was kept last (B)', () => editor.compare());
  const node = el('header', { class: 'toolbar', role: 'toolbar', 'aria-label': 'Commands' },
    el('h1', { title: job.name }, job.name), open, name,
    el('span', { class: 'group' }, undo, redo), el('span', { class: 'group' },
      button('Keep', 'Keep this face to compare with (K)', () => editor.shelf.keep()), compare),
    el('span', { class: 'group' },
      button('Draw', 'A face within the config’s limits; locked regions stay (R)', () => editor.shelf.draw()),
      button('Six like it', 'Six like this one, to pick from (L)', () => editor.shelf.offer()),
      button('Between', 'A way between two faces (N)', () => editor.shelf.startTravel())),
    el('span', { class: 'grow' }),
    el('span', { class: 'group' }, format,
      button('Save mesh', 'At full resolution (Ctrl+S)', () => editor.saveMesh(format.value), { class: 'export' })),
    button('Picture', 'Save a picture of this view', () => editor.savePicture()),
    button('Put back', 'Into the config or as a review', () => editor.putBack()),
    job.can_generate ? button('Generate', 'Make the whole crowd', () => editor.generate()) : null,
    button('?', 'All keys (?)', () => editor.help(), { class: 'plain', 'aria-label': 'All keys' }));
  return {
    node,
    show() {
      undo.disabled = editor.history.past.length === 0;
      redo.disabled = editor.history.future.length === 0;
      undo.title = undo.disabled ? 'Undo (Ctrl+Z)' : `Undo: ${editor.history.label} (Ctrl+Z)`;
      compare.disabled = editor.kept.length === 0;
      compare.classList.toggle('on', editor.comparing !== null);
      compare.setAttribute('aria-pressed', String(editor.comparing !== null));
      if (document.activeElement !== name) name.value = editor.document.recipe.id;
      if (document.activeElement !== open || open.matches('select')) open.show(editor.document.face);
    },
    format,
  };
}

const views = [['front', 'Front', 'F'], ['three_quarter', 'Three-quarter', 'Q'], ['profile', 'Profile', 'P'], ['back', 'Back']];

export function viewBar(editor) {
  const { job, view } = editor;
  const textures = job.heads.map((head, h) => [head, h]).filter(([head]) => head.texture);
  const options = [['surface', 'Own skin'], ['distance', 'Distance to target'], ['regions', 'Regions'],
    ...(textures.length > 0 ? [['texture', 'Texture: target’s'],
      ...textures.map(([head, h]) => [`texture ${h}`, `Texture: ${head.name}`])] : [])];
  const show = el('select', {
    'aria-label': 'What the face shows', title: 'What the face shows (C)', onchange: () => editor.setShow(show.value),
  }, options.map(([value, text]) => el('option', { value }, text)));
  const wire = el('button', {
    title: 'Edges of the preview (W)', onclick: () => editor.setWireframe(!editor.look.wireframe),
  }, 'Wireframe');
  const paint = el('button', {
    hidden: true, title: 'Paint the regions’ masks (M)', onclick: () => editor.painting.setOn(!editor.painting.on),
  }, 'Paint masks');
  const beside = el('button', {
    title: 'Another face beside, seen by the same camera (S)', onclick: () => editor.beside.setOn(!editor.beside.on),
  }, 'Side by side');
  const wears = Object.entries(job.attachments).map(([kind, names]) => [kind, el('select', {
    'aria-label': `What the face wears: ${kind}`, title: `What the face wears: ${kind}`,
    onchange: (event) => editor.wear(kind, event.target.value),
  }, el('option', { value: 'draw' }, `${kind}: drawn`), el('option', { value: 'none' }, `${kind}: none`),
  names.map((name) => el('option', { value: name }, name)))]);
  const scale = el('div', { class: 'scale', hidden: true }, el('i', {}), el('span', {}, '0'),
    el('span', {}, `${view.showMm} mm`));
  scale.firstChild.style.background = `linear-gradient(90deg, ${distanceColours.join(', ')})`;
  return {
    node: el('div', { class: 'viewbar' },
      el('div', { class: 'group', role: 'group', 'aria-label': 'Standard views' },
        views.map(([name, text, key]) => el('button', { title: `${text} view${key ? ` (${key})` : ''}`, onclick: () => view.view(name) }, text))),
      show, wears.map(([, select]) => select), wire, beside, paint, scale),
    show() {
      show.value = editor.look.show;
      for (const [kind, select] of wears) select.value = editor.look.wears[kind] ?? 'draw';
      wire.classList.toggle('on', editor.look.wireframe);
      wire.setAttribute('aria-pressed', String(editor.look.wireframe));
      beside.classList.toggle('on', editor.beside.on);
      beside.setAttribute('aria-pressed', String(editor.beside.on));
      scale.hidden = editor.look.show !== 'distance';
      paint.classList.toggle('on', Boolean(editor.painting?.on));
    },
    offerPainting() { paint.hidden = false; },
    values: options.map(([value]) => value),
  };
}
