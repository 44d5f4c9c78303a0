// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <compare>
#include <cstdint>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "crowdface/io/obj_writer.h"
#include "head_models/synth/hair_cut.h"
#include "head_models/synth/synthetic_head.h"

#include "cli/head_files.h"

namespace crowdface::cli {

/// Attachments for synthetic heads: brows, beards, and hair cards for every haircut that a
/// registered head may wear. All heads share each attachment, which has a neutral texture.
class SynthHair {
 public:
  /// Registers a head.
  /// \return  the head's tags for skin, hair colour and hair form, such as "light_skin, brown_hair,
  /// straight_hair". The second tag is the hair colour in the person's youth. The third tag is
  /// "bald" if the crown of the head is bald.
  std::string add_head(std::uint64_t seed, std::uint64_t index);

  /// Adds the files of the folder `attachments`, which is inside the folder of the heads: meshes,
  /// materials, textures, the average head to which the meshes are fitted, and attachments.yaml
  /// with the config section `attachments`.
  void add_files(const std::filesystem::path& directory, const SyntheticHeads& heads,
                 const std::vector<MaterialRange>& materials, std::vector<HeadFile>& files) const;

 private:
  /// The properties of a head that decide which haircuts the head may wear.
  struct HairStyle {
    bool female, curly, bald;
    auto operator<=>(const HairStyle&) const = default;  // NOLINT(modernize-use-nullptr)
  };
  /// Returns whether a registered head may wear the haircut.
  bool is_used(const synth::HairCut& cut) const;
  std::set<HairStyle> used_hair_styles_;  ///< the hair styles of the registered heads
};

}  // namespace crowdface::cli
