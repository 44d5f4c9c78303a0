// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>
#include <vector>

#include "crowdface/cast/face_plan.h"
#include "crowdface/cast/nearest_face_search.h"

namespace crowdface {

/// The faces that have been cast so far, in the order of the plan, and their points in the face
/// space.
class CrowdSoFar {
 public:
  explicit CrowdSoFar(Index dimensions) : nearest_search_(dimensions) {}

  void add(FacePlan face, FaceSpace::Point point) {
    nearest_search_.add(point);
    faces_.push_back(std::move(face));
    points_.push_back(std::move(point));
  }
  Index size() const { return nearest_search_.size(); }
  /// Marks the beginning of the sampled faces: all faces added later are sampled.
  void begin_sampled_faces() { first_sampled_index_ = size(); }
  /// Index of the first sampled face. Casting chooses among candidates by their distances to
  /// sampled faces only, so an additional recipe or family does not change the choice. (Every
  /// candidate must keep the minimum distance from all faces, though.)
  Index first_sampled_index() const { return first_sampled_index_; }
  const std::vector<FacePlan>& faces() const { return faces_; }
  const std::vector<FaceSpace::Point>& points() const { return points_; }
  /// Moves the faces out of this object. Afterwards, only `take_points` may be called.
  std::vector<FacePlan> take_faces() { return std::move(faces_); }
  /// Moves the points out of this object. Afterwards, only `take_faces` may be called.
  std::vector<FaceSpace::Point> take_points() { return std::move(points_); }
  /// Returns the search for the faces of this crowd that are nearest to a point.
  const NearestFaceSearch& nearest_search() const { return nearest_search_; }

 private:
  std::vector<FacePlan> faces_;
  std::vector<FaceSpace::Point> points_;
  NearestFaceSearch nearest_search_;
  Index first_sampled_index_ = 0;
};

}  // namespace crowdface
