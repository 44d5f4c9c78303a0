// SPDX-License-Identifier: Apache-2.0
// Direct manipulation on the page of a running `crowdface edit`: drags on the head, measurements, a face beside,
// the library, a photo. Looks at what stands on the page.
//   node handling.mjs ADDRESS PHOTO [PICTURES_FOLDER]
// The last line says "all right".
import assert from 'node:assert/strict';
import { openPage } from './open_page.mjs';

const [address, photo, pictures] = process.argv.slice(2);
if (!photo) throw new Error('usage: node handling.mjs ADDRESS PHOTO [PICTURES]');

const { browser, page, problems, take } = await openPage({ width: 1440, height: 900, pictures, own: address });

const shown = () => page.waitForFunction(() => !window.crowdface.editor.pending);
const settled = () => page.waitForFunction(() => {
  const it = window.crowdface?.editor;
  return it?.ready && !it.pending && it.exactOf === it.document;
});
const message = () => page.locator('.message').innerText();
const button = (name) => page.getByRole('button', { name, exact: true });
const undoTitle = () => button('Undo').getAttribute('title');
const place = async (region) => [await page.getByLabel(`${region}, to the right`).inputValue(), await page.getByLabel(`${region}, up`).inputValue()];
const type = async (field, text) => {
  await field.fill(text);
  await field.press('Enter');
  await shown();
};
const canvas = page.locator('.stage:not(.other) canvas');
const clickOnHead = async (part) => {
  const view = await canvas.boundingBox();
  await page.mouse.click(view.x + view.width / 2, view.y + part * view.height);
};
/// What is seen of an element, as PNG.
const picture = (locator) => locator.screenshot();

await page.goto(address);
await page.waitForSelector('.board');
await settled();
const regions = await page.locator('.regioncard').evaluateAll((cards) => cards.map((node) => node.dataset.region));
const heads = await page.locator('.head').evaluateAll((nodes) => nodes.map((node) => node.dataset.head));

// A drag that begins on the selected region moves its controller, any other one turns the head.
const controller = async (region) => page.locator(`.handle[data-region="${region}"]`).boundingBox();
const dragOnHead = async (part, dx, dy) => {
  const view = await canvas.boundingBox();
  const [x, y] = [view.x + view.width / 2, view.y + part * view.height];
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + dx, y + dy, { steps: 5 });
  await page.mouse.up();
  await settled();
};
const facing = () => page.evaluate(() => window.crowdface.editor.view.angle());
await type(page.getByLabel(`${regions[2]}, to the right`), '0.1');
await type(page.getByLabel(`${regions[2]}, up`), '0.35');
await clickOnHead(0.75);
assert.equal(await page.locator('.regioncard.chosen').getAttribute('data-region'), regions[2]);
const wasAt = await controller(regions[2]);
const placeBefore = await place(regions[2]);
await dragOnHead(0.75, 30, -20);
const isAt = await controller(regions[2]);
assert.ok(Math.abs(isAt.x - wasAt.x - 30) < 12 && Math.abs(isAt.y - wasAt.y + 20) < 12, 'the controller follows the hand');
assert.notDeepEqual(await place(regions[2]), placeBefore);
assert.equal(await facing(), 0, 'and the head stays');
await take('dragged_on_head');
await page.keyboard.press('Control+z');
await settled();
assert.deepEqual(await place(regions[2]), placeBefore, 'one step');
await dragOnHead(0.3, 60, 0);
assert.notEqual(await facing(), 0, 'beside the selected region the head turns');
await page.keyboard.press('f');
await page.keyboard.press('Escape');
assert.equal(await page.locator('.regioncard.chosen').count(), 0, 'Esc selects nothing');
await dragOnHead(0.75, 60, 0);
assert.notEqual(await facing(), 0, 'without a selection the head turns');
assert.deepEqual(await place(regions[2]), placeBefore);

