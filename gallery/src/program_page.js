// SPDX-License-Identifier: Apache-2.0
// What the pages have in common that a running program serves: a line that says what happened.

export class ProgramPage {
  // this.message: the line, hidden while it says nothing.

  /// Does something that may fail, and says why it did.
  async attempt(act) {
    try {
      return await act();
    } catch (error) {
      this.say(error.message, true);
      return null;
    }
  }

  /// \param stays  until something else is said
  say(text, bad = false, stays = false) {
    clearTimeout(this.timer);
    this.message.hidden = !text;
    this.message.classList.toggle('bad', bad);
    this.message.textContent = text ?? '';
    if (text && !stays) this.timer = setTimeout(() => { this.message.hidden = true; }, bad ? 9000 : 5000);
  }
}
