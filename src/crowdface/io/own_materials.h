// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "crowdface/io/texture_kind.h"

namespace crowdface {

/// The material files of a mesh merged into one, in which textures can be replaced.
class MergedMaterials {
 public:
  /// \param mesh, libraries  as in `find_material_files`; unreadable files are skipped.
  /// \param shared  path from the new file to the textures that are not replaced, such as "..";
  ///                empty: the same folder.
  MergedMaterials(const std::filesystem::path& mesh, const std::vector<std::string>& libraries,
                  const std::string& shared = {});

  /// Replacement files by kind and by material; paths may contain <UDIM>. The empty name means the
  /// only material.
  using Replacements = std::map<TextureKind, std::map<std::string, std::string>>;

  /// The text of a material file to be written beside the mesh. Every `map_Kd` of a material with a
  /// replacement is replaced; a material without `map_Kd` gets one and a white `Kd`. A texture of
  /// another kind is replaced where the material names the texture, with the same options, or else
  /// added. All other lines stay.
  std::string text(const Replacements& textures) const;

 private:
  struct Line {
    std::string text;      ///< the whole line
    std::string word;      ///< the first word; empty: no statement
    std::string rest;      ///< the line after the first word
    std::string material;  ///< material that the line belongs to
  };
  std::vector<Line> lines_;
};

}  // namespace crowdface
