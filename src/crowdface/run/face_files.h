// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "crowdface/core/file.h"
#include "crowdface/core/hash.h"
#include "crowdface/io/mesh_format.h"
#include "crowdface/validity/skin_check.h"

namespace crowdface {

/// A face's file as it was written.
struct MeshFile {
  MeshFormat format = MeshFormat::kObj;
  Digest digest;
  std::uint64_t bytes = 0;
};

/// What one face's files are.
struct FaceFiles {
  std::vector<MeshFile> meshes;
  std::optional<FileDigest> picture;  ///< if it was rendered
  std::optional<FileDigest> preview;  ///< its mesh in the gallery, if there is one
  std::optional<SkinDefects> skin;    ///< against the target's, if it was judged
};

}  // namespace crowdface
