// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>

#include "crowdface/mesh/adjacency.h"
#include "crowdface/mesh/topology.h"
#include "crowdface/paint/face_marks.h"
#include "crowdface/parts/part_list.h"
#include "crowdface/parts/surface_point.h"

namespace crowdface {

/// Landmarks of a face by name: points on the skin, and the reasons why landmarks are missing.
struct FaceLandmarks {
  /// point on the skin of each landmark; the key is the landmark's name
  std::map<std::string, SurfacePoint> points;
  /// reason why each missing landmark was not found; the key is the landmark's name. A reason is a
  /// clause such as "the nose has no wings that stand out from the cheeks".
  std::map<std::string, std::string> missing_reasons;
};

/// Finds the landmarks of Farkas' measurements (docs/traits.md) on a head from these parts of its
/// shape: the profile in the middle of the face, the visible parts of the eyeballs, the relief of
/// nose and mouth seen from the front, and the outline seen from the sides. Left and right are
/// searched together, at the same heights and depths.
/// \param head  usually the mean head
/// \param face  position of the face on the head
FaceLandmarks find_face_landmarks(const Topology& topology, const Components& components,
                                  const PartList& parts, const HeadShape& head,
                                  const ReliefMatch& face);

/// Finds the face on a head and then its landmarks; no landmarks if there is no face.
/// \param positions  #V by 3
/// \param axes  orientation of the head, accurate to about 35°
FaceLandmarks find_face_landmarks(const Topology& topology, const Components& components,
                                  const PartList& parts, const Positions& positions,
                                  const HeadAxes& axes);

}  // namespace crowdface
