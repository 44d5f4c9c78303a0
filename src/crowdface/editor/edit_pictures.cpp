// SPDX-License-Identifier: Apache-2.0
#include "crowdface/editor/edit_pictures.h"

#include "crowdface/core/parallel.h"

namespace crowdface {
namespace {

constexpr int kThumbnail = 192;

Config::ContactSheet one_picture(View view, int size) {
  Config::ContactSheet sheet;
  sheet.cell = size;
  sheet.views = {view};
  return sheet;
}

}  // namespace

std::string EditPictures::thumbnail(Index head) {
  const std::lock_guard lock(mutex_);
  std::string& png = thumbnails_[head];
  if (!png.empty()) return png;
  if (!thumbnail_renders_) {
    thumbnail_renders_ = std::make_unique<CrowdRenders>(
        job_.config, one_picture(View::kFront, kThumbnail), job_.inputs);
  }
  png = thumbnail_renders_->render_png(
      job_.inputs.head_set.heads[static_cast<std::size_t>(head)].positions, head);
  return png;
}

const FaceTextures& EditPictures::textures() {
  const std::lock_guard lock(mutex_);
  if (!textures_) textures_ = std::make_unique<FaceTextures>(job_.config, job_.inputs);
  return *textures_;
}

std::optional<TextureSet> EditPictures::textures_of(const Recipe& recipe) {
  constexpr int kMaxTexels = 1024;
  const Inputs& inputs = job_.inputs;
  if (!inputs.textures.are_blended() && !are_any_rendered(inputs.other_textures)) {
    return texture_set_of_head(inputs.textures, recipe.target, kMaxTexels);
  }
  FaceTextureSet own(inputs.textures, inputs.other_textures, recipe.target, kMaxTexels);
  const FaceTextures& blended = textures();
  parallel_for_each(blended.picture_count(),
                    [&](std::size_t p) { own.add(p, blended.blend(recipe, p)); });
  return own.texture_set();
}

}  // namespace crowdface
