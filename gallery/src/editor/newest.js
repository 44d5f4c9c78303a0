// SPDX-License-Identifier: Apache-2.0
// Questions about a face that changes: one at a time, always of the newest.

export class Newest {
  /// \param ask   gives a promise of the answer; \param show  is called with it; \param fail  with an error.
  constructor({ ask, show, fail }) {
    Object.assign(this, { request: ask, show, fail, running: null, next: null });
  }

  /// \param asked  what `ask` of the constructor takes
  /// \return       a promise that is kept once the newest answer is shown
  ask(asked) {
    this.next = asked;
    this.running ??= this.answerAll().catch(this.fail).finally(() => { this.running = null; });
    return this.running;
  }

  async answerAll() {
    while (this.next) {
      const { next } = this;
      this.next = null;
      await this.show(await this.request(next));
    }
  }
}
