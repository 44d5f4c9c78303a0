// SPDX-License-Identifier: Apache-2.0
// The crowd's faces with values derived from their recipes; filters and orders of faces.

import { loadScript } from './dom.js';

/// The tags of a face: those of its target or, if the target is a mixture, of the head in it whose tags agree best with
/// those of the other heads (cast/typical_head.h).
export function tagsOf(recipe, heads) {
  const tagsOfHead = (name) => heads.get(name)?.tags ?? [];
  if (!recipe.mixture) return tagsOfHead(recipe.target);
  const parts = Object.entries(recipe.mixture);
  const shareOf = (tag) => parts.reduce(
    (sum, [name, share]) => sum + (tagsOfHead(name).includes(tag) ? share : 0), 0);
  const agrees = ([name]) => tagsOfHead(name).reduce((sum, tag) => sum + 2 * shareOf(tag) - 1, 0);
  const [first] = parts.map((part) => ({ name: part[0], share: part[1], agrees: agrees(part) }))
    .sort((a, b) => (Math.abs(a.agrees - b.agrees) > 1e-9 ? b.agrees - a.agrees : b.share - a.share));
  return tagsOfHead(first.name);
}

function facesOf(data, heads) {
  return data.faces.map((recipe, order) => ({
    ...recipe,
    order,
    tags: tagsOf(recipe, heads),
    group: recipe.group ?? null,
    byHand: recipe.index === null && recipe.family === null,
    changes: recipe.changed?.length ?? 0,
    near: (data.near[order] ?? []).map(([other, mm]) => ({ id: data.faces[other].id, mm })),
    likeness: data.likeness[order] ?? order,
    folder: '',
    picture: data.pictures ? `../renders/${encodeURIComponent(recipe.id)}.png` : null,
  }));
}

/// The name of the subfolder with the files of a face. The number at the end of the face's id determines it.
export function folderOf(id, facesPerFolder) {
  const number = Number(id.match(/\d{0,15}$/)[0] || '0');
  return `${String(Math.floor(number / facesPerFolder)).padStart(3, '0')}/`;
}

/// A face of a large crowd, with the values that filters and orders use. loadFace adds the recipe.
class LightFace {
  constructor(data, order, target) {
    const { columns } = data;
    this.order = order;
    this.id = columns.id[order];
    this.target = target.name;
    this.tags = target.tags;
    this.attempt = columns.attempt[order];
    this.family = columns.family?.[order] ?? null;
    this.group = columns.group?.[order] ?? null;
    this.near = [];
    this.nearMm = columns.near_mm[order];
    this.headMm = columns.head_mm[order];
    this.likeness = data.likeness[order];
    if (columns.attachments) this.attachments = columns.attachments[order];
    this.crowd = data;
  }

  get traits() {
    const { traits } = this.crowd.columns;
    return traits && Object.fromEntries(Object.entries(traits).map(([name, all]) => [name, all[this.order]]));
  }
  get byHand() { return Boolean(this.crowd.columns.by_hand[this.order]); }
  get changes() { return this.crowd.columns.changes?.[this.order] ?? 0; }
  get parents() { return this.crowd.columns.parents[this.order]; }
  get note() { return this.crowd.columns.note[this.order]; }
  get regions() { return this.recipe?.regions ?? this.crowd.on_plane[this.order]; }
  get folder() { return folderOf(this.id, this.crowd.faces_per_page); }
  get picture() {
    return this.crowd.pictures ? `../renders/${this.folder}${encodeURIComponent(this.id)}.png` : null;
  }
}
for (const name of ['nearest', 'mixture', 'colours', 'age', 'age_years', 'asymmetry', 'mirrored', 'mother_share', 'inherits', 'changed']) {
  Object.defineProperty(LightFace.prototype, name, { get() { return this.recipe?.[name]; } });
}

/// Whether all data of a face are loaded.
export const isLoaded = (face) => !(face instanceof LightFace) || Boolean(face.recipe);

/// Loads the file of recipes that contains a face of a large crowd.
export async function loadFace(crowd, face) {
  if (isLoaded(face)) return;
  const length = crowd.faces_per_page;
  const number = Math.floor(face.order / length);
  await loadScript(`data/pages/${String(number).padStart(3, '0')}.js`);
  const page = window.crowdface.pages[number];
  page.faces.forEach((recipe, at) => {
    const one = crowd.faces[number * length + at];
    one.recipe = recipe;
    one.near = page.near[at].map(([other, mm]) => ({ id: crowd.faces[other].id, mm }));
  });
}

/// \param data  contents of data/crowd.js: name, seed, regions, bands, shapes (may be missing), heads, faces (lines of the
///              plan), near, likeness; for a large crowd, columns and faces_per_page instead of faces and near
export function readCrowd(data) {
  const heads = new Map(data.heads.map((head) => [head.name, head]));
  const faces = data.columns
    ? data.columns.target.map((target, order) => new LightFace(data, order, data.heads[target]))
    : facesOf(data, heads);
  const present = (values) => [...new Set(values)].sort();
  return {
    ...data,
    faces,
    heads: data.heads.map((head) => ({
      ...head,
      picture: data.pictures ? `../renders/heads/${encodeURIComponent(head.name)}.png` : null,
    })),
    byId: new Map(faces.map((face) => [face.id, face])),
    families: present(faces.map((face) => face.family).filter((name) => name !== null)),
    groups: present(faces.map((face) => face.group).filter((name) => name !== null)),
    targets: present(faces.map((face) => face.target)),
    bands: data.bands ?? [],
    traits: data.traits ?? [],
    reviews: data.reviews ?? 0,
    hairColours: data.hair_colours ?? [],
    skins: data.skins ?? false,
    shapes: data.shapes ?? [],
    locks: [...(data.regions.length > 1 ? data.regions : []), ...(data.bands ?? [])],
    tags: present(data.columns ? data.heads.flatMap((head) => head.tags) : faces.flatMap((face) => face.tags)),
    onPlane: data.columns ? Object.keys(data.on_plane).map((order) => faces[order]) : faces,
  };
}

