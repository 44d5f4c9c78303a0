// SPDX-License-Identifier: Apache-2.0
// Opens the page of a running `crowdface edit` in a headless Chromium and uses it as people do.
//   node editor.mjs ADDRESS RESULT_JSON [PICTURES_FOLDER]
// Writes the saved recipe, its file and the points on the screen to RESULT_JSON; the last line says
// "all right".
import assert from 'node:assert/strict';
import { readFileSync, writeFileSync } from 'node:fs';
import { openPage } from './open_page.mjs';
import { wornPixels } from './worn_pixels.mjs';

const [address, resultFile, pictures] = process.argv.slice(2);
if (!resultFile) throw new Error('usage: node editor.mjs ADDRESS RESULT_JSON [PICTURES]');

const { browser, page, problems, take, settled, kept, rested } = await openPage({ pictures, own: address });
page.on('requestfailed', (request) => {
  const why = request.failure().errorText;
  if (why !== 'net::ERR_ABORTED') problems.push(`${request.url()}: ${why}`); // overtaken ones are
});

const editor = (ask, argument) => page.evaluate(
  ([text, value]) => new Function('editor', 'value', `return ${text}`)(window.crowdface.editor, value), [ask, argument]);
const recipe = () => editor('editor.document.recipe');
/// Three numbers a vertex; null where the draft that moves has no vertex.
const points = () => page.evaluate(() => {
  const { view } = window.crowdface.editor;
  const read = Array.from(view.blender.read());
  if (!view.isBehind) return read;
  const moves = new Set(view.blender.draft.vertices);
  return read.map((value, i) => (moves.has(Math.floor(i / 3)) ? value : null));
});
const steps = () => editor('editor.history.past.length');
const farthest = (a, b) => a.reduce((most, value, i) => (value === null || b[i] === null ? most : Math.max(most, Math.abs(value - b[i]))), 0);
const frames = () => editor('editor.view.frames');

async function drag(locator, dx, dy) {
  const box = await locator.boundingBox();
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + dx / 2, y + dy / 2, { steps: 4 });
  await page.mouse.move(x + dx, y + dy, { steps: 4 });
  await page.waitForFunction(() => !window.crowdface.editor.pending);
  const during = await points();
  await page.mouse.up();
  return during;
}

// Open.
const began = Date.now();
await page.goto(address);
await page.waitForSelector('.board');
await settled();
console.log(`opened in ${Date.now() - began} ms, blends on the ${await editor('editor.view.blender.name')}`);
const job = await editor('({regions: editor.job.regions.map((r) => r.name), heads: editor.job.heads.map((h) => h.name), mm: editor.job.mm_per_unit, faces: editor.job.crowd?.faces.length ?? 0, textures: editor.job.heads.some((h) => h.texture)})');
const [region] = job.regions;
assert.match(await page.locator('.measures').innerText(), /nearest head \d/);
await page.waitForSelector('.traits summary');
assert.match(await page.locator('.traits').textContent(), /nose width[\d.]+ mm[+−][\d.]+/);
await take('opened');

// What the face wears stands on it once the program has told where, and can be chosen.
await page.waitForFunction(() => window.crowdface.editor.view.worn.node.children.length === 1);
await rested();
const card = await page.evaluate(`(${wornPixels})(window.crowdface.editor.view)`);
assert.ok(card.left > 100 && card.red > 0.9 * card.left && card.right < 0.3 * card.left, JSON.stringify(card));
await page.getByLabel('What the face wears: hat').selectOption('none');
await page.waitForFunction(() => window.crowdface.editor.view.worn.node.children.length === 0);
await page.getByLabel('What the face wears: hat').selectOption('card');
await page.waitForFunction(() => window.crowdface.editor.view.worn.node.children.length === 1);

