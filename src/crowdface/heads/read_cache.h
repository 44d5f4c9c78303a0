// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "crowdface/core/hash.h"
#include "crowdface/heads/cache_entry.h"
#include "crowdface/io/obj_file.h"

namespace crowdface {

/// What heads of one mesh have in common.
struct HeadMesh {
  Topology topology;
  TextureCoordinates uvs;
  std::vector<std::uint32_t> corner_normals;  ///< see ObjFile
  Digest digest() const;
};

/// \param text  digest of the whole file.
CacheKey read_key(const Digest& text);
CacheKey mesh_key(const Digest& mesh);

/// Fills in positions, materials and groups, as the reader found them when this text was last read.
/// \return the digest of its mesh. \throws InvalidInput if the entry holds no head.
Digest read_head(const CacheEntry& entry, ObjFile& head);
/// \param mesh  its digest. \throws InvalidInput if the entry does not hold this mesh.
HeadMesh read_mesh(const CacheEntry& entry, const Digest& mesh);

/// What the entries hold.
std::vector<EntryArray> arrays_of(const ObjFile& head, const Digest& mesh);
std::vector<EntryArray> arrays_of(const HeadMesh& mesh);

}  // namespace crowdface
