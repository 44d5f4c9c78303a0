// SPDX-License-Identifier: Apache-2.0
// How many pixels of a 3D view what the face wears changes, left and right of the middle, and how many of the left are red.
export function wornPixels(view) {
  const { node } = view.worn;
  const size = 128;
  const take = (visible) => {
    node.visible = visible;
    view.draw();
    const canvas = document.createElement('canvas');
    canvas.width = size;
    canvas.height = size;
    const context = canvas.getContext('2d');
    context.drawImage(view.node, 0, 0, size, size);
    return context.getImageData(0, 0, size, size).data;
  };
  const bare = take(false);
  const dressed = take(true);
  const found = { left: 0, right: 0, red: 0 };
  for (let i = 0; i < bare.length; i += 4) {
    const change = Math.max(...[0, 1, 2].map((c) => Math.abs(bare[i + c] - dressed[i + c])));
    if (change <= 12) continue;
    const isLeft = (i / 4) % size < size / 2;
    found[isLeft ? 'left' : 'right'] += 1;
    if (isLeft && dressed[i] > 2 * dressed[i + 1]) found.red += 1;
  }
  return found;
}
