// SPDX-License-Identifier: Apache-2.0
// Adds heads with textures that the user drops on the page or chooses in a dialog. The program checks them; then they
// appear on the plane.
import { post, putBytes } from '../api.js';
import { el } from '../dom.js';
import { asWeights } from './recipe.js';

const piece = 2 ** 21; // largest number of bytes per request

/// Whether all files are images, so that they may be reference photos.
export const arePictures = (files) => files.every(({ type }) => type.startsWith('image/'));

export class AddedHeads {
  /// \param editor  job, history, kept, openAgain(path, change, step), attempt, say
  constructor(editor) {
    this.editor = editor;
    this.file = el('input', {
      type: 'file', multiple: true, hidden: true, 'aria-label': 'Heads to add', onchange: () => this.take([...this.file.files]),
    });
    this.node = el('span', { hidden: !editor.job.can_edit_config }, this.file, el('button', {
      title: 'Heads with their material files and textures; or drop them anywhere on the page', onclick: () => this.file.click(),
    }, 'Add heads …'));
    addEventListener('dragover', (event) => { if (event.dataTransfer?.types.includes('Files')) event.preventDefault(); });
    addEventListener('drop', (event) => {
      const files = [...(event.dataTransfer?.files ?? [])];
      if (files.length === 0 || event.defaultPrevented) return;
      event.preventDefault();
      this.take(files);
    });
  }

  take(files) {
    return this.editor.attempt(() => this.add(files));
  }

  async add(files) {
    const { editor } = this;
    const all = files.reduce((sum, { size }) => sum + size, 0);
    await post('dropped', Object.fromEntries(files.map(({ name, size }) => [name, size])));
    let sent = 0;
    for (const file of files) {
      for (let at = 0; at < file.size; at += piece) {
        editor.say(`Reading ${file.name}: ${Math.round((100 * sent) / all)} %`);
        const bytes = file.slice(at, at + piece);
        await putBytes(`dropped/${at}/${encodeURIComponent(file.name)}`, bytes);
        sent += bytes.size;
      }
    }
    editor.say('Checking and preparing the heads …', false, true);
    await editor.openAgain('heads', {}, ({ faces, heads }) => {
      // With more heads, a position on the plane has other weights. Store weights, so that the faces stay the same.
      const { history, job } = editor;
      editor.kept = editor.kept.map((entry) => ({ ...entry, document: asWeights(job, entry.document) }));
      history.commit({ ...asWeights(job, history.now), config_faces: faces }, `${heads.join(', ')} joined`);
      editor.tellLater(`${heads.join(', ')} ${heads.length > 1 ? 'have' : 'has'} joined. The crowd’s faces were made without: Generate makes them anew.`);
    });
  }
}
