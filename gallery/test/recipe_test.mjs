// SPDX-License-Identifier: Apache-2.0
// The editor's mathematics: weights, levels, coefficients, blends, steps; the colours of legends.
//   node --test recipe_test.mjs
import assert from 'node:assert/strict';
import test from 'node:test';
import { unpack } from './src/api.js';
import { tagsOf } from './src/crowd.js';
import { cornersAround } from './src/editor/corners.js';
import { normalsOf } from './src/normals.js';
import { hitTriangle } from './src/hit.js';
import { History } from './src/history.js';
import { ProcessorBlend } from './src/editor/processor_blend.js';
import {
  amountAt, bandOf, between, coefficients, headAlone, levelOf, takeOver, targetShares, weightsAt, weightsOf, wire,
  withAmount, withBand,
} from './src/editor/recipe.js';
import { colourOf } from './src/plane.js';

const names = ['ann', 'bob', 'cyd', 'dan'];
const levels = { smoothness: [], iterations: [], size_mm: [] };
for (let i = 0; i <= 256; i += 1) {
  const s = (i / 256) ** 2;
  levels.smoothness.push(s);
  levels.iterations.push(Math.round(20000 * s));
  levels.size_mm.push(240 * Math.sqrt(s));
}
const job = {
  heads: names.map((name, i) => ({ name, anchor: [Math.cos(i * 1.5), Math.sin(i * 1.5)] })),
  regions: [{ name: 'top' }, { name: 'bottom' }],
  normalization: 'partition', max_sources: null, sources: [0, 1, 2], levels,
};
const anchors = job.heads.map((head) => head.anchor);
const sum = (values) => values.reduce((total, value) => total + value, 0);
const near = (a, b, within = 1e-12) => assert.ok(Math.abs(a - b) <= within, `${a} is not ${b}`);
const face = (change = {}) => ({
  recipe: {
    id: 'x', target: 'dan',
    regions: {
      top: { position: [0.3, 0.2], smoothness: 0.4, extrapolation: 1.2, ...change },
      bottom: { weights: { ann: 2, cyd: 1 }, smoothness: '60 mm', extrapolation: 1 },
    },
  },
  anchors: {},
});

test('weights are inverse squares, sum to one and hold the target', () => {
  const weights = weightsAt(job, anchors, 3, job.sources, [0.3, 0.2]);
  near(sum(weights), 1);
  const square = (h) => (0.3 - anchors[h][0]) ** 2 + (0.2 - anchors[h][1]) ** 2;
  near(weights[0] / weights[3], square(3) / square(0), 1e-9);
});

test('at an anchor its head takes all the weight', () => {
  assert.deepEqual(weightsAt(job, anchors, 3, job.sources, anchors[1]), [0, 1, 0, 0]);
});

test('the printed formula leaves the target’s weight out of the result, not out of the sum', () => {
  const partition = weightsAt(job, anchors, 3, job.sources, [0.3, 0.2]);
  const printed = weightsAt({ ...job, normalization: 'printed' }, anchors, 3, job.sources, [0.3, 0.2]);
  assert.equal(printed[3], 0);
  near(sum(printed) + partition[3], 1);
});

test('only so many sources lend beside the target', () => {
  const weights = weightsAt({ ...job, max_sources: 1 }, anchors, 3, job.sources, [0.3, 0.2]);
  assert.equal(weights.filter((weight) => weight > 0).length, 2);
  assert.ok(weights[3] > 0);
  near(sum(weights), 1);
});

test('weights by hand are divided by their sum', () => {
  assert.deepEqual(weightsOf(job, face(), 'bottom').map((w) => Math.round(300 * w)), [200, 0, 100, 0]);
});

test('a level is the same in every unit', () => {
  for (const level of [0, 0.25, 0.63, 1]) {
    for (const unit of ['%', 'mm', 'iterations']) {
      const region = withAmount({}, unit, amountAt(level, unit, levels));
      near(levelOf(region, levels), level, unit === 'iterations' ? 1e-2 : 1e-4);
    }
  }
  assert.deepEqual(Object.keys(withAmount({ smoothness: 0.3 }, 'iterations', 12.4)), ['iterations']);
});

