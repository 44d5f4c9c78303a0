// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <compare>
#include <cstdint>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "crowdface/io/obj_writer.h"
#include "head_models/synth/synthetic_head.h"

#include "cli/head_files.h"

namespace crowdface::cli {

/// Hair in cards for synthetic heads, as attachments: in each cut that somebody may wear, in the colour that they have.
class SynthHair {
 public:
  /// Notes what a head may wear. \return its tags: "light_skin, brown_hair, straight_hair"; "bald" in place of the last where the crown is.
  std::string add_head(std::uint64_t seed, std::uint64_t index);

  /// The folder `attachments` beside the heads: meshes, materials, textures, the average head on which they sit,
  /// and attachments.yaml with the config's section.
  void add_files(const std::filesystem::path& directory, const SyntheticHeads& heads,
                 const std::vector<MaterialRange>& materials, std::vector<HeadFile>& files) const;

 private:
  struct Wish {
    bool female, curly, bald;
    std::string colour;
    auto operator<=>(const Wish&) const = default;  // NOLINT(modernize-use-nullptr)
  };
  std::set<Wish> wishes_;
};

}  // namespace crowdface::cli