// A measurement's slider moves the face to the wanted value, by weights of the regions that it is about; a locked region
// stays; what the heads do not reach is told.
const measurement = (name) => page.getByRole('row', { name: new RegExp(`^${name} `) });
const measured = async (name) => parseFloat(await measurement(name).locator('td').nth(2).innerText());
const lends = () => page.locator('.regioncard .lends').allInnerTexts();
const slider = page.getByLabel('nose width', { exact: true });
const [low, high] = await slider.evaluate((node) => [Number(node.min), Number(node.max)]);
const wanted = Number(((low + high) / 2 + (await measured('nose width') > (low + high) / 2 ? -1 : 1) * 0.15 * (high - low)).toFixed(1));
const slide = async (value) => {
  await slider.evaluate((node, to) => {
    node.value = to;
    node.dispatchEvent(new Event('input', { bubbles: true }));
    node.dispatchEvent(new Event('change', { bubbles: true }));
  }, value);
  await page.waitForFunction(() => /^Undo: nose width/.test(document.querySelector('.toolbar button[title^="Undo"]').title));
  await settled();
};
const lentBefore = await lends();
const otherBefore = await measured('mouth width');
await slide(wanted);
assert.ok(Math.abs(await measured('nose width') - wanted) < 0.15, `nose width ${await measured('nose width')}, wanted ${wanted}`);
assert.notDeepEqual(await lends(), lentBefore);
await take('measurements');
await page.keyboard.press('Control+z');
await settled();
assert.deepEqual(await lends(), lentBefore, 'one step');
assert.ok(Math.abs(await measured('mouth width') - otherBefore) < 0.06);
for (const region of regions) await page.locator(`.regioncard[data-region="${region}"] button.lock`).click();
await slide(wanted).catch(() => {}); // nothing changes
assert.match(await message(), /as near .* as the heads allow with these regions locked/);
assert.deepEqual(await lends(), lentBefore);
for (const region of regions) await page.locator(`.regioncard[data-region="${region}"] button.lock`).click();
// By keyboard.
await slider.focus();
for (let i = 0; i < 3; i += 1) await page.keyboard.press('ArrowRight');
await page.waitForFunction(() => /^Undo: nose width/.test(document.querySelector('.toolbar button[title^="Undo"]').title));
await settled();
await page.keyboard.press('Control+z');

// Another face stands beside, seen by the same camera; the page opens again with it.
const other = page.locator('.stage.other canvas');
const isStill = () => page.waitForFunction(() => {
  const { beside } = window.crowdface.editor;
  return beside.view && !beside.exact.running;
});
await page.locator('body').click({ position: { x: 2, y: 2 } });
await page.keyboard.press('f');
await page.keyboard.press('s');
await other.waitFor();
await isStill();
await page.waitForTimeout(900); // until the views rest
const [own, beside] = [await canvas.boundingBox(), await other.boundingBox()];
assert.ok(own.x + own.width <= beside.x + 1 && Math.abs(own.width - beside.width) < 2, 'two halves');
const another = heads.find((name) => name !== heads[0]);
await page.getByLabel('Face beside', { exact: true }).selectOption(another);
await isStill();
await page.waitForTimeout(900);
const front = await picture(other);
await take('beside');
await page.mouse.move(own.x + 0.1 * own.width, own.y + own.height / 2);
await page.mouse.down();
await page.mouse.move(own.x + 0.1 * own.width + 90, own.y + own.height / 2, { steps: 5 });
await page.mouse.up();
await page.waitForTimeout(900);
const turned = await picture(other);
assert.ok(!turned.equals(front), 'the other one turns, too');
await page.keyboard.press('f');
await page.waitForTimeout(900);
assert.ok((await picture(other)).equals(front), 'and back');
const left = await picture(canvas);
await page.getByLabel('Face beside', { exact: true }).selectOption(heads[0]);
await isStill();
await page.waitForTimeout(900);
assert.ok(!(await picture(other)).equals(front), 'another head looks otherwise');
assert.ok((await picture(canvas)).equals(left), 'the edited face stays');
await page.waitForTimeout(600);
await page.reload();
await other.waitFor();
await settled();
assert.equal(await page.getByLabel('Face beside', { exact: true }).inputValue(), heads[0]);
await button('Close the face beside').click();
assert.ok(await other.isHidden());

assert.deepEqual(problems, []);
await browser.close();
console.log('all right');
