// SPDX-License-Identifier: Apache-2.0
// Buttons that ask for a change of one face, for the gallery and the editor.
import { el } from './dom.js';

/// An id without its beginning, the crowd's name, to save room on buttons.
export function shortName(crowd, name) {
  const start = `${crowd.name}_`;
  return name.startsWith(start) ? name.slice(start.length) : name;
}

/// \param crowd   {name, heads, hairColours, skins} as in the result of readCrowd
/// \param before  the face that was open before, or null
/// \param change  the requested change so far, such as {age: 'older', hair: 'red'}
/// \param ask     called with a key of the change and a value; the same value again removes the key.
/// \return  the buttons; null if the crowd offers no change
export function changeButtons({ crowd, face, before, change, ask }) {
  const has = (tag) => crowd.heads.some((head) => head.tags.includes(tag));
  const button = (name, value, text, title) => el('button', {
    class: `change ${value !== undefined && change[name] === value ? 'on' : ''}`, title,
    onclick: () => ask(name, value),
  }, text);
  // Each click requests the next value; the click after the last value removes the request.
  const next = (name, values, text) => el('button', {
    class: `change ${change[name] === undefined ? '' : 'on'}`, title: 'Again: the next one',
    onclick: () => ask(name, values[values.indexOf(change[name]) + 1]),
  }, change[name] === undefined ? text : `${text}: ${change[name]}`);
  const common = (head) => head.tags.filter((tag) => face.tags.includes(tag)).length;
  const skins = crowd.skins
    ? crowd.heads.filter((head) => head.name !== face.target)
      .sort((a, b) => common(b) - common(a)).map((head) => head.name)
    : [];
  const isSampled = !face.byHand && face.family === null;
  const buttons = [
    has('old') ? button('age', 'older', 'Older') : null,
    has('young') ? button('age', 'younger', 'Younger') : null,
    isSampled && before ? button('variant_of', before.id, `Variant of ${shortName(crowd, before.id)}`,
      'Replace this face by a face similar to the one that was open before') : null,
    crowd.hairColours.length > 0 ? next('hair', crowd.hairColours, 'Other hair') : null,
    skins.length > 0 ? next('colours', skins, 'Other skin') : null,
  ].filter(Boolean);
  return buttons.length === 0 ? null
    : el('div', { class: 'locks changes' }, el('span', { class: 'muted' }, 'Change'), buttons);
}
