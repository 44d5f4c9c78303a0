// SPDX-License-Identifier: Apache-2.0
// Recipes in the form of the config, and the values computed from them: weights (Eqs. 3 and 4), shares, levels.

const last = 256; // index of the last of the server's 257 levels, which are evenly spaced in the square root of smoothness

/// The position of `value` in an ascending table: 0 at the first entry, 1 at the last, linear between entries.
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

/// The unit in which a region's smoothness is given: '%', 'iterations' or 'mm'.
export function unitOf(region) {
  if (region.iterations !== undefined) return 'iterations';
  return typeof region.smoothness === 'string' ? 'mm' : '%';
}

/// The smoothness in this unit.
export function amountOf(region) {
  if (region.iterations !== undefined) return region.iterations;
  return typeof region.smoothness === 'string' ? parseFloat(region.smoothness) : 100 * region.smoothness;
}

/// A copy of a region with another smoothness.
export function withAmount(region, unit, amount) {
  const { smoothness, iterations, ...rest } = region;
  if (unit === 'iterations') return { ...rest, iterations: Math.max(0, Math.round(amount)) };
  if (unit === 'mm') return { ...rest, smoothness: `${Number(amount.toFixed(3))} mm` };
  return { ...rest, smoothness: Math.min(Math.max(amount / 100, 0), 1) };
}

/// √(L/L_max) of a region; sliders and tables are evenly spaced in this value.
export function levelOf(region, levels) {
  const unit = unitOf(region);
  if (unit === '%') return Math.sqrt(region.smoothness);
  return placeIn(unit === 'mm' ? levels.size_mm : levels.iterations, amountOf(region));
}

/// Formats a level in a unit.
export function amountAt(level, unit, levels) {
  if (unit === '%') return 100 * level * level;
  return valueIn(unit === 'mm' ? levels.size_mm : levels.iterations, level);
}

/// The anchor of each head: the position to which the user moved it, else the config's.
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

/// The names of a region's bands from coarse to fine; without bands, one empty name.
export function bandNames(job) {
  return job.bands?.length > 0 ? job.bands.map(({ name }) => name) : [''];
}

/// The values of a band of a region. The first band, and bands without values, have the region's values, except for the
/// smoothness at which they begin.
export function bandOf(job, recipe, name, band) {
  const { bands, ...own } = recipe.regions[name];
  const at = bandNames(job).indexOf(band);
  if (at <= 0) return own;
  const { smoothness, iterations, ...rest } = own;
  return bands?.[band] ?? { ...rest, smoothness: job.bands[at].smoothness[regionIndex(job, name)] };
}

/// A copy of a region with the values of all bands changed; then all bands have values.
function withBands(job, recipe, name, change) {
  const of = (band) => change(bandOf(job, recipe, name, band), band);
  const [first, ...finer] = bandNames(job);
  if (finer.length === 0) return of(first);
  return { ...of(first), bands: Object.fromEntries(finer.map((band) => [band, of(band)])) };
}

/// A copy of a region with other values of one band.
export function withBand(job, recipe, name, band, numbers) {
  return withBands(job, recipe, name, (old, at) => (at === band ? numbers : old));
}

function beginningLike(other, { smoothness, iterations, ...rest }) {
  if (other.iterations !== undefined) return { ...rest, iterations: other.iterations };
  return { ...rest, smoothness: other.smoothness };
}

/// A recipe with some bands [region, band] taken from another recipe; coarser bands then do not begin below them
/// (cast/band_order.h, take_over).
export function takeOver(job, parts, from, recipe) {
  const regions = Object.fromEntries(job.regions.map(({ name }) => {
    const isTaken = (band) => parts.some(([region, part]) => region === name && part === band);
    const numbers = new Map();
    let finer = null; // the next finer band that was taken
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

/// The weight of each head in a band of a region.
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

/// The weights above zero, by names of heads.
function named(job, weights) {
  return Object.fromEntries(weights.map((weight, h) => [job.heads[h].name, weight])
    .filter(([, weight]) => weight > 0));
}

/// The weights τ_h of the target, one per head; a child of two heads has the weights of both.
export function targetShares(job, recipe) {
  return job.heads.map((head) => (recipe.mixture
    ? recipe.mixture[head.name] ?? 0 : Number(head.name === recipe.target)));
}

/// The values of a recipe for the whole face, without id and regions.
export function wholeFace({ target, mixture, colours, asymmetry, mirrored }) {
  return {
    target,
    ...(mixture ? { mixture } : {}),
    ...(colours ? { colours } : {}),
    ...(asymmetry === undefined ? {} : { asymmetry }),
    ...(mirrored === undefined ? {} : { mirrored }),
  };
}

/// The levels to which a region smooths heads: per band {level, shares}, one share per head (blend/recipe.h,
/// level_shares). No band begins above the band before it.
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

/// The nonzero coefficients of the fields: per region Σ_L s_kLh φ_hp(L) (blend/crowd_blender.h).
/// \param heads  per head {rank, functions: 257 rows of `rank` numbers}; undefined while a head is not loaded
/// \return       per region a list of {head, field, value}
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

/// The recipe in the form that the program reads. If heads were moved on the plane, it contains weights instead of
/// positions, because positions refer to the config's anchors.
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

/// A face with the weights that differ between two recipes of the program; everything else, such as positions on the
/// plane, stays the same.
export function withWeights(job, document, before, after) {
  const regions = Object.fromEntries(job.regions.map(({ name }) => [name, withBands(job, document.recipe, name, (numbers, band) => {
    const { weights } = bandOf(job, after, name, band);
    if (!weights || JSON.stringify(weights) === JSON.stringify(bandOf(job, before, name, band).weights)) return numbers;
    const { position, ...rest } = numbers;
    return { ...rest, weights };
  })]));
  return { ...document, recipe: { ...document.recipe, regions } };
}

/// The same face after heads were moved: positions that refer to the former anchors become weights.
export function underAnchors(job, document, anchors) {
  if (JSON.stringify(document.anchors ?? {}) === JSON.stringify(anchors ?? {})) return document;
  return { ...asWeights(job, document), anchors };
}

/// The same face with weights instead of positions, where recipes allow weights.
export function asWeights(job, document) {
  if (job.normalization === 'printed') return document;
  const { recipe } = document;
  const regions = Object.fromEntries(job.regions.map(({ name }) => [name, withBands(job, recipe, name, (numbers, band) => {
    const { position, ...rest } = numbers;
    return position ? { ...rest, weights: named(job, weightsOf(job, document, name, band)) } : numbers;
  })]));
  return { ...document, recipe: { ...recipe, regions } };
}

/// Interpolates between two recipes. Regions for which both have positions keep positions; the target is that of the
/// nearer recipe.
/// \param t  0: the first recipe, 1: the second
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

/// The recipe of an unblended head: all controllers lie on it.
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
