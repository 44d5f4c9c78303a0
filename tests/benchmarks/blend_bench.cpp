// SPDX-License-Identifier: Apache-2.0
// Blending a crowd as one product, and the bare product of that size beside it: the counter
// `ratio_to_bare` relates the two.
#include <chrono>
#include <cmath>
#include <numeric>

#include <benchmark/benchmark.h>

#include "crowdface/blend/crowd_blender.h"
#include "crowdface/core/random.h"

#include "benchmarks/bare_product.h"
#include "benchmarks/bench_size.h"

namespace crowdface {
namespace {

double uniform(std::uint64_t index, const char* purpose) {
  return random_between({1, index, purpose, 0}, 0, 1);
}

/// Heads whose fields are noise, so that no vertex is told from others, three regions in bands with
/// soft edges (a tenth of the vertices in two of them), and recipes of four sources each.
struct Crowd {
  Crowd(Index heads, Index rank, Index vertices, std::size_t count) {
    faces.topology.vertex_count = vertices;
    const std::size_t tiles = LevelFields::tile_count(static_cast<std::size_t>(vertices));
    const std::size_t of_head = tiles * static_cast<std::size_t>(rank) * kTileValues;
    for (std::size_t tile = 0; tile <= tiles; ++tile) {
      first.push_back(static_cast<std::uint32_t>(tile * static_cast<std::size_t>(rank)));
    }
    steps.assign(first.back(), 1.0F / 1024);
    numbers.resize(static_cast<std::size_t>(heads) * of_head);
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      numbers[i] = static_cast<std::int16_t>(i * 2654435761U % 1000);
    }
    for (Index h = 0; h < heads; ++h) {
      faces.heads.push_back({"head", Positions::Constant(vertices, 3, static_cast<double>(h))});
      const auto own = std::span(numbers).subspan(static_cast<std::size_t>(h) * of_head, of_head);
      levels.push_back({{vertices, rank, first, steps, own, {}}, [rank](std::uint64_t level) {
                          return std::vector<double>(static_cast<std::size_t>(rank),
                                                     1.0 / (1.0 + static_cast<double>(level)));
                        }});
    }
    regions.alpha.setZero(vertices, 3);
    for (Index v = 0; v < vertices; ++v) {
      const double place = 3 * static_cast<double>(v) / static_cast<double>(vertices);
      const auto k = static_cast<Index>(place);
      const double in = std::min(1.0, (static_cast<double>(k + 1) - place) * 20 + (k == 2 ? 1 : 0));
      regions.alpha(v, k) = in;
      if (in < 1) regions.alpha(v, k + 1) = 1 - in;
    }
    for (std::size_t f = 0; f < count; ++f) {
      Recipe recipe;
      recipe.target = static_cast<Index>(uniform(f, "target") * static_cast<double>(heads));
      for (Index k = 0; k < 3; ++k) {
        RegionRecipe region;
        region.iterations = 100;
        for (Index h = 0; h < heads; ++h)
          region.weights.push_back({h, 1.0 / static_cast<double>(heads)});
        recipe.regions.push_back(region);
      }
      recipes.push_back(recipe);
    }
    for (const Recipe& recipe : recipes) pointers.push_back(&recipe);
    std::vector<std::uint32_t> order(static_cast<std::size_t>(vertices));
    std::iota(order.begin(), order.end(), 0U);
    patches = interpolate_fields(levels, std::vector<std::uint64_t>{1, 100}, order, 1e-6);
  }
  HeadSet faces;
  std::vector<std::uint32_t> first;
  std::vector<float> steps;
  std::vector<std::int16_t> numbers;
  std::vector<HeadSmoothing> levels;
  FieldPatches patches;
  RegionWeights regions;
  std::vector<Recipe> recipes;
  std::vector<const Recipe*> pointers;
};

void BM_BlendCrowd(benchmark::State& state) {
  const Index heads = state.range(0), rank = state.range(1);
  const auto faces = static_cast<std::size_t>(state.range(2));
  const Index vertices = bench::size(1'200'000, 2'000);
  double least = HUGE_VAL;
  {
    const Crowd crowd(heads, rank, vertices, faces);
    const CrowdBlender blender(crowd.faces, crowd.levels, crowd.patches, crowd.regions);
    std::vector<Positions> results(
        faces);  // a job uses them again and again, as from the second run
    for (auto _ : state) {
      const auto start = std::chrono::steady_clock::now();
      blender.blend(crowd.pointers, results);
      least = std::min(
          least, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    }
  }  // the bare product has the memory for itself
  const double ms = 1e3 * least / static_cast<double>(faces);
  const double bare = bench::bare_product_ms(3 * vertices, heads * rank, static_cast<Index>(faces));
  state.counters["ms_a_face"] = ms;
  state.counters["bare_ms_a_face"] = bare;
  state.counters["ratio_to_bare"] = ms / bare;
}
BENCHMARK(BM_BlendCrowd)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->Iterations(3)
    ->ArgNames({"heads", "rank", "faces"})
    ->Args({2, 4, 32})
    ->Args({4, 4, 32})
    ->Args({7, 4, 32})
    ->Args({10, 4, 32})
    ->Args({13, 4, 32})
    ->Args({15, 4, 32})
    ->Args({15, 10, 32})
    ->Args({15, 12, 32})
    ->Args({15, 10, 1})
    ->Args({15, 10, 6})
    ->Args({15, 10, 12});

/// Weights of `count` heads that follow each other, from one that depends on face, region and band.
std::vector<SourceWeight> neighbours(Index heads, Index count, std::uint64_t face, Index region,
                                     Index band) {
  const auto first = static_cast<Index>(
      random_between({face, static_cast<std::uint64_t>(region), "first", 0}, 0, 1) *
      static_cast<double>(heads));
  std::vector<SourceWeight> weights;
  for (Index i = 0; i < count; ++i) {
    weights.push_back({(first + band * count + i) % heads, 1 / static_cast<double>(count)});
  }
  return normalized_weights(std::move(weights));
}

/// The same crowd with one band and with three, by turns: `lend` heads lend to each.
void BM_BlendBands(benchmark::State& state) {
  const Index heads = state.range(0), rank = state.range(1), lend = state.range(3);
  const auto faces = static_cast<std::size_t>(state.range(2));
  Crowd crowd(heads, rank, bench::size(1'200'000, 2'000), faces);
  std::vector<Recipe> banded = crowd.recipes;
  std::vector<const Recipe*> pointers;
  for (std::size_t f = 0; f < faces; ++f) {
    for (Index k = 0; k < 3; ++k) {
      RegionRecipe& one = crowd.recipes[f].regions[static_cast<std::size_t>(k)];
      one.weights = neighbours(heads, lend, f, k, 0);
      RegionRecipe& three = banded[f].regions[static_cast<std::size_t>(k)];
      three = one;
      for (Index b = 1; b < 3; ++b) {
        BandRecipe& band = three.finer_bands.emplace_back(one);
        band.iterations = b == 1 ? 20 : 3;
        band.weights = neighbours(heads, lend, f, k, b);
        band.extrapolation = 1.1;
      }
    }
    pointers.push_back(&banded[f]);
  }
  const CrowdBlender blender(crowd.faces, crowd.levels, crowd.patches, crowd.regions);
  std::vector<Positions> results(faces);
  double one_band = HUGE_VAL, three_bands = HUGE_VAL;
  const auto timed = [&](const std::vector<const Recipe*>& recipes, double& least) {
    const auto start = std::chrono::steady_clock::now();
    blender.blend(recipes, results);
    least = std::min(
        least, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  };
  for (auto _ : state) {
    timed(crowd.pointers, one_band);
    timed(pointers, three_bands);
  }
  state.counters["ms_a_face"] = 1e3 * three_bands / static_cast<double>(faces);
  state.counters["ratio_to_one_band"] = three_bands / one_band;
}
BENCHMARK(BM_BlendBands)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->Iterations(5)
    ->ArgNames({"heads", "rank", "faces", "lend"})
    ->Args({16, 4, 32, 16})
    ->Args({16, 4, 32, 4})
    ->Args({16, 4, 1, 4});

}  // namespace
}  // namespace crowdface
