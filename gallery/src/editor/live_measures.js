// SPDX-License-Identifier: Apache-2.0
// How far a face is from others, asked for while it still moves: one question at a time, of the newest.
import { post } from '../api.js';

export class LiveMeasures {
  /// \param show  is called with what the program measured; \param fail  with an error.
  constructor({ show, fail }) {
    Object.assign(this, { show, fail, running: false, next: null });
  }

  async ask(recipe) {
    this.next = recipe;
    if (this.running) return;
    this.running = true;
    try {
      while (this.next) {
        const asked = this.next;
        this.next = null;
        this.show(await post('measures', { recipe: asked }));
      }
    } catch (error) {
      this.fail(error);
    } finally {
      this.running = false;
    }
  }
}
