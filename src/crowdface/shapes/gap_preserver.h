// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "crowdface/parts/skin_contacts.h"

namespace crowdface {

/// Preserves the gap between the lips in shapes that keep the lips closed or equally far apart. The
/// two lips are far from each other along the skin, so the linear maps of FrameField differ between
/// them and would change the gap.
class GapPreserver {
 public:
  /// \param skin  Vertices of the skin, ascending.
  GapPreserver(const HeadSet& faces, const Adjacency& adjacency,
               std::span<const std::uint32_t> skin);

  /// Returns whether a shape that moves these vertices (ascending) moves skin that nearly touches
  /// other skin.
  bool moved_by(std::span<const std::uint32_t> vertices) const;
  /// Returns one vertex of each place.
  std::vector<std::uint32_t> vertices() const;

  /// Returns the vertices that `keep` may move.
  std::vector<std::uint32_t> moved() const { return contacts_.moved(); }

  /// Returns the gaps at all places. \param positions  #V by 3.
  std::vector<double> gaps(const Positions& positions) const { return contacts_.gaps(positions); }
  /// Returns the largest depth, over all places, by which skin passes through other skin; 0 if
  /// there is no such place.
  double deepest(const Positions& positions) const;

  /// Which gaps to adjust: those that the shape hardly changes, or all.
  enum class Keeping { kNearlySame, kAll };
  /// Adjusts a shape so that gaps become `rest + widening`.
  ///
  /// \param rest      #places: gaps of the face at rest.
  /// \param widening  #places: wanted change of each gap.
  /// \param how       Which gaps to adjust.
  /// \param shape     The face in the shape, #V by 3; adjusted.
  void keep(std::span<const double> rest, std::span<const double> widening, Keeping how,
            Positions& shape) const;

 private:
  SkinContacts contacts_;
  double most_ = 0;  ///< kNearlySame adjusts only gaps that change by at most this length
};

}  // namespace crowdface
