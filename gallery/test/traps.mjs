// SPDX-License-Identifier: Apache-2.0
// What people run into on the page of a running `crowdface edit` and must not: linked regions, typed numbers,
// controllers that share a letter, moved heads, strokes, small windows. Looks at what stands on the page.
//   node traps.mjs ADDRESS [PICTURES_FOLDER]
// The last line says "all right".
import assert from 'node:assert/strict';
import { fine, openPage } from './open_page.mjs';

const [address, pictures] = process.argv.slice(2);
if (!address) throw new Error('usage: node traps.mjs ADDRESS [PICTURES]');

const { browser, context, page, problems, take, audit, settled, kept, rested, alike } = await openPage({ width: 1440, height: 900, pictures, own: address });

const message = () => page.locator('.message').innerText();
const card = (region) => page.locator(`.regioncard[data-region="${region}"]`);
const typed = (region, what) => page.getByLabel(`${what} of ${region}, typed`);
const place = async (region) => [await page.getByLabel(`${region}, to the right`).inputValue(), await page.getByLabel(`${region}, up`).inputValue()];
const numbers = async (region) => [await typed(region, 'Smoothness').inputValue(), await typed(region, 'Strength').inputValue(), ...await place(region)];
const shown = () => page.waitForFunction(() => !window.crowdface.editor.pending);
const type = async (field, text) => {
  await field.fill(text);
  await field.press('Enter');
  await shown();
};
/// Where a head stands on the board.
const headAt = async (name) => {
  const box = await page.locator(`.head[data-head="${name}"] .anchor > circle`).first().boundingBox();
  return [Math.round(box.x + box.width / 2), Math.round(box.y + box.height / 2)];
};

await page.goto(address);
await page.waitForSelector('.board');
await settled();
const regions = await page.locator('.regioncard').evaluateAll((cards) => cards.map((node) => node.dataset.region));
const [first, second] = regions;
const heads = await page.locator('.head').evaluateAll((nodes) => nodes.map((node) => node.dataset.head));

// A linked slider changes what it is about in the other region, and nothing else.
await type(typed(first, 'Strength'), '1.3');
await type(typed(second, 'Strength'), '0.8');
await type(page.getByLabel(`${second}, up`), '0.4');
for (const region of [first, second]) await card(region).getByRole('button', { name: 'link' }).click();
const before = await numbers(second);
await page.getByLabel(`Smoothness of ${first}`, { exact: true }).press('ArrowRight');
await shown();
const [smoothness, ...others] = await numbers(second);
assert.equal(smoothness, (await numbers(first))[0], 'a linked slider sets both');
assert.deepEqual(others, before.slice(1), 'strength and place of a linked region stay');
await type(page.getByLabel(`${first}, to the right`), '-0.25');
assert.deepEqual(await place(second), ['-0.25', '0.4'], 'one coordinate is set in both');
for (const region of [first, second]) await card(region).getByRole('button', { name: 'link' }).click();

// An emptied field shows its value again, a clamped one says so, and the plane stays as large as it was.
const strength = await typed(first, 'Strength').inputValue();
await type(typed(first, 'Strength'), '');
assert.equal(await typed(first, 'Strength').inputValue(), strength);
await type(typed(first, 'Strength'), '9');
assert.equal(await typed(first, 'Strength').inputValue(), '4');
assert.match(await message(), /Strength of .*: 9 is outside -4 to 4, so it is 4/);
await page.keyboard.press('Control+z');
const spread = async () => (await headAt(heads[0]))[0] - (await headAt(heads[2]))[0];
const wide = await spread();
await type(page.getByLabel(`${first}, to the right`), '500');
assert.ok(Number((await place(first))[0]) < 5);
assert.match(await message(), /500 is outside/);
assert.ok(Math.abs(await spread()) > 0.4 * Math.abs(wide), 'heads stay apart');
await page.keyboard.press('Control+z');
await settled();

// A face that the program would reject is told of on the page, in words.
for (const region of regions) await type(typed(region, 'Strength'), '4');
await settled();
assert.match(await page.locator('.measures').innerText(), /generate would reject this face: [a-z ]+/);
await page.waitForFunction(() => /the whole mesh has faults: .*lining/.test(document.querySelector('.measures').innerText));
await take('faults');
for (let i = 0; i < regions.length; i += 1) await page.keyboard.press('Control+z');
await settled();
assert.doesNotMatch(await page.locator('.measures').innerText(), /would reject|faults/);