const heads = names.map((_, h) => {
  const rank = 2 + (h % 2);
  const functions = new Float32Array(257 * rank);
  for (let i = 0; i <= 256; i += 1) for (let p = 0; p < rank; p += 1) functions[i * rank + p] = (i / 256) * (p + 1);
  return { rank, functions };
});

test('the target blended with itself has no coefficients', () => {
  for (const list of coefficients(job, headAlone(job, 'dan', 'x'), heads)) assert.deepEqual(list, []);
});

test('coefficients are shares times functions', () => {
  const document = face();
  const [top] = coefficients(job, document, heads);
  const weights = weightsOf(job, document, 'top');
  const entry = top.find(({ head, field }) => head === 1 && field === 2);
  near(entry.value, -1.2 * weights[1] * 3 * Math.sqrt(0.4), 1e-6);
  const own = top.find(({ head, field }) => head === 3 && field === 0);
  near(own.value, (1 - 1.2 * weights[3]) * Math.sqrt(0.4), 1e-6);
});

const banded = { ...job, bands: [
  { name: 'build', smoothness: [0.5, 0.5], sources: [0, 1, 2] }, { name: 'skin', smoothness: [0.04, 0.01], sources: [1] }] };
const withSkin = () => face({ bands: { skin: { weights: { bob: 1 }, smoothness: 0.09, extrapolation: 0.5 } } });

test('each band lends between its level and the next', () => {
  const [top] = coefficients(banded, withSkin(), heads);
  const build = weightsOf(banded, withSkin(), 'top', 'build');
  const of = (head, field) => top.find((entry) => entry.head === head && entry.field === field).value;
  // τ φ(L_1) + Σ_b e_b ω_b (φ(L_b+1) − φ(L_b)), with φ_p(L) = (p + 1) √(L/L_max) here.
  near(of(1, 2), 3 * (1.2 * build[1] * (0.3 - Math.sqrt(0.4)) + 0.5 * (0 - 0.3)), 1e-6);
  near(of(3, 0), Math.sqrt(0.4) + 1.2 * build[3] * (0.3 - Math.sqrt(0.4)), 1e-6);
});

test('bands that say the same are one band', () => {
  const [bands] = coefficients(banded, face({ position: undefined, weights: { ann: 1 } }), heads);
  const [one] = coefficients(job, face({ position: undefined, weights: { ann: 1 } }), heads);
  assert.deepEqual(bands, one);
});

test('one band is changed without the others, and told with them', () => {
  const document = withSkin();
  document.recipe.regions.top = withBand(banded, document.recipe, 'top', 'skin', { position: [1, 0], smoothness: 0.01 });
  assert.deepEqual(bandOf(banded, document.recipe, 'top', 'build').position, [0.3, 0.2]);
  assert.deepEqual(bandOf(banded, document.recipe, 'top', 'skin').position, [1, 0]);
  assert.deepEqual(wire(banded, document).regions.top.bands, { skin: { position: [1, 0], smoothness: 0.01 } });
  document.anchors = { ann: [0, 0] };
  assert.ok(wire(banded, document).regions.top.bands.skin.weights.bob > 0);
});

test('a band that a region leaves open begins where the config says for that region', () => {
  const { recipe } = face();
  assert.deepEqual(bandOf(banded, recipe, 'top', 'skin'), { position: [0.3, 0.2], smoothness: 0.04, extrapolation: 1.2 });
  assert.equal(bandOf(banded, recipe, 'bottom', 'skin').smoothness, 0.01);
});

test('a band that is taken over stays, and the coarser one gives way', () => {
  const high = { weights: { bob: 1 }, smoothness: '120 mm', extrapolation: 0.5 };
  const from = face({ smoothness: 0.6, bands: { skin: high } }).recipe;
  const to = face({ smoothness: 0.1 }).recipe;
  const { top, bottom } = takeOver(banded, [['top', 'skin']], from, to).regions;
  assert.deepEqual(top.bands.skin, high);
  assert.deepEqual({ ...top, bands: null }, { ...to.regions.top, smoothness: '120 mm', bands: null });
  assert.equal(bottom.smoothness, to.regions.bottom.smoothness);
  const build = takeOver(banded, [['top', 'build']], from, to).regions.top;
  assert.equal(build.smoothness, 0.6);
  assert.equal(build.bands.skin.smoothness, 0.04);
  assert.deepEqual(takeOver(job, [['top', '']], from, to).regions.bottom, to.regions.bottom);
});

