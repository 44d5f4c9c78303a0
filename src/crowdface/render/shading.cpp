// SPDX-License-Identifier: Apache-2.0
#include "crowdface/render/shading.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "crowdface/render/shading.cpp"
#include "hwy/foreach_target.h"
// Highway requires this order: foreach_target.h first, then the code that is compiled once for each
// instruction set.
#include <algorithm>
#include <numbers>

#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace crowdface::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Lanes = hn::CappedTag<float, ShadeBatch::kBlockSize>;
using Numbers = hn::VFromD<Lanes>;

HWY_INLINE Numbers number(float value) {
  return hn::Set(Lanes(), value);
}

HWY_INLINE Numbers square(Numbers x) {
  return hn::Mul(x, x);
}

struct Vectors {
  Numbers x, y, z;
};

HWY_INLINE Numbers dot(const Vectors& a, const Vectors& b) {
  return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}

HWY_INLINE Vectors direction_of(const Lamp& lamp) {
  return {number(lamp.direction.x()), number(lamp.direction.y()), number(lamp.direction.z())};
}

/// Wrapped diffuse light: the terminator lies at a cosine of −wrap. The light falls off as the mean
/// of a linear and a quadratic function. For every wrap, the integral over all directions is 5/6 of
/// the integral of Lambert's law.
HWY_INLINE Numbers wrapped(Numbers cosine, Numbers wrap) {
  const Numbers whole = hn::Add(number(1), wrap);
  const Numbers lit = hn::Max(hn::Div(hn::Add(cosine, wrap), whole), number(0));
  return hn::Mul(number(0.5F), hn::Div(hn::Add(square(lit), lit), whole));
}

/// Visible fraction of the sky per colour channel, increased by light that bounces inside a crevice
/// and takes on the surface's colour (fit by Jimenez et al. 2016, "Practical realtime strategies
/// for accurate indirect occlusion").
HWY_INLINE Numbers with_bounces(Numbers visible, Numbers albedo) {
  const auto line = [&](float slope, float at_zero) {
    return hn::Add(hn::Mul(number(slope), albedo), number(at_zero));
  };
  const Numbers a = line(2.0404F, -0.3324F);
  const Numbers b = line(-4.7951F, 0.6417F);
  const Numbers c = line(2.7552F, 0.6903F);
  const Numbers sum =
      hn::Mul(hn::Add(hn::Mul(hn::Add(hn::Mul(visible, a), b), visible), c), visible);
  return hn::Min(hn::Max(sum, visible), number(1));
}

/// Microfacet reflection (GGX distribution, Walter et al. 2007; Schlick's Fresnel term), multiplied
/// by the cosine between normal and light.
struct Gloss {
  const Vectors &normal, &to_viewer;
  Numbers alpha2, reflectance, masking;

  Gloss(const Vectors& n, const Vectors& eye, Numbers roughness, Numbers at_normal)
      : normal(n), to_viewer(eye), alpha2(square(square(roughness))), reflectance(at_normal) {
    masking = beyond(hn::Max(dot(normal, to_viewer), number(0.05F)));
  }
  HWY_INLINE Numbers beyond(Numbers cosine) const {
    const Numbers rest = hn::Mul(hn::Sub(number(1), alpha2), square(cosine));
    return hn::Add(cosine, hn::Sqrt(hn::Add(alpha2, rest)));
  }
  HWY_INLINE Numbers of(const Vectors& to_light) const {
    const Numbers n_l = dot(normal, to_light);
    const Vectors sum = {hn::Add(to_light.x, to_viewer.x), hn::Add(to_light.y, to_viewer.y),
                         hn::Add(to_light.z, to_viewer.z)};
    const Numbers length = hn::Max(hn::Sqrt(dot(sum, sum)), number(1e-6F));
    const Numbers n_h = hn::Max(hn::Div(dot(normal, sum), length), number(0));
    const Numbers v_h = hn::Max(hn::Div(dot(to_viewer, sum), length), number(0));
    const Numbers spread = hn::Add(hn::Mul(square(n_h), hn::Sub(alpha2, number(1))), number(1));
    const Numbers away = hn::Sub(number(1), v_h);
    const Numbers away5 = hn::Mul(square(square(away)), away);
    const Numbers fresnel = hn::Add(reflectance, hn::Mul(hn::Sub(number(1), reflectance), away5));
    const Numbers above = hn::Mul(hn::Mul(n_l, alpha2), fresnel);
    const Numbers below = hn::Mul(square(spread), hn::Mul(beyond(n_l), masking));
    return hn::IfThenElseZero(hn::Gt(n_l, number(0)), hn::Div(above, below));
  }
};

