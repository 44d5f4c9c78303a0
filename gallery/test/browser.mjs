// SPDX-License-Identifier: Apache-2.0
// Opens a crowd's gallery from disk in a headless Chromium and uses it as people do.
//   node browser.mjs GALLERY_FOLDER REVIEW_FILE [PICTURES_FOLDER]
// Writes the exported review to REVIEW_FILE; the last line says "all right".
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import { fine, openPage } from './open_page.mjs';
import { wornPixels } from './worn_pixels.mjs';

const [folder, reviewFile, pictures] = process.argv.slice(2);
if (!reviewFile) throw new Error('usage: node browser.mjs GALLERY_FOLDER REVIEW_FILE [PICTURES]');
const address = pathToFileURL(join(resolve(folder), 'index.html')).href;

const { browser, page, problems, take, audit, rested, stillPicture, alike } = await openPage({ width: 1440, height: 900, pictures, own: 'file:' });

const count = (selector) => page.locator(selector).count();
const ids = () => page.$$eval('.cell', (cells) => cells.map((cell) => cell.dataset.id));
const marks = () => page.evaluate(() => Object.fromEntries(window.crowdface.page.review.marks));

/// Exports the review. \return  its text
const exported = async () => {
  const download = page.waitForEvent('download');
  await page.keyboard.press('e');
  await (await download).saveAs(reviewFile);
  return readFileSync(reviewFile, 'utf8');
};

/// How many different shades the 3D view shows: none is blank.
const shades = () => page.evaluate(() => {
  const { turntable } = window.crowdface.page.face;
  turntable.draw();
  const canvas = document.createElement('canvas');
  canvas.width = 64;
  canvas.height = 64;
  const context2d = canvas.getContext('2d');
  context2d.drawImage(turntable.node, 0, 0, 64, 64);
  const { data } = context2d.getImageData(0, 0, 64, 64);
  const seen = new Set();
  let sum = 0;
  for (let i = 0; i < data.length; i += 4) {
    seen.add(data[i] + 256 * data[i + 1]);
    sum += data[i] * ((i / 4) % 64);
  }
  return { colours: seen.size, sum };
});

// Load.
const began = Date.now();
await page.goto(address);
await page.waitForSelector('.cell');
console.log(`opened in ${Date.now() - began} ms`);
const all = await ids();
const crowd = await page.evaluate(() => {
  const { name, regions, faces, targets } = window.crowdface.page.crowd;
  return { name, regions, targets, faces: faces.map(({ id, target, family, byHand, order }) => ({ id, target, family, byHand, order })) };
});
assert.equal(all.length, crowd.faces.length);
assert.ok(all.length >= 6, 'a crowd of at least six faces is needed');
await page.locator('.cell img').first().evaluate((image) => image.decode());
await take('faces');

// Filter, search, sort.
await page.selectOption('select[name=target]', crowd.targets[0]);
const wanted = crowd.faces.filter((face) => face.target === crowd.targets[0]).map((face) => face.id);
assert.deepEqual(await ids(), wanted);
await page.selectOption('select[name=target]', '');
await page.keyboard.press('Escape');
const drawn = crowd.faces.filter((face) => !face.byHand).map((face) => face.id);
await page.fill('input[type=search]', drawn[2]);
assert.deepEqual(await ids(), all.filter((id) => id.includes(drawn[2])));
await page.fill('input[type=search]', 'nobody is called this');
assert.equal(await count('.cell'), 0);
await page.fill('input[type=search]', '');
// By a measurement: order, filter, histogram with the heads.
const widths = await page.evaluate(() => Object.fromEntries(window.crowdface.page.crowd.faces.map((face) =>
  [face.id, face.traits.nose_width])));