test('the way between two faces goes through all bands', () => {
  const half = between(banded, withSkin(), face(), 0.5).recipe.regions.top;
  near(half.bands.skin.extrapolation, (0.5 + 1.2) / 2);
  near(levelOf(half.bands.skin, levels), (0.3 + 0.2) / 2, 1e-9);
});

/// A wavy patch of squares, split along one column as by a texture's seam.
function patch(side = 9) {
  const triangles = [];
  const points = [];
  const twin = [];
  for (let y = 0; y < side; y += 1) for (let x = 0; x < side; x += 1) points.push(x, y, Math.sin(x) * Math.cos(y));
  for (let v = 0; v < side * side; v += 1) twin.push(v);
  const copies = new Map();
  for (let y = 0; y < side; y += 1) {
    copies.set(y * side + 4, points.length / 3);
    twin.push(y * side + 4);
    points.push(...points.slice(3 * (y * side + 4), 3 * (y * side + 4) + 3));
  }
  for (let y = 0; y + 1 < side; y += 1) {
    for (let x = 0; x + 1 < side; x += 1) {
      const at = (dx, dy) => {
        const v = (y + dy) * side + x + dx;
        return x >= 4 ? copies.get(v) ?? v : v;
      };
      triangles.push(at(0, 0), at(1, 0), at(1, 1), at(0, 0), at(1, 1), at(0, 1));
    }
  }
  return {
    vertices: twin.length, triangles: Uint32Array.from(triangles), twin: Uint32Array.from(twin),
    points: Float32Array.from(points),
  };
}

test('normals are of unit length, and a seam does not show', () => {
  const { vertices, triangles, twin, points } = patch();
  const four = new Float32Array(4 * vertices);
  for (let v = 0; v < vertices; v += 1) four.set(points.subarray(3 * v, 3 * v + 3), 4 * v);
  const normals = new Float32Array(4 * vertices);
  normalsOf(four, triangles, twin, normals);
  const { first, next, after, place } = cornersAround(vertices, triangles, twin);
  assert.equal(first[vertices], triangles.length);
  for (let v = 0; v < vertices; v += 1) {
    near(Math.hypot(normals[4 * v], normals[4 * v + 1], normals[4 * v + 2]), 1, 1e-5);
    assert.deepEqual(normals.subarray(4 * v, 4 * v + 3), normals.subarray(4 * twin[v], 4 * twin[v] + 3));
    // The card sums the same corners.
    const total = [0, 0, 0];
    for (let i = first[place[v]]; i < first[place[v] + 1]; i += 1) {
      const [a, b] = [next[i], after[i]].map((other) =>
        [0, 1, 2].map((c) => four[4 * other + c] - four[4 * v + c]));
      total[0] += a[1] * b[2] - a[2] * b[1];
      total[1] += a[2] * b[0] - a[0] * b[2];
      total[2] += a[0] * b[1] - a[1] * b[0];
    }
    const length = Math.hypot(...total);
    total.forEach((value, c) => near(value / length, normals[4 * v + c], 1e-5));
  }
});

function blender() {
  const mesh = patch();
  const count = mesh.vertices;
  let seed = 1;
  const random = () => {
    seed = (seed * 48271) % 2147483647;
    return seed / 2147483647 - 0.5;
  };
  mesh.alpha = new Float32Array(2 * count);
  for (let v = 0; v < count; v += 1) {
    const top = Math.min(Math.max(mesh.points[3 * v + 1] / 4 - 0.5, 0), 1);
    mesh.alpha.set([top, 1 - top], 2 * v);
  }
  const blend = new ProcessorBlend(mesh, 2);
  const all = heads.map((head) => ({
    ...head, positions: mesh.points.map((value) => value + 0.1 * random()),
    fields: Int16Array.from({ length: 3 * count * head.rank }, () => Math.round(2000 * random())),
    scale: Array.from({ length: head.rank }, (_, p) => 0.001 * (p + 1)),
  }));
  all.forEach((head, h) => blend.setHead(h, head));
  return { mesh, blend, all };
}

