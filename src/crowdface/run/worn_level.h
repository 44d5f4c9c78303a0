// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "crowdface/cast/cast_face.h"
#include "crowdface/core/grouped.h"
#include "crowdface/heads/face_attachments.h"
#include "crowdface/heads/inputs.h"

namespace crowdface {

/// What faces wear on one level of detail: of each attachment the share of triangles that faces keep there, but no fewer
/// than 300, so that what is small stays whole.
struct WornLevel {
  std::map<const Attachment*, DetailLevel> items;  ///< that somebody wears

  /// How an attachment looks here; null: nobody wears it.
  const DetailLevel* find(const Attachment& item) const;
  /// What a face wears, reduced.
  std::vector<WornAttachment> of(std::span<const WornAttachment> worn) const;
};

/// What the faces or the vertices of a level are in the whole mesh. \param rows  of that.
template <class T>
std::vector<T> at_rows(const std::vector<T>& whole, std::span<const std::uint32_t> rows) {
  std::vector<T> some;
  for (const std::uint32_t row : rows) some.push_back(whole[row]);
  return some;
}
/// The same in groups; of none: none.
template <class T>
Grouped<T> at_rows(const Grouped<T>& whole, std::span<const std::uint32_t> rows) {
  Grouped<T> some;
  if (whole.group_count() == 0) return some;
  for (const std::uint32_t row : rows) some.add_group(whole.of(row));
  return some;
}

/// One for each of the inputs' levels of detail.
/// \param crowd  who wears something.
std::vector<WornLevel> worn_levels(const Inputs& inputs, std::span<const CastFace> crowd);

}  // namespace crowdface
