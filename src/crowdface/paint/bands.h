// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

#include "crowdface/mesh/topology.h"
#include "crowdface/paint/face_marks.h"
#include "crowdface/parts/head_axes.h"
#include "crowdface/region/region_weights.h"

namespace crowdface {

/// Parts of a head that a shape tells apart.
enum class Band : std::uint8_t {
  kBrow,   ///< brows and above
  kNose,   ///< eyes and nose
  kMouth,  ///< mouth and below
  kEars,
  kNeck,  ///< below chin and ears
};
inline constexpr std::array<std::pair<std::string_view, Band>, 5> kBandNames = {
    {{"brow", Band::kBrow},
     {"nose", Band::kNose},
     {"mouth", Band::kMouth},
     {"ears", Band::kEars},
     {"neck", Band::kNeck}}};

/// Shares of brow, nose and mouth (columns 0 to 2) at some heights: soft, one above the other.
/// \param heights  #V; rises upwards.
/// \throws InvalidInput unless the eyes are above the mouth.
RegionWeights::Alpha level_bands(const Eigen::VectorXd& heights, double eyes, double mouth);

/// Soft bands of a head, from its own shape.
/// \param marks  found in that head
/// \param bands  kBrow, kNose and kMouth, and which others.
/// \return #V by #bands, not negative; rows sum to one.
/// \throws InvalidInput if ears are asked for and nothing stands out at the sides of the head, or a
///         neck and nothing lies below the chin.
RegionWeights::Alpha propose_bands(const Topology& topology, const HeadShape& head,
                                   const FaceMarks& marks, const std::vector<Band>& bands);

}  // namespace crowdface