test('a blend on the processor is Eq. 7, also after a change', () => {
  const { mesh, blend, all } = blender();
  for (const document of [face(), face({ smoothness: 0.9 }), face({ position: [0.9, 0.1] })]) {
    const lists = coefficients(job, document, all);
    blend.blend(lists, targetShares(job, document.recipe));
    const result = blend.read();
    for (let v = 0; v < mesh.vertices; v += 7) {
      for (let c = 0; c < 3; c += 1) {
        let expected = all[3].positions[3 * v + c];
        lists.forEach((list, k) => list.forEach(({ head, field, value }) => {
          expected += mesh.alpha[2 * v + k] * value * all[head].scale[field] *
            all[head].fields[3 * mesh.vertices * field + 3 * v + c];
        }));
        near(result[3 * v + c], expected, 1e-5);
      }
    }
  }
});

test('while something moves, the corners of the draft have the points and the relief of the whole blend', () => {
  const { mesh, all } = blender();
  mesh.draft = mesh.triangles.filter((_, i) => Math.floor(i / 3) % 4 === 0);
  const blend = new ProcessorBlend(mesh, 2);
  all.forEach((head, h) => blend.setHead(h, head));
  const corners = new Set([...mesh.draft].flatMap((v) => [v, mesh.twin[v]]));
  assert.ok(corners.size > 20 && corners.size < mesh.vertices - 5);
  const blendOf = (document) => [coefficients(job, document, all), targetShares(job, document.recipe)];
  blend.blend(...blendOf(face({ smoothness: 0.8 })));
  const after = blend.points.slice();
  blend.blend(...blendOf(face()));
  const before = { points: blend.points.slice(), normals: blend.normals.slice() };
  blend.blendDraft(...blendOf(face()));
  before.points.forEach((value, i) => near(blend.points[i], value, 1e-6));
  before.normals.forEach((value, i) => near(blend.normals[i], value, 1e-6));
  blend.blendDraft(...blendOf(face({ smoothness: 0.8 })));
  for (let i = 0; i < 4 * mesh.vertices; i += 1) {
    near(blend.points[i], (corners.has(Math.floor(i / 4)) ? after : before.points)[i], 1e-6);
  }
  blend.blend(...blendOf(face({ smoothness: 0.8 })));
  after.forEach((value, i) => near(blend.points[i], value, 1e-6));
});

test('what the program’s face has beyond the preview stays while one goes on', () => {
  const { mesh, blend, all } = blender();
  const shares = targetShares(job, face().recipe);
  const go = (document) => blend.blend(coefficients(job, document, all), shares);
  go(face({ smoothness: 0.8 }));
  const later = blend.read();
  go(face());
  const plain = blend.read();
  const exact = plain.map((value, i) => value + (i % 5) * 0.01);
  const up = new Float32Array(3 * mesh.vertices).map((_, i) => Number(i % 3 === 2));
  for (let twice = 0; twice < 2; twice += 1) {
    blend.settle(exact, up);
    blend.read().forEach((value, i) => near(value, exact[i], 1e-6));
    near(blend.normals[6], 1, 1e-6);
  }
  go(face({ smoothness: 0.8 }));
  blend.read().forEach((value, i) => near(value, later[i] + (i % 5) * 0.01, 1e-5));
  blend.unsettle();
  go(face());
  blend.read().forEach((value, i) => near(value, plain[i], 1e-6));
});

test('moved heads are told as weights, others as positions', () => {
  const document = face();
  assert.deepEqual(wire(job, document).regions.top.position, [0.3, 0.2]);
  const moved = { ...document, anchors: { ann: [0.3, 0.3] } };
  const { top, bottom } = wire(job, moved).regions;
  assert.equal(top.position, undefined);
  near(sum(Object.values(top.weights)), 1);
  assert.ok(top.weights.ann > weightsOf(job, document, 'top')[0]);
  assert.deepEqual(bottom.weights, { ann: 2, cyd: 1 });
});

test('between two faces both ends are those faces', () => {
  const from = face();
  const to = headAlone(job, 'bob', 'y');
  const [a, b] = [between(job, from, to, 0), between(job, from, to, 1)];
  assert.equal(a.recipe.target, 'dan');
  assert.equal(b.recipe.target, 'bob');
  for (const [end, whole] of [[a, from], [b, to]]) {
    for (const name of ['top', 'bottom']) {
      weightsOf(job, end, name).forEach((weight, h) => near(weight, weightsOf(job, whole, name)[h], 1e-9));
      near(levelOf(end.recipe.regions[name], levels), levelOf(whole.recipe.regions[name], levels), 1e-4);
    }
  }
  near(between(job, from, to, 0.5).recipe.regions.top.extrapolation, 1.1);
});

