// SPDX-License-Identifier: Apache-2.0
#include "crowdface/editor/edit_pictures.h"

#include "crowdface/io/image.h"
#include "crowdface/render/shading.h"

namespace crowdface {
namespace {

constexpr int kThumbnail = 192, kMostTexels = 2048;

Config::ContactSheet one_picture(View view, int size) {
  Config::ContactSheet sheet;
  sheet.cell = size;
  sheet.views = {view};
  return sheet;
}

}  // namespace

bool has_one_texture(const HeadTextures& textures, Index head) {
  const auto h = static_cast<std::size_t>(head);
  if (!textures.coats.empty()) return textures.coats[h].textures.size() == 1;
  return textures.blended.layout.pictures.size() == 1 && textures.blended.maps[0][h] != nullptr;
}

std::string EditPictures::thumbnail(Index head) {
  const std::lock_guard lock(mutex_);
  std::string& png = thumbnails_[head];
  if (!png.empty()) return png;
  if (!small_) {
    small_ = std::make_unique<CrowdRenders>(job_.config, one_picture(View::kFront, kThumbnail),
                                            job_.inputs);
  }
  png = small_->render_png(job_.inputs.faces.heads[static_cast<std::size_t>(head)].positions, head);
  return png;
}

std::optional<std::string> EditPictures::texture(Index head) const {
  if (!has_one_texture(job_.inputs.textures, head)) return std::nullopt;
  const auto coat = coat_of_head(job_.inputs.textures, head, kMostTexels);
  const Texture& texture = *coat->textures.front();
  std::vector<std::uint8_t> pixels;
  pixels.reserve(3 * texture.texels.size());
  for (const Light& texel : texture.texels) {
    for (const std::uint8_t value : to_srgb8(texel)) pixels.push_back(value);
  }
  return encode_jpeg(texture.width, texture.height, pixels);
}

const TextureBlender* EditPictures::textures() {
  const std::lock_guard lock(mutex_);
  if (!textures_) textures_ = std::make_unique<FaceTextures>(job_.config, job_.inputs);
  return textures_->blender();
}

std::string EditPictures::picture(const Recipe& recipe, const Positions& positions, View view,
                                  int size) {
  const CrowdRenders renders(job_.config, one_picture(view, size), job_.inputs);
  const TextureBlender* own = textures();
  return own != nullptr ? renders.render_png(positions, own->blend(recipe))
                        : renders.render_png(positions, recipe.target);
}

}  // namespace crowdface
