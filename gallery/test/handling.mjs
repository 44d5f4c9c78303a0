// SPDX-License-Identifier: Apache-2.0
// Direct manipulation on the page of a running `crowdface edit`: drags on the head, measurements, a face beside,
// the library, a photo. Looks at what stands on the page.
//   node handling.mjs ADDRESS PHOTO [PICTURES_FOLDER]
// The last line says "all right".
import assert from 'node:assert/strict';
import { readFileSync, writeFileSync } from 'node:fs';
import { openPage } from './open_page.mjs';

const [address, photo, pictures] = process.argv.slice(2);
if (!photo) throw new Error('usage: node handling.mjs ADDRESS PHOTO [PICTURES]');

const { browser, page, problems, take, colourAt, settled, kept, rested, stillPicture, alike } = await openPage({ width: 1440, height: 900, pictures, own: address });

const shown = () => page.waitForFunction(() => !window.crowdface.editor.pending);
const message = () => page.locator('.message').innerText();
const button = (name) => page.getByRole('button', { name, exact: true });
const undoTitle = () => button('Undo').getAttribute('title');
const place = async (region) => [await page.getByLabel(`${region}, to the right`).inputValue(), await page.getByLabel(`${region}, up`).inputValue()];
const typedNumbers = async (region) => [await page.getByLabel(`Smoothness of ${region}, typed`).inputValue(),
  await page.getByLabel(`Strength of ${region}, typed`).inputValue()];
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

/// Asserts that Picture saves what the views show: to the right of the numbers that lie over them, and above.
const assertPictureIsView = async (what) => {
  await rested();
  await page.mouse.move(2, 2);
  const boxes = await Promise.all(['.stage:not(.other)', '.stage.other', '.photostage'].map((part) => page.locator(part).boundingBox()));
  const [own] = boxes;
  const width = Math.floor(Math.max(...boxes.filter(Boolean).map((box) => box.x + box.width)) - own.x);
  const screen = await page.screenshot({ clip: { x: own.x, y: own.y, width, height: Math.floor(own.height) } });
  const download = page.waitForEvent('download');
  await button('Picture').click();
  const saved = readFileSync(await (await download).path());
  const [size, differing] = await page.evaluate(async (texts) => {
    const [a, b] = await Promise.all(texts.map(async (text) => {
      const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
      const picture = await createImageBitmap(new Blob([bytes], { type: 'image/png' }));
      const small = new OffscreenCanvas(40, 40).getContext('2d', { willReadFrequently: true });
      small.drawImage(picture, 0, 0, 40, 40);
      return { size: [picture.width, picture.height], data: small.getImageData(0, 0, 40, 34).data };
    }));
    const far = (i) => [0, 1, 2].some((c) => Math.abs(a.data[i + c] - b.data[i + c]) > 24);
    return [b.size, [...Array(40 * 34).keys()].filter((i) => far(4 * i)).length];
  }, [screen, saved].map((picture) => picture.toString('base64')));
  assert.ok(Math.abs(size[0] - width) <= 1 && Math.abs(size[1] - own.height) <= 1, `${what}: ${size}`);
  assert.ok(differing < 14, `${what}: ${differing} of 1360 places of the saved picture differ from the screen`);
};

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

// A slider that is held still before it is let go, and one that comes back to where it was taken, is let go.
const smooth = page.getByLabel(`Smoothness of ${regions[0]}`, { exact: true });
const slideBy = async (ways) => {
  const { x, y, width, height } = await smooth.boundingBox();
  const at = x + 8 + (width - 16) * Number(await smooth.inputValue());
  await page.mouse.move(at, y + height / 2);
  await page.mouse.down();
  for (const way of ways) {
    await page.mouse.move(at + way, y + height / 2, { steps: 3 });
    await page.waitForTimeout(300);
    await shown();
  }
  await page.mouse.up();
  await settled();
  await rested(); // never, if the page still took it for held
};
const smoothness = () => page.getByLabel(`Smoothness of ${regions[0]}, typed`).inputValue();
const smoothBefore = await smoothness();
await slideBy([30]);
assert.notEqual(await smoothness(), smoothBefore);
assert.match(await undoTitle(), /Smoothness/, 'a step');
await page.keyboard.press('Control+z');
await settled();
assert.equal(await smoothness(), smoothBefore, 'one step');
await slideBy([30, 0]);

