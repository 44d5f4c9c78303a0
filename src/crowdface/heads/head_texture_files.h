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
struct HeadTextureFiles {
  /// A texture file.
  struct File {
    std::filesystem::path path;  ///< path of the existing texture file
    std::filesystem::path name;  ///< path as written in the material file; may contain <UDIM>
  };
  /// all files without duplicates, in the order in which polygons first use them
  std::vector<File> files;
  /// for each polygon, an index into `files`, or kNoIndex; empty if no head has files of this kind
  std::vector<std::uint32_t> file_of_polygon;
};

/// All heads' textures of one kind, and warnings about missing files.
struct FoundTextureFiles {
  TextureKind kind = TextureKind::kColour;
  std::vector<HeadTextureFiles> heads;  ///< the texture files of each head
  /// for each polygon: column and row of its UDIM tile
  std::vector<std::array<std::int32_t, 2>> tile_of_polygon;
  /// warnings without duplicates; each warning names the heads that it concerns
  std::vector<std::string> warnings;

  /// Whether at least one head has a texture of this kind.
  bool has_files() const;
  /// Returns false if all heads that have textures use the same files.
  bool heads_have_different_textures() const;
};

/// Removes files from the lists of `textures`, so that the polygons with these files have no
/// texture. No file is deleted.
void leave_out_files(FoundTextureFiles& textures, const std::set<std::filesystem::path>& files);
/// Calls leave_out_files for the files that are not readable images.
/// \return one warning per file.
std::vector<std::string> leave_out_unreadable_files(FoundTextureFiles& textures);

/// Reads material files and checks which textures exist, without reading the textures. The result's
/// item for colour textures also has the warnings about material files.
/// \param heads  topology and texture coordinates that all heads share
/// \param files  the file of each head
/// \return one item per kind of texture: always the colours, then each kind that any head has.
std::vector<FoundTextureFiles> find_texture_files(const HeadSet& heads,
                                                  std::span<const ObjFile> files);

}  // namespace crowdface