// A face is not nearest to itself, and one far beyond the heads is not near one of them.
const nearest = async (what) => (await page.locator('.measures').innerText()).match(new RegExp(`nearest ${what} ([\\d.]+) mm (\\S+)`)).slice(1);
assert.equal(await page.getByLabel('Name of the face').inputValue(), 'mob_0001_edited');
await page.keyboard.press('Escape');
await page.getByLabel('Open a face').selectOption('face mob_0001');
await settled();
const [away, neighbour] = await nearest('face');
assert.ok(Number(away) > 0 && neighbour !== 'mob_0001', `${neighbour}, ${away} mm`);
await page.getByLabel('Open a face').selectOption(`head ${heads[1]}`);
await settled();
assert.deepEqual(await nearest('head'), ['0', heads[1]]);
for (const region of regions) await type(typed(region, 'Strength'), '3');
await settled();
const exaggeration = (await page.locator('.measures').innerText()).match(/nearest head [\d.]+ mm \S+ \(at strength 1; ([\d.]+) mm as shown\)/);
assert.ok(Number(exaggeration?.[1]) > 1, `strength 3 leads away from every head: ${await page.locator('.measures').innerText()}`);
for (let i = 0; i < regions.length + 2; i += 1) await page.keyboard.press('Control+z');
await settled();

// No two controllers bear the same letter.
const letters = await page.locator('.handle text').allTextContents();
assert.equal(new Set(letters).size, regions.length, letters.join());

// Heads that were moved stay where they are when faces are drawn or mixed.
const head = page.locator(`.head[data-head="${heads[3]}"]`);
const box = await head.locator('.anchor > circle').first().boundingBox();
await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
await page.mouse.down();
await page.mouse.move(box.x + box.width / 2 + 18, box.y + box.height / 2 - 24, { steps: 4 });
await page.mouse.up();
await settled();
const undone = page.getByRole('button', { name: 'Undo', exact: true });
const moved = await head.evaluate((node) => node.classList.contains('away'));
assert.ok(moved);
const isAway = () => head.evaluate((node) => node.classList.contains('away'));
await page.getByRole('button', { name: 'Draw', exact: true }).click();
await page.waitForFunction(() => /a face drawn/.test(document.querySelector('.toolbar button[title^="Undo:"]')?.title ?? ''));
await settled();
assert.ok(await isAway(), 'Draw keeps a moved head');
await page.keyboard.press('l');
await page.waitForFunction(() => document.querySelectorAll('.picks .card img').length === 6);
assert.match(await page.locator('.picks .card').first().innerText(), /^[\d.]+ mm/, 'a face to pick from says how far it is');
await page.getByRole('button', { name: 'Keep face 2' }).click();
await type(page.getByLabel('Caption of kept 1'), 'the baker');
await page.locator('.picks .portrait').first().click();
await settled();
assert.ok(await isAway(), 'Six like it keeps a moved head');
await page.keyboard.press('Escape');
await page.keyboard.press('n');
await page.locator('.ends select').nth(1).selectOption(heads[0]);
await page.locator('.ends input').focus();
for (let i = 0; i < 30; i += 1) await page.keyboard.press('ArrowRight');
await page.getByRole('button', { name: 'Take it' }).click();
await settled();
assert.ok(await isAway(), 'Between keeps a moved head');
assert.ok(await undone.isEnabled());

// While masks are painted Ctrl+Z takes back the stroke, and the steps of the face stay.
await page.keyboard.press('f');
await page.keyboard.press('m');
const label = await undone.getAttribute('title');
const picture = async () => {
  await rested();
  const png = await page.evaluate(() => {
    const { view } = window.crowdface.editor;
    view.draw();
    return view.node.toDataURL().split(',')[1];
  });
  return Buffer.from(png, 'base64');
};
/** Waits until the page shows this picture; false if it does not within some ten seconds. */
const becomes = async (wanted) => {
  for (let tries = 0; tries < 50; tries += 1) {
    if (await alike(await picture(), wanted)) return true;
    await page.waitForTimeout(200);
  }
  return false;
};
await settled();
const bare = await picture();
const canvas = await page.locator('canvas.turntable').boundingBox();
const painted = () => page.waitForFunction(() => {
  const { painting } = window.crowdface.editor;
  return painting.waiting.length === 0 && !painting.sending;
});
await page.locator(`.painting button[data-region="${regions[2]}"]`).click();
await page.mouse.move(canvas.x + canvas.width / 2, canvas.y + canvas.height / 2);
await page.mouse.down();
await page.mouse.move(canvas.x + canvas.width / 2 + 40, canvas.y + canvas.height / 2, { steps: 6 });
await page.mouse.up();
await painted();
await page.mouse.move(canvas.x + 5, canvas.y + canvas.height - 5);
await settled();
assert.ok(!(await alike(await picture(), bare)), 'a stroke is seen');
await take('stroke');
await page.keyboard.press('Control+z');
// The page asks for the masks without the stroke some time after the key.
assert.ok(await becomes(bare), 'Ctrl+Z takes back the stroke');
await settled();
assert.equal(await undone.getAttribute('title'), label, 'and no step of the face');
// The brush is still out after a reload, and the view is as it was.
await page.keyboard.press('.');
await page.keyboard.press('+');
const turned = await picture();
await page.getByRole('button', { name: 'Smooth', exact: true }).click();
await kept();
await page.reload();
await page.waitForSelector('.painting:not([hidden])');
assert.equal(await page.getByRole('button', { name: 'Smooth', exact: true }).getAttribute('aria-pressed'), 'true');
await settled();
// Masks arrive some time after the face.
assert.ok(await becomes(turned), 'the same view');
assert.equal(await page.getByLabel('Caption of the baker').inputValue(), 'the baker');
await page.keyboard.press('Escape');