const byWidth = Object.keys(widths).sort((a, b) => widths[a] - widths[b]);
await page.selectOption('select[name=sort]', '+nose_width');
assert.deepEqual(await ids(), byWidth);
await page.fill('input[data-end=from]', String(widths[byWidth[3]]));
assert.deepEqual(await ids(), byWidth.slice(3));
await page.fill('input[data-end=from]', '');
assert.deepEqual(await ids(), byWidth);
assert.equal(await count('.histogram .heads'), await page.evaluate(() => window.crowdface.page.crowd.heads.length));
await page.selectOption('select[name=sort]', 'plan');
for (const order of ['distance', 'likeness', 'id']) {
  await page.selectOption('select[name=sort]', order);
  assert.deepEqual((await ids()).sort(), [...all].sort(), `order ${order} loses faces`);
}
await page.selectOption('select[name=sort]', 'distance');
const distances = await page.evaluate(() => window.crowdface.page.faces.map((face) => face.near[0].mm));
assert.deepEqual(distances, [...distances].sort((a, b) => a - b));
await page.selectOption('select[name=sort]', 'plan');

// Walk and mark with the keys.
await page.locator('.summary').click();
await page.keyboard.press('End');
assert.equal(await page.locator('.cell.selected').getAttribute('data-id'), all.at(-1));
await page.keyboard.press('Home');
await page.keyboard.press('ArrowRight');
assert.equal(await page.locator('.cell.selected').getAttribute('data-id'), all[1]);
await page.locator(`.cell[data-id="${drawn[0]}"]`).click();
await page.keyboard.press('k');
await page.locator(`.cell[data-id="${drawn[1]}"]`).click();
await page.keyboard.press('r');
assert.equal((await marks())[drawn[0]].verdict, 'keep');
assert.equal((await marks())[drawn[1]].verdict, 'reject');
await page.keyboard.press('r'); // takes it back
assert.equal((await marks())[drawn[1]], undefined);
await page.keyboard.press('r');

// Open one, turn it.
await page.locator(`.cell[data-id="${drawn[2]}"]`).click();
await page.keyboard.press('Enter');
await page.waitForFunction(() => window.crowdface.page.face.turntable?.shown !== undefined);
await rested();
const front = await shades();
assert.ok(front.colours > 50, `the 3D view shows ${front.colours} colours`);
assert.ok(!(await page.locator('main.face').innerText()).includes('[object'), 'raw objects on the page');
await take('face');
// Its skin has a picture of its own, where its vertices have nothing but the light that reaches them; the rest has colours.
const skin = await page.evaluate(() => {
  const { materials, object: { geometry: { groups, index, attributes: { color } } } } = window.crowdface.page.face.turntable;
  return groups.map(({ start, count, materialIndex }) => ({
    size: materials[materialIndex].map?.image.width,
    grey: Array.from(index.array.slice(start, start + count)).every((v) => (
      color.getX(v) === color.getY(v) && color.getX(v) === color.getZ(v))),
  }));
});
assert.deepEqual(skin, [{ size: 256, grey: true }, { size: undefined, grey: false }]);
const bare = await page.evaluate(() => {
  const { turntable } = window.crowdface.page.face;
  const [material] = turntable.materials;
  const { map } = material;
  const redraw = (to) => Object.assign(material, { map: to, needsUpdate: true }) && turntable.draw();
  redraw(null);
  const image = turntable.node.toDataURL();
  redraw(map);
  return image !== turntable.node.toDataURL();
});
assert.ok(bare, 'the picture is seen');
// What the face wears: red on the left, and where its picture has a hole nothing.
const card = await page.evaluate(`(${wornPixels})(window.crowdface.page.face.turntable)`);
assert.ok(card.left > 100 && card.red > 0.9 * card.left && card.right < 0.3 * card.left, JSON.stringify(card));
assert.match(await page.locator('main.face').innerText(), /Wears\s+card, tuft/);
// An expression: its slider moves what the shape moves, with its shading, and nothing else.
const geometry = () => page.evaluate(() => {
  const { position, normal } = window.crowdface.page.face.turntable.object.geometry.attributes;
  return { points: Array.from(position.array), normals: Array.from(normal.array) };
});
const worn = () => page.evaluate(() => window.crowdface.page.face.turntable.worn.node.children.map(
  (part) => Array.from(part.children[0].geometry.attributes.position.array)));
