// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "crowdface/parts/skin_contacts.h"

namespace crowdface {

/// Preserves the gap between the lips in shapes that keep the lips closed or equally far apart. The
/// linear maps of FrameField alone would change the gap, because the two lips get different maps:
/// the lips are far from each other along the skin. The width of a gap is measured at several
/// sections (see SkinContacts). Below, each section counts as one gap.
class GapPreserver {
 public:
  /// \param skin  Vertices of the skin, ascending.
  GapPreserver(const HeadSet& head_set, const Adjacency& adjacency,
               std::span<const std::uint32_t> skin);

  /// Returns whether any of these vertices (ascending) belongs to skin that nearly touches other
  /// skin.
  bool is_affected_by(std::span<const std::uint32_t> vertices) const;
  /// Returns, for each gap, one vertex of the skin beside the gap. The order is the order of
  /// measure_gaps.
  std::vector<std::uint32_t> contact_vertices() const;

  /// Returns the vertices that `adjust` may move.
  std::vector<std::uint32_t> movable_vertices() const { return contacts_.movable_vertices(); }

  /// Returns the width of each gap, in the unit of the positions; negative if the skin overlaps.
  /// \param positions  #V by 3.
  std::vector<double> measure_gaps(const Positions& positions) const {
    return contacts_.gaps(positions);
  }
  /// Returns the largest depth to which skin overlaps other skin at a gap; 0 if no skin overlaps.
  double max_overlap(const Positions& positions) const;

  /// Which gaps to adjust: only the gaps that the shape hardly changes, or all gaps.
  enum class GapSelection { kNearlyUnchanged, kAll };
  /// Moves the skin of a face with a blend shape applied, so that gaps become
  /// `rest_gaps + gap_changes`.
  ///
  /// \param rest_gaps    Width of each gap on the face at rest.
  /// \param gap_changes  Wanted change of the width of each gap from rest to the shape.
  /// \param selection    Which gaps to adjust.
  /// \param shaped_face  The face with the blend shape applied, #V by 3; adjusted.
  void adjust(std::span<const double> rest_gaps, std::span<const double> gap_changes,
              GapSelection selection, Positions& shaped_face) const;

 private:
  SkinContacts contacts_;
  /// With kNearlyUnchanged, `adjust` skips the gaps whose change is larger than this length.
  double max_gap_change_ = 0;
};

}  // namespace crowdface
