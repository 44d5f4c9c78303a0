// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "crowdface/core/hash.h"
#include "crowdface/heads/read_cache.h"
#include "crowdface/io/obj_file.h"

namespace crowdface {

/// A head as read from its file. The topology, texture coordinates and corner normals are in
/// `mesh`; the same members of `file` are empty.
struct HeadFile {
  ObjFile file;        ///< the content of the file, except the members in `mesh`
  Digest text_digest;  ///< hash of the file's bytes
  Digest mesh_digest;  ///< HeadMesh::digest of `mesh`
  /// polygons, texture coordinates and corner normals; one object for all heads with equal meshes
  std::shared_ptr<HeadMesh> mesh;
  bool is_cached = false;  ///< whether the cache has an entry for the head's file
  /// whether the file has several vertices at the same position, which the reader has joined
  bool has_joined_vertices = false;
};

}  // namespace crowdface