const atRest = await geometry();
const wornAtRest = await worn();
await page.getByLabel('browUp').fill('1');
const acting = await geometry();
const far = atRest.points.map((value, i) => Math.abs(value - acting.points[i]));
assert.ok(Math.max(...far) > 0.3 && Math.max(...far) < 0.8, `moved by up to ${Math.max(...far)} cm`);
assert.ok(far.filter((value) => value > 0).length < far.length / 3, 'most of the face stays');
assert.notDeepEqual(acting.normals, atRest.normals);
const [still, tuft] = await worn();
assert.deepEqual(still, wornAtRest[0], 'what is rigid stays');
const upBy = tuft.map((value, i) => value - wornAtRest[1][i]).filter((_, i) => i % 3 === 1);
assert.ok(upBy.length === 3 && upBy.every((up) => up > 0.3 && up < 0.8), `a tuft of the brow goes along: ${upBy}`);
await page.getByLabel('browUp').press('ArrowLeft');
assert.ok(Math.abs(Number(await page.getByLabel('browUp').inputValue()) - 0.99) < 1e-9, 'arrows move the slider, not the page');
await take('expression');
await page.getByRole('button', { name: 'At rest' }).click();
assert.deepEqual(await geometry(), atRest);
await page.locator('main.face h1').click();
for (const width of [700, 900]) {
  await page.setViewportSize({ width, height: 700 });
  const picture = await page.locator('.box').boundingBox();
  const verdicts = await page.locator('.verdicts').boundingBox();
  assert.ok(verdicts.x >= picture.x + picture.width, `Keep and Reject stand beside the picture at ${width} pixels`);
}
await page.setViewportSize({ width: 1440, height: 900 });
const box = await page.locator('.turntable').boundingBox();
await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
await page.mouse.down();
await page.mouse.move(box.x + box.width / 2 - 160, box.y + box.height / 2 + 20, { steps: 8 });
await page.mouse.up();
const angle = await page.evaluate(() => window.crowdface.page.face.turntable.angle());
assert.ok(Math.abs(angle) > 15, `dragging turned by ${angle} degrees`);
assert.notEqual((await shades()).sum, front.sum, 'turning changes the picture');
await take('turned');
await page.keyboard.press('t');
await page.waitForFunction(() => window.crowdface.page.face.turntable.shown.startsWith('head '));
await page.keyboard.press('t');

// Another face stands beside the face, seen by the same camera.
const [ownView, otherView] = ['.stage:not(.other)', '.stage.other'].map((part) => page.locator(`.box ${part} .turntable`));
await page.keyboard.press('f');
await page.keyboard.press('s');
await page.waitForFunction(() => window.crowdface.page.face.otherTable?.shown?.startsWith('head '));
const [leftBox, rightBox] = [await ownView.boundingBox(), await otherView.boundingBox()];
assert.ok(leftBox.x + leftBox.width <= rightBox.x + 1 && Math.abs(leftBox.width - rightBox.width) < 3, 'two halves');
const [ownFront, targetFront] = [await stillPicture(ownView), await stillPicture(otherView)];
await take('side_by_side');
await page.keyboard.press('.');
assert.ok(!(await alike(await stillPicture(ownView), ownFront)) && !(await alike(await stillPicture(otherView), targetFront)), 'both turn');
await page.keyboard.press('f');
assert.ok(await alike(await stillPicture(otherView), targetFront) && await alike(await stillPicture(ownView), ownFront), 'and back');
await page.keyboard.press('c');
await page.waitForFunction(() => !window.crowdface.page.face.otherTable.shown.startsWith('head '));
assert.ok(!(await alike(await stillPicture(otherView), targetFront)), 'another face is another picture');
assert.ok(await alike(await stillPicture(ownView), ownFront), 'the face itself stays');
await page.keyboard.press('s');
assert.ok(await otherView.isHidden());

