// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "crowdface/heads/face_textures.h"
#include "crowdface/pictures/crowd_renders.h"
#include "crowdface/run/job.h"

namespace crowdface {

/// Rendered images for the editor's page. Loads the resources for rendering at the first request.
/// Thread-safe.
class EditPictures {
 public:
  /// \param job  must outlive this object.
  explicit EditPictures(const Job& job) : job_(job) {}

  /// A PNG file that shows a head from the front.
  std::string thumbnail(Index head);
  /// Returns the object that blends the faces' textures. The first call creates the object.
  const FaceTextures& textures();
  /// The textures of a face, with the resolution and content that contact sheets show; nothing if
  /// faces have no textures.
  std::optional<TextureSet> textures_of(const Recipe& recipe);

 private:
  const Job& job_;
  std::mutex mutex_;
  /// renders thumbnails; null until the first thumbnail is requested
  std::unique_ptr<CrowdRenders> thumbnail_renders_;
  /// maps the index of a head to the PNG file of its thumbnail
  std::map<Index, std::string> thumbnails_;
  std::unique_ptr<FaceTextures> textures_;  ///< see textures(); null until the first call
};

}  // namespace crowdface