// Without a graphics card what moves is drawn from few triangles, what is worn with it; at rest in full, with smooth
// outlines. A pixel of the outline is neither whole nor empty.
const drawing = () => page.evaluate(() => {
  const { view } = window.crowdface.editor;
  view.draw();
  const { triangles } = view.renderer.info.render;
  const canvas = document.createElement('canvas');
  [canvas.width, canvas.height] = [view.node.width, view.node.height];
  const context = canvas.getContext('2d');
  context.drawImage(view.node, 0, 0);
  const { data } = context.getImageData(0, 0, canvas.width, canvas.height);
  let between = 0;
  for (let i = 3; i < data.length; i += 4) between += data[i] > 20 && data[i] < 235 ? 1 : 0;
  return { triangles, between, width: canvas.width };
});
await settled();
await rested();
const view = await page.locator('canvas.turntable').first().boundingBox();
const still = await drawing();
assert.equal(still.width, Math.round(view.width));
assert.ok(still.between > 400, `${still.between} pixels smooth the outline`);
// A picture for the library leaves the face as it stands: the draft does not appear, the program is not asked again.
const stood = await points();
const isLeft = await page.evaluate(async () => {
  const { editor } = window.crowdface;
  const { exactFace } = editor;
  await editor.wornPicture('hat', 'card');
  await new Promise((done) => { requestAnimationFrame(() => requestAnimationFrame(done)); });
  return editor.exactFace === exactFace && editor.exactOf === editor.document && !editor.view.moving;
});
assert.ok(isLeft, 'the face moved for a picture');
assert.ok(farthest(await points(), stood) < 1e-6);
assert.deepEqual(await drawing(), still);
await page.mouse.move(view.x + view.width / 2, view.y + view.height / 2);
await page.mouse.down();
for (let i = 1; i <= 6; i += 1) await page.mouse.move(view.x + view.width / 2 + i, view.y + view.height / 2);
const moving = await drawing();
await page.evaluate(() => { // from when it is let go until it is drawn in full
  const { node, renderer } = window.crowdface.editor.view;
  const gl = renderer.getContext();
  window.untilDrawn = () => gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
  addEventListener('pointerup', () => {
    const began = performance.now();
    new MutationObserver((_, observer) => {
      if (node.ariaBusy === 'true') return;
      observer.disconnect();
      window.untilDrawn();
      window.restMs = performance.now() - began;
    }).observe(node, { attributeFilter: ['aria-busy'] });
  }, { once: true, capture: true });
});
const movingCard = await page.evaluate(`(${wornPixels})(window.crowdface.editor.view)`);
await page.mouse.up();
assert.ok(moving.triangles > 4000 && moving.triangles < 26000, `${moving.triangles} triangles move`);
// At the lowest resolution, a tenth of the card's pixels are mixed with what lies behind its edges.
assert.ok(movingCard.left > 100 && movingCard.red > 0.7 * movingCard.left, `what moves is worn: ${JSON.stringify(movingCard)}`);
await rested();
assert.equal((await drawing()).width, still.width, 'at rest there are all pixels');
const [restMs, wholeMs] = await page.evaluate(() => {
  const { view } = window.crowdface.editor;
  const times = [0, 1, 2].map(() => {
    const began = performance.now();
    view.draw();
    window.untilDrawn();
    return performance.now() - began;
  });
  return [window.restMs, Math.max(...times)];
});
console.log(`in full after ${restMs.toFixed(0)} ms; a whole frame takes ${wholeMs.toFixed(0)} ms`);
assert.ok(restMs < 250 + 1.5 * wholeMs, `in full after ${restMs} ms, where a whole frame takes ${wholeMs} ms`);
await page.keyboard.press('f');
await rested();

// The preview is the program's face, but for what only the program does to eyes and lips.
async function previewError() {
  return page.evaluate(() => {
    const { editor: it } = window.crowdface;
    const { blender, mesh } = it.view;
    blender.unsettle();
    blender.blend(...it.coefficientsOf(it.document));
    const mine = blender.read();
    const exact = it.exactFace.positions;
    let most = 0;
    for (let v = 0; v < mesh.vertices; v += 1) {
      if (mesh.part?.[v]) continue;
      for (let c = 0; c < 3; c += 1) most = Math.max(most, Math.abs(mine[3 * v + c] - exact[3 * v + c]));
    }
    it.exactOf = null;
    it.refresh();
    return most * it.job.mm_per_unit;
  });
}

// Drag a controller: the face follows while the button is down.
const first = await points();
const before = await recipe();
// Distances follow while it is dragged, before the program's own face comes.
const faces = [];
await page.route('**/api/face', (route) => { faces.push(route); });
const told = await page.locator('.measures').innerText();
const handle = await page.locator(`.handle[data-region="${region}"]`).boundingBox();
await page.mouse.move(handle.x + handle.width / 2, handle.y + handle.height / 2);
await page.mouse.down();
await page.mouse.move(handle.x + 40, handle.y - 30, { steps: 4 });
await page.waitForFunction((before) => document.querySelector('.measures').innerText.match(/nearest head [\d.]+/)[0] !==
  before.match(/nearest head [\d.]+/)[0], told);
