// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "crowdface/morph/head_model.h"

namespace crowdface {

/// A region mask in three bands, one picture for each texture tile (UDIM: 1001 + ⌊u⌋ + 10·⌊v⌋) that
/// the mesh uses: `size` × `size` × 3 bytes, first row at v = 1; channels top (brows and above),
/// middle (eyes and nose), bottom (mouth and below), which add up to 255 and run softly into one
/// another. Painted where the texture's faces lie and some way beyond their borders, black elsewhere; where
/// faces share a place, the first one's height counts.
/// \throws InvalidInput if a face has no texture coordinates or eyes are not above mouth.
std::map<int, std::vector<std::uint8_t>> band_masks(const Mesh& neutral, const FaceHeights& heights,
                                                    int size);

}  // namespace crowdface
