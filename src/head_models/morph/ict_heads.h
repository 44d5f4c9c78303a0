// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "crowdface/io/obj_file.h"
#include "head_models/morph/head_model.h"

namespace crowdface {

/// Heads of the ICT face model (light): the neutral mesh plus its identity modes, each weighted by a
/// normally distributed number, cut at two standard deviations. All parts are kept: face, head,
/// mouth, gums, teeth, eyes, lashes.
class IctHeads : public HeadModel {
 public:
  /// \param checkout  of ICT-FaceKit: FaceXModel/generic_neutral_mesh.obj and
  ///                  FaceXModel/identity000.obj, identity001.obj, … as many as there are.
  /// \throws MissingInput; InvalidInput if a file is unusable or of another topology.
  explicit IctHeads(const std::filesystem::path& checkout);

  const Mesh& neutral() const override { return neutral_; }
  const std::vector<MaterialRange>& materials() const override { return file_.materials; }
  Positions positions(std::uint64_t seed, std::uint64_t index) const override;
  /// Nothing: the modes have no sex and no age.
  std::optional<HeadPerson> person(std::uint64_t seed, std::uint64_t index) const override;

  /// The neutral mesh's file, whose groups and materials heads keep.
  const ObjFile& file() const { return file_; }
  std::size_t mode_count() const { return modes_.size(); }
  /// \throws InvalidInput if there are no eyeballs or teeth.
  FaceHeights heights() const;

 private:
  ObjFile file_;
  Mesh neutral_;
  std::vector<Positions> modes_;  ///< displacements
};

}  // namespace crowdface
