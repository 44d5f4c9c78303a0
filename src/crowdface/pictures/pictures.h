// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "crowdface/crowd/likeness_file.h"
#include "crowdface/heads/face_shapes.h"
#include "crowdface/heads/face_textures.h"
#include "crowdface/pictures/crowd_renders.h"
#include "crowdface/pictures/gallery.h"
#include "crowdface/pictures/sheets.h"

namespace crowdface {

/// Writes all images and pages of a crowd: renders, contact sheets, gallery.
class CrowdPictures {
 public:
  /// \param config, inputs, directory  must outlive this object; the config must have contact
  ///                sheets.
  /// \param settings  from settings_digest; the gallery shows it.
  /// \param textures  blended textures of the faces, if any; must outlive this object.
  /// \param shapes    shapes of the faces; must outlive this object.
  CrowdPictures(const Config& config, const Inputs& inputs, const Digest& settings,
                const CrowdDirectory& directory, const FaceTextures& textures,
                const FaceShapes& shapes);

  const CrowdRenders& renders() const { return renders_; }

  /// Sets the measurements that the gallery shows for the input heads.
  /// \param head_traits  for each head, the value of each named trait
  void set_head_traits(std::vector<std::vector<double>> head_traits) {
    head_traits_ = std::move(head_traits);
  }

  /// Renders the input heads. Further calls do nothing.
  void write_heads();
  /// Renders the founder of a family; the founder has no mesh file in the crowd's folder.
  void write_founder(const std::string& family, const Positions& positions,
                     const Recipe& recipe) const;

  /// Writes the contact sheets and the gallery from the renders in the crowd's folder.
  WrittenSheets write_sheets_and_gallery(const std::vector<FacePlan>& crowd,
                                         const CrowdLikeness& likeness) const;

 private:
  /// Writes the page, the recipes and the heads of the gallery, but not the scripts of faces.
  void write_gallery(const std::vector<FacePlan>& crowd, const CrowdLikeness& likeness) const;
  /// Writes the gallery's scripts with the recipes of the crowd. A crowd without numbered
  /// subfolders gets one script, data/crowd.js. With subfolders, data/crowd.js has only the columns
  /// for filtering and sorting; the recipes are in data/pages, one script per subfolder, which the
  /// page loads on demand.
  void write_scripts(const std::vector<FacePlan>& crowd, const CrowdLikeness& likeness) const;

  const Config& config_;
  const Inputs& inputs_;
  Digest settings_digest_;
  const CrowdDirectory& directory_;
  const FaceTextures& textures_;
  const FaceShapes& shapes_;
  CrowdRenders renders_;
  /// Folder of the gallery's page, if there is a gallery
  std::optional<std::filesystem::path> page_folder_;
  std::unique_ptr<GalleryMeshes> gallery_;
  bool heads_are_written_ = false;
  std::vector<std::vector<double>> head_traits_;  ///< see set_head_traits
};

/// Lists the files of contact sheets, gallery and likeness in the crowd's folder, sorted by path.
/// Does not list the renders and meshes of the faces. \throws IoError if a folder cannot be read.
std::vector<std::filesystem::path> picture_files(const CrowdDirectory& directory,
                                                 const WrittenSheets& sheets);

}  // namespace crowdface