await page.mouse.up();
await page.unroute('**/api/face');
await Promise.all(faces.map((route) => route.continue().catch(() => {})));
await settled();
await page.keyboard.press('Control+z');
await settled();

const during = await drag(page.locator(`.handle[data-region="${region}"]`), 70, 45);
assert.ok(farthest(first, during) > 0.01 / job.mm, 'the face follows the mouse');
assert.equal(await steps(), 1, 'one drag is one step');
const dragged = await recipe();
assert.notDeepEqual(dragged.regions[region].position, before.regions[region].position);
await settled();
assert.ok(farthest(during, await points()) < 3 / job.mm, 'the program’s face is near the preview');
const error = await previewError();
console.log(`preview within ${error.toFixed(4)} mm of the program's face`);
assert.ok(error < 0.1, `the preview is ${error} mm off`);
await settled();
await take('dragged');

// Sliders: by mouse, by keys, and a typed number.
const slider = page.locator(`.regioncard[data-region="${region}"] input[type=range]`);
await drag(slider.first(), -40, 0);
await settled();
const smoother = await recipe();
assert.notEqual(smoother.regions[region].smoothness, dragged.regions[region].smoothness);
await slider.nth(1).focus();
for (let i = 0; i < 12; i += 1) await page.keyboard.press('ArrowRight');
await settled();
assert.ok((await recipe()).regions[region].extrapolation > smoother.regions[region].extrapolation + 0.1);
const amount = page.locator(`.regioncard[data-region="${region}"] input[type=number]`).first();
await amount.fill('35');
await amount.press('Enter');
await settled();
assert.equal((await recipe()).regions[region].smoothness, 0.35);
await page.locator(`.regioncard[data-region="${region}"] select`).selectOption('mm');
assert.match((await recipe()).regions[region].smoothness, /^[\d.]+ mm$/);
await settled();

// Another target, with one click.
const other = job.heads.find((name) => name !== before.target);
const otherHead = page.locator(`.head[data-head="${other}"]`);
await otherHead.click();
assert.equal((await recipe()).target, other);
await settled();
assert.equal(await otherHead.getAttribute('aria-pressed'), 'true');
assert.ok((await previewError()) < 0.1);
await settled();
await take('target');

// Drag a head: weights change, not the controllers; the recipe tells weights.
const place = (await recipe()).regions[region].position;
await drag(page.locator(`.head[data-head="${job.heads[2]}"]`), 30, 20);
assert.deepEqual((await recipe()).regions[region].position, place);
assert.ok((await editor('editor.wire()')).regions[region].weights);
await settled();
assert.ok((await previewError()) < 0.1);
await settled();

// Prints the time of a frame while something is dragged.
console.log(await page.evaluate((name) => {
  const { editor: it } = window.crowdface;
  const { view } = it;
  const gl = view.renderer.getContext();
  const pixel = new Uint8Array(4);
  view.setMoving(true);
  const times = [];
  for (let i = 0; i < 12; i += 1) {
    const coefficients = it.coefficientsOf(it.withRegions(name, ({ weights, ...rest }) => ({ ...rest, position: [0.01 * i, 0.1] })));
    const began = performance.now();
    view.blend(...coefficients);
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
    times.push(performance.now() - began);
  }
  times.sort((a, b) => a - b);
  it.exactOf = null;
  it.refresh();
  return `a frame of ${view.mesh.vertices} vertices takes ${times[0].toFixed(1)} to ${times[6].toFixed(1)} ms`;
}, region));
await settled();

// Undo everything and do it again.
const made = await recipe();
const count = await steps();
await page.keyboard.press('Escape');
for (let i = 0; i < count; i += 1) await page.keyboard.press('Control+z');
assert.deepEqual(await recipe(), before);
assert.equal(await steps(), 0);
for (let i = 0; i < count; i += 1) await page.keyboard.press('Control+Shift+Z');
assert.deepEqual(await recipe(), made);
await settled();

// Keep it, change it, compare.
await page.keyboard.press('k');
await page.waitForSelector('.cards .card img');
await page.keyboard.press('1');
for (let i = 0; i < 6; i += 1) await page.keyboard.press('ArrowLeft');
const changed = await recipe();
assert.notDeepEqual(changed, made);
await page.keyboard.press('b');
assert.deepEqual(await recipe(), made);
await settled();
await page.keyboard.press('b');
assert.deepEqual(await recipe(), changed);
await settled();

