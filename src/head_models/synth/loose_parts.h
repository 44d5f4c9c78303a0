// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "crowdface/mesh/topology.h"
#include "head_models/synth/identity.h"

namespace crowdface::synth {

/// The parts of a head that are not skin.
enum class LoosePiece { kLeftEye, kRightEye, kUpperTeeth, kLowerTeeth };

/// Two eyeballs (spheres) and two rows of teeth (closed bands along the dental arches) as quad
/// meshes. The parts of two heads differ in scale and position, but not in shape.
class LooseParts {
 public:
  /// \param edge_cm  desired edge length in cm.
  explicit LooseParts(double edge_cm);

  /// Appends the polygons and texture coordinates of the parts to the polygons and texture
  /// coordinates of the skin. Eyeballs get the texture areas of unwrap_eyeball. Teeth get the hole
  /// that the mouth leaves in the texture (unwrap_hole).
  void append_to(Topology& topology, TextureCoordinates& uvs) const;
  Index vertex_count() const { return static_cast<Index>(points_.size()); }
  Index face_count() const { return static_cast<Index>(corners_.size() / 4); }
  /// Returns the index of the first vertex of a piece. Pieces are stored in the order of
  /// LoosePiece.
  Index first_vertex(LoosePiece piece) const {
    return first_vertices_[static_cast<std::size_t>(piece)];
  }
  /// Returns the index of the first polygon of a piece.
  Index first_face(LoosePiece piece) const { return first_faces_[static_cast<std::size_t>(piece)]; }

  /// Returns whether a vertex belongs to an eyeball.
  bool is_on_eyeball(Index vertex) const { return vertex < first_vertex(LoosePiece::kUpperTeeth); }
  /// Returns the position of an eyeball's vertex on the unit sphere, whose pupil is at +z.
  const Eigen::Vector3d& point_on_eyeball(Index vertex) const {
    return points_[static_cast<std::size_t>(vertex)];
  }

  /// Returns the vertex positions of the parts in a head: vertex_count() by 3, cm. Two objects of
  /// this class that were made for different edge lengths describe the same shapes.
  Positions positions(const Identity& identity) const;

 private:
  /// Adds an eyeball, a subdivided cube that is projected onto the sphere.
  /// \param side   1, or −1 for the eyeball at x < 0.
  /// \param quads  number of quads along an edge of the cube.
  void add_eyeball(double side, int quads);
  /// Adds a row of teeth, a closed band.
  /// \param up             1: upper row, −1: lower row.
  /// \param along, around  quads along the row and around its cross-section.
  void add_teeth(double up, int along, int around);
  /// Adds the quads of the band, and closes each end with a centre vertex and a fan of quads.
  /// \param first  index of the band's first vertex.
  void close_band(Index first, int along, int around);

  /// position of each vertex; eyeballs: on the unit sphere; teeth: in the mean head, cm
  std::vector<Eigen::Vector3d> points_;
  std::vector<Eigen::RowVector2d> uvs_;  ///< texture coordinates, one pair per vertex
  std::vector<std::uint32_t> corners_;   ///< indices of the polygons' corners, four per polygon
  /// index of each piece's first vertex and of its first polygon, in the order of LoosePiece
  std::vector<Index> first_vertices_, first_faces_;
};

}  // namespace crowdface::synth
