// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "crowdface/io/obj_file.h"
#include "head_models/morph/head_model.h"

namespace crowdface {

/// Heads of the light version of the ICT face model: the neutral mesh plus its identity modes. The
/// weight of each mode is normally distributed and clamped to two standard deviations. Heads
/// contain all parts of the model: face, head, mouth, gums, teeth, eyes, lashes.
class IctHeads : public HeadModel {
 public:
  /// \param checkout  folder of ICT-FaceKit with FaceXModel/generic_neutral_mesh.obj and any number
  ///                  of modes FaceXModel/identity000.obj, identity001.obj, …
  /// \throws MissingInput; InvalidInput if a file is invalid or has another topology.
  explicit IctHeads(const std::filesystem::path& checkout);

  const Mesh& neutral() const override { return neutral_; }
  const std::vector<MaterialRange>& materials() const override { return file_.materials; }
  Positions positions(std::uint64_t seed, std::uint64_t index) const override;
  /// Returns nothing, because the model does not define sex and age.
  std::optional<HeadPerson> person(std::uint64_t seed, std::uint64_t index) const override;

  /// Returns the file of the neutral mesh. All heads have its groups and materials.
  const ObjFile& file() const { return file_; }
  /// Returns the number of identity modes in the folder.
  std::size_t mode_count() const { return modes_.size(); }
  /// Returns the heights of eyes and mouth. \throws InvalidInput if the neutral mesh has no
  /// eyeballs or no teeth.
  FeatureHeights heights() const;

 private:
  ObjFile file_;                  ///< file of the neutral mesh
  Mesh neutral_;                  ///< see neutral()
  std::vector<Positions> modes_;  ///< displacements from the neutral mesh, each #V by 3
};

}  // namespace crowdface