// Linked regions take the same values.
if (job.regions.length > 1) {
  for (const name of job.regions.slice(0, 2)) await page.locator(`.regioncard[data-region="${name}"] button`, { hasText: 'link' }).click();
  await page.keyboard.press('2');
  await page.keyboard.press('ArrowUp');
  const linked = await recipe();
  assert.deepEqual(linked.regions[job.regions[0]].position, linked.regions[job.regions[1]].position);
  for (const name of job.regions.slice(0, 2)) await page.locator(`.regioncard[data-region="${name}"] button`, { hasText: 'link' }).click();
  await settled();
}

// Draw with a region locked; six like it.
await page.locator(`.regioncard[data-region="${region}"] button.lock`).click();
const held = (await recipe()).regions[region];
const sofar = await steps();
await page.getByRole('button', { name: 'Draw', exact: true }).click();
await page.waitForFunction((n) => window.crowdface.editor.history.past.length > n, sofar);
const drawn = await recipe();
await settled();
if (!process.env.MOCK) {
  const same = (a, b) => a.smoothness === b.smoothness && a.extrapolation === b.extrapolation;
  assert.ok(same(drawn.regions[region], held), 'a locked region stays');
}
await page.keyboard.press('l');
await page.waitForFunction(() => document.querySelectorAll('.picks .card img').length === 6, null, { timeout: 120000 });
await settled();
await take('six');
await page.locator('.picks .portrait').nth(2).click();
await page.waitForFunction((n) => window.crowdface.editor.history.past.length > n, sofar + 1);
await page.keyboard.press('Escape');
await page.locator(`.regioncard[data-region="${region}"] button.lock`).click();

// Between two.
await page.keyboard.press('n');
await page.locator('.ends select').nth(1).selectOption(job.heads[0]);
await page.locator('.ends input').focus();
await page.keyboard.press('ArrowRight');
await page.getByRole('button', { name: 'Take it' }).click();
await settled();

// Turn, wheel, wireframe, distances, textures.
const canvas = page.locator('canvas.turntable');
await drag(canvas, -120, 10);
assert.ok(Math.abs(await editor('editor.view.angle()')) > 10);
await page.mouse.wheel(0, -300);
await page.keyboard.press('w');
await page.getByLabel('What the face shows').selectOption('distance');
const drawnFrames = await frames();
await page.waitForTimeout(300);
await take('distance');
assert.ok((await frames()) >= drawnFrames);
await page.keyboard.press('w');
await page.getByLabel('What the face shows').selectOption('regions');
await page.waitForTimeout(200);
await take('regions');
if (job.textures) {
  await page.getByLabel('What the face shows').selectOption('texture');
  await page.waitForFunction(() => window.crowdface.editor.view.material.map !== null);
  await page.waitForTimeout(300);
  await take('texture');
}
await page.keyboard.press('Escape');
await page.keyboard.press('f');

// Paint a region's mask; the face follows, and nothing is saved that the config would not make.
if (await editor('editor.job.can_paint')) {
  const share = () => page.evaluate(() => {
    const { mesh } = window.crowdface.editor.view;
    const count = window.crowdface.editor.job.regions.length;
    let sum = 0;
    for (let v = 0; v < mesh.vertices; v += 1) sum += mesh.alpha[count * v];
    return sum;
  });
  const painted = async (act) => {
    const old = await share();
    await act();
    await page.waitForFunction(() => !window.crowdface.editor.painting.sending);
    await settled();
    return (await share()) - old;
  };
  await page.keyboard.press('Escape');
  await page.keyboard.press('f');
  await page.keyboard.press('m');
  const placeBefore = await editor('editor.view.place()');
  // The mouse is let go while the stroke's first points are still on their way: the others belong to it, and
  // an answer that takes its time is waited for.
  const slowly = async (route) => {
    await new Promise((done) => { setTimeout(done, 1500); });
    await route.continue();
  };
  await page.route(/masks\/(stroke|undo)$/, slowly);
  const more = await painted(() => drag(canvas, 60, 90));
  assert.ok(more > 5, `a stroke adds ${more} vertices' worth`);
  assert.deepEqual(await editor('editor.view.place()'), placeBefore, 'the brush does not turn the view');
  const sums = await page.evaluate(() => {
    const { editor: it } = window.crowdface;
    const count = it.job.regions.length;
    let most = 0;
    for (let v = 0; v < it.view.mesh.vertices; v += 1) {
      if (it.view.mesh.part[v]) continue;
      const sum = it.view.mesh.alpha.slice(count * v, count * v + count).reduce((a, b) => a + b, 0);
      most = Math.max(most, Math.abs(sum - 1));
    }
    return most;
  });
  assert.ok(sums < 1e-5, `sums of masks are one, to ${sums}`);
  assert.ok((await previewError()) < 0.1, 'the program blends with what is painted');
  await settled();
  await take('painting');
  const less = await painted(() => page.getByRole('button', { name: 'Undo stroke' }).click());
  assert.ok(Math.abs(less + more) < 1e-3, `a whole stroke is taken back: ${less} of ${more}`);
  await page.keyboard.press('Escape');
  await settled();
}

