// SPDX-License-Identifier: Apache-2.0
// The steps of a page, for undo and redo, and states that are kept for comparison.

const most = 400; // largest number of steps; a step has some hundred bytes

export class History {
  /// \param document  {recipe, anchors}: replaced by each step, never changed.
  /// \param kept      a result of toJson(), or null
  constructor(document, kept) {
    this.now = kept?.now ?? document;
    this.label = kept?.label ?? '';
    this.past = kept?.past ?? [];
    this.future = kept?.future ?? [];
    this.listeners = [];
  }

  /// \param letters  approximate largest length of the result; the oldest steps are omitted beyond it
  toJson(letters = Infinity) {
    const { now, label, future } = this;
    let { past } = this;
    while (past.length > 0 && JSON.stringify([past, future]).length > letters) past = past.slice(Math.ceil(past.length / 4));
    return { now, label, past, future };
  }

  /// Adds a step. Steps of one kind in quick succession, such as repeats of a key or of a wheel, become one step.
  commit(document, label, { joins = false, time = Date.now() } = {}) {
    if (JSON.stringify(document) === JSON.stringify(this.now)) return;
    const joined = joins && this.label === label && time - this.time < 800;
    if (!joined) this.past.push({ document: this.now, label: this.label });
    if (this.past.length > most) this.past.shift();
    Object.assign(this, { now: document, label, time, future: [] });
    this.tell();
  }

  undo() {
    return this.step(this.past, this.future);
  }

  redo() {
    return this.step(this.future, this.past);
  }

  step(from, to) {
    if (from.length === 0) return false;
    to.push({ document: this.now, label: this.label });
    const { document, label } = from.pop();
    Object.assign(this, { now: document, label, time: 0 });
    this.tell();
    return true;
  }

  tell() {
    for (const listener of this.listeners) listener();
  }
}
