// SPDX-License-Identifier: Apache-2.0
// Questions about a face that changes: one at a time, always of the newest.

export class Newest {
  /// \param ask   gives a promise of the answer; \param show  is called with it; \param fail  with an error.
  constructor({ ask, show, fail }) {
    Object.assign(this, { request: ask, show, fail, running: false, next: null });
  }

  /// \param asked  what `ask` of the constructor takes
  async ask(asked) {
    this.next = asked;
    if (this.running) return;
    this.running = true;
    try {
      while (this.next) {
        const { next } = this;
        this.next = null;
        await this.show(await this.request(next));
      }
    } catch (error) {
      this.fail(error);
    } finally {
      this.running = false;
    }
  }
}
