// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "crowdface/config/config.h"
#include "crowdface/crowd/crowd_directory.h"
#include "crowdface/crowd/likeness_file.h"
#include "crowdface/heads/inputs.h"
#include "crowdface/preview/packed_face.h"

namespace crowdface {

/// Where pages lie once they are built or installed: share/crowdface/gallery beside the program's bin;
/// the environment's CROWDFACE_GALLERY, if set, instead. Nothing if that cannot be told.
std::optional<std::filesystem::path> gallery_page_folder();

/// The same folder if it holds the gallery's page, or nothing.
std::optional<std::filesystem::path> find_gallery_page();

/// Whether a crowd of this config gets a gallery here.
bool has_gallery(const Config& config);

/// The hash of the page that a crowd of this config gets; of nothing, if it gets none.
Digest gallery_page_digest(const Config& config);

/// The meshes of a gallery: reduced, and packed into scripts, because a page opened from disk may
/// load nothing else. What all faces share is prepared once.
class GalleryMeshes {
 public:
  /// \param inputs  must outlive this object.
  GalleryMeshes(const Config& config, const Inputs& inputs);

  /// data/mesh.js: triangles, colours, the frame of the positions.
  std::string shared_script() const;
  /// data/faces/NAME.js or data/heads/NAME.js.
  std::string face_script(const std::string& name, const Positions& positions) const;

  const std::vector<Head>& heads() const { return inputs_.faces.heads; }

 private:
  const Config& config_;
  const Inputs& inputs_;
  ReducedMesh mesh_;
  FacesAround around_;
  PackingFrame frame_;
  Eigen::Vector3d low_, high_;  ///< of the heads' boxes
};

/// Everything of the gallery but its faces' scripts: the page, the crowd's recipes, the heads.
void write_gallery(const CrowdDirectory& directory, const Config& config,
                   const std::filesystem::path& page, const GalleryMeshes& meshes,
                   const std::vector<CastFace>& crowd, const Digest& settings,
                   const CrowdLikeness& likeness);

}  // namespace crowdface
