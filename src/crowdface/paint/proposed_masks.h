// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "crowdface/paint/mask_bands.h"
#include "crowdface/region/mask_painting.h"

namespace crowdface {

/// Parses a list of regions such as "brow,nose,mouth" (see MaskBand). The list must contain brow,
/// nose and mouth.
/// \throws UsageError otherwise.
std::vector<MaskBand> parse_bands(std::string_view text);
/// Returns the name of each of the given bands, see kMaskBandNames.
std::vector<std::string> names_of(const std::vector<MaskBand>& bands);

/// Width and height in texels that are sufficient for masks of soft regions on a mesh with this
/// number of vertices: 1024 or 2048.
int mask_side_texels(Index vertex_count);

/// Computes the weights of mask regions from the shape of the mean head: #V by #bands.
/// \throws InvalidInput in the same cases as propose_bands, and if no face with this orientation is
///     found; the message then gives the reason, see why_no_face_found.
RegionWeights::Alpha propose_regions(const Topology& topology, const HeadShape& mean,
                                     const Orientation& orientation,
                                     const std::vector<MaskBand>& bands);

/// Computes the regions of propose_regions as mask images in the texture coordinates of the heads.
/// \param size  width and height in texels.
/// \throws InvalidInput in the same cases as propose_regions and paint_masks, and if the heads have
///     no texture coordinates.
PaintedMasks propose_masks(const HeadSet& heads, const HeadShape& mean,
                           const Orientation& orientation, const std::vector<MaskBand>& bands,
                           int size);

}  // namespace crowdface
