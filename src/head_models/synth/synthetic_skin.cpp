// SPDX-License-Identifier: Apache-2.0
#include "head_models/synth/synthetic_skin.h"

#include <algorithm>

#include "crowdface/core/parallel.h"
#include "crowdface/core/require.h"
#include "head_models/synth/bust.h"
#include "head_models/synth/skin_paint.h"
#include "head_models/synth/skin_surface.h"

namespace crowdface {
namespace {

/// Opacity of painted hair below hair cards: only roots show. A higher opacity would be visible on
/// bald crowns of faces that are blended from heads with hair.
constexpr double kRoots = 0.3;

/// Paints `size` texels.
/// \param colour_at  returns the colour of a texel
template <class ColourAt>
std::vector<std::uint8_t> painted(std::size_t size, const ColourAt& colour_at) {
  std::vector<std::uint8_t> bytes(3 * size);
  parallel_for_each(size, synth::kTexelsPerBlock, [&](std::size_t i) {
    const synth::ScreenColour colour = colour_at(i);
    for (Eigen::Index c = 0; c < 3; ++c) {
      bytes[3 * i + static_cast<std::size_t>(c)] = synth::to_byte(colour[c]);
    }
  });
  return bytes;
}

}  // namespace

SyntheticSkins::SyntheticSkins(int size, SyntheticHeads::Scalp scalp)
    : size_(size), scalp_hair_(scalp == SyntheticHeads::Scalp::kShorn ? kRoots : 1) {
  require(size >= 64 && size <= 8192, "textures of ", size, " texels");
  atlas_ = synth::skin_atlas(size);
  texel_cm_ = synth::texel_cm(size, atlas_);
}

std::vector<std::uint8_t> SyntheticSkins::albedo(std::uint64_t seed, std::uint64_t index) const {
  const synth::SkinPaint paint(seed, index, scalp_hair_);
  return painted(atlas_.size(), [&](std::size_t i) { return paint.at(atlas_[i]); });
}

std::vector<std::uint8_t> SyntheticSkins::body_albedo(std::uint64_t seed,
                                                      std::uint64_t index) const {
  const synth::SkinPaint paint(seed, index, scalp_hair_);
  const auto side = static_cast<std::size_t>(size_);
  return painted(atlas_.size(), [&](std::size_t i) {
    const double u = (static_cast<double>(i % side) + 0.5) / size_;
    const double v = 1 - (static_cast<double>(i / side) + 0.5) / size_;
    synth::SkinPlace place;
    place.skin.position = synth::bust_point({u, v});
    return paint.at(place);
  });
}

std::vector<std::uint8_t> SyntheticSkins::normals(std::uint64_t seed, std::uint64_t index,
                                                  double edge_cm) const {
  const synth::Identity identity(seed, index);
  // A texture represents wavelengths from two texels, a mesh from four edges.
  const double finest = texel_cm_ / 2;
  return synth::skin_normals(size_, atlas_, synth::Relief(identity, finest),
                             synth::Relief(identity, std::max(finest, edge_cm)));
}

std::vector<std::uint8_t> SyntheticSkins::roughness(std::uint64_t seed, std::uint64_t index) const {
  const synth::SkinPaint paint(seed, index, scalp_hair_);
  std::vector<std::uint8_t> bytes(atlas_.size());
  parallel_for_each(bytes.size(), synth::kTexelsPerBlock, [&](std::size_t i) {
    bytes[i] = synth::to_byte(paint.roughness_at(atlas_[i]));
  });
  return bytes;
}

}  // namespace crowdface
