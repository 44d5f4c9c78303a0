// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <chrono>
#include <functional>
#include <vector>

#include "crowdface/core/parallel.h"
#include "crowdface/core/text.h"
#include "crowdface/editor/edit.h"
#include "crowdface/editor/edit_session.h"

namespace crowdface {
namespace {

using Change = std::function<void(Recipe& recipe, double fraction)>;

/// Moves a region on the weight plane, as a user does by dragging the region's controller: sets the
/// region's position to a point between the anchors of two heads, and sets the heads' weights in
/// the region that belong to this position.
void set_region_position(const CastingOptions& casting, Recipe& recipe, std::size_t region,
                         double share) {
  const std::vector<PlanePoint>& anchors = casting.anchors;
  const PlanePoint at = (1 - share) * anchors[region % anchors.size()] +
                        share * anchors[(region + 1) % anchors.size()];
  recipe.regions[region].position = at;
  recipe.regions[region].weights =
      weights_at_position(anchors, recipe.target, sources_of(casting.sampling, 0), at,
                          casting.normalization, casting.sampling.max_sources);
}

/// Returns the median time, in milliseconds, that a session takes to build a face and the page's
/// data after a change of the recipe. Repeats the measurement several times.
double median_ms(const EditSession& session, Recipe recipe, const Change& change) {
  constexpr int kRepetitions = 21;
  std::vector<double> times;
  session.build(recipe);
  for (int i = 1; i <= kRepetitions; ++i) {
    change(recipe, static_cast<double>(i) / (kRepetitions + 1));
    const auto begin = std::chrono::steady_clock::now();
    const Positions face = session.build(recipe);
    session.preview_points(face);
    session.preview_normals(face);
    times.push_back(
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin)
            .count());
  }
  std::nth_element(times.begin(), times.begin() + kRepetitions / 2, times.end());
  return times[kRepetitions / 2];
}

std::string line(std::string_view what, double ms) {
  return concat("  ", what, std::string(40 - std::min<std::size_t>(what.size(), 40), ' '),
                format_fixed(ms, 1), " ms\n");
}

}  // namespace

std::string benchmark_edit(const std::filesystem::path& config_or_crowd,
                           const ConfigOverrides& overrides, const EditOptions& options) {
  const auto begin = std::chrono::steady_clock::now();
  const EditSession session(load_edited_job(config_or_crowd, overrides, options.cache),
                            options.cache, options.preview_vertices);
  const std::chrono::duration<double> opened = std::chrono::steady_clock::now() - begin;
  const CastingOptions& casting = session.casting();
  Recipe start;
  for (const RegionSampling& sampling : casting.sampling.regions) {
    start.regions.push_back({});
    RegionRecipe& region = start.regions.back();
    region.extrapolation = sampling.extrapolation.high;
    region.smoothness = 0.5;
    region.iterations = iterations_of(region.smoothness, casting.level_scale);
    set_region_position(casting, start, start.regions.size() - 1, 0.5);
  }
  const double one = median_ms(session, start, [&](Recipe& recipe, double fraction) {
    set_region_position(casting, recipe, 0, fraction);
  });
  const double all = median_ms(session, start, [&](Recipe& recipe, double fraction) {
    for (std::size_t k = 0; k < recipe.regions.size(); ++k)
      set_region_position(casting, recipe, k, fraction);
  });
  const double levels = median_ms(session, start, [&](Recipe& recipe, double fraction) {
    recipe.regions[0].iterations = iterations_of(fraction, casting.level_scale);
  });
  const double target = median_ms(session, start, [&](Recipe& recipe, double) {
    recipe.target = (recipe.target + 1) % static_cast<Index>(casting.anchors.size());
  });
  const auto& faces = session.job().inputs.head_set;
  return concat(
      faces.heads.size(), " heads of ", faces.topology.vertex_count, " vertices, ",
      start.regions.size(), " regions, ", session.preview().vertices.size(), " vertices shown, ",
      thread_count(), " threads\n", line("opened (heads prepared before)", 1000 * opened.count()),
      "the full face, parts placed, with normals, after\n", line("one region was moved", one),
      line("all regions were moved", all), line("one region's smoothness was changed", levels),
      line("the target was changed", target),
      "(the paper reports 25 ms per frame, for 15 heads of 1.2 million vertices on a graphics "
      "card)\n");
}

}  // namespace crowdface
