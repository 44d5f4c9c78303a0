// SPDX-License-Identifier: Apache-2.0
// The program's own face, asked for when the mouse rests.
import { postForBinary } from '../api.js';

const rest = 60; // ms; longer than the time between two moves of a drag on a page without a graphics card
export const undressed = 1000; // ms until the program is asked anew for a face without all that it wears

/// The program's face of a request once it has put on what the face wears.
export async function dressedFace(request) {
  for (;;) {
    const face = await postForBinary('face', request);
    if (!face.bare) return face;
    await new Promise((done) => { setTimeout(done, undressed); });
  }
}

export class Exact {
  /// \param show  is called with (face, document) for the newest document alone; \param fail  with an error.
  constructor({ show, fail, waiting }) {
    Object.assign(this, { show, fail, waiting, turn: 0, page: crypto.randomUUID() });
  }

  /// \param document  the document on the page
  /// \param asked     the request for its face
  /// \param wait      milliseconds without another call after which the request is sent
  ask(document, asked, wait = rest) {
    clearTimeout(this.timer);
    this.running?.abort();
    this.running = null;
    this.waiting(true);
    if (wait === 0) this.send(document, asked); // before the page draws again
    else this.timer = setTimeout(() => this.send(document, asked), wait);
  }

  async send(document, asked) {
    this.turn += 1;
    const { turn } = this;
    const running = new AbortController();
    this.running = running;
    const began = performance.now();
    try {
      const face = await postForBinary('face', {
        measure: true, ...asked, page: this.page, turn,
      }, running.signal);
      if (turn !== this.turn || this.running !== running) return;
      this.running = null;
      this.show({ ...face, round_trip_ms: performance.now() - began }, document);
      this.waiting(false);
    } catch (error) {
      if (error.name === 'AbortError' || this.running !== running) return;
      this.running = null;
      this.fail(error);
    }
  }
}
