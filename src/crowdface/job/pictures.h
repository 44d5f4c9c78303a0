// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "crowdface/job/casting.h"
#include "crowdface/job/crowd_renders.h"
#include "crowdface/job/face_builder.h"
#include "crowdface/job/gallery.h"
#include "crowdface/job/likeness_file.h"
#include "crowdface/job/sheets.h"

namespace crowdface {

/// Everything of a crowd that is for looking at: renders, contact sheets, the gallery.
class CrowdPictures {
 public:
  /// \param job  must outlive this object; \param sheet  how its sheets are to be.
  CrowdPictures(const Job& job, const Config::ContactSheet& sheet, const CrowdDirectory& directory);

  const CrowdRenders& renders() const { return renders_; }

  /// Pictures of the heads, and of the founders of families, whom no file of the crowd holds.
  void write_heads() const;
  void write_founders(const std::vector<FamilyFounder>& founders, const FaceBuilder& builder) const;
  /// Each face again from its mesh.
  void write_faces(const std::vector<CastFace>& crowd) const;

  /// Sheets and gallery, from the pictures in the folder.
  /// \return how many pages of contact sheets.
  std::size_t finish(const std::vector<CastFace>& crowd, const CrowdLikeness& likeness) const;

 private:
  const Job& job_;
  const Config::ContactSheet& sheet_;
  const CrowdDirectory& directory_;
  CrowdRenders renders_;
  std::optional<std::filesystem::path> page_;  ///< of the gallery, if there is to be one
  std::unique_ptr<GalleryMeshes> gallery_;
};

/// All files in the folder that `finish` and what goes before it wrote, sorted; not the faces' own
/// pictures and meshes.
std::vector<std::filesystem::path> picture_files(const CrowdDirectory& directory);

/// What sheets and gallery need of a crowd that was just cast; distances have four decimals.
CrowdLikeness crowd_likeness(const Cast& cast);

}  // namespace crowdface
