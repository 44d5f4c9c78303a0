// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>

#include "crowdface/cast/constraints.h"
#include "crowdface/cast/face_point_index.h"
#include "crowdface/cast/plausibility.h"
#include "crowdface/cast/proxy_skin.h"
#include "crowdface/validity/skin_check.h"

namespace crowdface {

/// Which limit a face's skin goes beyond; nothing if it keeps all.
std::optional<Reason> limit_passed(const BelievabilityOptions& limits, const SkinDefects& skin);

/// Builds the whole mesh of a recipe and compares its skin with the target's; from any thread.
using MeshDefects = std::function<SkinDefects(const Recipe&)>;

/// Judges a candidate by itself, whatever else is in the crowd.
class FaceJudge {
 public:
  /// \param skin    judges closely, by the samples; none: nothing is judged by its shape.
  /// \param meshes  looked at besides, if given, where the samples find nothing.
  FaceJudge(const FaceSpace& space, const DiversityOptions& diversity,
            const BelievabilityOptions& believability, const ProxySkin* skin = nullptr,
            MeshDefects meshes = {});

  /// What can be told from the recipe and its place, in microseconds: weights, the distance from the
  /// input heads, plausibility. \return why it will not do; nothing if it will.
  std::optional<Reason> at_a_glance(const Recipe& recipe, const FaceSpace::Point& point) const;

  /// What only the shape of the skin tells: flips, stretch, intersections. A millisecond by the
  /// samples, a tenth of a second by a mesh of 28,000 triangles.
  std::optional<Reason> closely(const Recipe& recipe) const;

  /// Where faces may be mirrored, the mirror image of a head is as near to somebody as the head itself.
  FacePointIndex::Nearest nearest_head(const FaceSpace::Point& point) const {
    FacePointIndex::Nearest nearest = heads_.nearest(point);
    nearest.face %= space_.head_count();
    return nearest;
  }
  const FaceSpace& space() const { return space_; }

 private:
  const FaceSpace& space_;
  DiversityOptions diversity_;
  BelievabilityOptions believability_;
  FacePointIndex heads_;
  Plausibility plausibility_;
  const ProxySkin* skin_;
  MeshDefects meshes_;
};

}  // namespace crowdface
