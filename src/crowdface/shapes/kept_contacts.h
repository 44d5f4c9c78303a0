// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "crowdface/parts/skin_contacts.h"

namespace crowdface {

/// Lips that a shape leaves closed, or as far apart as they are, stay so. They are far from each other
/// along the skin: what turns and stretches it there is not the same on both.
class KeptContacts {
 public:
  /// \param skin  its vertices, ascending
  KeptContacts(const FaceSet& faces, const Adjacency& adjacency,
               std::span<const std::uint32_t> skin);

  /// Whether a shape with these vertices, ascending, moves skin that nearly touches skin.
  bool moved_by(std::span<const std::uint32_t> vertices) const;
  /// A vertex of each place where skin nearly touches skin.
  std::vector<std::uint32_t> vertices() const;

  /// The vertices that `keep` may move.
  std::vector<std::uint32_t> moved() const { return contacts_.moved(); }

  /// Of all places. \param positions  #V by 3
  std::vector<double> gaps(const Positions& positions) const { return contacts_.gaps(positions); }
  /// How far skin goes through skin at most; 0: nowhere.
  double deepest(const Positions& positions) const;

  /// Of places that are to stay nearly as they are, or of all.
  enum class Keeping { kNearlySame, kAll };
  /// Brings the gaps of those places to what is asked for.
  /// \param rest      #places: gaps of the face at rest
  /// \param widening  #places, asked for
  /// \param shape     of the face, #V by 3; made to fit
  void keep(std::span<const double> rest, std::span<const double> widening, Keeping how,
            Positions& shape) const;

 private:
  SkinContacts contacts_;
  double most_ = 0;  ///< a gap that changes by more is not kept
};

}  // namespace crowdface
