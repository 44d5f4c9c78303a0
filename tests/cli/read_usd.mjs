// SPDX-License-Identifier: Apache-2.0
// Loads the USD layers of a crowd with two readers, three.js's and TinyUSDZ, and compares them with its NumPy files.
//   node read_usd.mjs CROWD NODE_MODULES
import assert from 'node:assert/strict';
import { readFileSync, readdirSync } from 'node:fs';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';

const [crowd, modules] = process.argv.slice(2);
const meshes = join(crowd, 'meshes');

async function openTinyUsdz() {
  // It is built for browsers alone: a worker of one is what it finds here.
  Object.assign(globalThis, { WorkerGlobalScope: class {}, self: globalThis });
  process.type = 'renderer';
  const at = join(modules, 'tinyusdz');
  const { default: init } = await import(pathToFileURL(join(at, 'tinyusdz.js')));
  const program = readFileSync(join(at, 'tinyusdz.wasm'));
  return init({
    instantiateWasm(imports, done) {
      WebAssembly.instantiate(program, imports).then((made) => done(made.instance, made.module));
      return {};
    },
  });
}

function readArray(path, Numbers) {
  const bytes = readFileSync(path);
  const begin = 10 + bytes.readUInt16LE(8);
  const copy = new Uint8Array(bytes.subarray(begin));
  return Numbers ? new Numbers(copy.buffer) : copy.buffer;
}

const numbers = (text) => JSON.parse(text.replace(/[()]/g, ''));
const singles = (text) => new Float32Array(numbers(text));

function child(prim, type, name) {
  const found = prim[`def ${type} "${name}"`];
  assert.ok(found, `no ${type} ${name}`);
  return found;
}

function compareShapes(mesh, id, names) {
  const records = new DataView(readArray(join(meshes, `${id}+shapes.npy`)));
  const size = 20;
  names.forEach((name, number) => {
    const shape = child(mesh, 'BlendShape', name.replace(/\W/g, '_'));
    const indices = [];
    const deltas = [];
    for (let at = 0; at < records.byteLength; at += size) {
      if (records.getUint32(at, true) !== number) continue;
      indices.push(records.getUint32(at + 4, true));
      for (let c = 0; c < 3; ++c) deltas.push(records.getFloat32(at + 8 + 4 * c, true));
    }
    assert.deepEqual(numbers(shape['uniform int[] pointIndices']), indices);
    assert.deepEqual(singles(shape['uniform vector3f[] offsets']), new Float32Array(deltas));
  });
}

function compareFace(parser, text, id, names) {
  const face = child(child(parser.parseText(text), 'Xform', id), 'SkelRoot', 'face');
  const mesh = child(face, 'Mesh', 'mesh');
  const topology = join(meshes, 'topology');
  const points = readArray(join(meshes, `${id}.npy`), Float32Array);
  assert.deepEqual(singles(mesh['point3f[] points']), points);
  assert.equal(singles(mesh['normal3f[] normals']).length, points.length);
  const offsets = readArray(join(topology, 'offsets.npy'), Int32Array);
  assert.deepEqual(numbers(mesh['int[] faceVertexCounts']),
    Array.from(offsets.subarray(1), (end, f) => end - offsets[f]));
  assert.deepEqual(new Int32Array(numbers(mesh['int[] faceVertexIndices'])),
    readArray(join(topology, 'corners.npy'), Int32Array));
  assert.deepEqual(singles(mesh['texCoord2f[] primvars:st']),
    readArray(join(topology, 'uvs.npy'), Float32Array));
  assert.deepEqual(new Int32Array(numbers(mesh['int[] primvars:st:indices'])),
    readArray(join(topology, 'corner_uvs.npy'), Int32Array));
  assert.deepEqual(numbers(mesh['uniform token[] skel:blendShapes']), names);
  compareShapes(mesh, id, names);
  const drawn = [];
  parser.parse(text, {}).traverse((object) => object.isMesh && drawn.push(object));
  assert.ok(drawn.length > 0 && drawn[0].geometry.attributes.position.count > 0);
  const [skin] = [drawn[0].material].flat();
  for (const map of ['map', 'normalMap', 'roughnessMap']) assert.ok(skin[map], `${id}: no ${map}`);
}

/// What a strict reader says of a layer; `assets` are the layers that it references.
function load(reader, path, assets) {
  const stage = new reader.TinyUSDZLoaderNative();
  const bytes = readFileSync(path);
  if (!assets) {
    assert.ok(stage.loadFromBinary(bytes, path), `${path}: ${stage.error()}`);
  } else {
    assert.ok(stage.loadAsLayerFromBinary(bytes, path), `${path}: ${stage.error()}`);
    for (const [name, asset] of assets) stage.setAsset(name, asset);
    assert.ok(stage.composeReferences(), `${path}: ${stage.error()}`);
    assert.ok(stage.layerToRenderScene(), `${path}: ${stage.error()}`);
  }
  return stage;
}

// Pictures are named, and not loaded: a browser's alone are read by three.js.
globalThis.document = {
  createElementNS: () => ({ addEventListener() {}, removeEventListener() {}, src: '' }),
};
const reader = await openTinyUsdz();
delete globalThis.self;
const { USDAParser } =
  await import(pathToFileURL(join(modules, 'three/examples/jsm/loaders/usd/USDAParser.js')));
const layers = readdirSync(meshes).filter((name) => name.endsWith('.usda'));
const faces = layers.filter((name) => !name.includes('+')).map((name) => name.slice(0, -5));
const letters = readArray(join(meshes, 'topology/shape_names.npy'), Uint32Array);
const names = Array.from({ length: letters.length / 64 }, (_, i) =>
  String.fromCodePoint(...letters.subarray(64 * i, 64 * i + 64).filter(Boolean)));
for (const id of faces) {
  compareFace(new USDAParser(), readFileSync(join(meshes, `${id}.usda`), 'utf8'), id, names);
}
const meshesOf = (layer) => readFileSync(join(meshes, layer), 'utf8').split('def Mesh ').length - 1;
for (const layer of layers) {
  assert.equal(load(reader, join(meshes, layer)).numMeshes(), meshesOf(layer), layer);
}

const stage = join(crowd, 'crowd.usda');
const referenced = readFileSync(stage, 'utf8').match(/@[^@]*@/g).map((name) => name.slice(1, -1));
assert.deepEqual([...referenced].sort(), layers.map((name) => `./meshes/${name}`).sort());
const assets = referenced.map((name) => [name, readFileSync(join(crowd, name))]);
const composed = load(reader, stage, assets);
if (layers.length === faces.length) {
  const all = layers.reduce((sum, layer) => sum + meshesOf(layer), 0);
  assert.equal(composed.numMeshes(), all);
}
console.log(`${layers.length} layers of ${faces.length} faces, ${names.length} shapes: as in the NumPy files`);
