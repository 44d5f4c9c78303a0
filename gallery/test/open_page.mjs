// SPDX-License-Identifier: Apache-2.0
// A page in a headless Chromium that draws without a graphics card.
import { mkdirSync } from 'node:fs';
import { join } from 'node:path';
import { isDeepStrictEqual } from 'node:util';
import { chromium } from 'playwright-core';

/// What is wrong with no page: text below 12 pixels, things to take below 28, controls that scrolling does not bring into
/// the window, that lie behind something, that have no tooltip or no name.
export const fine = { sizes: [], narrow: [], lost: [], covered: [], untold: [], nameless: [] };

function auditPage() {
  const isSeen = (node) => !node.closest('[hidden]') && node.getClientRects().length > 0 && getComputedStyle(node).visibility !== 'hidden';
  const sizes = [...document.querySelectorAll('body *')].filter((node) => {
    const writes = [...node.childNodes].some((child) => child.nodeType === 3 && child.textContent.trim());
    const scale = node.ownerSVGElement ? node.ownerSVGElement.getScreenCTM().a : 1;
    return writes && isSeen(node) && parseFloat(getComputedStyle(node).fontSize) * scale < 11.99;
  }).map((node) => node.textContent);
  const controls = [...document.querySelectorAll('button, input, select, textarea')].filter(isSeen);
  const lost = controls.filter((node) => {
    node.scrollIntoView({ block: 'nearest', inline: 'nearest' });
    const box = node.getBoundingClientRect();
    return box.left < -1 || box.right > innerWidth + 1 || box.top < -1 || box.bottom > innerHeight + 1 || box.width < 8;
  });
  const covered = controls.filter((node) => {
    node.scrollIntoView({ block: 'center', inline: 'center' });
    const box = node.getBoundingClientRect();
    const seen = document.elementFromPoint(box.left + box.width / 2, box.top + box.height / 2);
    return !seen || !(node.closest('label') ?? node).contains(seen);
  });
  const takes = '.handle .knob, .head .anchor > circle:not(.targetring), .card .portrait';
  const narrow = [...document.querySelectorAll(takes)].filter(isSeen).map((node) => node.getBoundingClientRect().width).filter((wide) => wide < 28);
  const told = (nodes) => nodes.map((node) => node.outerHTML.slice(0, 200));
  return {
    sizes, narrow, lost: told(lost), covered: told(covered), untold: told(controls.filter((node) => !node.title && !node.closest('[title]'))),
    nameless: told(controls.filter((node) => !node.getAttribute('aria-label') && !node.textContent.trim() && !node.labels?.length)),
  };
}

/// \param pictures  the folder that take(NAME) writes to; nothing: it does nothing.
/// \param own       what begins a request that the page may make.
/// \return          problems: what went wrong on the page so far, a sentence each; colourAt(x, y): [red, green, blue]
///                  that is seen there;
///                  settled(): waits until the editor shows the program's own face, in its skin and light, at rest;
///                  kept(): waits until the program has the editor's last step;
///                  rested(): waits until all 3D views are drawn in full; stillPicture(locator), alike(one, other), audit().
export async function openPage({ width = 1280, height = 720, pictures, own = null } = {}) {
  const browser = await chromium.launch({
    executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
    args: ['--no-sandbox', '--enable-unsafe-swiftshader'],
  });
  const context = await browser.newContext({ viewport: { width, height }, acceptDownloads: true });
  const page = await context.newPage();
  page.setDefaultTimeout(Number(process.env.PATIENCE_MS ?? 120000)); // a busy machine is no fault
  const problems = [];
  page.on('pageerror', (error) => problems.push(`error: ${error.message}`));
  page.on('console', (message) => message.type() === 'error' && problems.push(`console: ${message.text()}`));
  page.on('request', (request) => {
    const url = request.url();
    if (own && !url.startsWith(own) && !/^(blob|data):/.test(url)) problems.push(`network: ${url}`);
  });
  const take = async (name) => {
    if (!pictures) return;
    mkdirSync(pictures, { recursive: true });
    await page.screenshot({ path: join(pictures, `${name}.png`) });
  };
  const colourAt = async (x, y) => {
    const shot = await page.screenshot({ clip: { x: x - 1, y: y - 1, width: 3, height: 3 } });
    return page.evaluate(async (text) => {
      const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
      const context = new OffscreenCanvas(3, 3).getContext('2d');
      context.drawImage(await createImageBitmap(new Blob([bytes], { type: 'image/png' })), 0, 0);
      return [...context.getImageData(1, 1, 1, 1).data].slice(0, 3);
    }, shot.toString('base64'));
  };
  const rested = () => page.waitForFunction(() => !document.querySelector('canvas[aria-busy=true]'));
  const settled = async () => {
    await page.waitForFunction(() => {
      const it = window.crowdface?.editor;
      return it?.ready && it.light && !it.pending && !it.skin.running && it.exactOf === it.document;
    });
    await rested();
  };
  const kept = (of = page) => of.waitForFunction(() => !window.crowdface.editor.keeping);
  /// What is seen of an element once it no longer changes, as PNG.
  const stillPicture = async (locator) => {
    await rested();
    let before = await locator.screenshot();
    for (;;) {
      await page.waitForTimeout(800);
      await rested();
      const now = await locator.screenshot();
      if (now.equals(before)) return now;
      before = now;
    }
  };
  /// Whether two pictures (PNG) are the same but for the last step of a colour, which the browser rounds by chance.
  const alike = (one, other) => page.evaluate(async (texts) => {
    const [a, b] = await Promise.all(texts.map(async (text) => {
      const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
      const picture = await createImageBitmap(new Blob([bytes], { type: 'image/png' }));
      const context = new OffscreenCanvas(picture.width, picture.height).getContext('2d');
      context.drawImage(picture, 0, 0);
      return context.getImageData(0, 0, picture.width, picture.height);
    }));
    return a.width === b.width && a.height === b.height && a.data.every((value, i) => Math.abs(value - b.data[i]) <= 1);
  }, [one, other].map((picture) => picture.toString('base64')));
  /// A page that changed its size needs a moment until everything has its place.
  const audit = async () => {
    let found = await page.evaluate(auditPage);
    for (let tries = 0; tries < 40 && !isDeepStrictEqual(found, fine); tries += 1) {
      await page.waitForTimeout(250);
      found = await page.evaluate(auditPage);
    }
    return found;
  };
  return { browser, context, settled, kept, rested, stillPicture, alike, page, problems, take, colourAt, audit };
}