test('every step can be taken back and done again, also after a reload', () => {
  let history = new History({ n: 0 });
  for (let n = 1; n <= 4; n += 1) history.commit({ n }, `step ${n}`, { time: n });
  history.undo();
  history.undo();
  history = new History({ n: 99 }, JSON.parse(JSON.stringify(history.toJson())));
  assert.deepEqual(history.now, { n: 2 });
  history.redo();
  assert.deepEqual([history.now, history.label], [{ n: 3 }, 'step 3']);
  history.commit({ n: 7 }, 'another');
  assert.equal(history.redo(), false);
  while (history.undo());
  assert.deepEqual(history.now, { n: 0 });
});

test('steps of one kind in a moment are one, and nothing changed is none', () => {
  const history = new History({ n: 0 });
  for (let n = 1; n <= 5; n += 1) history.commit({ n }, 'key', { joins: true, time: 100 * n });
  history.commit({ n: 5 }, 'same');
  assert.equal(history.past.length, 1);
  history.commit({ n: 6 }, 'key', { joins: true, time: 5000 });
  assert.equal(history.past.length, 2);
});

test('binary answers are unpacked as the head lists them', () => {
  const head = JSON.stringify({ ms: 3, arrays: [{ name: 'a', type: 'u8', count: 3 }, { name: 'b', type: 'f32', count: 2 }] });
  const text = head + ' '.repeat((4 - (head.length % 4)) % 4);
  const bytes = new Uint8Array(4 + text.length + 4 + 8);
  new DataView(bytes.buffer).setUint32(0, text.length, true);
  bytes.set(new TextEncoder().encode(text), 4);
  bytes.set([7, 8, 9], 4 + text.length);
  new Float32Array(bytes.buffer, 8 + text.length, 2).set([0.5, -2]);
  const { ms, a, b } = unpack(bytes.buffer);
  assert.deepEqual([ms, [...a], [...b]], [3, [7, 8, 9], [0.5, -2]]);
  assert.throws(() => unpack(new Uint8Array([2, 0, 0, 0]).buffer));
});

test('a ray meets the nearest triangle that looks at it, and no part', () => {
  const points = Float32Array.from([0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 0, 1, 1]);
  const both = Uint32Array.from([0, 1, 2, 3, 4, 5]);
  const hit = hitTriangle([0.2, 0.3, 5], [0, 0, -1], points, both);
  assert.equal(hit.triangle, 1);
  near(hit.u, 0.2, 1e-6);
  near(hit.v, 0.3, 1e-6);
  assert.deepEqual([hit.point[2], hit.normal], [1, [0, 0, 1]]);
  assert.equal(hitTriangle([0.2, 0.3, 5], [0, 0, -1], points, both, [0, 0, 0, 1, 1, 1]).triangle, 0);
  assert.equal(hitTriangle([0.2, 0.3, -5], [0, 0, 1], points, both), null);
  assert.equal(hitTriangle([0.7, 0.7, 5], [0, 0, -1], points, both), null);
});

test('fifty heads have fifty colours', () => {
  assert.equal(new Set(Array.from({ length: 50 }, (_, k) => colourOf(k))).size, 50);
});

test('a mixture has the tags of the head that most of it agrees with', () => {
  const heads = new Map([
    ['ann', { tags: ['female', 'young'] }], ['bob', { tags: ['male', 'old'] }], ['cyd', { tags: ['female', 'young'] }],
  ]);
  assert.deepEqual(tagsOf({ target: 'bob' }, heads), ['male', 'old']);
  assert.deepEqual(tagsOf({ target: 'bob', mixture: { ann: 0.3, bob: 0.4, cyd: 0.3 } }, heads), ['female', 'young']);
  assert.deepEqual(tagsOf({ target: 'bob', mixture: { ann: 0.2, bob: 0.6, cyd: 0.2 } }, heads), ['male', 'old']);
});
