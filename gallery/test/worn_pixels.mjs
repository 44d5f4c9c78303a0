// SPDX-License-Identifier: Apache-2.0
// How many pixels of a 3D view what the face wears changes, left and right of the middle, and how many of the left are red.
// While a view moves, its resolution follows its speed: only pictures of one resolution are compared.
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
    return { width: view.node.width, data: context.getImageData(0, 0, size, size).data };
  };
  let [without, with_] = [take(false), take(true)];
  while (without.width !== with_.width) [without, with_] = [take(false), take(true)];
  const [bare, dressed] = [without.data, with_.data];
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
