// SPDX-License-Identifier: Apache-2.0
#include "crowdface/synth/synthetic_skin.h"

#include <algorithm>
#include <cmath>

#include "crowdface/core/parallel.h"
#include "crowdface/core/require.h"
#include "crowdface/synth/skin_atlas.h"
#include "crowdface/synth/skin_paint.h"
#include "crowdface/synth/skin_surface.h"

namespace crowdface {
namespace {

/// Under hair in cards only its roots are in the skin. More of them would be seen on the bald crowns of faces
/// that are mixed from haired heads.
constexpr double kRoots = 0.3;

}  // namespace

struct SyntheticSkins::State {
  int size;
  double scalp_hair;
  std::vector<synth::SkinPlace> atlas;
  double texel_cm = 0;
};

SyntheticSkins::SyntheticSkins(int size, SyntheticHeads::Scalp scalp) {
  require(size >= 64 && size <= 8192, "textures of ", size, " texels");
  state_ = std::make_unique<State>(
      State{size, scalp == SyntheticHeads::Scalp::kShorn ? kRoots : 1.0, synth::skin_atlas(size)});
  state_->texel_cm = synth::texel_cm(size, state_->atlas);
}
SyntheticSkins::~SyntheticSkins() = default;
SyntheticSkins::SyntheticSkins(SyntheticSkins&&) noexcept = default;
SyntheticSkins& SyntheticSkins::operator=(SyntheticSkins&&) noexcept = default;

int SyntheticSkins::size() const {
  return state_->size;
}

std::vector<std::uint8_t> SyntheticSkins::albedo(std::uint64_t seed, std::uint64_t index) const {
  const synth::SkinPaint paint(seed, index, state_->scalp_hair);
  std::vector<std::uint8_t> bytes(3 * state_->atlas.size());
  parallel_for_each(state_->atlas.size(), synth::kTexelsPerBlock, [&](std::size_t i) {
    const synth::ScreenColour colour = paint.at(state_->atlas[i]);
    for (Eigen::Index c = 0; c < 3; ++c) {
      bytes[3 * i + static_cast<std::size_t>(c)] = synth::to_byte(colour[c]);
    }
  });
  return bytes;
}

std::vector<std::uint8_t> SyntheticSkins::normals(std::uint64_t seed, std::uint64_t index,
                                                  double edge_cm) const {
  const synth::Identity identity(seed, index);
  // A texture holds waves of two texels, a mesh those of four edges and more.
  const double finest = state_->texel_cm / 2;
  return synth::skin_normals(state_->size, state_->atlas, synth::Relief(identity, finest),
                             synth::Relief(identity, std::max(finest, edge_cm)));
}

std::vector<std::uint8_t> SyntheticSkins::roughness(std::uint64_t seed, std::uint64_t index) const {
  const synth::SkinPaint paint(seed, index, state_->scalp_hair);
  std::vector<std::uint8_t> bytes(state_->atlas.size());
  parallel_for_each(bytes.size(), synth::kTexelsPerBlock, [&](std::size_t i) {
    bytes[i] = synth::to_byte(paint.roughness_at(state_->atlas[i]));
  });
  return bytes;
}

}  // namespace crowdface