// A lock that is taken back leaves the mark as it was.
if (crowd.regions.length > 1) {
  const lock = page.locator('.locks button').first();
  await lock.click();
  assert.equal((await marks())[drawn[2]].verdict, 'reject');
  await lock.click();
  assert.equal((await marks())[drawn[2]], undefined, 'neither locked nor rejected');
  assert.doesNotMatch(await exported(), new RegExp(`^  ${drawn[2]}:`, 'm'), 'nor named in the exported review');
  await page.keyboard.press('k');
  await lock.click();
  await lock.click();
  assert.equal((await marks())[drawn[2]].verdict, 'keep');
  await page.keyboard.press('k');
}

// Mark it: lock a region where there are several, and a note that needs care in YAML.
if (crowd.regions.length > 1) await page.keyboard.press('1');
else await page.keyboard.press('r');
const note = 'too like "0007": chin, #2 {nose} \\ é — ok?';
await page.fill('textarea', note);
await page.keyboard.press('Escape');
const mark = (await marks())[drawn[2]];
assert.equal(mark.note, note);
assert.deepEqual(mark.lock, crowd.regions.length > 1 ? [crowd.regions[0]] : undefined);
await take('marked');
await page.keyboard.press('ArrowRight');
await page.waitForFunction((id) => document.querySelector('main.face h1').textContent === id, all[all.indexOf(drawn[2]) + 1]);
await page.locator('.neighbour').first().click();
await page.goBack();
await page.keyboard.press('Escape');
await page.waitForSelector('main.all:not([hidden])');

// The plane.
await page.keyboard.press('m');
await page.waitForSelector('.panels');
assert.equal(await count('.panels figure'), Math.max(1, crowd.regions.length));
assert.ok(await count('.dot') >= drawn.length);
await page.locator('.dot').first().hover({ force: true });
await take('plane');
await page.keyboard.press('g');

// Reload: marks stay.
await page.reload();
await page.waitForSelector('.cell');
assert.equal((await marks())[drawn[2]].note, note);
await page.selectOption('select[name=mark]', 'reject');
assert.deepEqual(await ids(), [drawn[1], drawn[2]]);
await page.selectOption('select[name=mark]', 'any');
await take('after_reload');

// Changes: older, and a variant of the face that was open before.
const older = page.locator('.change', { hasText: 'Older' });
const open = async (id) => {
  await page.evaluate((to) => { location.hash = `#/face/${to}`; }, id);
  await page.waitForFunction((to) => document.querySelector('main.face h1').textContent === to, id);
};
const sampled = crowd.faces.filter((face) => !face.byHand && face.family === null).map((face) => face.id);
const [aged, similar] = sampled.slice(-2);
await open(aged);
await older.click();
await open(similar);
await page.locator('.change', { hasText: 'Variant of' }).click();
assert.equal((await marks())[similar].change.variant_of, aged);
await page.keyboard.press('Escape');
await page.waitForSelector('main.all:not([hidden])');

// Everything has its tooltip and a name, is legible, and is within reach in small windows.
for (const [width, height] of [[1440, 900], [1280, 720], [1024, 768], [853, 600], [390, 844]]) {
  await page.setViewportSize({ width, height });
  for (const place of ['faces', 'plane', `face/${similar}`]) {
    await page.evaluate((to) => { location.hash = `#/${to}`; }, place);
    await page.waitForTimeout(300);
    await take(`${place.split('/')[0]}_at_${width}`);
    assert.deepEqual(await audit(), fine, `${place} at ${width} pixels`);
  }
}
await page.setViewportSize({ width: 1440, height: 900 });
await page.evaluate(() => { location.hash = '#/faces'; });

const review = await exported();
assert.match(review, /^schema: 1$/m);
assert.match(review, new RegExp(`^  ${drawn[0]}: keep$`, 'm'));
assert.match(review, new RegExp(`^  ${drawn[1]}: reject$`, 'm'));
assert.match(review, /^after: \d+$/m);
assert.match(review, new RegExp(`^  ${aged}: {age: older}$`, 'm'));
assert.match(review, new RegExp(`^  ${similar}: {variant_of: ${aged}}$`, 'm'));
await page.keyboard.press('?');
await page.waitForSelector('dialog[open]');
await take('keys');
await page.keyboard.press('Escape');

assert.deepEqual(problems, []);
await browser.close();
console.log('all right');
