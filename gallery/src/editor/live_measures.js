// SPDX-License-Identifier: Apache-2.0
// How far a face is from others, asked for while it still moves: one question at a time, of the newest.
import { post } from '../api.js';

export class LiveMeasures {
  /// \param show  is called with what the program measured; \param fail  with an error.
  constructor({ show, fail }) {
    Object.assign(this, { show, fail, running: false, next: null });
  }

  /// \param asked  {recipe, face: id of the crowd's face that was opened}
  async ask(asked) {
    this.next = asked;
    if (this.running) return;
    this.running = true;
    try {
      while (this.next) {
        const { next } = this;
        this.next = null;
        this.show(await post('measures', next));
      }
    } catch (error) {
      this.fail(error);
    } finally {
      this.running = false;
    }
  }
}