/// Shades one SIMD vector of consecutive points of a block.
/// \param points, lights  the fields and the radiances of the first point; ShadeBatch describes the
///                        layout in memory
HWY_INLINE void shade_some(const float* points, const Studio& lamps, float* lights) {
  const auto field = [&](int f) {
    return hn::LoadU(Lanes(), points + static_cast<std::size_t>(f) * ShadeBatch::kBlockSize);
  };
  const auto vectors = [&](int f) { return Vectors{field(f), field(f + 1), field(f + 2)}; };
  const Vectors normal = vectors(ShadeBatch::kNormal), to_viewer = vectors(ShadeBatch::kToViewer);
  const Numbers sky = field(ShadeBatch::kSky), key = field(ShadeBatch::kKey);
  const Vectors to_key = direction_of(lamps.key), to_fill = direction_of(lamps.fill);
  const Vectors to_right = direction_of(lamps.rim_right), to_left = direction_of(lamps.rim_left);
  const Numbers n_key = dot(normal, to_key), n_fill = dot(normal, to_fill);
  const Numbers right = hn::Mul(hn::Max(dot(normal, to_right), number(0)), sky);
  const Numbers left = hn::Mul(hn::Max(dot(normal, to_left), number(0)), sky);
  const Numbers up = hn::Add(number(0.5F), hn::Mul(number(0.5F), normal.y));
  const Gloss gloss(normal, to_viewer, field(ShadeBatch::kRoughness),
                    field(ShadeBatch::kReflectance));
  const Numbers specular = field(ShadeBatch::kSpecularFactor),
                shown = field(ShadeBatch::kRadianceFactor);
  const Numbers soft = hn::Mul(specular, square(sky));
  const Numbers key_gloss = hn::Mul(gloss.of(to_key), hn::Mul(specular, key));
  const Numbers fill_gloss = hn::Mul(gloss.of(to_fill), soft);
  // Weaken the highlights of the rim lights, because no shadow rays are traced to these lights,
  // although the face hides them in some places, such as beside the nose.
  const Numbers rim = hn::Mul(number(0.4F), soft);
  const Numbers right_gloss = hn::Mul(gloss.of(to_right), rim);
  const Numbers left_gloss = hn::Mul(gloss.of(to_left), rim);
  for (int c = 0; c < 3; ++c) {
    const Numbers albedo = field(ShadeBatch::kAlbedo + c), wrap = field(ShadeBatch::kWrap + c);
    const Numbers open = with_bounces(sky, albedo);
    const auto coloured = [&](const Lamp& lamp, Numbers amount) {
      return hn::Mul(number(lamp.colour[c]), amount);
    };
    const Numbers ambient = hn::Add(number(lamps.sky_below[c]),
                                    hn::Mul(number(lamps.sky_above[c] - lamps.sky_below[c]), up));
    Numbers diffuse = coloured(lamps.key, hn::Mul(wrapped(n_key, wrap), key));
    diffuse = hn::Add(diffuse, coloured(lamps.fill, hn::Mul(wrapped(n_fill, wrap), open)));
    diffuse = hn::Add(diffuse, coloured(lamps.rim_right, right));
    diffuse = hn::Add(diffuse, coloured(lamps.rim_left, left));
    diffuse = hn::Add(diffuse, hn::Mul(ambient, open));
    Numbers light = hn::Mul(albedo, diffuse);
    light = hn::Add(light, coloured(lamps.key, key_gloss));
    light = hn::Add(light, coloured(lamps.fill, fill_gloss));
    light = hn::Add(light, coloured(lamps.rim_right, right_gloss));
    light = hn::Add(light, coloured(lamps.rim_left, left_gloss));
    hn::StoreU(hn::Mul(light, shown), Lanes(),
               lights + static_cast<std::size_t>(c) * ShadeBatch::kBlockSize);
  }
}

