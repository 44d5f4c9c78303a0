// SPDX-License-Identifier: Apache-2.0
// Marks: kept in the browser across reloads, exported as the review.yaml that `crowdface generate
// --review` takes.

import { locksAll } from './crowd.js';

/// A text as a double-quoted YAML scalar on one line.
function quoted(text) {
  const escaped = text
    .replace(/\\/g, '\\\\').replace(/"/g, '\\"').replace(/\r?\n/g, '\\n').replace(/\t/g, '\\t')
    .replace(/[\u0000-\u001f\u007f]/g, ' ');
  return `"${escaped}"`;
}

/// A face's id as a key: of letters, digits, '_', '-' and '.', and `null` would be none.
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

export class Review {
  /// \param storage  localStorage, or null where there is none.
  constructor(crowd, storage) {
    this.crowd = crowd;
    this.storage = storage;
    this.key = `crowdface review · ${crowd.name} · ${crowd.seed}`;
    this.listeners = [];
    this.kept = true; // whether marks outlast the page
    this.marks = new Map();
    try {
      const stored = JSON.parse(storage?.getItem(this.key) ?? '{}');
      for (const [id, mark] of Object.entries(stored)) this.marks.set(id, mark);
      this.kept = storage !== null;
    } catch {
      this.kept = false;
    }
  }

  /// A mark is about the face that was looked at: one that was drawn anew since has none.
  of(face) {
    const mark = this.marks.get(face.id);
    return mark && mark.attempt === face.attempt ? mark : undefined;
  }

  change(face, change) {
    const mark = { attempt: face.attempt, ...this.of(face), ...change };
    if (!mark.verdict) delete mark.verdict;
    if (!mark.lock?.length || mark.verdict !== 'reject') {
      delete mark.lock;
      delete mark.unlocked;
    }
    if (!mark.note) delete mark.note;
    if (mark.verdict || mark.note) this.marks.set(face.id, mark);
    else this.marks.delete(face.id);
    try {
      this.storage?.setItem(this.key, JSON.stringify(Object.fromEntries(this.marks)));
    } catch {
      this.kept = false;
    }
    for (const listener of this.listeners) listener(face);
  }

  /// \return why not, or null.
  verdict(face, verdict) {
    if (verdict === 'reject' && face.byHand) {
      return 'This face is written by hand or has children: change the config.';
    }
    this.change(face, { verdict: this.of(face)?.verdict === verdict ? undefined : verdict });
    return null;
  }

  /// Locks a region or band, or lets it go: the face is drawn anew but for what is locked.
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

  count(verdict) {
    return this.crowd.faces.filter((face) => this.of(face)?.verdict === verdict).length;
  }

  /// The review file: a line for each mark, in the plan's order.
  toYaml() {
    const lines = this.crowd.faces
      .map((face) => [face, this.of(face)])
      .filter(([, mark]) => mark)
      .map(([face, mark]) => `  ${key(face.id)}: ${formatMark(mark, this.crowd.locks)}`);
    const faces = lines.length > 0 ? `faces:\n${lines.join('\n')}` : 'faces: {}';
    return `# Marks of the crowd ${this.crowd.name}, seed ${this.crowd.seed}: ` +
      `crowdface generate CONFIG --review THIS_FILE\nschema: 1\n${faces}\n`;
  }
}
