// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "crowdface/core/units.h"
#include "crowdface/mesh/topology.h"
#include "crowdface/parts/head_axes.h"

namespace crowdface {

/// Where the features of a face lie: heights along HeadAxes::up, in the unit of the positions.
struct FaceMarks {
  double middle = 0;      ///< between the head's halves, along HeadAxes::side()
  double bridge = 0;      ///< of the nose, where it is deepest, between the eyes
  double tip = 0;         ///< of the nose
  double eyes = 0;        ///< their middles
  double mouth = 0;       ///< between the lips
  double chin = 0;        ///< its lowest point
  double stands_out = 0;  ///< how far the nose does, as a part of the head's size
  double chin_front = 0;  ///< how far in front that is, along HeadAxes::front
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

/// Looks for nose, mouth and chin in the outline that the head's middle plane cuts from its skin, for
/// any topology.
/// \return nothing if nothing there stands out as a nose does, over a throat that lies back.
std::optional<FaceMarks> find_face_marks(const Topology& topology, const HeadShape& head,
                                         const HeadAxes& axes);

/// Which way a head looks.
struct Bearing {
  Axis up, front;
  bool operator==(const Bearing&) const = default;
};
HeadAxes axes_of(const Bearing& bearing);

/// Tries all 24 ways a head may stand: halves that mirror each other to the sides, a nose in front.
/// \return nothing if none is a head's.
std::optional<Bearing> find_bearing(const Topology& topology, const HeadShape& head);

}  // namespace crowdface
