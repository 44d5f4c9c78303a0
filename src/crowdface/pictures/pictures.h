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
  /// \param config, inputs, directory  must outlive this object.
  /// \param sheet     how its sheets are to be; likewise.
  /// \param settings  see settings_digest; the gallery shows it.
  /// \param textures  of faces' own, if they have any; likewise.
  /// \param shapes    of faces; likewise.
  CrowdPictures(const Config& config, const Config::ContactSheet& sheet, const Inputs& inputs,
                const Digest& settings, const CrowdDirectory& directory,
                const FaceTextures& textures, const FaceShapes& shapes);

  const CrowdRenders& renders() const { return renders_; }

  /// The pictures of the heads, once however often it is called.
  void write_heads();
  /// The picture of a family's founder, whom no mesh file of the crowd holds.
  void write_founder(const std::string& family, const Positions& positions,
                     const Recipe& recipe) const;
  /// Each face again from its mesh.
  void write_faces(const std::vector<CastFace>& crowd, const FaceAttachments& attachments) const;

  /// Sheets and gallery, from the pictures in the folder.
  WrittenSheets finish(const std::vector<CastFace>& crowd, const CrowdLikeness& likeness) const;

 private:
  const Config& config_;
  const Config::ContactSheet& sheet_;
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
