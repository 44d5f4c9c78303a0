// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "crowdface/mesh/topology.h"
#include "crowdface/region/mask_source.h"

namespace crowdface {

/// The masks α_k of Eq. 7: how much of each region every vertex belongs to.
struct RegionWeights {
  using Alpha = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  Alpha alpha;                   ///< #V by #R, not negative, rows sum to one
  Index uncovered_vertices = 0;  ///< of faces, but covered by no mask: in the last region
};

/// One region that is the whole head.
RegionWeights whole_head(const Topology& topology);

/// Looks the masks up at every vertex's texture coordinates.
///
/// Channels make regions in the order of the images, alpha left out; channels beyond the last
/// region are ignored. Channels that an OpenEXR file calls like regions are those regions, and so are columns of
/// weights of vertices. As many images as regions, each with more than one channel, give one region each: the grey
/// of theirs, or their alpha; by the files' names if these are the regions'. Where all colours are the same
/// and alpha is not, alpha is the mask. One channel of two regions leaves the rest to the second, as do named
/// channels to the last region if it has none. A place is sampled bilinearly between texel centres and clamped at the
/// image's edge, the first row at v = 1. A set of UDIM tiles takes the place from the tile that it
/// lies in; on a border the middle of the corner's polygon decides. A single picture covers u and v
/// in [0, 1], beyond which its edge goes on. A vertex gets the mean over its distinct places,
/// scaled to sum to one; where that is zero, and for vertices in no face, the last region.
///
/// \param masks    may be empty if there is one region.
/// \param needed   #V, or empty for all: of a tile that none of these vertices lies in there need be no
///                 image; vertices that lie nowhere else go to the last region.
/// \throws MissingInput if an image or a tile that some texture coordinate lies in is missing, all
///         of them named; InvalidInput if an image cannot be used, channels do not suffice, a whole
///         image is left over, tiles differ in channels, named channels are no regions, or texture coordinates of needed
///         vertices lack.
/// \param names    of the regions; empty: channels are told by their order alone.
RegionWeights region_weights(const Topology& topology, const TextureCoordinates& uvs,
                             const std::vector<MaskSource>& masks, Index regions,
                             const std::vector<bool>& needed = {},
                             const std::vector<std::string>& names = {});

/// The first channel of one mask at every vertex, looked up in the same way but not scaled; zero for
/// vertices in no face. \throws as region_weights.
/// \param needed  as there.
std::vector<double> mask_values(const Topology& topology, const TextureCoordinates& uvs,
                                const MaskSource& mask, const std::vector<bool>& needed = {});

/// One channel of an image at (u, v) in the unit square, as above.
double sample_bilinear(const Image& image, double u, double v, int channel);

}  // namespace crowdface