// Of heads that stand close together on the plane only those show their names that have room for them.
const namesSeen = () => page.locator('.head text').evaluateAll((texts) => texts.map((node) => node.getBoundingClientRect()).filter(({ width }) => width > 0));
const areApart = (boxes) => boxes.every((a, i) => boxes.every((b, k) => i <= k || a.right <= b.left || b.right <= a.left || a.bottom <= b.top || b.bottom <= a.top));
const circleOf = async (name) => page.locator(`.head[data-head="${name}"] .anchor > circle`).first().boundingBox();
const [near, moved] = [await circleOf(heads[1]), await circleOf(heads[2])];
await page.mouse.move(moved.x + moved.width / 2, moved.y + moved.height / 2);
await page.mouse.down();
await page.mouse.move(near.x + near.width / 2 + 20, near.y + near.height / 2, { steps: 5 });
await page.mouse.up();
await page.mouse.move(2, 2);
await page.locator('.head:focus').evaluateAll(([node]) => node?.blur());
await settled();
await take('heads_close');
assert.ok(areApart(await namesSeen()), 'names lie over each other');
assert.ok((await namesSeen()).length > 1, 'the others are named');
const clash = await page.evaluate(() => [...document.querySelectorAll('.head')].filter((node) => {
  const name = node.querySelector('text').getBoundingClientRect();
  return name.width > 0 && [...document.querySelectorAll('.head')].some((other) => {
    const picture = other.querySelector('.anchor > circle').getBoundingClientRect();
    const across = Math.min(name.right, picture.right) - Math.max(name.left, picture.left);
    const down = Math.min(name.bottom, picture.bottom) - Math.max(name.top, picture.top);
    return other !== node && Math.min(across, down) > 6;
  });
}).map((node) => node.dataset.head));
assert.deepEqual(clash, [], 'names that lie behind pictures');
await page.keyboard.press('Control+z');
await settled();

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
const [own, beside] = [await canvas.boundingBox(), await other.boundingBox()];
assert.ok(own.x + own.width <= beside.x + 1 && Math.abs(own.width - beside.width) < 2, 'two halves');
const another = heads.find((name) => name !== heads[0]);
await page.getByLabel('Face beside', { exact: true }).selectOption(another);
await isStill();
const front = await stillPicture(other);
await take('beside');
await assertPictureIsView('a face beside');
for (let step = 0; step < 16; step += 1) {
  const seen = await colourAt(beside.x + 0.47 * beside.width + step, beside.y + 0.42 * beside.height);
  assert.ok(Math.min(...seen) > 70, `bare skin on the forehead beside, without edges of the mesh: ${seen}`);
}
await page.mouse.move(own.x + 0.1 * own.width, own.y + own.height / 2);
await page.mouse.down();
await page.mouse.move(own.x + 0.1 * own.width + 90, own.y + own.height / 2, { steps: 5 });
await page.mouse.up();
const turned = await stillPicture(other);
assert.ok(!(await alike(turned, front)), 'the other one turns, too');
await page.keyboard.press('f');
assert.ok(await alike(await stillPicture(other), front), 'and back');
const left = await stillPicture(canvas);
await page.getByLabel('Face beside', { exact: true }).selectOption(heads[0]);
await isStill();
assert.ok(!(await alike(await stillPicture(other), front)), 'another head looks otherwise');
assert.ok(await alike(await stillPicture(canvas), left), 'the edited face stays');
await kept();
await page.reload();
await other.waitFor();
await settled();
assert.equal(await page.getByLabel('Face beside', { exact: true }).inputValue(), heads[0]);
await button('Close the face beside').click();
assert.ok(await other.isHidden());

