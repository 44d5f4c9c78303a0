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

/// Everything of a crowd that is for looking at: renders, contact sheets, the gallery.
class CrowdPictures {
 public:
  /// \param config, inputs, directory  must outlive this object; the config has contact sheets.
  /// \param settings  see settings_digest; the gallery shows it.
  /// \param textures  of faces' own, if they have any; likewise.
  /// \param shapes    of faces; likewise.
  CrowdPictures(const Config& config, const Inputs& inputs, const Digest& settings,
                const CrowdDirectory& directory, const FaceTextures& textures,
                const FaceShapes& shapes);

  const CrowdRenders& renders() const { return renders_; }

  /// The pictures of the heads, once however often it is called.
  void write_heads();
  /// The picture of a family's founder, whom no mesh file of the crowd holds.
  void write_founder(const std::string& family, const Positions& positions,
                     const Recipe& recipe) const;

  /// Sheets and gallery, from the pictures in the folder.
  WrittenSheets finish(const std::vector<CastFace>& crowd, const CrowdLikeness& likeness) const;

 private:
  /// Everything of the gallery but its faces' scripts: the page, the crowd's recipes, the heads.
  void write_gallery(const std::vector<CastFace>& crowd, const CrowdLikeness& likeness) const;
  /// What the gallery knows of a crowd's recipes, as scripts: data/crowd.js, and of a crowd in numbered
  /// subfolders there only what filters and orders need of each face; the recipes lie in data/pages,
  /// as many faces a script as a subfolder, which the page loads as it shows them.
  void write_scripts(const std::vector<CastFace>& crowd, const CrowdLikeness& likeness) const;

  const Config& config_;
  const Inputs& inputs_;
  Digest settings_;
  const CrowdDirectory& directory_;
  const FaceTextures& textures_;
  const FaceShapes& shapes_;
  CrowdRenders renders_;
  std::optional<std::filesystem::path> page_;  ///< of the gallery, if there is to be one
  std::unique_ptr<GalleryMeshes> gallery_;
  bool heads_are_written_ = false;
};

/// All files in the folder that `finish` and what goes before it wrote, sorted; not the faces' own
/// pictures and meshes. \throws IoError if a folder cannot be read.
std::vector<std::filesystem::path> picture_files(const CrowdDirectory& directory,
                                                 const WrittenSheets& sheets);

}  // namespace crowdface
