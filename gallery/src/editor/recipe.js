// SPDX-License-Identifier: Apache-2.0
// Recipes as the config spells them, and what they mean: weights (Eqs. 3 and 4), shares, levels.

const last = 256; // of the 257 levels that the server tells, evenly spaced in the root of smoothness

/// Where `value` lies between the steps of an ascending table, as a part 0 … 1 of its length.
function placeIn(table, value) {
  if (value <= table[0]) return 0;
  let low = 0;
  let high = table.length - 1;
  if (value >= table[high]) return 1;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (table[middle] <= value) low = middle;
    else high = middle;
  }
  const step = table[high] - table[low];
  return (low + (step > 0 ? (value - table[low]) / step : 0)) / (table.length - 1);
}

function valueIn(table, place) {
  const x = Math.min(Math.max(place, 0), 1) * (table.length - 1);
  const low = Math.min(Math.floor(x), table.length - 2);
  return table[low] + (x - low) * (table[low + 1] - table[low]);
}

/// In which of '%', 'iterations' and 'mm' a region's smoothness is written.
export function unitOf(region) {
  if (region.iterations !== undefined) return 'iterations';
  return typeof region.smoothness === 'string' ? 'mm' : '%';
}

/// The number in that unit.
export function amountOf(region) {
  if (region.iterations !== undefined) return region.iterations;
  return typeof region.smoothness === 'string' ? parseFloat(region.smoothness) : 100 * region.smoothness;
}

/// The same region with another smoothness.
export function withAmount(region, unit, amount) {
  const { smoothness, iterations, ...rest } = region;
  if (unit === 'iterations') return { ...rest, iterations: Math.max(0, Math.round(amount)) };
  if (unit === 'mm') return { ...rest, smoothness: `${Number(amount.toFixed(3))} mm` };
  return { ...rest, smoothness: Math.min(Math.max(amount / 100, 0), 1) };
}

/// √(L/L_max) of a region, which is what sliders and tables are even in.
export function levelOf(region, levels) {
  const unit = unitOf(region);
  if (unit === '%') return Math.sqrt(region.smoothness);
  return placeIn(unit === 'mm' ? levels.size_mm : levels.iterations, amountOf(region));
}

/// What a level is called in a unit.
export function amountAt(level, unit, levels) {
  if (unit === '%') return 100 * level * level;
  return valueIn(unit === 'mm' ? levels.size_mm : levels.iterations, level);
}

/// The anchor of each head: those that were moved by hand, and the config's.
export function anchorsOf(job, moved) {
  return job.heads.map((head) => moved?.[head.name] ?? head.anchor);
}

/// The weights ω̂ of a position (Eqs. 3 and 4), one a head; see blend/recipe.h, weights_at.
export function weightsAt(job, anchors, target, sources, position) {
  const heads = [...new Set([...sources, target])].sort((a, b) => a - b);
  const squares = heads.map((h) =>
    (position[0] - anchors[h][0]) ** 2 + (position[1] - anchors[h][1]) ** 2);
  const nearest = Math.min(...squares);
  const omega = squares.map((square) => (nearest > 0 ? nearest / square : Number(square === 0)));
  let others = heads.map((head, i) => ({ head, weight: omega[i] }));
  const own = others.find((entry) => entry.head === target);
  others = others.filter((entry) => entry !== own);
  if (job.max_sources && others.length > job.max_sources) {
    others = [...others].sort((a, b) => b.weight - a.weight).slice(0, job.max_sources);
  }
  const partition = job.normalization !== 'printed';
  const sum = others.reduce((total, entry) => total + entry.weight, own.weight);
  const weights = new Array(job.heads.length).fill(0);
  for (const { head, weight } of others) weights[head] = weight / sum;
  if (partition) weights[target] = own.weight / sum;
  return weights;
}

/// The names of a region's bands, coarse to fine; without bands one of no name.
export function bandNames(job) {
  return job.bands?.length > 0 ? job.bands.map(({ name }) => name) : [''];
}

/// The numbers of a band of a region. The first one's are the region's own; so are those of a band that
/// has none, but for where it begins.
export function bandOf(job, recipe, name, band) {
  const { bands, ...own } = recipe.regions[name];
  const at = bandNames(job).indexOf(band);
  if (at <= 0) return own;
  const { smoothness, iterations, ...rest } = own;
  return bands?.[band] ?? { ...rest, smoothness: job.bands[at].smoothness[regionIndex(job, name)] };
}

