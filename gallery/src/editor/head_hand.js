// SPDX-License-Identifier: Apache-2.0
// Pointer actions on the head: a click selects the region at the pointer, a drag that begins on the selected region
// moves its controller, any other drag turns the head.
import { still } from './plane_board.js';

export class HeadHand {
  /// \param editor  view, board, panel, painting, preview(document), commit(document, label), focusRegion(name).
  constructor(editor) {
    Object.assign(this, { editor, selected: null });
    const { node } = editor.view;
    node.addEventListener('pointerdown', (event) => this.down(event), { capture: true });
    node.addEventListener('pointermove', (event) => this.move(event));
    node.addEventListener('pointerup', (event) => this.up(event));
    node.addEventListener('pointercancel', () => this.end());
    this.select(null);
  }

  /// \param name  name of a region; null: deselects
  select(name) {
    const { editor } = this;
    this.selected = name;
    for (const part of editor.node.querySelectorAll('.handle, .regioncard')) {
      const is = part.dataset.region === name;
      part.classList.remove('pulse');
      part.getBoundingClientRect(); // restarts the animation
      part.classList.toggle('pulse', is);
      part.classList.toggle('chosen', is);
    }
    if (name) editor.focusRegion(name);
    editor.view.node.title = name
      ? `Drag on ${name}: moves its controller. Drag elsewhere: turns the head. Esc, or a click beside the head: selects nothing.`
      : 'Drag: turns the head. Click: selects the region; then a drag that begins on it moves its controller.';
  }

  down({ button, clientX, clientY, pointerId, isPrimary }) {
    if (this.pressed || this.editor.painting?.on || this.editor.photo.matching || button !== 0 || !isPrimary) {
      this.end();
      return;
    }
    this.pressed = { x: clientX, y: clientY, region: this.editor.view.regionAt(clientX, clientY) };
    if (!this.selected || this.pressed.region !== this.selected) return;
    this.pressed.drag = this.editor.board.dragOf(this.selected);
    const { controls, node } = this.editor.view;
    controls.enabled = false; // so that the view does not turn
    node.setPointerCapture(pointerId);
  }

  move({ clientX, clientY }) {
    const { pressed } = this;
    if (!pressed) {
      const { view } = this.editor;
      if (this.selected) view.node.style.cursor = view.regionAt(clientX, clientY) === this.selected ? 'move' : '';
      return;
    }
    const [dx, dy] = [clientX - pressed.x, clientY - pressed.y];
    pressed.moved ||= Math.hypot(dx, dy) > still;
    if (pressed.moved && pressed.drag) this.editor.preview(pressed.drag(dx, dy));
  }

  up() {
    const { pressed, editor } = this;
    if (!pressed) return;
    if (!pressed.moved) this.select(pressed.region);
    else if (pressed.drag) editor.commit(editor.document, `${this.selected} moved`);
    this.end();
  }

  end() {
    if (this.pressed?.drag && this.editor.passing) this.editor.preview(null);
    this.editor.view.controls.enabled = true;
    this.pressed = null;
  }
}
