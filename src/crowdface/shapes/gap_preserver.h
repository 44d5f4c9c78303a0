// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "crowdface/parts/skin_contacts.h"

namespace crowdface {

/// Preserves the gap between the lips in shapes that keep the lips closed or equally far apart. The
/// two lips are far from each other along the skin. So the linear maps of FrameField differ between
/// the lips, and alone they would change the gap.
class GapPreserver {
 public:
  /// \param skin  Vertices of the skin, ascending.
  GapPreserver(const HeadSet& faces, const Adjacency& adjacency,
               std::span<const std::uint32_t> skin);

  /// Returns whether a shape that moves these vertices (ascending) moves skin that nearly touches
  /// other skin.
  bool is_affected_by(std::span<const std::uint32_t> vertices) const;
  /// Returns one vertex at each place where gaps are measured.
  std::vector<std::uint32_t> vertices() const;

  /// Returns the vertices that `adjust` may move.
  std::vector<std::uint32_t> movable_vertices() const { return contacts_.movable_vertices(); }

  /// Returns the gaps at all places. \param positions  #V by 3.
  std::vector<double> gaps(const Positions& positions) const { return contacts_.gaps(positions); }
  /// Returns the largest depth by which skin overlaps other skin, over all places; 0 if no skin
  /// overlaps.
  double max_overlap(const Positions& positions) const;

  /// Which gaps to adjust: only the gaps that the shape hardly changes, or all gaps.
  enum class GapSelection { kNearlySame, kAll };
  /// Adjusts a shape so that gaps become `rest + widening`.
  ///
  /// \param rest      #places: gaps of the face at rest.
  /// \param widening  #places: wanted change of each gap.
  /// \param how       Which gaps to adjust.
  /// \param shape     The face in the shape, #V by 3; adjusted.
  void adjust(std::span<const double> rest, std::span<const double> widening, GapSelection how,
              Positions& shape) const;

 private:
  SkinContacts contacts_;
  double max_change_ = 0;  ///< largest change of a gap that kNearlySame adjusts
};

}  // namespace crowdface