/// The bands of a region's recipe from coarse to fine: [name, numbers]. Without bands, one band with an empty name.
export function bandsOf(crowd, region) {
  return crowd.bands.length > 0
    ? crowd.bands.map((name, at) => [name, at === 0 ? region : region.bands?.[name] ?? region])
    : [['', region]];
}

/// Whether all regions or all bands are locked.
export function locksAll(crowd, lock) {
  const all = (names) => names.length > 0 && names.every((name) => lock.has(name));
  return all(crowd.regions) || all(crowd.bands);
}

/// Parents, siblings and children of a face that are faces of the crowd.
export function relativesOf(crowd, face) {
  const parents = Object.entries(face.parents ?? {}).map(([role, name]) => ({
    role, name, face: crowd.byId.get(name), head: crowd.heads.find((head) => head.name === name),
  }));
  const same = (other) => other.parents?.mother === face.parents?.mother &&
    other.parents?.father === face.parents?.father;
  return {
    parents,
    siblings: crowd.faces.filter((other) => other !== face &&
      (face.parents ? same(other) : face.family !== null && other.family === face.family)),
    children: crowd.faces.filter((other) => Object.values(other.parents ?? {}).includes(face.id)),
  };
}

/// Distance to the nearest other face of the whole crowd.
export function nearestMm(face) {
  return face.near.length > 0 ? face.near[0].mm : face.nearMm ?? face.nearest?.crowd_mm ?? Infinity;
}

/// Distance to the nearest head.
const headMm = (face) => face.headMm ?? face.nearest?.face_mm ?? Infinity;

const byId = new Intl.Collator('en', { numeric: true });

const orders = {
  plan: (a, b) => a.order - b.order,
  id: (a, b) => byId.compare(a.id, b.id),
  distance: (a, b) => nearestMm(a) - nearestMm(b) || a.order - b.order,
  far: (a, b) => nearestMm(b) - nearestMm(a) || a.order - b.order,
  head: (a, b) => headMm(a) - headMm(b),
  likeness: (a, b) => a.likeness - b.likeness,
  group: (a, b) =>
    (a.group ?? '\uffff').localeCompare(b.group ?? '\uffff') || a.order - b.order,
  family: (a, b) =>
    (a.family ?? '\uffff').localeCompare(b.family ?? '\uffff') || a.order - b.order,
};

/// The order of faces that a filter asks for: a key of `orders`, or a measurement in ascending ("+nose_width") or
/// descending ("-nose_width") order.
function orderOf(sort) {
  if (orders[sort]) return orders[sort];
  const name = sort.slice(1);
  const sign = sort[0] === '-' ? -1 : 1;
  const value = (face) => face.traits?.[name] ?? Infinity;
  return (a, b) => sign * (value(a) - value(b)) || a.order - b.order;
}

/// Whether the measurements of a face are in the ranges, such as {nose_width: [30, 38]}. A null end has no limit.
const inRanges = (face, ranges) => Object.entries(ranges).every(([name, [low, high]]) => {
  const value = face.traits?.[name];
  return value !== undefined && value >= (low ?? -Infinity) && value <= (high ?? Infinity);
});

/// Whether each word of a search text occurs in the id, family, group, target, tags, attachments or note of a face.
function matches(face, words, mark) {
  if (words.length === 0) return true;
  const text = [face.id, face.family, face.group, face.target, ...face.tags, ...(face.attachments ?? []), face.note, mark?.note]
    .filter(Boolean).join(' ').toLowerCase();
  return words.every((word) => text.includes(word));
}

const markFilters = {
  any: () => true,
  unmarked: (mark) => !mark?.verdict,
  keep: (mark) => mark?.verdict === 'keep',
  reject: (mark) => mark?.verdict === 'reject',
  locked: (mark) => (mark?.lock?.length ?? 0) > 0,
  noted: (mark) => Boolean(mark?.note),
  changed: (mark) => Boolean(mark?.change),
};

/// The faces that pass the filters, in order.
export function chosenFaces(crowd, filters, markOf) {
  const words = filters.search.toLowerCase().split(/\s+/).filter(Boolean);
  return crowd.faces
    .filter((face) => {
      const mark = markOf(face);
      return (
        (!filters.family ||
          (filters.family === '·none' ? face.family === null : face.family === filters.family)) &&
        (!filters.group ||
          (filters.group === '·none' ? face.group === null : face.group === filters.group)) &&
        (!filters.target || face.target === filters.target) &&
        filters.tags.every((tag) => face.tags.includes(tag)) &&
        markFilters[filters.mark](mark) &&
        inRanges(face, filters.traits) &&
        matches(face, words, mark)
      );
    })
    .sort(orderOf(filters.sort));
}

export const noFilters = { search: '', family: '', group: '', target: '', tags: [], mark: 'any', sort: 'plan', traits: {} };
