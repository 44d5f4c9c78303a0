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

/// The texture files of one kind that a head's materials name.
struct AttachmentTextures {
  struct File {
    std::filesystem::path path;  ///< an existing file
    std::filesystem::path name;  ///< as in the material file; may contain <UDIM>
  };
  std::vector<File> files;  ///< without duplicates, in the order in which polygons first use them
  std::vector<std::uint32_t>
      of_face;  ///< #F, index into `files` or kNoIndex; empty if no head has any
};

/// All heads' textures of one kind, and warnings about missing files.
struct HeadsTextures {
  TextureKind kind = TextureKind::kColour;
  std::vector<AttachmentTextures> heads;  ///< #heads
  /// #F, column and row of each polygon's UDIM tile
  std::vector<std::array<std::int32_t, 2>> tile;
  std::vector<std::string> warnings;  ///< without duplicates, each with the heads concerned

  bool any() const;
  /// Whether two heads have different textures.
  bool differ() const;
};

/// Removes these files; polygons that use them then have no texture.
void leave_out(HeadsTextures& textures, const std::set<std::filesystem::path>& files);
/// Removes files that are not readable images. \return a warning for each.
std::vector<std::string> leave_out_unreadable(HeadsTextures& textures);

/// Reads material files and checks which textures exist, without reading the textures. Problems in
/// material files are listed with the colour textures.
/// \param faces  topology and texture coordinates that all heads share
/// \param files  #heads
/// \return the colour textures, then each other kind that any head has.
std::vector<HeadsTextures> find_attachment_textures(const HeadSet& faces,
                                                    std::span<const ObjFile> files);

}  // namespace crowdface
