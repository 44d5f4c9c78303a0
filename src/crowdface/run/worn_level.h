// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "crowdface/cast/cast_face.h"
#include "crowdface/heads/face_attachments.h"
#include "crowdface/heads/inputs.h"

namespace crowdface {

/// What faces wear on one level of detail: of each attachment the share of triangles that faces keep there, but no fewer
/// than kFewestTriangles, so that what is small stays whole.
class WornLevel {
 public:
  static constexpr std::size_t kFewestTriangles = 300;

  /// How an attachment looks here; null: nobody wears it.
  const DetailLevel* find(const Attachment& item) const;
  /// What a face wears, reduced.
  std::vector<WornAttachment> of(std::span<const WornAttachment> worn) const;

 private:
  friend std::vector<WornLevel> worn_levels(const Inputs& inputs, std::span<const CastFace> crowd);
  std::map<const Attachment*, DetailLevel> items_;
};

/// What the faces of a level were in the whole mesh. \param of_face  #F of the whole.
std::vector<std::uint32_t> on_level(const DetailLevel& level,
                                    std::span<const std::uint32_t> of_face);

/// One for each of the inputs' levels of detail.
/// \param crowd  who wears something.
std::vector<WornLevel> worn_levels(const Inputs& inputs, std::span<const CastFace> crowd);

}  // namespace crowdface
