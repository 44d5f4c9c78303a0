// SPDX-License-Identifier: Apache-2.0
// Opens the page of a running `crowdface wrap --pick` in a headless Chromium and picks landmarks as people do.
//   node pick.mjs ADDRESS TEMPLATE.obj SCAN.obj [PICTURES_FOLDER]
// Vertices of template and scan correspond by number, so that it is known where each place belongs. The last line says
// "all right".
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { fine, openPage } from './open_page.mjs';

const [address, templateFile, scanFile, pictures] = process.argv.slice(2);
if (!scanFile) throw new Error('usage: node pick.mjs ADDRESS TEMPLATE.obj SCAN.obj [PICTURES]');
const vertices = (file) => readFileSync(file, 'utf8').split('\n').filter((line) => line.startsWith('v '))
  .map((line) => line.split(/\s+/).slice(1, 4).map(Number));
const ofTemplate = vertices(templateFile);
const ofScan = vertices(scanFile);

const { browser, page, problems, take, colourAt, audit } = await openPage({ pictures, own: address });
page.on('dialog', (dialog) => { problems.push(`dialog: ${dialog.message()}`); dialog.accept(); });

const picker = (ask, argument) => page.evaluate(
  ([text, value]) => new Function('picker', 'value', `return ${text}`)(window.crowdface.picker, value), [ask, argument]);
const settled = () => page.waitForFunction(() => window.crowdface.picker.answered === window.crowdface.picker.asked);
const landmark = (name) => picker('picker.document.landmarks.find((one) => one.name === value) ?? null', name);
const steps = () => picker('picker.history.past.length');
const far = (a, b) => Math.hypot(...a.map((x, i) => x - b[i]));

/// Where a point of a file stands in the window.
const onScreen = (side, point) => page.evaluate(([which, where]) => {
  const view = window.crowdface.picker.views[which];
  const { x, y } = view.project({ point: where });
  const box = view.node.getBoundingClientRect();
  return [box.left + x, box.top + y];
}, [side, point]);
const onTemplate = (vertex) => onScreen('template', ofTemplate[vertex].map((x) => 10 * x)); // cm to mm
async function clickStep(x, y) {
  const before = await steps();
  await page.mouse.click(x, y);
  await page.waitForFunction((n) => window.crowdface.picker.history.past.length > n, before);
  await settled();
}
const choose = (name) => page.locator(`.names li[data-name="${name}"]`).click();

// Open: the scan lies on its back in its file, and is found to.
const began = Date.now();
await page.goto(address);
await page.waitForSelector('.picker');
await settled();
console.log(`opened in ${Date.now() - began} ms`);
assert.deepEqual((await picker('picker.job.scan.stands')).up.map((x) => Math.round(x) + 0), [0, 0, 1]);
const proposed = await picker('Object.fromEntries(Object.entries(picker.suggested.template).map(([n, p]) => [n, p.vertex]))');
for (const name of ['nose_tip', 'nose_base', 'chin', 'eye_outer_left', 'eye_inner_right', 'lid_upper_left']) {
  assert.ok(name in proposed, `${name} is told from the template's shape`);
}
assert.ok(ofTemplate[proposed.eye_outer_left][0] > 0 && ofTemplate[proposed.eye_outer_right][0] < 0, 'left is the head’s own');
await take('opened');

// The scan has its colours: its left half is blue.
const besideEye = (side) => onScreen('scan', ofScan[proposed[`eye_outer_${side}`]].map((value, axis) => value - (axis === 2 ? 25 : 0)));
const [ofLeft, ofRight] = [await colourAt(...await besideEye('left')), await colourAt(...await besideEye('right'))];
assert.ok(ofLeft[2] > 1.5 * ofLeft[0] && ofRight[0] > ofRight[2], `blue on the left: ${ofLeft}; skin on the right: ${ofRight}`);

// Everything has its tooltip and a name, is legible, and is within reach in small windows.
for (const [width, height] of [[1440, 900], [1024, 768], [853, 600], [390, 844], [1280, 720]]) {
  await page.setViewportSize({ width, height });
  await page.waitForTimeout(300);
  await take(`at_${width}`);
  assert.deepEqual(await audit(), fine, `at ${width} pixels`);
}

// What the template's shape tells takes one click, on the scan.
await choose('nose_tip');
const tip = proposed.nose_tip;
await clickStep(...await onScreen('scan', ofScan[tip]));
let picked = await landmark('nose_tip');
assert.equal(picked.template.vertex, tip);
assert.ok(far(picked.scan.point, ofScan[tip]) < 2.5, `the scan's tip is ${far(picked.scan.point, ofScan[tip])} mm off`);
assert.equal(await picker('picker.active'), 'chin', 'the next name comes by itself');

