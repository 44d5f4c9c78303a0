// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <span>

#include "crowdface/blend/crowd_blender.h"
#include "crowdface/config/config.h"
#include "crowdface/heads/prepare.h"
#include "crowdface/parts/follower.h"
#include "crowdface/parts/skin_contacts.h"
#include "crowdface/validity/skin_check.h"

namespace crowdface {

/// Builds the meshes of recipes with the levels the config asks for; several at once cost less than
/// one by one and have the same bytes.
class FaceBuilder {
 public:
  /// \param config, inputs, prepared  must outlive the builder.
  FaceBuilder(const Config& config, const Inputs& inputs, const Prepared& prepared);
  FaceBuilder(const FaceBuilder&) = delete;
  FaceBuilder& operator=(const FaceBuilder&) = delete;

  /// \param results  one for each recipe, #V by 3 in file units; their memory is used again.
  void build(std::span<const Recipe* const> recipes, std::span<Positions> results) const;
  Positions build(const Recipe& recipe) const;

  /// A face that the next one changes little of.
  struct Kept {
    std::optional<Recipe> recipe;
    Positions blended;
  };
  /// The same as `build` for one recipe, quicker where it differs from the last in few regions.
  /// \param kept  what the last call left there; empty at first.
  Positions rebuild(const Recipe& recipe, Kept& kept) const;

  /// Faces are blended with these masks from now on, in place of the inputs'. What `rebuild` kept is of no
  /// use afterwards.
  void use_masks(const Config& config, const RegionWeights& regions);

  /// The masks that faces are blended with: zero at vertices that parts put elsewhere.
  const RegionWeights& regions() const { return regions_; }

  /// What is wrong with the skin of a face that was built from a recipe, against that of its target.
  SkinDefects defects(const SkinCheck& check, const Recipe& recipe, const Positions& face) const;

  /// How much farther lips, or other skin that nearly touches, are apart in a face than in any head.
  double wider_mm(const Recipe& recipe, const Positions& face) const;

  /// Memory that building `faces` at once takes, their positions included.
  std::uint64_t bytes(std::size_t faces) const;

 private:
  /// What is done to a face once it is blended.
  void finish(const Recipe& recipe, Positions& face) const;
  /// By which faces are mirrored; found when the first is.
  const MirrorMap& mirror() const;
  /// Between the gap that a face's target has at each contact and that of its sources, by weight.
  std::vector<SkinContacts::Range> contact_ranges(const Recipe& recipe) const;
  void allow_other_side(std::vector<SkinContacts::Range>& ranges) const;

  const Config& config_;
  const Inputs& inputs_;
  const Prepared& prepared_;
  mutable std::once_flag mirror_once_;
  mutable std::shared_ptr<const MirrorMap> mirror_;
  /// The masks, without those vertices of parts that get other positions anyway.
  RegionWeights regions_;
  std::optional<CrowdBlender> blender_;             ///< of fitted levels
  std::optional<SkinContacts> contacts_;            ///< always there once the builder is made
  std::vector<std::vector<double>> contact_masks_;  ///< #places by #regions, rows summing to one
  bool keeps_contacts_;
  double mm_per_unit_;
  std::optional<PartFollower> follower_;  ///< if there are parts beside the skin
};

}  // namespace crowdface