// The library: a head onto the plane, a region and the face; a face onto a region and the face; what is worn.
await page.keyboard.press('Escape');
const tab = (name) => page.locator(`.library button[data-shelf="${name}"]`);
const picked = (name) => page.locator(`.library .portrait[data-name="${name}"]`);
const step = async (act, pattern) => {
  await act();
  await page.waitForFunction((text) => new RegExp(text).test(document.querySelector('.toolbar button[title^="Undo"]').title), pattern);
  await settled();
};
const lentTo = (region) => page.locator(`.regioncard[data-region="${region}"] .lends`).innerText();
const headAt = async (name) => {
  const box = await page.locator(`.head[data-head="${name}"] .anchor > circle`).first().boundingBox();
  return [box.x + box.width / 2, box.y + box.height / 2];
};
await tab('Heads').click();
assert.equal(await page.locator('.library .portrait img').count(), heads.length);
const cardOf = (region) => page.locator(`.regioncard[data-region="${region}"] h3`);
await step(() => picked(heads[3]).dragTo(cardOf(regions[1])), `Undo: ${heads[3]} on ${regions[1]}`);
assert.equal(await lentTo(regions[1]), `${heads[3]} 100 %`);
const board = page.locator('.board');
const isAt3 = await headAt(heads[3]);
const boardBox = await board.boundingBox();
const target = { x: isAt3[0] - boardBox.x + 34, y: isAt3[1] - boardBox.y + 22 };
await step(() => picked(heads[3]).dragTo(board, { targetPosition: target }), `Undo: ${heads[3]} moved`);
assert.ok(await page.locator(`.head[data-head="${heads[3]}"]`).evaluate((node) => node.classList.contains('away')));
const now3 = await headAt(heads[3]);
assert.ok(Math.hypot(now3[0] - isAt3[0] - 34, now3[1] - isAt3[1] - 22) < 12, 'it stands where it was dropped');
const notTarget = await page.locator('.head:not(.target)').first().getAttribute('data-head');
await step(() => picked(notTarget).dragTo(canvas), `Undo: target ${notTarget}`);
assert.equal(await page.locator('.head.target').getAttribute('data-head'), notTarget);
await tab('Faces').click();
await page.waitForFunction(() => [...document.querySelectorAll('.library img')].every((image) => image.complete && image.naturalWidth > 0));
await take('library');
const placesBefore = await Promise.all(regions.map(place));
await step(() => picked('mob_0003').dragTo(cardOf(regions[2])), `Undo: mob_0003 on ${regions[2]}`);
const placesAfter = await Promise.all(regions.map(place));
assert.deepEqual(placesAfter.slice(0, 2), placesBefore.slice(0, 2), 'other regions stay');
assert.notDeepEqual(placesAfter[2], placesBefore[2]);
const ofRegion = await typedNumbers(regions[2]);
// By a click, where the list says.
await step(() => picked('mob_0003').click(), 'Undo: mob_0003 opened');
assert.equal(await page.getByLabel('Name of the face').inputValue(), 'mob_0003_edited');
assert.deepEqual(await typedNumbers(regions[2]), ofRegion, 'the region was as in that face');
await page.getByLabel('Where a click puts it').selectOption(regions[0]);
await step(() => picked('mob_0001').click(), `Undo: mob_0001 on ${regions[0]}`);
// While the face is held, no picture of the library takes the time.
const taken = () => page.locator('.library .portrait img').count();
await tab('hat').click();
await page.mouse.move((await canvas.boundingBox()).x + 20, (await canvas.boundingBox()).y + 200);
await page.mouse.down();
await page.mouse.move((await canvas.boundingBox()).x + 40, (await canvas.boundingBox()).y + 200);
await page.waitForTimeout(1500);
const takenFirst = await taken();
await page.waitForTimeout(3000);
assert.equal(await taken(), takenFirst, 'a picture was made meanwhile');
await page.mouse.up();
const hat = (name) => page.locator(`.library .portrait[data-name="${name}"] img`);
await hat('card').waitFor();
await hat('none').waitFor();
assert.notEqual(await hat('card').getAttribute('src'), await hat('none').getAttribute('src'), 'the pictures show what is worn');
const forehead = async () => {
  const view = await canvas.boundingBox();
  return colourAt(view.x + 0.43 * view.width, view.y + 0.24 * view.height);
};
const isRed = ([r, g, b]) => r > 1.8 * g && r > 1.8 * b;
await page.keyboard.press('f');
const untilRed = async (wanted) => {
  while (isRed(await forehead()) !== wanted) await page.waitForTimeout(200);
};
await picked('none').dragTo(canvas);
await settled();
await untilRed(false);
await picked('card').dragTo(canvas);
await untilRed(true);
await take('worn');
await tab('hat').click();

// Faces to pick from are shown with what they wear.
await page.getByRole('button', { name: 'Six like it' }).click();
await page.waitForFunction(() => document.querySelectorAll('.picks .card img').length === 6);
await take('six');
const redPixels = await page.$$eval('.picks .card img', (images) => Promise.all(images.map(async (image) => {
  await image.decode();
  const context = new OffscreenCanvas(image.naturalWidth, image.naturalHeight).getContext('2d');
  context.drawImage(image, 0, 0);
  const { data } = context.getImageData(0, 0, image.naturalWidth, image.naturalHeight);
  let count = 0;
  for (let i = 0; i < data.length; i += 4) if (data[i] > 1.8 * data[i + 1] && data[i] > 1.8 * data[i + 2]) count += 1;
  return count;
})));
assert.ok(redPixels.every((count) => count > 20), `red pixels of the six: ${redPixels}`);
await page.getByRole('button', { name: 'Close the faces to pick from' }).click();
await settled();

