// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "crowdface/core/units.h"
#include "crowdface/mesh/topology.h"
#include "crowdface/paint/face_relief.h"
#include "crowdface/parts/head_axes.h"

namespace crowdface {

/// Where the features of a face lie: heights along axes.up, in the unit of the positions.
struct FaceMarks {
  HeadAxes axes;          ///< the face's own axes, see ReliefMatch
  double middle = 0;      ///< between the halves of the face, along axes.side()
  double bridge = 0;      ///< of the nose, where it is deepest, between the eyes
  double tip = 0;         ///< of the nose
  double eyes = 0;        ///< their middles
  double mouth = 0;       ///< between the lips
  double chin = 0;        ///< its lowest point
  double chin_front = 0;  ///< how far in front the chin is, along axes.front
  /// From mouth to eyes, some 65 mm: what other lengths are measured by.
  double face() const { return eyes - mouth; }
};

/// A head as far as its face is looked for: the mean of all heads.
struct HeadShape {
  Positions positions;                    ///< #V by 3
  std::vector<bool> skin;                 ///< #V
  std::vector<Eigen::Vector3d> eyeballs;  ///< their middles, where there are any
};
HeadShape shape_of_mean(const FaceSet& faces);

/// Where the head's halves meet along HeadAxes::side(): the middle of its skin.
double middle_of(const Topology& topology, const HeadShape& head, const HeadAxes& axes);

/// Finds the face by its relief, see match_relief.
/// \param axes  how the head stands, within some 35°
/// \return nothing if no part of the skin has the relief of a face
std::optional<ReliefMatch> find_face(const Topology& topology, const HeadShape& head,
                                     const HeadAxes& axes);
/// Finds nose, mouth and chin in the outline that the middle plane of a face cuts from the skin.
FaceMarks marks_of_face(const Topology& topology, const HeadShape& head, const ReliefMatch& face);
/// Both. Neither depends on how the mesh is cut.
std::optional<FaceMarks> find_face_marks(const Topology& topology, const HeadShape& head,
                                         const HeadAxes& axes);

/// Which way a head looks.
struct Bearing {
  Axis up, front;
  bool operator==(const Bearing&) const = default;
};
HeadAxes axes_of(const Bearing& bearing);
std::vector<Bearing> all_bearings();  ///< the 24 ways a head may stand along the axes

/// Tries all 24 ways a head may stand along the axes; the relief of a face agrees best along the right one.
/// \return nothing if none is a head's.
std::optional<Bearing> find_bearing(const Topology& topology, const HeadShape& head);

}  // namespace crowdface
