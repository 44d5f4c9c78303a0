// SPDX-License-Identifier: Apache-2.0
// Requests about a face that changes: one request at a time, always for the newest face.

export class Newest {
  /// \param ask   an async function of a request: returns the answer
  /// \param show  called with the answer
  /// \param fail  called with an error
  constructor({ ask, show, fail }) {
    Object.assign(this, { request: ask, show, fail, running: null, next: null });
  }

  /// Makes a request; replaces a request that has not been sent yet.
  /// \return  a promise that resolves when the newest answer has been shown, or a request has failed
  ask(asked) {
    this.next = asked;
    this.running ??= this.answerAll();
    return this.running;
  }

  async answerAll() {
    try {
      while (this.next) {
        const { next } = this;
        this.next = null;
        await this.show(await this.request(next));
      }
    } catch (error) {
      this.fail(error);
    } finally {
      this.running = null;
    }
  }
}
