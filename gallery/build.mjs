// SPDX-License-Identifier: Apache-2.0
// Bundles the pages: node build.mjs FOLDER writes the gallery (index.html, gallery.js, gallery.css),
// the editor (editor.html, editor.js, editor.css) and the page to pick landmarks (pick.html, …) there.
import { copyFileSync, mkdirSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { build } from 'esbuild';

const here = dirname(fileURLToPath(import.meta.url));
const folder = process.argv[2];
if (!folder) throw new Error('usage: node build.mjs FOLDER');
mkdirSync(folder, { recursive: true });
await build({
  entryPoints: {
    gallery: join(here, 'src/main.js'),
    editor: join(here, 'src/editor/main.js'),
    pick: join(here, 'src/pick/main.js'),
  },
  outdir: folder,
  bundle: true,
  minify: true,
  format: 'iife', // classic: pages opened from disk load no modules
  target: 'es2020',
  legalComments: 'none', // three.LICENSE.txt stands beside the bundles
  logLevel: 'warning',
});
await build({
  entryPoints: {
    gallery: join(here, 'src/gallery.css'),
    editor: join(here, 'src/editor/editor.css'),
    pick: join(here, 'src/pick/pick.css'),
  },
  outdir: folder,
  bundle: true,
  logLevel: 'warning',
});
for (const page of ['index.html', 'editor.html', 'pick.html']) copyFileSync(join(here, page), join(folder, page));
copyFileSync(join(here, 'node_modules/three/LICENSE'), join(folder, 'three.LICENSE.txt'));
