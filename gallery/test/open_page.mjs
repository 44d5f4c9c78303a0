// SPDX-License-Identifier: Apache-2.0
// A page in a headless Chromium that draws without a graphics card.
import { mkdirSync } from 'node:fs';
import { join } from 'node:path';
import { chromium } from 'playwright-core';

/// \param pictures  the folder that take(NAME) writes to; nothing: it does nothing.
/// \param own       what begins a request that the page may make.
/// \return          problems: what went wrong on the page so far, a sentence each; colourAt(x, y): [red, green, blue]
///                  that is seen there.
export async function openPage({ width = 1280, height = 720, pictures, own = null } = {}) {
  const browser = await chromium.launch({
    executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
    args: ['--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'],
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
  return { browser, context, page, problems, take, colourAt };
}
