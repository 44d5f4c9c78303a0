// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "crowdface/core/hash.h"
#include "crowdface/core/problems.h"
#include "crowdface/heads/cache_folder.h"
#include "crowdface/heads/head_file.h"
#include "crowdface/io/obj_file.h"

namespace crowdface {

/// Smaller files are not cached: reading them takes no longer than reading their cache entry.
inline constexpr std::uint64_t kMinCachedBytes = 1'000'000;

/// What to do with a mesh whose polygons face inward: keep it, or turn the polygons outward.
enum class Winding { kAsItIs, kOutward };

/// Reads meshes in parallel, from the cache if it has them.
/// \param what   noun for the meshes, shown in the progress bar
/// \param cache  cache folder; empty: no cache
/// \return one item for each path; empty if the file could not be read. Each unreadable file is
/// added as a problem.
std::vector<std::optional<HeadFile>> read_mesh_files(
    const std::vector<std::filesystem::path>& paths, std::string_view what,
    const CacheFolder& cache, Problems& problems, Winding winding = Winding::kOutward);

/// Reads heads like read_mesh_files. \return the readable heads, in order; unreadable heads are
/// added as problems.
std::vector<HeadFile> read_heads(const std::vector<std::filesystem::path>& paths,
                                 const CacheFolder& cache, Problems& problems);

/// Reads the vertex positions of a mesh file.
/// \param topology        the topology that the mesh must have
/// \param name_of_meshes  noun in error messages for the meshes that have `topology`: "the heads"
/// \throws InvalidInput if the mesh has another topology; Error if the file cannot be read.
Positions read_positions(const std::filesystem::path& file, const Topology& topology,
                         std::string_view name_of_meshes);

/// Stores the heads and their meshes in the cache folder. Skips heads that the cache already has
/// and heads from files smaller than kMinCachedBytes. If the folder cannot be written, only warns.
void cache_heads(const std::vector<HeadFile>& heads, const std::filesystem::path& cache);

}  // namespace crowdface