/// A region with each band's numbers changed; all bands have their own then.
function withBands(job, recipe, name, change) {
  const of = (band) => change(bandOf(job, recipe, name, band), band);
  const [first, ...finer] = bandNames(job);
  if (finer.length === 0) return of(first);
  return { ...of(first), bands: Object.fromEntries(finer.map((band) => [band, of(band)])) };
}

/// A region with other numbers of one band.
export function withBand(job, recipe, name, band, numbers) {
  return withBands(job, recipe, name, (old, at) => (at === band ? numbers : old));
}

function beginningLike(other, { smoothness, iterations, ...rest }) {
  if (other.iterations !== undefined) return { ...rest, iterations: other.iterations };
  return { ...rest, smoothness: other.smoothness };
}

/// The recipe with bands of another, [region, band] each; coarser ones do not begin below those
/// (cast/band_order.h, take_over).
export function takeOver(job, parts, from, recipe) {
  const regions = Object.fromEntries(job.regions.map(({ name }) => {
    const isTaken = (band) => parts.some(([region, part]) => region === name && part === band);
    const numbers = new Map();
    let finer = null; // that was taken
    for (const band of bandNames(job).reverse()) {
      let own = bandOf(job, isTaken(band) ? from : recipe, name, band);
      if (isTaken(band)) finer = own;
      else if (finer && levelOf(own, job.levels) < levelOf(finer, job.levels)) own = beginningLike(finer, own);
      numbers.set(band, own);
    }
    return [name, withBands(job, recipe, name, (_, band) => numbers.get(band))];
  }));
  return { ...recipe, regions };
}

function regionIndex(job, name) {
  return job.regions.findIndex((region) => region.name === name);
}

function sourcesOf(job, index, band) {
  const sources = job.bands?.find(({ name }) => name === band)?.sources ?? job.sources;
  if (!sources) return job.heads.map((_, h) => h);
  return Array.isArray(sources[0]) ? sources[index] : sources;
}

export function headIndex(job, name) {
  return job.heads.findIndex((head) => head.name === name);
}

/// How much each head lends to a band of a region, one a head.
export function weightsOf(job, document, name, band = bandNames(job)[0]) {
  const { recipe } = document;
  const numbers = bandOf(job, recipe, name, band);
  if (numbers.position) {
    return weightsAt(job, anchorsOf(job, document.anchors), headIndex(job, recipe.target),
      sourcesOf(job, regionIndex(job, name), band), numbers.position);
  }
  const weights = job.heads.map((head) => numbers.weights?.[head.name] ?? 0);
  const sum = weights.reduce((total, weight) => total + weight, 0);
  return weights.map((weight) => (sum > 0 ? weight / sum : 0));
}

/// Weights by the heads' names, those above zero.
function named(job, weights) {
  return Object.fromEntries(weights.map((weight, h) => [job.heads[h].name, weight])
    .filter(([, weight]) => weight > 0));
}

/// τ_h of the target, one a head: of a child of two heads those of both.
export function targetShares(job, recipe) {
  return job.heads.map((head) => (recipe.mixture
    ? recipe.mixture[head.name] ?? 0 : Number(head.name === recipe.target)));
}

/// What a recipe says of the face as a whole, beside its id and regions.
export function wholeFace({ target, mixture, colours, asymmetry, mirrored }) {
  return {
    target,
    ...(mixture ? { mixture } : {}),
    ...(colours ? { colours } : {}),
    ...(asymmetry === undefined ? {} : { asymmetry }),
    ...(mirrored === undefined ? {} : { mirrored }),
  };
}

/// Which heads a region smooths to which level: per band {level, shares}, one share a head
/// (blend/recipe.h, level_shares). No band begins above the one before it.
function levelShares(job, document, name) {
  let coarser = targetShares(job, document.recipe);
  let most = 1;
  return bandNames(job).map((band) => {
    const numbers = bandOf(job, document.recipe, name, band);
    const finer = weightsOf(job, document, name, band).map((weight) => (numbers.extrapolation ?? 1) * weight);
    const shares = coarser.map((share, h) => share - finer[h]);
    coarser = finer;
    most = Math.min(levelOf(numbers, job.levels), most);
    return { level: most, shares };
  });
}

