// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "crowdface/heads/face_textures.h"
#include "crowdface/pictures/crowd_renders.h"
#include "crowdface/run/pipeline.h"

namespace crowdface {

/// Pictures for the editor's page. What they need is made when it is first asked for. Any thread may ask.
class EditPictures {
 public:
  /// \param job  must outlive this object.
  explicit EditPictures(const Job& job) : job_(job) {}

  /// The head from the front, as a PNG file.
  std::string thumbnail(Index head);
  /// A face as contact sheets show it, as a PNG file. \param size  pixels a side.
  std::string picture(const Recipe& recipe, const Positions& positions, View view, int size);
  const FaceTextures& textures();

 private:
  const Job& job_;
  std::mutex mutex_;
  std::unique_ptr<CrowdRenders> small_;
  std::map<Index, std::string> thumbnails_;
  std::unique_ptr<FaceTextures> textures_;
};

}  // namespace crowdface
