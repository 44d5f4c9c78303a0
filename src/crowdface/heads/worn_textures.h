// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "crowdface/io/obj_file.h"
#include "crowdface/io/texture_kind.h"
#include "crowdface/mesh/topology.h"

namespace crowdface {

/// The files of one kind that one head's materials name for its faces.
struct WornTextures {
  struct File {
    std::filesystem::path path;  ///< is there
    std::filesystem::path name;  ///< as the material says; may hold <UDIM>
  };
  std::vector<File> files;  ///< each once, as faces first wear them
  std::vector<std::uint32_t>
      of_face;  ///< #F rows of `files`, or kNoIndex; empty where no head has any
};

/// Of all heads, and what is missing.
struct HeadsTextures {
  TextureKind kind = TextureKind::kColour;
  std::vector<WornTextures> heads;                ///< #heads
  std::vector<std::array<std::int32_t, 2>> tile;  ///< #F, column and row of each face's UDIM tile
  std::vector<std::string> warnings;              ///< each once, with the heads it is about

  bool any() const;
  /// Whether two heads have different ones.
  bool differ() const;
};

/// Takes files away: those heads have no texture there.
void leave_out(HeadsTextures& textures, const std::set<std::filesystem::path>& files);
/// What is no image that we read. \return what to say of it.
std::vector<std::string> leave_out_unreadable(HeadsTextures& textures);

/// Reads material files, and asks which textures are there; reads none of these. What is wrong with
/// material files is told with the colours.
/// \param faces  the topology and coordinates that all heads share. \param files  #heads.
/// \return the colours, then the other kinds that any head has.
std::vector<HeadsTextures> find_worn_textures(const FaceSet& faces, std::span<const ObjFile> files);

}  // namespace crowdface
