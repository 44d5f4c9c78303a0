// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "crowdface/mesh/topology.h"
#include "crowdface/paint/face_marks.h"
#include "crowdface/parts/head_axes.h"
#include "crowdface/region/region_weights.h"

namespace crowdface {

/// Regions of a mask that can be computed from a head's shape: three horizontal bands of the face,
/// the ears, and the neck. Unrelated to the bands of detail.
enum class MaskBand : std::uint8_t {
  kBrow,   ///< the band contains the brows and everything above
  kNose,   ///< the band at the height of the nose: contains the nose and the eyes
  kMouth,  ///< the band contains the mouth and everything below, down to the neck
  kEars,
  kNeck,  ///< below chin and ears
};
/// The name of each mask region that a MaskBand defines.
inline constexpr std::array<std::pair<std::string_view, MaskBand>, 5> kMaskBandNames = {
    {{"brow", MaskBand::kBrow},
     {"nose", MaskBand::kNose},
     {"mouth", MaskBand::kMouth},
     {"ears", MaskBand::kEars},
     {"neck", MaskBand::kNeck}}};

/// Both ears of a head: their vertices, and their extent along the head's axes.
struct Ears {
  double bottom = 0, top = 0;           ///< heights of the lowest and the highest point of the ears
  double back = 0, front = 0;           ///< range of the ears' coordinates along HeadAxes::front
  std::vector<std::uint32_t> vertices;  ///< vertices of both ears, ascending; at least one
};
/// Finds the ears: the parts of the skin that protrude at both sides of the head, between the
/// heights of mouth and brows.
/// \return nothing if nothing protrudes.
std::optional<Ears> find_ears(const Topology& topology, const HeadShape& head,
                              const FaceMarks& marks);

/// Computes the weights of brow, nose and mouth (columns 0 to 2) as horizontal bands with soft
/// borders, #V by 3.
/// \param heights      #V: height of each vertex, upwards.
/// \param eyes, mouth  heights of the eyes and of the mouth.
/// \throws InvalidInput unless the eyes are above the mouth.
RegionWeights::Alpha horizontal_bands(const Eigen::VectorXd& heights, double eyes, double mouth);

/// Computes the weights of the given bands, with soft borders, from the shape of a head.
/// \param marks  the result of find_face_marks for this head
/// \param bands  kBrow, kNose and kMouth, and optionally other bands
/// \return #V by #bands, not negative; each row sums to one.
/// \throws InvalidInput if `bands` has kEars and no ears stand out at the sides of the head, or if
///     `bands` has kNeck and the head ends at the chin.
RegionWeights::Alpha propose_bands(const Topology& topology, const HeadShape& head,
                                   const FaceMarks& marks, const std::vector<MaskBand>& bands);

}  // namespace crowdface
