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
#include "crowdface/heads/read_cache.h"
#include "crowdface/io/obj_file.h"

namespace crowdface {

/// Smaller files are read as fast as what the cache says of them.
inline constexpr std::uint64_t kLeastKeptBytes = 1'000'000;

/// A head's file. The topology, texture coordinates and corner normals of its ObjFile are empty.
struct HeadFile {
  ObjFile file;
  Digest text;  ///< of the file's bytes
  Digest mesh_digest;
  std::shared_ptr<HeadMesh> mesh;  ///< one for all heads that have the same
  bool is_kept = false;            ///< the cache has it
};

/// What becomes of meshes whose faces look inward.
enum class Winding { kAsItIs, kOutward };

/// Reads meshes side by side, those that the cache knows from there.
/// \param what   they are, for the bar that shows how far it is
/// \param cache  its folder; empty: none.
/// \return #paths; those that could not be read are problems.
std::vector<std::optional<HeadFile>> read_mesh_files(
    const std::vector<std::filesystem::path>& paths, std::string_view what,
    const CacheFolder& cache, Problems& problems, Winding winding = Winding::kOutward);

/// The same of heads. \return those that could be read, in their order; the others are problems.
std::vector<HeadFile> read_heads(const std::vector<std::filesystem::path>& paths,
                                 const CacheFolder& cache, Problems& problems);

/// The positions of a mesh. \throws Error, InvalidInput if it has another topology than `others`, which
/// messages call so.
Positions read_positions(const std::filesystem::path& file, const Topology& topology,
                         std::string_view others);

/// Writes into the cache what it lacks of large files. A cache that cannot be written to costs a
/// warning.
void keep_heads(const std::vector<HeadFile>& heads, const std::filesystem::path& cache);

}  // namespace crowdface
