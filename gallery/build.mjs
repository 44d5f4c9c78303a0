// SPDX-License-Identifier: Apache-2.0
// Bundles the gallery: node build.mjs FOLDER writes index.html, gallery.css and gallery.js there.
import { copyFileSync, mkdirSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { build } from 'esbuild';

const here = dirname(fileURLToPath(import.meta.url));
const folder = process.argv[2];
if (!folder) throw new Error('usage: node build.mjs FOLDER');
mkdirSync(folder, { recursive: true });
await build({
  entryPoints: [join(here, 'src/main.js')],
  outfile: join(folder, 'gallery.js'),
  bundle: true,
  minify: true,
  format: 'iife', // classic: pages opened from disk load no modules
  target: 'es2020',
  legalComments: 'none', // three.LICENSE.txt stands beside the bundle
  logLevel: 'warning',
});
copyFileSync(join(here, 'index.html'), join(folder, 'index.html'));
copyFileSync(join(here, 'src/gallery.css'), join(folder, 'gallery.css'));
copyFileSync(join(here, 'node_modules/three/LICENSE'), join(folder, 'three.LICENSE.txt'));