// Two clicks where one wants another place.
await choose('mouth_left');
const between = (a, b) => a.map((x, i) => (x + b[i]) / 2);
const outer = await onTemplate(proposed.eye_outer_left);
const mouth = await onTemplate(proposed.lip_upper);
const cheek = between(outer, mouth);
await clickStep(...cheek);
picked = await landmark('mouth_left');
assert.equal(picked.scan, null);
assert.equal(await picker('picker.active'), 'mouth_left', 'it is missing on the scan');
const placed = await onTemplate(picked.template.vertex);
assert.ok(far(placed, cheek) < 6, 'the vertex that was clicked');
const cheekVertex = picked.template.vertex;
await clickStep(...await onScreen('scan', ofScan[cheekVertex]));
assert.ok(far((await landmark('mouth_left')).scan.point, ofScan[cheekVertex]) < 2.5);

// The other half is suggested on the template; one more pair, and on the scan as well.
await choose('eye_outer_left');
await clickStep(...await onScreen('scan', ofScan[proposed.eye_outer_left]));
await choose('mouth_right');
const mirrored = await picker('picker.suggested.template.mouth_right.point');
const here = ofTemplate[cheekVertex].map((x) => 10 * x);
assert.ok(far(mirrored, [-here[0], here[1], here[2]]) < 6, 'the mirrored place');
assert.ok(await picker('picker.suggested.scan.mouth_right'), 'three pairs tell where the others are');
assert.equal(await page.locator('section[data-side="scan"] .mark.ghost.active').count(), 1);
await take('suggested');
await page.keyboard.press('Enter');
await settled();
picked = await landmark('mouth_right');
assert.ok(picked.template && far(picked.scan.point, ofScan[picked.template.vertex]) < 12, 'Enter takes both');

// Undo and redo.
const all = await picker('picker.wire()');
await page.keyboard.press('Control+z');
await settled();
assert.equal((await landmark('mouth_right')).template, null);
await page.keyboard.press('Control+Shift+Z');
await settled();
assert.deepEqual(await picker('picker.wire()'), all);

// A mark is dragged: one step, on the surface, and the view stays where it was.
const place = await picker('picker.views.scan.camera.position.toArray()');
const count = await steps();
const mark = await onScreen('scan', (await landmark('mouth_right')).scan.point);
const goal = await onScreen('scan', ofScan[picked.template.vertex]);
await page.mouse.move(...mark);
await page.mouse.down();
await page.mouse.move(mark[0] + 12, mark[1] + 8, { steps: 4 });
await page.mouse.move(...goal, { steps: 4 });
await page.mouse.up();
await page.waitForFunction((n) => window.crowdface.picker.history.past.length > n, count);
await settled();
assert.equal(await steps(), count + 1);
assert.ok(far((await landmark('mouth_right')).scan.point, ofScan[picked.template.vertex]) < 2.5, 'it is where it was let go');
assert.deepEqual(await picker('picker.views.scan.camera.position.toArray()'), place);

// A click on the ring of another name picks this place for the chosen name.
await choose('chin');
const ring = await picker('picker.suggested.scan.nose_base.point');
await clickStep(...await onScreen('scan', ring));
picked = await landmark('chin');
assert.ok(far(picked.scan.point, ring) < 2.5, `the click on a ring was taken ${far(picked.scan.point, ring)} mm beside it`);
assert.equal((await landmark('nose_base')).scan, null);
await page.keyboard.press('Control+z');
await settled();

// The other names of the middle and the eyes, by clicks on the scan alone; then one on the wrong side.
for (const name of ['eye_outer_right', 'chin', 'nose_base', 'eye_inner_left', 'eye_inner_right']) {
  await choose(name);
  await clickStep(...await onScreen('scan', ofScan[proposed[name]]));
}
assert.equal(await page.locator('.names .outlier').count(), 0, 'nothing is out of place');
await choose('eye_outer_left');
await clickStep(...await onScreen('scan', ofScan[proposed.eye_inner_left].map((x, i) => (i === 2 ? x - 40 : x))));
assert.equal(await page.locator('.names .outlier').count(), 1);
assert.equal(await page.locator('.names .outlier').getAttribute('data-name'), 'eye_outer_left');
await choose('eye_outer_left');
await take('outlier');
// It is saved only once it is confirmed.
await page.keyboard.press('Control+s');
const question = page.getByRole('dialog', { name: 'Far from the others' });
assert.match(await question.innerText(), /eye_outer_left: \d+\.\d mm/);
await question.getByRole('button', { name: 'Look at them' }).click();
assert.match(await page.locator('.count').innerText(), /not saved/, 'nothing was saved');
await page.keyboard.press('Control+z');
await settled();
assert.equal(await page.locator('.names .outlier').count(), 0);

