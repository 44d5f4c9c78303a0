// SPDX-License-Identifier: Apache-2.0
// Dialogs that save the face to the crowd and that generate the whole crowd.
import { getJson, post } from '../api.js';
import { changeButtons } from '../changes.js';
import { openDialog } from '../dialog.js';
import { el } from '../dom.js';

/// Saves the face as a recipe of the config, or as a review of a face of the crowd.
export function showPutBack(editor) {
  const { face } = editor.document;
  const note = el('textarea', { rows: 2, placeholder: 'Note', 'aria-label': 'Note' });
  const locked = editor.lockedNames();
  const review = (verdict, lock) => editor.attempt(async () => {
    const { file } = await post('review', {
      id: face, lock, ...(verdict ? { verdict } : {}), ...(note.value ? { note: note.value } : {}),
    });
    dialog.close();
    editor.say(`${face} is marked in ${file}`);
  });
  const wanted = el('div', {});
  const drawChanges = () => {
    const entry = editor.reviewedFace(face);
    if (!entry) return;
    const buttons = changeButtons({
      crowd: editor.reviewedCrowd, face: entry, before: editor.reviewedFace(editor.before),
      change: editor.review.of(entry)?.change ?? {},
      ask: (name, value) => editor.attempt(async () => {
        editor.review.ask(entry, name, value);
        drawChanges();
        const { file } = await post('review', { id: face, change: editor.review.changeOf(entry) });
        editor.say(`${face} is changed in ${file}`);
      }),
    });
    wanted.replaceChildren(...(buttons ? [buttons] : []));
  };
  drawChanges();
  const dialog = openDialog('Put back',
    el('section', {}, el('h3', {}, 'Into the config'),
      el('p', { class: 'muted' }, `As ${editor.document.recipe.id}, into the file that the config names as edits.`),
      el('button', {
        class: 'export', title: 'The next run of generate makes it', onclick: () => editor.attempt(async () => {
          const { file } = await post('recipes', { recipe: editor.wire() });
          dialog.close();
          editor.say(`${editor.document.recipe.id} is saved under recipes in ${file}`);
        }),
      }, 'Save it under recipes')),
    editor.job.crowd ? el('section', {}, el('h3', {}, 'As a review'),
      face ? [el('p', { class: 'muted' }, `What the next run does with ${face}.`), note,
        el('div', { class: 'choices' },
          el('button', { title: 'The next run keeps this face', onclick: () => review('keep', []) }, 'Keep'),
          el('button', { title: 'The next run draws another face in its place', onclick: () => review('reject', []) }, 'Reject'),
          el('button', {
            disabled: locked.length === 0, title: 'Lock the regions that are good first',
            onclick: () => review(null, locked),
          }, locked.length > 0 ? `Redraw except ${locked.join(', ')}` : 'Redraw except locked regions')), wanted]
        : el('p', { class: 'muted' }, 'Open a face of the crowd first.')) : null);
}

/// \param save  called to replace the file
export function showReplace(name, save) {
  const dialog = openDialog(`${name} exists`,
    el('p', {}, 'Save over it? Another name at the top keeps both.'),
    el('div', { class: 'choices' },
      el('button', { class: 'export', title: 'Replaces the mesh and its recipe', onclick: () => { dialog.close(); save(); } }, 'Save over it'),
      el('button', { title: 'Saves nothing', onclick: () => dialog.close() }, 'Cancel')));
}

/// Shown if another page has begun to edit: the page opened last edits.
export function showElsewhere() {
  const dialog = openDialog('Open in another tab',
    el('p', {}, 'This face is edited in a tab that was opened later. All steps of this tab are there.'),
    el('div', { class: 'choices' },
      el('button', { class: 'export', title: 'This tab takes over', onclick: () => location.reload() }, 'Edit here again')));
  dialog.addEventListener('cancel', (event) => event.preventDefault());
  dialog.querySelector('[aria-label=Close]').remove();
}

/// \param painting  the function use(change) of this object opens the page again
export function showAddRegion(painting) {
  const name = el('input', { type: 'text', 'aria-label': 'Name of the region', placeholder: 'cheeks', spellcheck: 'false', maxlength: 64 });
  const dialog = openDialog('Another region',
    el('form', { method: 'dialog', onsubmit: () => painting.editor.attempt(() => painting.use({ add: name.value.trim() })) },
      el('p', { class: 'muted' }, 'It is empty until it is painted. It is added to the config at once.'),
      el('div', { class: 'choices' }, name, el('button', { class: 'export', title: 'Adds the region to the config' }, 'Add'))));
  name.focus();
  return dialog;
}

const optional = ['ears', 'neck'];

export function showProposeRegions(painting) {
  const boxes = optional.map((name) => el('input', { type: 'checkbox', value: name }));
  const names = () => ['brow', 'nose', 'mouth', ...boxes.filter((box) => box.checked).map((box) => box.value)];
  return openDialog('Regions from the heads’ shape',
    el('form', { method: 'dialog', onsubmit: () => painting.editor.attempt(() => painting.use({ propose: names() })) },
      el('p', { class: 'muted' }, 'Brow, nose and mouth replace the current regions. The config is changed at once.'),
      el('div', { class: 'choices' }, boxes.map((box) => el('label', {}, box, ` ${box.value}`)),
        el('button', { class: 'export', title: 'Replaces the regions of the config' }, 'Propose'))));
}

function duration(seconds) {
  if (!Number.isFinite(seconds)) return '';
  if (seconds < 90) return `${Math.round(seconds)} s`;
  return `${Math.round(seconds / 60)} min`;
}

/// Starts `generate` for the whole crowd, and shows its progress while the dialog is open.
export function showGenerate(editor) {
  const bar = el('progress', { max: 1, value: 0, 'aria-label': 'Progress' });
  const text = el('p', { role: 'status' }, '');
  const begin = el('button', {
    class: 'export', title: 'Starts the run', onclick: () => editor.attempt(async () => {
      await post('generate', {});
      await look();
    }),
  }, 'Generate the crowd');
  const stop = el('button', { title: 'Stops the run; the next one goes on', onclick: () => editor.attempt(() => post('generate/stop', {})) }, 'Stop');
  const open = el('button', {
    hidden: true, title: 'Loads the page again with them', onclick: () => editor.attempt(() => editor.openAgain('open', {})),
  }, 'Open the new faces');
  let timer = null;
  async function look() {
    const run = await getJson('generate');
    const running = run.state === 'running';
    bar.max = run.total || 1;
    bar.value = run.done || 0;
    open.hidden = run.state !== 'done';
    text.textContent = running
      ? `${run.done} of ${run.total}${Number.isFinite(run.eta_s) ? `, ${duration(run.eta_s)} left` : ''} ${run.message ?? ''}`
      : run.message || (run.state === 'idle' ? '' : run.state);
    begin.disabled = running;
    stop.disabled = !running;
    clearTimeout(timer);
    if (running) timer = setTimeout(() => editor.attempt(look), 700);
  }
  const dialog = openDialog('The whole crowd',
    el('p', { class: 'muted' }, 'Runs crowdface generate with the config as saved on disk.'),
    bar, text, el('div', { class: 'choices' }, begin, stop, open));
  dialog.addEventListener('close', () => clearTimeout(timer));
  editor.attempt(look);
}
