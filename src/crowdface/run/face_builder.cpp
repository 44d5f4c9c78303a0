// SPDX-License-Identifier: Apache-2.0
#include "crowdface/run/face_builder.h"

#include "crowdface/blend/blend.h"
#include "crowdface/core/parallel.h"
#include "crowdface/heads/named_parts.h"

namespace crowdface {

FaceBuilder::FaceBuilder(const Config& config, const Inputs& inputs, const Prepared& prepared)
    : inputs_(inputs), prepared_(prepared), regions_(inputs.regions) {
  if (config.parts.shape == PartShape::kTarget) {
    for (const Part& part : inputs.parts.parts) {
      for (const std::uint32_t v : part.vertices) regions_.alpha.row(v).setZero();
    }
  }
  if (config.smoothing.levels != Levels::kExact) {
    blender_.emplace(inputs.faces, head_levels(config, prepared), regions_);
  }
  if (!inputs.parts.parts.empty()) {
    follower_.emplace(inputs.faces, inputs.parts, head_axes(config), config.parts.shape);
  }
}

void FaceBuilder::build(std::span<const Recipe* const> recipes,
                        std::span<Positions> results) const {
  if (blender_) {
    blender_->blend(recipes, results);
  } else {
    blend_exact(inputs_.faces, *prepared_.filter, regions_, recipes, results);
  }
  require_whole(prepared_);
  if (!follower_) return;
  parallel_for_each(static_cast<Index>(recipes.size()), [&](Index f) {
    const auto i = static_cast<std::size_t>(f);
    follower_->follow(recipes[i]->target, results[i]);
  });
}

std::uint64_t FaceBuilder::bytes(std::size_t faces) const {
  const auto vertices = static_cast<std::uint64_t>(inputs_.faces.topology.vertex_count);
  std::uint64_t of_face = 3 * sizeof(double) * vertices;
  if (!blender_) {
    // Per region the difference, its rows, four vectors of the recurrence and one sum.
    const auto regions = static_cast<std::uint64_t>(inputs_.regions.alpha.cols());
    of_face += regions * vertices * (3 * sizeof(double) + 6 * sizeof(Row<double>));
  }
  return faces * of_face;
}

}  // namespace crowdface
