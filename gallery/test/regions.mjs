// SPDX-License-Identifier: Apache-2.0
// Regions that come and go on the page of a running `crowdface edit` whose config has none yet.
//   node regions.mjs ADDRESS use|again [PICTURES_FOLDER]
// `use` leaves a stroke that no mask holds; `again`, in the next editor, finds it. The last line says
// "all right".
import assert from 'node:assert/strict';
import { openPage } from './open_page.mjs';

const [address, part, pictures] = process.argv.slice(2);
if (!part) throw new Error('usage: node regions.mjs ADDRESS use|again [PICTURES]');

const { browser, page, problems, take, settled } = await openPage({ pictures, own: address });

const editor = (ask) => page.evaluate((text) => new Function('editor', `return ${text}`)(window.crowdface.editor), ask);
const names = () => editor('editor.job.regions.map((region) => region.name)');
/// How much of the preview each region has.
const shares = () => page.evaluate(() => {
  const { mesh } = window.crowdface.editor.view;
  const count = window.crowdface.editor.job.regions.length;
  const sums = new Array(count).fill(0);
  mesh.alpha.forEach((value, i) => { sums[i % count] += value; });
  return sums;
});
/// Does what makes the program open the job again, and waits for the page.
async function reopened(act) {
  await page.evaluate(() => { window.before = true; });
  await act();
  await page.waitForFunction(() => !window.before && window.crowdface?.editor?.ready);
  await settled();
}
async function paint() {
  const stage = await page.locator('.stage canvas').first().boundingBox();
  await page.mouse.move(stage.x + stage.width / 2, stage.y + stage.height / 2);
  await page.mouse.down();
  await page.mouse.move(stage.x + stage.width / 2 + 20, stage.y + stage.height / 2 + 10, { steps: 5 });
  await page.mouse.up();
  await page.waitForFunction(() => {
    const { painting } = window.crowdface.editor;
    return painting.waiting.length === 0 && !painting.sending;
  });
}
const button = (name) => page.getByRole('button', { name, exact: true });

await page.goto(address);
await page.waitForSelector('.board');
await settled();
if (part === 'use') {
  assert.deepEqual(await names(), ['all']);
  await page.keyboard.press('m');
  await button('Propose …').click();
  await page.getByLabel('ears').check();
  await take('propose');
  await reopened(() => button('Propose').click());
  assert.deepEqual(await names(), ['brow', 'nose', 'mouth', 'ears']);
  // It is a step as any other, and while the brush is out Ctrl+Z takes it back when there is no stroke.
  await reopened(() => page.keyboard.press('Control+z'));
  assert.deepEqual(await names(), ['all']);
  await reopened(() => button('Redo').click());
  assert.deepEqual(await names(), ['brow', 'nose', 'mouth', 'ears']);

  await page.waitForSelector('.painting:not([hidden])'); // as before the page was loaded again
  await button('Add …').click();
  await page.getByLabel('Name of the region').fill('cheeks');
  await reopened(() => page.keyboard.press('Enter'));
  assert.deepEqual(await names(), ['brow', 'nose', 'mouth', 'ears', 'cheeks']);
  assert.equal((await shares())[4], 0, 'a new region is nowhere');

  await page.waitForSelector('.painting:not([hidden])'); // as before the page was loaded again
  await page.locator('.painting button[data-region="cheeks"]').click();
  await paint();
  await take('painted');
  await reopened(() => button('Use masks').click());
  const painted = (await shares())[4];
  assert.ok(painted > 0, 'what was painted is in the masks');

  await page.waitForSelector('.painting:not([hidden])'); // as before the page was loaded again
  await page.locator('.painting button[data-region="cheeks"]').click();
  await page.getByLabel('Strength of cheeks, typed').fill('1.4');
  await page.getByLabel('Strength of cheeks, typed').press('Enter');
  await reopened(() => button('Remove').click());
  assert.deepEqual(await names(), ['brow', 'nose', 'mouth', 'ears']);
  await take('removed');
  await reopened(() => button('Undo').click());
  assert.deepEqual(await names(), ['brow', 'nose', 'mouth', 'ears', 'cheeks']);
  assert.equal(await page.getByLabel('Strength of cheeks, typed').inputValue(), '1.4', 'with its numbers');
  assert.ok((await shares())[4] > 0.5 * painted, 'and its mask');
  await button('Undo').click(); // the strength
  await reopened(() => button('Undo').click()); // the use of what was painted
  assert.equal((await shares())[4], 0, 'the mask from before is in use');
  await reopened(() => button('Redo').click());
  await button('Redo').click();
  await reopened(() => button('Redo').click());
  assert.deepEqual(await names(), ['brow', 'nose', 'mouth', 'ears']);
  await page.waitForSelector('.painting:not([hidden])'); // as before the page was loaded again
  await paint();
} else {
  const painted = await shares();
  await page.waitForSelector('.painting:not([hidden])');
  await button('Undo stroke').click();
  await page.waitForFunction(() => {
    const { painting } = window.crowdface.editor;
    return painting.waiting.length === 0 && !painting.sending;
  });
  await page.reload();
  await settled();
  assert.notDeepEqual(await shares(), painted, 'a stroke that outlived the editor is taken back');

  await button('Generate').click();
  await button('Generate the crowd').click();
  await page.waitForSelector('text=Open the new faces');
  await reopened(() => button('Open the new faces').click());
  assert.equal(await editor('editor.job.crowd.faces.length'), 4);
}
assert.deepEqual(problems, []);
await browser.close();
console.log('all right');