// By keyboard alone: from the top to the first head, the heads, the controllers and the cards.
await page.locator('.toolbar select').first().focus();
const reached = new Set();
for (let i = 0; i < 120; i += 1) {
  await page.keyboard.press('Tab');
  reached.add(await page.evaluate(() => {
    const at = document.activeElement;
    return at.closest('.head') ? 'head' : at.closest('.handle') ? 'handle' : at.matches('canvas') ? 'face'
      : at.closest('.regioncard') ? 'card' : at.closest('.toolbar') ? 'toolbar' : at.closest('.shelf') ? 'shelf' : 'other';
  }));
}
for (const place of ['toolbar', 'face', 'head', 'handle', 'shelf', 'card']) assert.ok(reached.has(place), `Tab reaches ${place}`);
await page.locator(`.head[data-head="${job.heads[1]}"]`).focus();
await page.keyboard.press('Enter');
assert.equal((await recipe()).target, job.heads[1]);
await page.keyboard.press('Shift+ArrowLeft');
assert.ok(await editor('editor.document.anchors[editor.job.heads[1].name]'), 'an arrow moves a head');
for (let i = 0; i < 2; i += 1) await page.keyboard.press('Control+z');
await canvas.focus();
const facing = await editor('editor.view.angle()');
await page.keyboard.press('ArrowRight');
assert.notEqual(await editor('editor.view.angle()'), facing);
await page.keyboard.press('f');
const nameless = await page.evaluate(() => [...document.querySelectorAll('button, input, select, [tabindex="0"]')]
  .filter((node) => !node.getAttribute('aria-label') && !node.textContent.trim() && !node.labels?.length).map((node) => node.outerHTML));
assert.deepEqual(nameless, [], 'all that takes the focus has a name');
await page.keyboard.press('Escape');
await page.keyboard.press('?');
await page.waitForSelector('dialog[open]');
await take('keys');
await page.keyboard.press('Escape');

// Reload: everything is still there, and undo goes on.
await page.locator('.toolbar .name').fill('made_by_hand');
await page.locator('.toolbar .name').press('Enter');
const last = await recipe();
const stepsBefore = await steps();
await kept();
await page.reload();
await page.waitForSelector('.board');
await settled();
assert.deepEqual(await recipe(), last);
assert.equal(await steps(), stepsBefore);
assert.equal(await page.locator('.shelf .card img').count(), 1);
await page.keyboard.press('Control+z');
assert.notDeepEqual(await recipe(), last);
await page.keyboard.press('Control+Shift+Z');
assert.deepEqual(await recipe(), last);
await settled();

