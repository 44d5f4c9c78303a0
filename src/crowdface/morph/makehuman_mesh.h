// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "crowdface/morph/head_model.h"

namespace crowdface {

/// Head and neck of the MakeHuman base mesh, cut from the body along one of its own loops: skin and
/// eyeballs. Everything else of the file (joints, clothes' helpers, lashes, teeth) is left out.
struct MakeHumanMesh {
  Positions file_positions;         ///< of the whole file, decimetres: what targets are made for
  Mesh head;                        ///< decimetres, as in the file
  std::vector<std::uint32_t> rows;  ///< #V, the vertices' places in the file, ascending
  std::vector<MaterialRange> materials;  ///< skin, then eyeball_r and eyeball_l
  FaceHeights heights;                   ///< decimetres
};

/// Reads public/data/models/human_full_size.json (three.js' JSON format, version 3).
/// \throws MissingInput, or InvalidInput naming the file, what was expected and what was found.
MakeHumanMesh read_makehuman_mesh(const std::filesystem::path& file);

}  // namespace crowdface
