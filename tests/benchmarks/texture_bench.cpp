// SPDX-License-Identifier: Apache-2.0
// How many texels a second are blended from four heads, without reading and encoding. Beside it the
// plain mean of the same bytes, in light: what a loop costs that only averages.
#include <benchmark/benchmark.h>

#include "crowdface/core/random.h"
#include "crowdface/texture/texture_blender.h"

#include "benchmarks/bench_size.h"
#include "texture/two_charts.h"

namespace crowdface {
namespace {

constexpr Index kHeads = 4;

testing::TwoCharts heads_of(int size) {
  testing::TwoCharts sheet(size);
  for (std::uint64_t h = 0; h < kHeads; ++h) {
    sheet.add_head([&](double x, double y, int column, int row) -> Eigen::Array3f {
      const auto texel = static_cast<std::uint64_t>(row) * static_cast<std::uint64_t>(size) +
                         static_cast<std::uint64_t>(column);
      const double noise = random_uniform({h + 1, texel, "texel", 0});
      return Eigen::Array3d(0.2 + 0.3 * x, 0.2 + 0.2 * y, 0.2 + 0.3 * noise).cast<float>();
    });
  }
  return sheet;
}

Recipe recipe_of_all() {
  Recipe recipe;
  recipe.regions.resize(1);
  for (Index h = 0; h < kHeads; ++h) recipe.regions[0].weights.push_back({h, 0.25});
  return recipe;
}

void blend_four_textures(benchmark::State& state) {
  const auto size = static_cast<int>(bench::size(2048, 64));
  const testing::TwoCharts sheet = heads_of(size);
  const TextureBlender blender = sheet.blender();
  const Recipe recipe = recipe_of_all();
  for (auto _ : state) benchmark::DoNotOptimize(blender.blend(recipe, 0));
  state.SetItemsProcessed(state.iterations() *
                          static_cast<std::int64_t>(sheet.texels().covered_texel_count()));
}
BENCHMARK(blend_four_textures)->Unit(benchmark::kMillisecond)->UseRealTime();

void plain_mean_of_light(benchmark::State& state) {
  const auto size = static_cast<std::size_t>(bench::size(2048, 64));
  const testing::TwoCharts sheet = heads_of(static_cast<int>(size));
  std::vector<std::vector<std::uint8_t>> bytes;
  for (const auto& map : sheet.textures.maps[0]) bytes.push_back(srgb8_of(*map));
  std::vector<float> light(256);
  for (std::size_t v = 0; v < 256; ++v) {
    light[v] = light_of_density(static_cast<float>(density_by_srgb8()[v]));
  }
  std::vector<std::uint8_t> screen(65536);
  for (std::size_t i = 0; i < screen.size(); ++i) {
    screen[i] = srgb8_by_density()[density_of_light(static_cast<float>(i) / 65535.0F)];
  }
  std::vector<std::uint8_t> result(3 * size * size);
  for (auto _ : state) {
    for (std::size_t i = 0; i < result.size(); ++i) {
      float sum = 0;
      for (const auto& head : bytes) sum += light[head[i]];
      result[i] = screen[static_cast<std::size_t>(sum * (65535.0F / kHeads))];
    }
    benchmark::DoNotOptimize(result.data());
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(size * size));
}
BENCHMARK(plain_mean_of_light)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace crowdface
