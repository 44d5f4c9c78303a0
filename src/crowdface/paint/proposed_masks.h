// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "crowdface/paint/bands.h"
#include "crowdface/region/mask_painting.h"

namespace crowdface {

/// "brow,nose,mouth": commas between names; brow, nose and mouth must be among them.
/// \throws UsageError otherwise.
std::vector<Band> parse_bands(std::string_view text);
std::vector<std::string> names_of(const std::vector<Band>& bands);

/// Texels of a side that are enough for soft regions on so many vertices: 1024 or 2048.
int mask_size(Index vertices);

/// Regions told from the shape of the mean head: #V by #bands.
/// \throws InvalidInput if no face is found that looks along the front, naming the axes along which
///         one does, if there are; as propose_bands.
RegionWeights::Alpha propose_regions(const Topology& topology, const HeadShape& mean,
                                     const Bearing& bearing, const std::vector<Band>& bands);

/// The same as images in the layout of the heads' texture.
/// \param size  texels of a side.
/// \throws InvalidInput as propose_regions and paint_masks.
PaintedMasks propose_masks(const FaceSet& faces, const HeadShape& mean, const Bearing& bearing,
                           const std::vector<Band>& bands, int size);

}  // namespace crowdface