// Own names, by keys; Space picks the middle of a view; Delete takes off.
await page.keyboard.press('n');
await page.keyboard.type('scar: é "#1"');
await page.keyboard.press('Enter');
assert.equal(await picker('picker.active'), 'scar: é "#1"');
for (const side of ['template', 'scan']) {
  const before = await steps();
  await page.locator(`section[data-side="${side}"] canvas`).focus();
  await page.keyboard.press('Space');
  await page.waitForFunction((n) => window.crowdface.picker.history.past.length > n, before);
}
picked = await landmark('scar: é "#1"');
assert.ok(picked.template && picked.scan);
await choose('lip_lower');
await page.keyboard.press('Enter');
await settled();
assert.ok((await landmark('lip_lower')).scan);
await choose('lip_lower');
await page.keyboard.press('Delete');
await settled();
assert.equal((await landmark('lip_lower')).scan, null);

// Turning is no picking; linked views stand alike.
const untouched = await steps();
const box = await page.locator('section[data-side="template"] canvas').boundingBox();
await page.keyboard.press('Escape');
await page.keyboard.press('l');
await page.mouse.move(box.x + box.width / 2, box.y + box.height - 60);
await page.mouse.down();
await page.mouse.move(box.x + box.width / 2 - 90, box.y + box.height - 50, { steps: 6 });
await page.mouse.up();
assert.equal(await steps(), untouched);
assert.ok(Math.abs(await picker('picker.views.template.angle()')) > 10);
assert.ok(Math.abs(await picker('picker.views.scan.angle() - picker.views.template.angle()')) < 0.1, 'both turn');
const alike = far(await onScreen('template', ofTemplate[tip].map((x) => 10 * x)),
  (await onScreen('scan', ofScan[tip])).map((x, i) => (i === 0 ? x - box.width : x)));
assert.ok(alike < 30, `the noses stand ${alike} pixels apart`);
await take('linked');
await page.keyboard.press('f');

await page.keyboard.press('l');

// A scan that does not stand upright is turned by hand; what is seen stays when it becomes the front.
const seen = () => onScreen('scan', ofScan[tip]);
const scanBox = await page.locator('section[data-side="scan"] canvas').boundingBox();
const centre = [scanBox.x + scanBox.width / 2, scanBox.y + scanBox.height / 2];
const [sx, sy] = (await seen()).map((x, i) => x - centre[i]);
await page.getByRole('button', { name: 'Roll' }).click();
assert.ok(far((await seen()).map((x, i) => x - centre[i]), [sy, -sx]) < 12, 'a quarter around the line of sight');
for (let i = 0; i < 3; i += 1) await page.getByRole('button', { name: 'Roll' }).click();
assert.ok(far((await seen()).map((x, i) => x - centre[i]), [sx, sy]) < 1, 'four quarters are a whole turn');
await page.locator('section[data-side="scan"] canvas').focus();
for (let i = 0; i < 3; i += 1) await page.keyboard.press('ArrowRight');
assert.ok(Math.abs(await picker('picker.views.scan.angle()')) > 25);
const turned = await seen();
await page.getByRole('button', { name: 'Front is here' }).click();
assert.ok(Math.abs(await picker('picker.views.scan.angle()')) < 0.1);
assert.ok(far(await seen(), turned) < 1, 'the picture stays');
await page.keyboard.press('Escape');
await page.keyboard.press('f');
assert.ok(far((await seen()).map((x, i) => x - centre[i]), [sx, sy]) < 30, 'with pairs the views stand as the template does');

// All that takes the focus has a name.
const nameless = await page.evaluate(() => [...document.querySelectorAll('button, input, select, [tabindex="0"]')]
  .filter((node) => !node.getAttribute('aria-label') && !node.textContent.trim() && !node.labels?.length).map((node) => node.outerHTML));
assert.deepEqual(nameless, []);
await page.keyboard.press('?');
await page.waitForSelector('dialog[open]');
await page.keyboard.press('Escape');

// Save, and open it again.
assert.match(await page.locator('.count').innerText(), /not saved/);
const saved = await picker('picker.wire()');
await page.keyboard.press('Control+s');
await page.waitForFunction(() => /^Saved: /.test(document.querySelector('.message').textContent));
await take('saved');
await page.reload();
await page.waitForSelector('.picker');
await settled();
const byName = (list) => Object.fromEntries(list.map((one) => [one.name, one]));
assert.deepEqual(byName(await picker('picker.wire()')), byName(saved));
assert.ok(await page.locator('.export').isDisabled(), 'nothing is left to save');

await page.setViewportSize({ width: 2560, height: 1440 });
await page.waitForTimeout(1500);
await take('large');
const cut = await page.evaluate(() => [...document.querySelectorAll('.toolbar, .names, .hint')]
  .filter((node) => node.scrollWidth > node.clientWidth + 1).map((node) => node.className));
assert.deepEqual(cut, [], 'nothing is cut off');

assert.deepEqual(problems, []);
await browser.close();
console.log('all right');
