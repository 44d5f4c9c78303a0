// SPDX-License-Identifier: Apache-2.0
// Dialogs of pages that the program serves.
import { el } from './dom.js';

export function openDialog(title, ...children) {
  const dialog = el('dialog', { 'aria-label': title, onclose: () => dialog.remove() },
    el('header', {}, el('h2', {}, title), el('span', { class: 'grow' }),
      el('button', { class: 'plain', onclick: () => dialog.close(), 'aria-label': 'Close' }, '✕')), children);
  document.body.append(dialog);
  dialog.showModal();
  return dialog;
}

export function showKeys(keys) {
  openDialog('Keys', el('dl', { class: 'keys' }, keys.map(([key, does]) =>
    [el('dt', {}, el('kbd', {}, key)), el('dd', {}, does)])));
}
