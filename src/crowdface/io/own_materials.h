// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace crowdface {

/// The material files of a mesh as one, in which colour textures can be replaced.
class OwnMaterials {
 public:
  /// \param mesh, libraries  as find_material_files takes them; what cannot be read is left out.
  /// \param shared  the way from the new file to the textures that stay: ".."; empty: beside it.
  OwnMaterials(const std::filesystem::path& mesh, const std::vector<std::string>& libraries,
               const std::string& shared = {});

  /// The text for a file beside the mesh. What a material names as its `map_Kd`, wherever it names it, is
  /// replaced; one that has none gets one, and white for its `Kd`. All else stays.
  /// \param colours  the textures of materials, by name; they may hold <UDIM>.
  std::string text(const std::map<std::string, std::string>& colours) const;

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
