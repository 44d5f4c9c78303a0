// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "crowdface/io/texture_kind.h"

namespace crowdface {

/// All material files of a mesh, merged into one file. Textures in the merged file can be replaced.
class MergedMaterials {
 public:
  /// \param mesh, libraries  as in `find_material_files`; material files that cannot be read are
  ///                         skipped.
  /// \param shared  path from the folder of the merged file to the folder of the textures that are
  ///                not replaced, such as ".."; empty if both are the same folder.
  MergedMaterials(const std::filesystem::path& mesh, const std::vector<std::string>& libraries,
                  const std::string& shared = {});

  /// Replacement files by kind of texture and name of material; paths may contain <UDIM>. The empty
  /// name stands for the mesh's only material.
  using Replacements = std::map<TextureKind, std::map<std::string, std::string>>;

  /// The text of a material file to be written beside the mesh. If a material has a replacement for
  /// its colour map, every `map_Kd` of the material names the replacement; a material without
  /// `map_Kd` gets a `map_Kd` and a white `Kd`. For other kinds of textures, the replacement takes
  /// the place of the file name in the material's statement, and the statement's options stay. A
  /// material without such a statement gets a new statement. All other lines stay.
  std::string text(const Replacements& textures) const;

 private:
  /// A line of the merged file.
  struct Line {
    std::string text;       ///< the whole line
    std::string keyword;    ///< first word of the line; empty: the line is not a statement
    std::string arguments;  ///< the text after the first word
    std::string material;   ///< name of the material to which the line belongs
  };
  std::vector<Line> lines_;  ///< the lines of the merged file, in order
};

}  // namespace crowdface
