// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "crowdface/mesh/topology.h"
#include "crowdface/region/mask_source.h"

namespace crowdface {

/// The weight of each region at every vertex: the masks α_k of Eq. 7.
struct RegionWeights {
  using Alpha = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  /// weight of each region at each vertex, #V by #R; not negative; each row sums to one
  Alpha alpha;
  /// Number of vertices that need masks (see `is_needed` of region_weights), but at which all masks
  /// are zero. These vertices belong to the last region.
  Index uncovered_vertex_count = 0;
};

/// Returns the weights of a single region that covers the whole head.
RegionWeights whole_head_weights(const Topology& topology);

/// Samples the masks at every vertex's texture coordinates.
///
/// Assignment of channels to regions:
/// - By default, channels are assigned to regions in the order of the images; alpha channels are
///   skipped and surplus channels ignored.
/// - Channels with names that match region names (OpenEXR channels, or columns of a vertex weight
///   file) are assigned by name. If only the last region has no channel, this region gets 1 minus
///   the sum of all other regions.
/// - If there are as many images as regions, each image is the mask of one region. The mask is the
///   grey value of the image, or alpha if the image is not grey. If every region's name matches one
///   file name, the file names assign the images to the regions.
/// - If all colour channels are constant and alpha is not, alpha is the mask.
/// - If there is one channel for two regions, the second region gets 1 minus the first region.
///
/// Sampling is bilinear between texel centres and clamped at the image's edge. The first row of the
/// image is at v = 1. With UDIM tiles, a sample comes from the tile that contains the texture
/// coordinate. If the coordinate lies on a tile border, the mean coordinate of the corner's polygon
/// selects the tile. A single image covers u and v in [0, 1]; coordinates outside this range are
/// clamped. A vertex with several distinct texture coordinates gets the mean of the samples at
/// these coordinates. The weights of each vertex are scaled, so that their sum is one. Vertices
/// whose weights are all zero, and vertices without polygons, belong to the last region.
///
/// \param masks   may be empty if there is one region.
/// \param is_needed  one entry per vertex, or empty for all vertices: whether the vertex needs
///                   masks. Tiles that no needed vertex uses may be missing; vertices that lie only
///                   in missing tiles belong to the last region.
/// \param names   names of the regions; empty: assigns channels by order only.
/// \param mesh_name  name or file of the mesh, for messages.
/// \throws MissingInput naming every missing image, and every missing tile that a needed vertex
///         uses.
/// \throws InvalidInput if an image cannot be used, there are too few channels, a whole image is
///         unused, tiles differ in their channels, named channels match no region, or needed
///         vertices lack texture coordinates.
RegionWeights region_weights(const Topology& topology, const TextureCoordinates& uvs,
                             const std::vector<MaskSource>& masks, Index regions,
                             const std::vector<bool>& is_needed = {},
                             const std::vector<std::string>& names = {},
                             const std::string& mesh_name = "the mesh");

/// Samples the first channel of a mask at every vertex, like region_weights, but does not scale the
/// values. Returns zero for vertices that no polygon uses. Throws the errors of region_weights.
/// \param is_needed  one entry per vertex, or empty for all vertices: whether the vertex must have
///                   texture coordinates.
std::vector<double> mask_values(const Topology& topology, const TextureCoordinates& uvs,
                                const MaskSource& mask, const std::vector<bool>& is_needed = {},
                                const std::string& mesh_name = "the mesh");

/// Samples one channel of an image bilinearly at (u, v), as in region_weights; coordinates outside
/// [0, 1] are clamped.
double sample_bilinear(const Image& image, double u, double v, int channel);

}  // namespace crowdface