// Save the mesh.
await page.getByLabel('Format of the mesh').selectOption('obj');
await page.keyboard.press('Escape');
await page.keyboard.press('Control+s');
await page.waitForFunction(() => /^Saved: /.test(document.querySelector('.message').textContent), null, { timeout: 120000 });
const file = (await page.locator('.message').innerText()).replace('Saved: ', '');
const saved = await editor('editor.wire()');
await take('saved');
// The saved picture is the view: as it stands there, turned, at the same size.
await canvas.focus();
await page.keyboard.press('ArrowRight');
await rested();
const download = page.waitForEvent('download');
await page.getByRole('button', { name: 'Picture', exact: true }).click();
const downloaded = await download;
assert.equal(downloaded.suggestedFilename(), 'made_by_hand_view.png');
const png = readFileSync(await downloaded.path()).toString('base64');
const differing = await page.evaluate(async (base64) => {
  const saved = new Image();
  saved.src = `data:image/png;base64,${base64}`;
  await saved.decode();
  const { view } = window.crowdface.editor;
  const pixels = (draw) => {
    const canvas = document.createElement('canvas');
    [canvas.width, canvas.height] = [saved.width, saved.height];
    const context = canvas.getContext('2d');
    draw(context);
    return context.getImageData(0, 0, saved.width, saved.height).data;
  };
  const own = pixels((context) => context.drawImage(saved, 0, 0));
  const seen = pixels((context) => { view.draw(); context.drawImage(view.node, 0, 0); });
  let shown = 0;
  let different = 0;
  for (let i = 0; i < seen.length; i += 4) {
    if (seen[i + 3] < 255) continue;
    shown += 1;
    if ([0, 1, 2].some((c) => Math.abs(seen[i + c] - own[i + c]) > 2)) different += 1;
  }
  return { size: [saved.width - view.node.width, saved.height - view.node.height], shown, different };
}, png);
assert.deepEqual(differing.size, [0, 0]);
assert.ok(differing.shown > 20000 && differing.different === 0, JSON.stringify(differing));
await page.keyboard.press('f');

// Save it under the config's recipes, and say about a face of the crowd what a review says.
const said = (pattern) => page.waitForFunction(
  (text) => new RegExp(text).test(document.querySelector('.message').textContent), pattern, { timeout: 120000 });
await page.getByRole('button', { name: 'Put back' }).click();
await page.getByRole('button', { name: 'Save it under recipes' }).click();
await said('made_by_hand is saved under recipes');
for (let i = 0; i < 2; i += 1) await page.keyboard.press(']'); // the first is written by hand
await settled();
const opened = await editor('editor.document.face');
assert.ok(opened, 'a face of the crowd is open');
await page.locator(`.regioncard[data-region="${region}"] button.lock`).click();
await page.getByRole('button', { name: 'Put back' }).click();
await take('put_back');
await page.getByLabel('Note').fill('the chin: é "so"');
await page.getByRole('button', { name: 'Redraw except' }).click();
await said(`${opened} is marked`);
// Changes of another face, by the gallery's buttons.
await page.keyboard.press(']');
await settled();
const another = await editor('editor.document.face');
await page.getByRole('button', { name: 'Put back' }).click();
await page.locator('.changes').getByRole('button', { name: 'Older' }).click();
await said(`${another} is changed`);
await page.locator('.changes').getByRole('button', { name: `Variant of ${opened.slice(-4)}` }).click();
await page.locator('.changes .on:has-text("Variant")').waitFor();
await page.locator('.changes').getByRole('button', { name: 'Other skin' }).click();
await page.locator('.changes .on:has-text("Other skin: synth")').waitFor();
await page.locator('.changes').getByRole('button', { name: 'Older' }).click(); // no longer older
await page.waitForFunction(() => document.querySelectorAll('.changes .on').length === 2);
await take('changes');
await page.keyboard.press('Escape');
await page.keyboard.press('Control+z');
for (let i = 0; i < 2; i += 1) await page.keyboard.press('Control+z');
assert.deepEqual(await recipe(), last);
await settled();

// Large screens.
await page.setViewportSize({ width: 3840, height: 2160 });
await page.waitForTimeout(1500);
await take('large');
const cut = await page.evaluate(() => [...document.querySelectorAll('.toolbar, .regioncard header, .control')]
  .filter((node) => node.scrollWidth > node.clientWidth + 1).map((node) => node.className));
assert.deepEqual(cut, [], 'nothing is cut off');

const shown = await points();

// The same on the card, which is a program here: the shaders compute what the processor does.
await page.setViewportSize({ width: 800, height: 600 });
await page.goto(`${address}?blend=card`);
await page.waitForSelector('.board');
await settled();
assert.equal(await editor('editor.view.blender.name'), 'card');
assert.ok(farthest(shown, await points()) < 0.01 / job.mm, 'the same face stands there');
const onCard = await previewError();
console.log(`on the card within ${onCard.toFixed(4)} mm of the program's face`);
assert.ok(onCard < 0.1);
await settled();
await drag(page.locator(`.handle[data-region="${region}"]`), -40, 30);
await settled();
assert.ok((await previewError()) < 0.1);

writeFileSync(resultFile, JSON.stringify({ recipe: saved, file, reviewed: opened, points: shown }));
assert.deepEqual(problems, []);
await browser.close();
console.log('all right');