void shade_blocks(const float* points, std::size_t blocks, const Studio& lamps, float* lights) {
  constexpr std::size_t kBlockSize = ShadeBatch::kBlockSize;
  for (std::size_t b = 0; b < blocks; ++b) {
    for (std::size_t i = 0; i < kBlockSize; i += hn::Lanes(Lanes())) {
      shade_some(points + b * ShadeBatch::kFields * kBlockSize + i, lamps,
                 lights + b * 3 * kBlockSize + i);
    }
  }
}

}  // namespace crowdface::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace crowdface {
namespace {

/// Lower bound of roughness: the lamps are point lights, which a smoother surface would reflect as
/// dots.
constexpr float kMinRoughness = 0.14F;

/// Factor on the highlights of a surface with this albedo. Albedos darker than any skin are painted
/// hair, which has weaker highlights.
float dark_specular(const LinearRgb& albedo) {
  constexpr float kDarkestSkin = 0.055F;
  return std::clamp(albedo.mean() / kDarkestSkin, 0.25F, 1.0F);
}

}  // namespace

HWY_EXPORT(shade_blocks);

void ShadeBatch::add(const ShadePoint& point, float specular) {
  const std::size_t block = count_ / kBlockSize * kFields * kBlockSize;
  if (points_.size() < block + kFields * kBlockSize)
    points_.resize(block + kFields * kBlockSize, 0.5F);
  float* const at = points_.data() + block + count_++ % kBlockSize;
  const auto put = [&](int field, float value) {
    at[static_cast<std::size_t>(field) * kBlockSize] = value;
  };
  const Material& material = material_of(point.kind);
  for (int c = 0; c < 3; ++c) {
    put(kNormal + c, point.normal[c]);
    put(kToViewer + c, point.to_viewer[c]);
    put(kAlbedo + c, point.albedo[c]);
    put(kWrap + c, material.wrap[c]);
  }
  put(kRoughness,
      point.roughness >= 0 ? std::clamp(point.roughness, kMinRoughness, 1.0F) : material.roughness);
  const bool darkens = point.kind == SurfaceKind::kSkin || point.kind == SurfaceKind::kAttachment;
  put(kReflectance, material.reflectance * (darkens ? dark_specular(point.albedo) : 1));
  put(kKey, point.key_visibility);
  put(kSky, point.sky_visibility);
  // Attachments are mostly hair, whose strands point in all directions and weaken highlights.
  put(kSpecularFactor, point.kind == SurfaceKind::kAttachment ? 0.3F * specular : specular);
  put(kRadianceFactor, point.is_back ? 0.3F : 1.0F);
}

void ShadeBatch::shade() {
  const std::size_t blocks = (count_ + kBlockSize - 1) / kBlockSize;
  lights_.resize(std::max(lights_.size(), blocks * 3 * kBlockSize));
  HWY_DYNAMIC_DISPATCH(shade_blocks)(points_.data(), blocks, studio(), lights_.data());
}

LinearRgb shade(const ShadePoint& point, float specular) {
  ShadeBatch alone;
  alone.add(point, specular);
  alone.shade();
  return alone.radiance(0);
}

}  // namespace crowdface
#endif
