// SPDX-License-Identifier: Apache-2.0
// Marks of faces. The browser stores them across reloads; they are exported as a review.yaml for `crowdface generate
// --review`.

import { locksAll } from './crowd.js';

/// Formats a text as a double-quoted YAML scalar on one line.
function quoted(text) {
  const escaped = text
    .replace(/\\/g, '\\\\').replace(/"/g, '\\"').replace(/\r?\n/g, '\\n').replace(/\t/g, '\\t')
    .replace(/[\u0000-\u001f\u007f]/g, ' ');
  return `"${escaped}"`;
}

/// Formats a face's id as a YAML key. Ids consist of letters, digits, '_', '-' and '.'; `null` must be quoted.
function key(id) {
  return id.toLowerCase() === 'null' ? quoted(id) : id;
}

function formatMark(mark, locks) {
  if (!mark.note && !mark.lock?.length) return mark.verdict;
  const parts = [];
  if (mark.lock?.length) {
    parts.push(`lock: [${locks.filter((name) => mark.lock.includes(name)).map(quoted).join(', ')}]`);
  } else if (mark.verdict) {
    parts.push(`mark: ${mark.verdict}`);
  }
  if (mark.note) parts.push(`note: ${quoted(mark.note)}`);
  return `{${parts.join(', ')}}`;
}

/// Formats a change as in review files, where `colours` is a mapping from heads to weights.
const asWritten = (change) => (change.colours ? { ...change, colours: { [change.colours]: 1 } } : change);

function formatChange(change) {
  const parts = Object.entries(asWritten(change)).map(([name, value]) => (name === 'colours'
    ? `colours: {${quoted(change.colours)}: 1}` : `${name}: ${name === 'variant_of' ? key(value) : value}`));
  return `{${parts.join(', ')}}`;
}

export class Review {
  /// \param storage  localStorage, or null if the browser has none
  constructor(crowd, storage) {
    this.crowd = crowd;
    this.storage = storage;
    this.key = `crowdface review · ${crowd.name} · ${crowd.seed}`;
    this.listeners = [];
    this.kept = true; // whether the browser stores the marks
    this.marks = new Map();
    try {
      const stored = JSON.parse(storage?.getItem(this.key) ?? '{}');
      for (const [id, mark] of Object.entries(stored)) this.marks.set(id, mark);
      this.kept = storage !== null;
    } catch {
      this.kept = false;
    }
  }

  /// The mark of a face. A mark made before the face was redrawn or changed does not count.
  of(face) {
    const mark = this.marks.get(face.id);
    const isSame = mark?.attempt === face.attempt && (mark?.changes ?? 0) === face.changes;
    return isSame ? mark : undefined;
  }

  change(face, change) {
    const mark = { attempt: face.attempt, changes: face.changes, ...this.of(face), ...change };
    if (Object.keys(mark.change ?? {}).length === 0) delete mark.change;
    if (!mark.verdict) delete mark.verdict;
    if (!mark.lock?.length || mark.verdict !== 'reject') {
      delete mark.lock;
      delete mark.unlocked;
    }
    if (!mark.note) delete mark.note;
    if (mark.verdict || mark.note || mark.change) this.marks.set(face.id, mark);
    else this.marks.delete(face.id);
    try {
      this.storage?.setItem(this.key, JSON.stringify(Object.fromEntries(this.marks)));
    } catch {
      this.kept = false;
    }
    for (const listener of this.listeners) listener(face);
  }

  /// \return  the reason if the verdict was refused, or null
  verdict(face, verdict) {
    if (verdict === 'reject' && face.byHand) {
      return 'This face is written by hand or has children: change the config.';
    }
    this.change(face, { verdict: this.of(face)?.verdict === verdict ? undefined : verdict });
    return null;
  }

  /// Locks or unlocks a region or band. A face with locks is redrawn except for the locked parts.
  lock(face, part) {
    if (face.byHand) return 'This face is written by hand or has children: change the config.';
    const lock = new Set(this.of(face)?.lock ?? []);
    if (!lock.delete(part)) lock.add(part);
    if (locksAll(this.crowd, lock)) {
      return `Every ${this.crowd.bands.includes(part) ? 'band' : 'region'} is locked, so nothing is left to redraw.`;
    }
    const before = this.of(face);
    const unlocked = before?.lock ? before.unlocked : before?.verdict; // the verdict before the first lock
    this.change(face, { verdict: lock.size > 0 ? 'reject' : unlocked, lock: [...lock], unlocked });
    return null;
  }

  /// Sets a key of the face's change. The same value again, or null, removes the key.
  ask(face, name, value) {
    const change = { ...this.of(face)?.change };
    if (value === undefined || change[name] === value) delete change[name];
    else change[name] = value;
    this.change(face, { change });
  }

  /// The requested change as in review files; {} if there is none.
  changeOf(face) {
    return asWritten(this.of(face)?.change ?? {});
  }

  count(verdict) {
    return this.crowd.faces.filter((face) => this.of(face)?.verdict === verdict).length;
  }

  /// The text of the review file: a line for each mark and each change, in the plan's order.
  toYaml() {
    const all = this.crowd.faces.map((face) => [face, this.of(face)]).filter(([, mark]) => mark);
    const section = (name, lines) => (lines.length > 0 ? `${name}:\n${lines.join('\n')}\n` : '');
    const faces = section('faces', all.filter(([, mark]) => mark.verdict || mark.note)
      .map(([face, mark]) => `  ${key(face.id)}: ${formatMark(mark, this.crowd.locks)}`));
    const changes = section('changes', all.filter(([, mark]) => mark.change)
      .map(([face, mark]) => `  ${key(face.id)}: ${formatChange(mark.change)}`));
    return `# Marks of the crowd ${this.crowd.name}, seed ${this.crowd.seed}: ` +
      `crowdface generate CONFIG --review THIS_FILE\nschema: 1\nafter: ${this.crowd.reviews}\n` +
      `${faces || changes ? faces : 'faces: {}\n'}${changes}`;
  }
}
