// SPDX-License-Identifier: Apache-2.0
// Requests the exact face from the program when nothing has moved for a while.
import { postForBinary } from '../api.js';

// Milliseconds without a change after which the face is requested: longer than the time between two moves of a drag
// without a graphics card.
const rest = 60;
/// Milliseconds after which a face is requested again if the program sent it without all attachments.
export const undressed = 1000;

/// The program's face for a request, with all attachments.
export async function dressedFace(request) {
  for (;;) {
    const face = await postForBinary('face', request);
    if (!face.bare) return face;
    await new Promise((done) => { setTimeout(done, undressed); });
  }
}

export class Exact {
  /// \param show     called with (face, document), only for the newest document
  /// \param fail     called with an error
  /// \param waiting  called with true when a face is requested, with false when it has arrived
  constructor({ show, fail, waiting }) {
    Object.assign(this, { show, fail, waiting, turn: 0, page: crypto.randomUUID() });
  }

  /// \param document  the document on the page
  /// \param asked     the request for its face
  /// \param isFinal   whether to send the request at once; otherwise it is sent after a time without another call
  ask(document, asked, isFinal = false) {
    clearTimeout(this.timer);
    this.running?.abort();
    this.running = null;
    this.waiting(true);
    if (isFinal) this.send(document, asked);
    else this.timer = setTimeout(() => this.send(document, asked), rest);
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
