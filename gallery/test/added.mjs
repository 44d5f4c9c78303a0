// SPDX-License-Identifier: Apache-2.0
// Heads that are dropped on the page of a running `crowdface edit`, and expressions. Looks at what stands on the page.
//   node added.mjs ADDRESS HEADS_FOLDER [PICTURES_FOLDER]
// HEADS_FOLDER has synth_05, which the config lacks. The last line says "all right".
import assert from 'node:assert/strict';
import { readdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { openPage } from './open_page.mjs';

const [address, folder, pictures] = process.argv.slice(2);
if (!folder) throw new Error('usage: node added.mjs ADDRESS HEADS_FOLDER [PICTURES]');

const { browser, page, problems, take, settled, kept } = await openPage({ width: 1440, height: 900, pictures, own: address });

const message = () => page.locator('.message').innerText();
const heads = () => page.locator('.head').evaluateAll((nodes) => nodes.map((node) => node.dataset.head));
/// What the view shows, as a PNG in base64, without what lies over it.
const picture = async () => {
  await settled();
  return page.evaluate(() => {
    const { view } = window.crowdface.editor;
    view.draw();
    return view.node.toDataURL().split(',')[1];
  });
};
/// How many pixels of two pictures differ visibly: the same face may differ in the last bits.
const differing = (one, other) => page.evaluate(async (texts) => {
  const [a, b] = await Promise.all(texts.map(async (text) => {
    const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
    const bitmap = await createImageBitmap(new Blob([bytes], { type: 'image/png' }));
    const context = new OffscreenCanvas(bitmap.width, bitmap.height).getContext('2d');
    context.drawImage(bitmap, 0, 0);
    return context.getImageData(0, 0, bitmap.width, bitmap.height).data;
  }));
  let count = 0;
  for (let i = 0; i < a.length; i += 4) count += [0, 1, 2].some((c) => Math.abs(a[i + c] - b[i + c]) > 12) ? 1 : 0;
  return count;
}, [one, other]);
const assertSame = async (one, other, text) => {
  const count = await differing(one, other);
  assert.ok(count < 30, `${text}: ${count} pixels differ`);
};
const assertOther = async (one, other, text) => {
  const count = await differing(one, other);
  assert.ok(count > 300, `${text}: ${count} pixels differ`);
};
/// Drops files on a part of the page. \param files  {name: bytes}
const drop = async (selector, files) => {
  const dropped = await page.evaluateHandle((all) => {
    const data = new DataTransfer();
    for (const [name, text] of all) {
      const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
      data.items.add(new File([bytes], name, { type: /png$/.test(name) ? 'image/png' : '' }));
    }
    return data;
  }, Object.entries(files).map(([name, bytes]) => [name, Buffer.from(bytes).toString('base64')]));
  await page.locator(selector).dispatchEvent('drop', { dataTransfer: dropped });
};
const refused = async (files, pattern) => {
  await page.evaluate(() => window.crowdface.editor.say(''));
  await drop('.board', files);
  await page.waitForFunction(() => document.querySelector('.message.bad:not([hidden])'));
  assert.match(await message(), pattern);
};
/// Does what loads the page again, and waits for it.
const reopened = async (act) => {
  await page.evaluate(() => { window.before = true; });
  await act();
  await page.waitForFunction(() => !window.before && window.crowdface?.editor?.ready);
  await settled();
};

await page.goto(address);
await page.waitForSelector('.board');
await settled();
const four = await heads();
assert.equal(four.length, 4);

// An expression is seen while its slider moves, stays after a reload, and goes; the mesh is saved without.
const atRest = await picture();
const brow = page.getByLabel('browUp');
await brow.fill('1');
await settled();
const acting = await picture();
await assertOther(acting, atRest, 'the brow is up');
await take('expression');
const lifted = () => page.evaluate(() => Array.from(window.crowdface.editor.view.blender.read()));
const up = await lifted();
await brow.evaluate((node) => { // while it is held
  node.value = 0.4;
  node.dispatchEvent(new Event('input', { bubbles: true }));
});
await page.waitForFunction((before) => window.crowdface.editor.view.blender.read().some((value, i) => Math.abs(value - before[i]) > 0.1), up);
await brow.fill('1');
await settled();
await assertSame(await picture(), acting, 'the same expression is the same picture');
await page.locator('.toolbar .name').fill('acting');
await page.locator('.toolbar .name').press('Enter');
await page.getByLabel('Format of the mesh').selectOption('obj');
await page.keyboard.press('Escape');
await page.keyboard.press('Control+s');
await page.waitForFunction(() => /^Saved: .*without the expression/.test(document.querySelector('.message').textContent));
await kept();
await page.reload();
await settled();
assert.equal(await brow.inputValue(), '1');
await assertSame(await picture(), acting, 'an expression stays');
await page.getByRole('button', { name: 'At rest' }).click();
await settled();
await assertSame(await picture(), atRest, 'at rest as before');

// What cannot join is refused with the reason, and changes nothing.
const head = readFileSync(join(folder, 'synth_05.obj'));
await refused({ 'notes.txt': 'hello' }, /"notes.txt": expected heads/);
await refused({ 'eva.obj': 'hello' }, /eva\.obj/);
await refused({ 'eva.obj': 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' }, /eva.*(vertices|topology|mesh)/);
await refused({ 'fringe.obj': 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 4 3\n' }, /fringe.*another mesh.*hair.*section attachments/);
await refused({ 'synth_01.obj': head }, /two heads are called "synth_01"/);
await refused({ 'skin.png': await page.screenshot() }, /drop textures together with their heads/);
assert.deepEqual(await heads(), four);
await page.reload();
await settled();
assert.deepEqual(await heads(), four);

// A head with its textures joins the plane; the face stays as it is.
const files = Object.fromEntries(readdirSync(folder).filter((name) => /^synth_05.*\.(obj|mtl|png)$/.test(name) || /\.mtl$/.test(name))
  .map((name) => [name, readFileSync(join(folder, name))]));
const before = await lifted();
await reopened(() => drop('.board', files));
const five = [...four, 'synth_05'];
assert.deepEqual(await heads(), five);
const after = await lifted();
const moved = 10 * Math.max(...after.map((value, i) => Math.abs(value - before[i])));
console.log(`the face differs by ${moved.toFixed(4)} mm`);
assert.ok(moved < 0.5, `the face is as it was, to 0.5 mm: ${moved}`);
await take('joined');
await page.locator('.library button[data-shelf=Heads]').click();
assert.equal(await page.locator('.library .portrait img').count(), 5);
await page.locator('.library .portrait[data-name=synth_05]').click();
await page.waitForFunction(() => document.querySelector('.head.target').dataset.head === 'synth_05');
await settled();
const plain = await picture();
await page.getByLabel('What the face shows').selectOption('texture 4');
await page.waitForFunction(() => window.crowdface.editor.view.material.map !== null);
await assertOther(await picture(), plain, 'its texture is seen');
await page.getByLabel('What the face shows').selectOption('surface');
await page.keyboard.press('Escape');

// It is a step as any other.
const undo = page.getByRole('button', { name: 'Undo', exact: true });
await undo.click(); // the target
await reopened(() => undo.click());
assert.deepEqual(await heads(), four);
await reopened(() => page.getByRole('button', { name: 'Redo', exact: true }).click());
assert.deepEqual(await heads(), five);

// What the program refuses is no fault, although the browser notes it.
assert.deepEqual(problems.filter((problem) => !/400 \(Bad Request\)/.test(problem)), []);
await browser.close();
console.log('all right');