/// What is multiplied with which field: of each region the numbers that are not zero,
/// Σ_L s_kLh φ_hp(L) (blend/crowd_blender.h).
/// \param heads  per head {rank, functions: 257 rows of rank}; those not loaded yet are undefined.
/// \return       per region a list of {head, field, value}.
export function coefficients(job, document, heads) {
  return job.regions.map(({ name }) => {
    const levels = levelShares(job, document, name);
    const list = [];
    heads.forEach((head, h) => {
      const used = levels.filter(({ shares }) => shares[h] !== 0);
      if (!head || used.length === 0) return;
      for (let p = 0; p < head.rank; p += 1) {
        let value = 0;
        for (const { level, shares } of used) {
          const x = level * last;
          const low = Math.min(Math.floor(x), last - 1);
          const before = head.functions[low * head.rank + p];
          const after = head.functions[(low + 1) * head.rank + p];
          value += shares[h] * (before + (x - low) * (after - before));
        }
        if (value !== 0) list.push({ head: h, field: p, value });
      }
    });
    return list;
  });
}

/// The recipe as the program reads it. Where heads were moved on the page's plane a position would
/// mean something else to the program, so that the weights themselves are told.
export function wire(job, document) {
  const { recipe, anchors } = document;
  const moved = Object.keys(anchors ?? {}).length > 0;
  const regions = {};
  for (const { name } of job.regions) {
    regions[name] = withBands(job, recipe, name, (numbers, band) => {
      const { position, weights, ...rest } = numbers;
      if (!position) return { weights, ...rest };
      if (!moved) return { position, ...rest };
      return { weights: named(job, weightsOf(job, document, name, band)), ...rest };
    });
  }
  return { id: recipe.id, ...wholeFace(recipe), regions };
}

/// The face with the weights that changed from one recipe to another, as the program told both; what did not change stays
/// as it is, places on the plane among it.
export function withWeights(job, document, before, after) {
  const regions = Object.fromEntries(job.regions.map(({ name }) => [name, withBands(job, document.recipe, name, (numbers, band) => {
    const { weights } = bandOf(job, after, name, band);
    if (!weights || JSON.stringify(weights) === JSON.stringify(bandOf(job, before, name, band).weights)) return numbers;
    const { position, ...rest } = numbers;
    return { ...rest, weights };
  })]));
  return { ...document, recipe: { ...document.recipe, regions } };
}

/// The same face with heads where they were moved to: positions that speak of other places become weights.
export function underAnchors(job, document, anchors) {
  if (JSON.stringify(document.anchors ?? {}) === JSON.stringify(anchors ?? {})) return document;
  return { ...asWeights(job, document), anchors };
}

/// The same face with weights in place of positions, where the program takes them.
export function asWeights(job, document) {
  if (job.normalization === 'printed') return document;
  const { recipe } = document;
  const regions = Object.fromEntries(job.regions.map(({ name }) => [name, withBands(job, recipe, name, (numbers, band) => {
    const { position, ...rest } = numbers;
    return position ? { ...rest, weights: named(job, weightsOf(job, document, name, band)) } : numbers;
  })]));
  return { ...document, recipe: { ...recipe, regions } };
}

/// A part `t` of the way from one recipe to another. Positions stay positions where both have one;
/// the target is that of the nearer one, as a face stands on one head.
export function between(job, from, to, t) {
  const near = t < 0.5 ? from : to;
  const mix = (a, b) => a + t * (b - a);
  const regions = {};
  for (const { name } of job.regions) {
    regions[name] = withBands(job, near.recipe, name, (numbers, band) => {
      const a = bandOf(job, from.recipe, name, band);
      const b = bandOf(job, to.recipe, name, band);
      const level = mix(levelOf(a, job.levels), levelOf(b, job.levels));
      const mixed = { extrapolation: mix(a.extrapolation ?? 1, b.extrapolation ?? 1) };
      if (a.position && b.position) {
        mixed.position = [mix(a.position[0], b.position[0]), mix(a.position[1], b.position[1])];
      } else {
        const [u, v] = [weightsOf(job, from, name, band), weightsOf(job, to, name, band)];
        mixed.weights = named(job, u.map((weight, h) => mix(weight, v[h])));
      }
      const unit = unitOf(numbers);
      return withAmount(mixed, unit, amountAt(level, unit, job.levels));
    });
  }
  return {
    recipe: { id: from.recipe.id, ...wholeFace(near.recipe), regions },
    anchors: near.anchors ?? {},
  };
}

/// A head unblended: every controller on it.
export function headAlone(job, name, id) {
  const head = job.heads[headIndex(job, name)];
  return {
    recipe: {
      id, target: name,
      regions: Object.fromEntries(job.regions.map((region) =>
        [region.name, { position: [...head.anchor], smoothness: 0.5, extrapolation: 1 }])),
    },
    anchors: {},
  };
}
