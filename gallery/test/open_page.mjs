// SPDX-License-Identifier: Apache-2.0
// A page in a headless Chromium that draws without a graphics card.
import { mkdirSync } from 'node:fs';
import { join } from 'node:path';
import { chromium } from 'playwright-core';

/// \param pictures  the folder that take(NAME) writes to; nothing: it does nothing.
/// \param own       what begins a request that the page may make.
/// \return          problems: what went wrong on the page so far, a sentence each.
export async function openPage({ width = 1280, height = 720, pictures, own = null } = {}) {
  const browser = await chromium.launch({
    executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
    args: ['--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'],
  });
  const context = await browser.newContext({ viewport: { width, height }, acceptDownloads: true });
  const page = await context.newPage();
  page.setDefaultTimeout(120000); // a busy machine is no fault
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
  return { browser, context, page, problems, take };
}
