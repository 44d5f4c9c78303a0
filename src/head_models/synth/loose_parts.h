// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "crowdface/mesh/topology.h"
#include "head_models/synth/identity.h"

namespace crowdface::synth {

/// Which piece of a head is not skin.
enum class LoosePiece { kLeftEye, kRightEye, kUpperTeeth, kLowerTeeth };

/// Eyeballs (closed balls) and two rows of teeth (closed bands along the jaws' arcs), behind lids and
/// lips: meshes of quads that no identity deforms; they are placed as wholes.
class LooseParts {
 public:
  /// \param edge_cm  wanted length of their edges
  explicit LooseParts(double edge_cm);

  /// Adds their faces and texture coordinates, which fill the holes that eyes and mouth leave in the
  /// texture, behind those of the skin.
  void append_to(Topology& topology, TextureCoordinates& uvs) const;
  Index vertex_count() const { return static_cast<Index>(points_.size()); }
  Index face_count() const { return static_cast<Index>(corners_.size() / 4); }
  /// From which of its vertices on a piece begins; pieces follow each other in their order.
  Index first_vertex(LoosePiece piece) const { return first_[static_cast<std::size_t>(piece)]; }
  /// The same of its faces.
  Index first_face(LoosePiece piece) const { return first_faces_[static_cast<std::size_t>(piece)]; }

  /// Whether a vertex is an eyeball's, and where it lies on the unit ball, which looks along +z.
  bool in_eyeball(Index vertex) const { return vertex < first_vertex(LoosePiece::kUpperTeeth); }
  const Eigen::Vector3d& on_eyeball(Index vertex) const {
    return points_[static_cast<std::size_t>(vertex)];
  }

  /// Their places in a head, vertex_count() by 3. The same surfaces at every edge length.
  Positions positions(const Identity& identity) const;

 private:
  void add_eyeball(double side, int rings);
  void add_teeth(double up, int along, int around);
  void close_band(Index first, int along, int around);

  std::vector<Eigen::Vector3d>
      points_;  ///< of an eyeball: on the unit ball; teeth: of the mean head
  std::vector<Eigen::RowVector2d> uvs_;  ///< one a vertex
  std::vector<std::uint32_t> corners_;   ///< four a face
  std::vector<Index> first_, first_faces_;
};

}  // namespace crowdface::synth
