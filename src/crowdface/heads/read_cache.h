// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "crowdface/core/hash.h"
#include "crowdface/heads/cache_entry.h"
#include "crowdface/heads/cache_folder.h"
#include "crowdface/io/obj_file.h"

namespace crowdface {

/// The data that heads with the same mesh share.
struct HeadMesh {
  Topology topology;
  TextureCoordinates uvs;                     ///< texture coordinates, #T by 2
  std::vector<std::uint32_t> corner_normals;  ///< see ObjFile::corner_normals
  Digest digest() const;                      ///< hash of all members of this object
};

/// Fills in positions, materials and groups of a head from the cache. The mesh has its own entry,
/// see find_mesh.
/// \param text_digest  hash of the whole file
/// \param head         receives the data
/// \return the hash of the head's mesh, or nothing if the cache has no entry for the file.
std::optional<Digest> fill_head_from_cache(const CacheFolder& cache, const Digest& text_digest,
                                           ObjFile& head);
/// Finds the mesh of a head in the cache; nothing if the cache has no valid entry.
/// \param mesh_digest  hash of the mesh
std::optional<HeadMesh> find_mesh(const CacheFolder& cache, const Digest& mesh_digest);

/// Writes the cache entry of a head. \throws CannotCreate, IoError.
void cache_head(const std::filesystem::path& cache, const Digest& text_digest,
                const Digest& mesh_digest, const ObjFile& head);
/// Writes the cache entry of a mesh that heads share. \throws CannotCreate, IoError.
void cache_mesh(const std::filesystem::path& cache, const HeadMesh& mesh);

/// The cache key of a head as read from its file (kind kReadKind).
CacheKey key_of_read_head(const Digest& text_digest);

}  // namespace crowdface