// A click on the head finds the region that is there, and the page tells how long a frame takes.
await page.keyboard.press('f');
await settled();
const found = [];
for (const part of [0.3, 0.75]) {
  const view = await page.locator('canvas.turntable').boundingBox();
  await page.mouse.click(view.x + view.width / 2, view.y + part * view.height);
  const pulsing = await page.locator('.regioncard.pulse').getAttribute('data-region');
  assert.equal(await page.locator('.handle.pulse').getAttribute('data-region'), pulsing);
  found.push(pulsing);
}
assert.deepEqual(found, [regions[0], regions[2]], 'the forehead and the chin');

await page.keyboard.press('i');
assert.match(await page.locator('.frames').innerText(), /^[\d.]+ ms a frame, \d+ × \d+ pixels$/);
await page.keyboard.press('i');

// The sliders are near by keyboard.
await page.locator('body').evaluate(() => document.activeElement.blur());
await page.reload();
await page.waitForSelector('.board');
await settled();
let tabs = 0;
while (tabs < 10 && !await page.evaluate(() => document.activeElement.matches('.skip'))) {
  await page.keyboard.press('Tab');
  tabs += 1;
}
await page.keyboard.press('Enter');
assert.ok(await page.evaluate(() => document.activeElement.matches('.regioncard input[type=range]')), `after ${tabs} Tabs`);

// A mesh that was there before is not replaced without a question; once it was answered, it is.
const save = () => page.keyboard.press('Control+s');
const isSaved = () => page.waitForFunction(() => /^Saved: /.test(document.querySelector('.message').textContent));
await save();
await isSaved();
await page.reload();
await page.waitForSelector('.board');
await settled();
await save();
await page.getByRole('button', { name: 'Save over it' }).click();
await isSaved();
await page.evaluate(() => { document.querySelector('.message').textContent = ''; });
await save();
await isSaved();

// A second tab takes over with every step of the first, which says so and keeps nothing any more.
await type(typed(first, 'Strength'), '1.75');
const secondTab = await context.newPage();
await secondTab.goto(address);
await secondTab.waitForFunction(() => window.crowdface?.editor?.ready);
assert.equal(await secondTab.getByLabel(`Strength of ${first}, typed`).inputValue(), '1.75');
await page.getByRole('dialog', { name: 'Open in another tab' }).waitFor();
await secondTab.getByLabel(`Strength of ${first}, typed`).fill('1.25');
await secondTab.keyboard.press('Enter');
await kept(secondTab);
await page.getByRole('button', { name: 'Edit here again' }).click();
await page.waitForFunction(() => window.crowdface?.editor?.ready);
await settled();
assert.equal(await typed(first, 'Strength').inputValue(), '1.25', 'the first tab goes on from the second one’s steps');
await secondTab.getByRole('dialog', { name: 'Open in another tab' }).waitFor();
await secondTab.close();
await page.reload();
await page.waitForSelector('.board');
await settled();
assert.equal(await typed(first, 'Strength').inputValue(), '1.25', 'a tab that closes overwrites nothing');

// Everything has its tooltip, is legible, and is within reach in small windows, with all that can be open.
await page.locator('.library button[data-shelf=Faces]').click();
await page.locator('.photobox input[type=file]').setInputFiles({ name: 'photo.png', mimeType: 'image/png', buffer: await page.screenshot() });
await page.waitForSelector('.photostage:not([hidden])');
await page.keyboard.press('m');
await page.keyboard.press('s');
await page.waitForSelector('.besidebar:not([hidden])');
for (const [width, height] of [[1440, 900], [1280, 720], [1024, 768], [1152, 720], [960, 600], [853, 600], [683, 512], [390, 844]]) {
  await page.setViewportSize({ width, height });
  await page.waitForFunction(() => { // until the plane has its new size
    const { board } = window.crowdface.editor;
    const box = board.svg.getBoundingClientRect();
    return Math.abs(board.unit * Math.min(box.width, box.height) - 460) < 1;
  });
  await take(`at_${width}`);
  assert.deepEqual(await audit(), fine, `at ${width} pixels`);
  const [bar, view] = await Promise.all(['.viewbar', '.stage:not(.other) canvas'].map((part) => page.locator(part).boundingBox()));
  assert.ok(bar.y + bar.height <= view.y + 1, `at ${width} pixels no button lies over the head`);
  const name = await page.getByLabel('Name of the face').evaluate((node) => [node.scrollWidth, node.clientWidth]);
  assert.ok(name[0] <= name[1], `at ${width} pixels the name is seen in full: ${name}`);
}

// A question that the program asks back is no fault, although the browser notes it.
assert.deepEqual(problems.filter((problem) => !/409 \(Conflict\)/.test(problem)), []);
await browser.close();
console.log('all right');
