// SPDX-License-Identifier: Apache-2.0
// Makes a picture of the editor's views.
const backdrop = ['#83868a', '#46484c']; // colours of the views' background, from top to bottom, as in program_page.css

/// \param editor  stage, view, beside, photo
/// \return        a canvas with photo, face and second face as on the page, drawn in full
export function photograph({ stage, view, beside, photo }) {
  const own = stage.getBoundingClientRect();
  const stages = [stage, beside.stage, photo.stage].map((node) => node.getBoundingClientRect());
  const width = Math.max(...stages.map(({ right }) => right)) - own.left; // hidden stages have an empty box
  const picture = document.createElement('canvas');
  [picture.width, picture.height] = [Math.floor(view.fullRatio * width), Math.floor(view.fullRatio * own.height)];
  const context = picture.getContext('2d');
  context.scale(picture.width / width, picture.height / own.height);
  const behind = context.createLinearGradient(0, 0, 0, own.height);
  backdrop.forEach((colour, end) => behind.addColorStop(end, colour));
  context.fillStyle = behind;
  context.fillRect(0, 0, width, own.height);
  photo.paint(context, own.left);
  for (const one of beside.on ? [view, beside.view] : [view]) {
    const box = one.node.parentElement.getBoundingClientRect();
    one.drawInFull();
    context.globalAlpha = Number(one.node.style.opacity || 1);
    context.drawImage(one.node, box.left - own.left, 0, box.width, box.height);
  }
  return picture;
}