// A photo lies behind or beside the head; points that are clicked on both turn the camera to where the photo was taken.
await page.keyboard.press('Escape');
await page.keyboard.press('f');
await rested();
const places = [[0.5, 0.3], [0.33, 0.36], [0.66, 0.36], [0.5, 0.5], [0.42, 0.72], [0.58, 0.72]];
const headBox = await canvas.boundingBox();
const onPage = ([x, y]) => [Math.round(headBox.x + x * headBox.width), Math.round(headBox.y + y * headBox.height)];
const inPhoto = await page.evaluate((pixels) => {
  const { view } = window.crowdface.editor;
  const box = view.node.getBoundingClientRect();
  const points = pixels.map(([x, y]) => view.hit(x, y).point);
  view.view('three_quarter');
  view.turn(-8);
  view.camera.updateMatrixWorld();
  return points.map((point) => {
    const at = view.camera.position.clone().fromArray(point).applyMatrix4(view.group.matrix).project(view.camera);
    return [((at.x + 1) / 2) * box.width, ((1 - at.y) / 2) * box.height];
  });
}, places.map(onPage));
const takenFrom = await facing();
const photoOfHead = `${photo}.of_head.png`;
writeFileSync(photoOfHead, await stillPicture(canvas));
await page.keyboard.press('f');
const bareBeside = await colourAt(headBox.x + 20, headBox.y + 300);
await page.locator('.photobox input[type=file]').setInputFiles(photo);
await page.waitForSelector('.photostage:not([hidden])');
const coloursOfHead = async () => { // at several places, because the photo shows a face of the same clay
  const colours = [];
  for (const x of [0.4, 0.5, 0.6]) colours.push(await colourAt(headBox.x + x * headBox.width, headBox.y + 0.5 * headBox.height));
  return colours;
};
const covered = await coloursOfHead();
await page.getByLabel('Opacity of the head').fill('0');
assert.notDeepEqual(await coloursOfHead(), covered, 'the opacity counts');
await page.getByLabel('Opacity of the head').fill('0.6');
await assertPictureIsView('a photo behind');
await page.locator('.photobox input[type=file]').setInputFiles(photoOfHead);
await page.waitForFunction((width) => Math.abs(document.querySelector('.photo').naturalWidth - width) < 2, headBox.width);
await button('Match points').click();
const hint = page.locator('.photobox [role=status]');
const photoPlace = ([x, y]) => page.evaluate(([u, v]) => {
  const stage = document.querySelector('.photostage').getBoundingClientRect();
  const at = new DOMMatrix(getComputedStyle(document.querySelector('.photo')).transform).transformPoint(new DOMPoint(u, v));
  return [stage.left + at.x, stage.top + at.y];
}, [x, y]);
for (const [i, at] of places.entries()) {
  if (i > 0) await page.keyboard.press('f'); // from where the place on the head is known
  assert.match(await hint.innerText(), /Click a place on the head/);
  await page.mouse.click(...onPage(at));
  assert.match(await hint.innerText(), /same place on the photo/);
  await page.mouse.click(...await photoPlace(inPhoto[i]));
  if (i === 1) await take('photo_points');
}
await rested();
assert.ok(Math.abs(await facing() - takenFrom) < 2, `seen from ${await facing()}°, taken from ${takenFrom}°`);
assert.match(await message(), /The camera matches 6 points to \d+\.\d mm/);
const marks = await page.locator('.photomarks g').evaluateAll((nodes) => nodes.map((node) => {
  const box = node.querySelector('circle').getBoundingClientRect();
  return [box.x, box.y];
}));
assert.equal(marks.length, 12);
for (let i = 0; i < marks.length; i += 2) {
  const distance = Math.hypot(marks[i][0] - marks[i + 1][0], marks[i][1] - marks[i + 1][1]);
  assert.ok(distance < 6, `point ${i / 2 + 1} lies ${distance} pixels from its place on the photo`);
}
await take('photo_matched');
await button('Match points').click();
await page.keyboard.press('f');
await button('Look from there').click();
assert.ok(Math.abs(await facing() - takenFrom) < 2);
await button('Beside').click();
await take('photo_beside');
await assertPictureIsView('a photo beside');
const half = await page.locator('.photostage').boundingBox();
assert.ok(half.x >= (await canvas.boundingBox()).x + (await canvas.boundingBox()).width - 1, 'beside the head');
await page.reload();
await settled();
await page.waitForSelector('.photostage.right:not([hidden])');
await page.locator('.photobox button[data-mode=off]').click();
assert.deepEqual(await colourAt(headBox.x + 20, headBox.y + 300), bareBeside, 'the photo is off');

assert.deepEqual(problems, []);
await browser.close();
console.log('all right');
