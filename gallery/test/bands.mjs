// SPDX-License-Identifier: Apache-2.0
// Bands of detail, and mirrored faces, on the pages: opens the gallery of a crowd that has two bands, build
// and skin, and `sampling: {mirror: drawn}`, and the running `crowdface edit` of the same config.
//   node bands.mjs GALLERY_FOLDER ADDRESS RESULT_JSON
// Writes the face that it saves to RESULT_JSON; the last line says "all right".
import assert from 'node:assert/strict';
import { writeFileSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import { openPage } from './open_page.mjs';

const [gallery, address, resultFile] = process.argv.slice(2);
if (!resultFile) throw new Error('usage: node bands.mjs GALLERY_FOLDER ADDRESS RESULT_JSON');

const { browser, page, problems, settled } = await openPage();

// The gallery: each region's numbers stand there band by band, and a mirrored face says so.
await page.goto(pathToFileURL(join(resolve(gallery), 'index.html')).href);
await page.waitForSelector('.cell');
const faces = await page.evaluate(() => window.crowdface.page.crowd.faces.map(({ id, mirrored }) => ({ id, mirrored })));
const regions = await page.evaluate(() => window.crowdface.page.crowd.regions);
const image = faces.find(({ mirrored }) => mirrored);
const plain = faces.find(({ mirrored }) => !mirrored);
assert.ok(image && plain, 'some faces are mirrored and some are not');
for (const { id, mirrored } of [image, plain]) {
  await page.locator(`.cell[data-id="${id}"]`).click();
  await page.keyboard.press('Enter');
  await page.waitForFunction((name) => document.querySelector('main.face h1')?.textContent === name, id);
  const bands = await page.locator('main.face .region h4.band').allTextContents();
  assert.deepEqual(bands, regions.flatMap(() => ['build', 'skin']));
  assert.equal(await page.locator('main.face dt', { hasText: 'Mirrored' }).count(), mirrored ? 1 : 0);
  await page.keyboard.press('Escape');
  await page.waitForSelector('main.all:not([hidden])');
}
await page.keyboard.press('m');
await page.waitForSelector('.panels');
assert.equal(await page.locator('.panels figure').count(), 2 * regions.length, 'a plane for each band of each region');

// The editor: what is moved in one band leaves the other, in one region alone.
const editor = (ask) => page.evaluate((text) => new Function('editor', `return ${text}`)(window.crowdface.editor), ask);
const recipe = () => editor('editor.document.recipe');
await page.goto(address);
await page.waitForSelector('.board');
await settled();
const [region, other] = await editor('editor.job.regions.map((r) => r.name)');
const { skin, ...build } = await page.evaluate(([name]) => {
  const { bands, ...own } = window.crowdface.editor.document.recipe.regions[name];
  return { ...own, skin: bands.skin };
}, [region]);
const untouched = (await recipe()).regions[other];
for (const band of ['build', 'skin']) assert.equal(await page.locator(`button[data-band="${band}"]`).count(), 1);
const strength = page.getByLabel(`Strength of ${region}, typed`);

await page.locator('button[data-band="skin"]').click();
await page.waitForFunction(() => document.querySelector('button[data-band="skin"]').getAttribute('aria-pressed') === 'true');
await strength.fill('1.4');
await strength.press('Enter');
await settled();
const finer = (await recipe()).regions[region];
assert.equal(finer.bands.skin.extrapolation, 1.4);
assert.deepEqual(finer.bands.skin.position, skin.position);
const { bands: ignored, ...stillBuild } = finer;
assert.deepEqual(stillBuild, build, 'the build stays');

await page.locator('button[data-band="build"]').click();
await page.waitForFunction(() => document.querySelector('button[data-band="build"]').getAttribute('aria-pressed') === 'true');
await strength.fill('0.8');
await strength.press('Enter');
await settled();
const coarser = (await recipe()).regions[region];
assert.equal(coarser.extrapolation, 0.8);
assert.deepEqual(coarser.bands, finer.bands, 'the skin stays');
assert.deepEqual((await recipe()).regions[other], untouched, 'other regions stay');

// A mirrored face of the crowd stays mirrored, and says so.
for (let i = 0; !(await recipe()).mirrored; i += 1) {
  assert.ok(i < faces.length, 'a mirrored face of the crowd can be opened');
  await page.keyboard.press('Escape');
  await page.keyboard.press(']');
  await settled();
}
assert.equal(await page.locator('.mirrored').innerText(), 'mirrored');
await strength.fill('1.1');
await strength.press('Enter');
await settled();
const told = await editor('editor.wire()');
assert.equal(told.mirrored, true);
await page.locator('.toolbar .name').fill('an_image');
await page.locator('.toolbar .name').press('Enter');
await settled();
await page.getByLabel('Format of the mesh').selectOption('obj');
await page.keyboard.press('Escape');
await page.keyboard.press('Control+s');
await page.waitForFunction(() => /^Saved: /.test(document.querySelector('.message').textContent));
const exact = await editor('Array.from(editor.exactFace.positions)');
writeFileSync(resultFile, JSON.stringify({ recipe: await editor('editor.wire()'), points: exact }));

assert.deepEqual(problems, []);
await browser.close();
console.log('all right');
