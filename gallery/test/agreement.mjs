// SPDX-License-Identifier: Apache-2.0
// How far faces in the gallery's 3D view, and in the editor if there is an address, differ in colour from the same
// faces in the sheet's renders: the mean colours of the middle of the face, as CIE76 ΔE; and how well
// wrinkles of the forehead are seen.
//   node agreement.mjs GALLERY_FOLDER COUNT MOST [PICTURES_FOLDER] [EDITOR_ADDRESS]
// Prints each face's difference and fails if one is above MOST. Writes both pictures of each face side by side. The
// last line says "all right".
import assert from 'node:assert/strict';
import { mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import { openPage } from './open_page.mjs';

const [folder, count, most, pictures, address] = process.argv.slice(2);
if (!most) throw new Error('usage: node agreement.mjs GALLERY_FOLDER COUNT MOST [PICTURES] [ADDRESS]');

const { browser, page, problems, rested } = await openPage({ width: 1440, height: 900 });
await page.goto(pathToFileURL(join(resolve(folder), 'index.html')).href);
await page.waitForSelector('.cell');
const provideCompare = () => page.evaluate(() => {
  const pixels = (source, size) => {
    const canvas = document.createElement('canvas');
    [canvas.width, canvas.height] = [size, size];
    const context = canvas.getContext('2d', { willReadFrequently: true });
    context.drawImage(source, 0, 0);
    return context.getImageData(0, 0, size, size).data;
  };
  /// The columns and the first row of what stands before the background: in the sheet rows of one colour, in the
  /// 3D view nothing.
  const boxOf = (data, size, isSheet) => {
    const box = { left: size, right: 0, top: size };
    for (let y = 0; y < size; y += 1) {
      for (let x = 0; x < size; x += 1) {
        const at = 4 * (y * size + x);
        const beside = 4 * y * size;
        const differs = isSheet ? [0, 1, 2].some((c) => Math.abs(data[at + c] - data[beside + c]) > 14) : data[at + 3] > 128;
        if (!differs) continue;
        box.top = Math.min(box.top, y);
        box.left = Math.min(box.left, x);
        box.right = Math.max(box.right, x);
      }
    }
    return box;
  };
  const labOf = (data, at) => {
    const [r, g, b] = [0, 1, 2].map((c) => {
      const value = data[at + c] / 255;
      return value <= 0.04045 ? value / 12.92 : ((value + 0.055) / 1.055) ** 2.4;
    });
    const f = (value) => (value > 0.008856 ? Math.cbrt(value) : 7.787 * value + 16 / 116);
    const x = f((0.4124 * r + 0.3576 * g + 0.1805 * b) / 0.9505);
    const y = f(0.2126 * r + 0.7152 * g + 0.0722 * b);
    const z = f((0.0193 * r + 0.1192 * g + 0.9505 * b) / 1.089);
    return [116 * y - 16, 500 * (x - y), 200 * (y - z)];
  };
  let camera = null; // of the sheet, one for all faces
  window.compare = async (address) => {
    const sheet = new Image();
    sheet.src = address;
    await sheet.decode();
    const size = sheet.height;
    const turntable = window.crowdface.editor?.view ?? window.crowdface.page.face.turntable;
    turntable.renderer.setPixelRatio(1);
    turntable.renderer.setSize(size, size, false);
    turntable.camera.aspect = 1;
    turntable.camera.updateProjectionMatrix();
    const look = ({ distance, x, y }) => {
      turntable.controls.target.set(x, y, 0);
      turntable.camera.position.set(x, y, distance);
      turntable.controls.update();
      turntable.draw();
      return pixels(turntable.node, size);
    };
    const wanted = pixels(sheet, size);
    const box = boxOf(wanted, size, true);
    if (!camera) {
      camera = { distance: 6.4, x: 0, y: 0 };
      for (let round = 0; round < 4; round += 1) {
        const found = boxOf(look(camera), size, false);
        camera.distance *= (found.right - found.left) / (box.right - box.left);
        const unit = (2 * camera.distance * Math.tan(Math.PI / 18)) / size;
        camera.x += ((found.left + found.right - box.left - box.right) / 2) * unit;
        camera.y -= (found.top - box.top) * unit;
      }
    }
    const shown = look(camera);
    const [middle, wide] = [(box.left + box.right) / 2, box.right - box.left];
    const sums = [[0, 0, 0], [0, 0, 0]];
    let places = 0;
    for (let at = 0; at < shown.length; at += 4) {
      const [x, y] = [(at / 4) % size, Math.floor(at / 4 / size)];
      const across = (x - middle) / (0.24 * wide);
      const down = (y - box.top - 0.78 * wide) / (0.36 * wide);
      if (across * across + down * down > 1 || shown[at + 3] < 250) continue;
      [wanted, shown].forEach((data, k) => labOf(data, at).forEach((value, c) => { sums[k][c] += value; }));
      places += 1;
    }
    /// How much neighbours above each other differ on the forehead, where wrinkles run across.
    const wrinkles = [wanted, shown].map((data) => {
      let [sum, count] = [0, 0];
      for (let y = Math.round(box.top + 0.36 * wide); y < box.top + 0.56 * wide; y += 1) {
        for (let x = Math.round(middle - 0.14 * wide); x < middle + 0.14 * wide; x += 1) {
          const [above, here, below] = [y - 1, y, y + 1].map((row) => labOf(data, 4 * (row * size + x))[0]);
          sum += Math.abs(2 * here - above - below);
          count += 1;
        }
      }
      return sum / count;
    });
    const means = sums.map((sum) => sum.map((value) => value / places));
    const both = document.createElement('canvas');
    [both.width, both.height] = [2 * size, size];
    const context = both.getContext('2d');
    context.drawImage(sheet, 0, 0);
    context.clearRect(size, 0, size, size);
    context.drawImage(turntable.node, size, 0);
    return { means, wrinkles, difference: Math.hypot(...means[0].map((value, c) => value - means[1][c])), both: both.toDataURL() };
  };
});
/// Pixels of the skin that what lies behind it to close its cracks makes much darker: pinholes.
const countPinholes = () => page.evaluate(() => {
  const { view } = window.crowdface.editor;
  view.view('three_quarter');
  view.nearer(0.6);
  view.worn.node.visible = false;
  const [bare, own] = [false, true].map((visible) => {
    view.draft.node.visible = visible;
    view.drawCheaply(false);
    const context = new OffscreenCanvas(view.node.width, view.node.height).getContext('2d');
    context.drawImage(view.node, 0, 0);
    return context.getImageData(0, 0, view.node.width, view.node.height).data;
  });
  view.worn.node.visible = true;
  const light = (data, i) => data[i] + data[i + 1] + data[i + 2];
  let count = 0;
  for (let i = 0; i < own.length; i += 4) if (bare[i + 3] === 255 && light(own, i) < light(bare, i) - 90) count += 1;
  return count;
});
const ids = await page.evaluate((n) => window.crowdface.page.crowd.faces.slice(0, n).map(({ id }) => id), Number(count));
/// \param show  shows a face of an id
async function compareAll(where, show) {
  await provideCompare();
  const differences = [];
  const seen = [0, 0];
  for (const id of ids) {
    await show(id);
    const render = readFileSync(join(folder, '..', 'renders', `${id}.png`)).toString('base64');
    const { means, wrinkles, difference, both } = await page.evaluate((url) => window.compare(url), `data:image/png;base64,${render}`);
    differences.push(difference);
    wrinkles.forEach((value, k) => { seen[k] += value; });
    console.log(`${id}: ΔE ${difference.toFixed(2)}; sheet ${means[0].map((v) => v.toFixed(1))}, page ${means[1].map((v) => v.toFixed(1))}; wrinkles ${wrinkles.map((v) => v.toFixed(2))}`);
    if (!pictures) continue;
    mkdirSync(pictures, { recursive: true });
    writeFileSync(join(pictures, `${where}_${id}.png`), Buffer.from(both.split(',')[1], 'base64'));
  }
  const mean = differences.reduce((a, b) => a + b, 0) / ids.length;
  console.log(`ΔE of ${ids.length} faces in the ${where}: mean ${mean.toFixed(2)}, most ${Math.max(...differences).toFixed(2)}`);
  assert.ok(differences.every((difference) => difference <= Number(most)), `a face differs by more than ΔE ${most}`);
  assert.ok(seen[1] > 0.65 * seen[0], `wrinkles have ${(seen[1] / seen[0]).toFixed(2)} of the sheet's contrast`);
}
await compareAll('gallery', async (id) => {
  await page.evaluate((name) => { location.hash = `#/face/${name}`; }, id);
  await page.waitForFunction((name) => window.crowdface.page.face.turntable?.shown === name, id);
  await rested();
});
if (address) {
  await page.goto(address);
  await page.waitForFunction(() => window.crowdface?.editor?.ready && window.crowdface.editor.view.skin);
  await compareAll('editor', async (id) => {
    await page.getByLabel('Open a face').selectOption(`face ${id}`);
    await page.waitForFunction((name) => { // until its own skin and what it wears are there
      const { editor: it } = window.crowdface;
      return it.document.face === name && !it.pending && it.exactOf === it.document && it.skinOf?.document === it.document && !it.skin.running && it.view.worn.node.visible && !it.exactFace.bare;
    }, id);
    await page.waitForTimeout(500);
    await rested();
  });
  const pinholes = await countPinholes();
  console.log(`${pinholes} pixels of pinholes`);
  assert.ok(pinholes < 5, `${pinholes} pixels of pinholes`);
}
assert.deepEqual(problems, []);
await browser.close();
console.log('all right');
