// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "crowdface/core/units.h"
#include "crowdface/mesh/topology.h"
#include "crowdface/paint/face_relief.h"
#include "crowdface/parts/head_axes.h"

namespace crowdface {

/// Positions of the features of a face. Heights are coordinates along axes.up, in the unit of the
/// positions.
struct FaceMarks {
  HeadAxes axes;               ///< see ReliefMatch::axes
  double symmetry_offset = 0;  ///< position of the symmetry plane along axes.side()
  double bridge_height = 0;    ///< height of the point where the bridge of the nose is most hollow
  double tip_height = 0;       ///< height of the tip of the nose
  double eyes_height = 0;      ///< height of the centres of the eyes
  double mouth_height = 0;     ///< height of the line between the lips
  double chin_height = 0;      ///< height of the most convex point of the profile of the chin
  double chin_front = 0;       ///< front coordinate of the chin, along axes.front
  /// Returns the height of the eyes above the mouth, about 65 mm on a face of average size. Many
  /// lengths are defined as multiples of this height.
  double eye_to_mouth() const { return eyes_height - mouth_height; }
};

/// A head in which the functions below search for a face; usually the mean of all heads.
struct HeadShape {
  Positions positions;        ///< vertex positions, #V by 3
  std::vector<bool> is_skin;  ///< whether each vertex is skin, #V
  /// centre of each eyeball; empty if the head has no eyeballs
  std::vector<Eigen::Vector3d> eyeball_centres;
};
/// Returns the shape of the mean of all heads.
HeadShape mean_head_shape(const HeadSet& heads);

/// Offset of the symmetry plane along HeadAxes::side(), estimated as the mean position of the skin
/// along this axis, weighted by area.
double symmetry_offset(const Topology& topology, const HeadShape& head, const HeadAxes& axes);

/// Finds the face on a head by the relief of the face, see match_relief.
/// \param axes  orientation of the head, accurate to about 35°
/// \return nothing if no part of the skin has the relief of a face
std::optional<ReliefMatch> find_face(const Topology& topology, const HeadShape& head,
                                     const HeadAxes& axes);
/// Finds nose, mouth and chin in the profile of a face. The profile is the curve in which the
/// symmetry plane of the face cuts the skin.
FaceMarks marks_of_face(const Topology& topology, const HeadShape& head, const ReliefMatch& face);
/// Calls find_face and marks_of_face; returns nothing if find_face finds no face. The result does
/// not depend on the tessellation of the mesh.
std::optional<FaceMarks> find_face_marks(const Topology& topology, const HeadShape& head,
                                         const HeadAxes& axes);

/// The up and front directions of a head.
struct Orientation {
  Axis up, front;
  bool operator==(const Orientation&) const = default;
};
/// Returns the axes of a head with this orientation.
HeadAxes axes_of(const Orientation& orientation);
/// Returns the 24 axis-aligned orientations of a head.
std::vector<Orientation> all_orientations();

/// Tries all 24 axis-aligned orientations of a head and returns the one in which the relief of a
/// face matches best.
/// \return nothing if no orientation shows a face.
std::optional<Orientation> find_orientation(const Topology& topology, const HeadShape& head);

/// Returns a message if the mesh has the relief of a face but too long edges to represent the
/// features of a face. Returns nothing for other meshes.
std::optional<std::string> long_edges_message(const Topology& topology, const HeadShape& head,
                                              const HeadAxes& axes);
/// Explains why `find_face` found nothing: the face has another orientation than `axes` (the text
/// names this orientation), the mesh has too long edges, or there is no face.
std::string why_no_face_found(const Topology& topology, const HeadShape& head,
                              const HeadAxes& axes);

}  // namespace crowdface
