// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "crowdface/io/texture_kind.h"

namespace crowdface {

/// The material files of a mesh as one, in which textures can be replaced.
class OwnMaterials {
 public:
  /// \param mesh, libraries  as find_material_files takes them; what cannot be read is left out.
  /// \param shared  the way from the new file to the textures that stay: ".."; empty: beside it.
  OwnMaterials(const std::filesystem::path& mesh, const std::vector<std::string>& libraries,
               const std::string& shared = {});

  /// The files that take the place of others, by kind and by material; they may hold <UDIM>.
  using Replacements = std::map<TextureKind, std::map<std::string, std::string>>;

  /// The text for a file beside the mesh. What a material names as its `map_Kd`, wherever it names it, is
  /// replaced; one that has none gets one, and white for its `Kd`. A texture of another kind is replaced where
  /// it is named as that, its options kept, or added. All else stays.
  std::string text(const Replacements& textures) const;

 private:
  struct Line {
    std::string text;      ///< as it stands there
    std::string word;      ///< the statement; empty: none
    std::string rest;      ///< what stands behind it
    std::string material;  ///< that it is about
  };
  std::vector<Line> lines_;
};

}  // namespace crowdface
