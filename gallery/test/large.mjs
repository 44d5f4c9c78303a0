// SPDX-License-Identifier: Apache-2.0
// The gallery of a crowd in numbered subfolders, opened from disk: faces come a page at a time, recipes as
// they are asked for. The crowd has nine faces, three a folder, and a family of two.
//   node large.mjs GALLERY_FOLDER REVIEW_FILE [PICTURES_FOLDER]
// Writes the exported review to REVIEW_FILE; the last line says "all right".
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import { openPage } from './open_page.mjs';

const [folder, reviewFile, pictures] = process.argv.slice(2);
if (!reviewFile) throw new Error('usage: node large.mjs GALLERY_FOLDER REVIEW_FILE [PICTURES]');
const { browser, page, problems, take } = await openPage({ width: 1440, height: 900, pictures, own: 'file:' });

const plan = readFileSync(join(folder, '../plan.jsonl'), 'utf8').trim().split('\n').map((line) => JSON.parse(line));
const likeness = JSON.parse(readFileSync(join(folder, '../likeness.json'), 'utf8'));
const all = plan.map((face) => face.id);
const ids = () => page.$$eval('.cell', (cells) => cells.map((cell) => cell.dataset.id));
const selected = () => page.locator('.cell.selected').getAttribute('data-id');
const loaded = () => page.evaluate(() => Object.keys(window.crowdface.pages).map(Number));
const opened = (id) => page.waitForFunction(
  (name) => document.querySelector('main.face:not([hidden]) h1')?.textContent === name, id);

await page.goto(pathToFileURL(join(resolve(folder), 'index.html')).href);
await page.waitForSelector('.cell');

// Three faces a page; no recipe is there yet.
assert.equal(all.length, 9);
assert.deepEqual(await ids(), all.slice(0, 3));
assert.equal(await page.locator('.pages span').textContent(), '1 to 3 of 9');
assert.deepEqual(await loaded(), []);
await page.locator('.cell img').first().evaluate((image) => image.decode());
await take('large_faces');
assert.ok(await page.locator('.pages button').first().isDisabled());
await page.getByRole('button', { name: 'Later' }).click();
assert.deepEqual(await ids(), all.slice(3, 6));
await page.locator('.cell img').nth(2).evaluate((image) => image.decode());

// Keys walk from page to page.
await page.locator('.summary').click();
await page.keyboard.press('End');
assert.equal(await selected(), all[8]);
assert.deepEqual(await ids(), all.slice(6));
await page.keyboard.press('Home');
for (let step = 0; step < 3; step += 1) await page.keyboard.press('ArrowRight');
assert.equal(await selected(), all[3]);
assert.deepEqual(await ids(), all.slice(3, 6));

// Filters and orders know every face.
const order = async (name) => {
  await page.selectOption('select[name=sort]', name);
  const faces = await page.evaluate(() => window.crowdface.page.faces.map((face) => face.id));
  assert.deepEqual(await ids(), faces.slice(0, 3));
  return faces;
};
assert.deepEqual(await order('likeness'), likeness.order);
const near = (id) => Object.values(likeness.nearest[id])[0];
assert.deepEqual((await order('distance')).map(near), all.map(near).sort((a, b) => a - b));
const head = (id) => plan.find((face) => face.id === id).nearest.face_mm;
assert.deepEqual((await order('head')).map(head), all.map(head).sort((a, b) => a - b));
await order('plan');
await page.selectOption('select[name=target]', plan[4].target);
assert.deepEqual(await page.evaluate(() => window.crowdface.page.faces.map((face) => face.id)),
  plan.filter((face) => face.target === plan[4].target).map((face) => face.id));
await page.selectOption('select[name=target]', '');
await page.selectOption('select[name=family]', 'smith');
assert.deepEqual(await ids(), all.filter((id) => id.startsWith('mob_smith')));
assert.ok(!await page.locator('.pages').isVisible());
await page.selectOption('select[name=family]', '');
assert.deepEqual(await loaded(), [], 'nothing of that needs recipes');

// A face: its recipe comes with its page of them, its mesh from its subfolder.
await page.fill('input[type=search]', all[5]);
assert.deepEqual(await ids(), [all[5]]);
await page.locator('.cell').dblclick();
await opened(all[5]);
assert.deepEqual(await loaded(), [1]);
const recipe = await page.locator('main.face').innerText();
assert.match(recipe, new RegExp(`Nearest head\\s+${plan[5].nearest.face}, `));
assert.deepEqual(await page.locator('main.face .neighbour b').allTextContents(),
  Object.keys(likeness.nearest[all[5]]).map((id) => id.replace(/^mob_/, '')));
await page.waitForFunction((id) => window.crowdface.page.face.turntable?.shown === id, all[5]);
await page.keyboard.press('c');
const nearest = Object.keys(likeness.nearest[all[5]])[0];
await page.waitForFunction((id) => window.crowdface.page.face.turntable.shown === id, nearest);
await take('large_face');
await page.keyboard.press('r');
await page.fill('textarea', 'too round');
await page.keyboard.press('Escape');
const [first] = await page.locator('main.face .neighbour').all();
await first.click();
await opened(nearest);
await page.keyboard.press('Escape');
await page.waitForSelector('main.all:not([hidden])');
await page.fill('input[type=search]', '');

// Sisters and brothers are known without their recipes.
await page.locator(`.cell[data-id="${all[0]}"]`).dblclick();
await opened('mob_smith_01');
assert.match(await page.locator('main.face .tree').innerText(), /smith_02/);
await page.keyboard.press('Escape');
await page.waitForSelector('main.all:not([hidden])');

// The plane, a face by its address, and the review.
await page.keyboard.press('m');
await page.waitForSelector('.panels');
assert.equal(await page.locator('.dot').count(), plan.filter((face) => face.regions.all.position).length);
await page.locator('.dot').first().hover({ force: true });
await take('large_plane');
await page.goto(`${pathToFileURL(join(resolve(folder), 'index.html')).href}#/face/${all[8]}`);
await page.reload();
await opened(all[8]);
assert.deepEqual(await loaded(), [2]);
await page.keyboard.press('Escape');
const download = page.waitForEvent('download');
await page.click('.export');
await (await download).saveAs(reviewFile);
assert.match(readFileSync(reviewFile, 'utf8'), new RegExp(`^  ${all[5]}: \\{mark: reject, note: "too round"\\}$`, 'm'));

assert.deepEqual(problems, []);
await browser.close();
console.log('all right');
