// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "head_models/morph/makehuman_heads.h"
#include "head_models/morph/makehuman_wardrobe.h"

#include "cli/head_files.h"

namespace crowdface::cli {

/// What `import makehuman --dress` writes beside the heads. Pictures are made when they are written.
class MakeHumanDress {
 public:
  /// Makes the model's heads wear eyes, lashes, teeth and tongue.
  /// \param most_texels  longer pictures are made smaller.
  MakeHumanDress(const std::filesystem::path& package, MakeHumanHeads& model, int most_texels);

  /// A person's material file `NAME.mtl`, skin `NAME_skin.png`, and eyes.
  void add_person(const std::filesystem::path& folder, const std::string& name, std::uint64_t seed,
                  std::uint64_t index, std::vector<HeadFile>& files);
  /// What all heads share: pictures of lashes, teeth and tongue; hair, brows and beards in
  /// `attachments`, as far as a person added before may wear them, with the section that names them for a
  /// config; `licences.txt`.
  /// \param base  the average head, in the heads' topology.
  void add_common(const std::filesystem::path& folder, HeadFile base, std::vector<HeadFile>& files);

 private:
  void add_attachment(const std::filesystem::path& folder, const MakeHumanAttachment& item,
                      const FittedMesh& mesh, std::vector<HeadFile>& files) const;

  std::filesystem::path package_;
  const MakeHumanHeads& model_;
  MakeHumanParts parts_;
  int most_texels_;
  std::set<std::set<std::string>> tags_;               ///< of people
  std::map<std::string, std::filesystem::path> eyes_;  ///< pictures in use, by colour
};

}  // namespace crowdface::cli
