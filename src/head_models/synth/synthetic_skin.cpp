// SPDX-License-Identifier: Apache-2.0
#include "head_models/synth/synthetic_skin.h"

#include <algorithm>
#include <array>

#include "crowdface/core/require.h"
#include "head_models/synth/bust.h"
#include "head_models/synth/skin_paint.h"
#include "head_models/synth/skin_surface.h"

namespace crowdface {
namespace {

/// Opacity of painted hair roots below hair cards. A face with a bald crown may have a texture that
/// is blended from heads with hair; more opaque roots would be visible on this crown.
constexpr double kRootOpacity = 0.3;

/// Writes a colour as three bytes.
void write_texel(const synth::ScreenColour& colour, std::uint8_t* bytes) {
  for (Eigen::Index c = 0; c < 3; ++c) bytes[c] = synth::to_byte(colour[c]);
}

/// Returns the bytes of a texture. `paint` fills the bytes of each texel that shows a surface. Each
/// other texel gets the bytes of a nearby texel that shows a surface (SkinAtlas::source_texel).
template <class Paint>
std::vector<std::uint8_t> painted(const synth::SkinAtlas& atlas, std::size_t channels,
                                  const Paint& paint) {
  std::vector<std::uint8_t> bytes(channels * atlas.size());
  synth::for_each_texel(atlas.side(), [&](std::size_t i) {
    if (atlas.is_covered(i)) paint(atlas[i], &bytes[channels * i]);
  });
  for (std::size_t i = 0; i < atlas.size(); ++i) {
    if (atlas.is_covered(i)) continue;
    std::copy_n(&bytes[channels * atlas.source_texel(i)], channels, &bytes[channels * i]);
  }
  return bytes;
}

int checked_size(int size) {
  require(size >= 64 && size <= 8192, "textures of ", size, " texels");
  return size;
}

}  // namespace

SyntheticSkins::SyntheticSkins(int size, SyntheticHeads::Scalp scalp)
    : atlas_(checked_size(size)),
      scalp_hair_(scalp == SyntheticHeads::Scalp::kShorn ? kRootOpacity : 1),
      texel_cm_(synth::texel_cm(atlas_)) {}

std::vector<std::uint8_t> SyntheticSkins::albedo(std::uint64_t seed, std::uint64_t index) const {
  const synth::SkinPaint paint(seed, index, scalp_hair_);
  return painted(atlas_, 3, [&](const synth::AtlasTexel& place, std::uint8_t* bytes) {
    write_texel(paint.at(place), bytes);
  });
}

std::vector<std::uint8_t> SyntheticSkins::body_albedo(std::uint64_t seed) const {
  constexpr std::array<std::uint64_t, 5> kFirstHeads = {1, 2, 3, 4, 5};  // one of them is young
  const std::uint64_t youngest = *std::ranges::min_element(
      kFirstHeads, {}, [&](std::uint64_t i) { return synth::random_person(seed, i).age_years; });
  const synth::SkinPaint paint(seed, youngest, scalp_hair_);
  const auto side = static_cast<std::size_t>(body_size());
  std::vector<std::uint8_t> bytes(3 * side * side);
  synth::for_each_texel(side, [&](std::size_t i) {
    const std::size_t row = i / side, column = i % side;
    const double u = (static_cast<double>(column) + 0.5) / static_cast<double>(side);
    const double v = 1 - (static_cast<double>(row) + 0.5) / static_cast<double>(side);
    synth::AtlasTexel place;
    place.skin.position = synth::bust_point({u, v});
    write_texel(paint.at(place), &bytes[3 * i]);
  });
  return bytes;
}

std::vector<std::uint8_t> SyntheticSkins::normals(std::uint64_t seed, std::uint64_t index,
                                                  double edge_cm) const {
  const synth::Identity identity(seed, index);
  // Relief takes the edge length of a mesh. A mesh can represent wavelengths of at least four
  // edges. A texture can represent wavelengths of at least two texels, the same as a mesh whose
  // edges are half a texel long.
  const double finest_edge = texel_cm_ / 2;
  return synth::skin_normals(atlas_, texel_cm_,
                             synth::Relief(identity, finest_edge, std::max(finest_edge, edge_cm)));
}

std::vector<std::uint8_t> SyntheticSkins::roughness(std::uint64_t seed, std::uint64_t index) const {
  const synth::SkinPaint paint(seed, index, scalp_hair_);
  return painted(atlas_, 1, [&](const synth::AtlasTexel& place, std::uint8_t* bytes) {
    *bytes = synth::to_byte(paint.roughness_at(place));
  });
}

}  // namespace crowdface
