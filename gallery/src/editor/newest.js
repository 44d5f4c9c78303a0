// SPDX-License-Identifier: Apache-2.0
// Requests about a face that changes: one request at a time, always for the newest face.

export class Newest {
  /// \param ask   takes what is asked, returns a promise of the answer
  /// \param show  called with the answer
  /// \param fail  called with an error
  constructor({ ask, show, fail }) {
    Object.assign(this, { request: ask, show, fail, running: null, next: null });
  }

  /// \param asked  what `ask` of the constructor takes
  /// \return       a promise that resolves when the newest answer has been shown
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
