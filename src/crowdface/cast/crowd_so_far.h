// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>
#include <vector>

#include "crowdface/cast/cast_face.h"
#include "crowdface/cast/face_point_index.h"

namespace crowdface {

/// The faces that are settled, in the order of the plan, and where they lie.
class CrowdSoFar {
 public:
  explicit CrowdSoFar(Index dimensions) : index_(dimensions) {}

  void add(CastFace face, FaceSpace::Point point) {
    index_.add(point);
    faces_.push_back(std::move(face));
    points_.push_back(std::move(point));
  }
  Index size() const { return index_.size(); }
  /// What comes from now on is sampled.
  void begin_sampled() { first_sampled_ = size(); }
  /// Candidates compete by their distance from the faces from here on, so that a recipe or a family
  /// more does not change which of them wins (though all faces must be far enough from all).
  Index first_sampled() const { return first_sampled_; }
  const std::vector<CastFace>& faces() const { return faces_; }
  const std::vector<FaceSpace::Point>& points() const { return points_; }
  /// Gives the faces, and where they lie, away; nothing may be asked afterwards.
  std::vector<CastFace> take_faces() { return std::move(faces_); }
  std::vector<FaceSpace::Point> take_points() { return std::move(points_); }
  const FacePointIndex& index() const { return index_; }

 private:
  std::vector<CastFace> faces_;
  std::vector<FaceSpace::Point> points_;
  FacePointIndex index_;
  Index first_sampled_ = 0;
};

}  // namespace crowdface
