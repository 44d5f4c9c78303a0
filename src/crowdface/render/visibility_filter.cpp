// SPDX-License-Identifier: Apache-2.0
#include "crowdface/render/visibility_filter.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "crowdface/render/visibility_filter.cpp"
#include "hwy/foreach_target.h"
// Highway requires this order: foreach_target.h first, then the code that is compiled once for each
// instruction set.
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace crowdface::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Lanes = hn::CappedTag<float, 16>;
using Numbers = hn::VFromD<Lanes>;

HWY_INLINE Numbers number(float value) {
  return hn::Set(Lanes(), value);
}

/// Weighted sums of numbers of rays towards a light, over several pixels. A pixel's weight is its
/// similarity to the filtered point.
struct RayCounts {
  Numbers visible, traced;  ///< rays that reached the light, and all traced rays

  void add(Numbers others_open, Numbers others_asked, Numbers weight) {
    visible = hn::Add(visible, hn::Mul(weight, others_open));
    traced = hn::Add(traced, hn::Mul(weight, others_asked));
  }
  /// The fraction of rays that reached the light. \param default_share  result if there are no
  /// rays.
  Numbers share(float default_share) const {
    return hn::IfThenElse(hn::Gt(traced, number(0)), hn::Div(visible, traced),
                          number(default_share));
  }
};

template <bool kInARow>
void share(const PointVisibility& points, std::size_t count, const PixelVisibility& pixels,
           std::size_t pixel, float pixel_side, float* key_shares, float* sky_shares) {
  using Field = PointVisibility;
  // Give the point's own rays a small weight, so that these rays only matter if the point matches
  // none of the 3 by 3 pixels.
  const Numbers own = number(0.01F);
  const Numbers zero = number(0), one = number(1);
  for (std::size_t i = 0; i < count; i += hn::Lanes(Lanes())) {
    const auto of_point = [&](int field) {
      return hn::LoadU(Lanes(), points.field_values[static_cast<std::size_t>(field)] + i);
    };
    const Numbers x = of_point(Field::kPoint), y = of_point(Field::kPoint + 1);
    const Numbers z = of_point(Field::kPoint + 2), u = of_point(Field::kNormal);
    const Numbers v = of_point(Field::kNormal + 1), w = of_point(Field::kNormal + 2);
    RayCounts key = {zero, zero}, sky = {zero, zero};
    key.add(of_point(Field::kKeyVisible), of_point(Field::kKeyTraced), own);
    sky.add(of_point(Field::kSkyVisible), of_point(Field::kSkyTraced), own);
    for (std::size_t row = 0; row < 3; ++row) {
      for (std::size_t column = 0; column < 3; ++column) {
        const std::size_t at =
            pixel + row * PixelVisibility::kStride + column - PixelVisibility::kStride - 1;
        const auto there = [&](int field) {
          return kInARow ? hn::LoadU(Lanes(), pixels.field_values(field) + at + i)
                         : number(pixels.field_values(field)[at]);
        };
        const auto along = [&](Numbers a, Numbers b, Numbers c) {
          return hn::Add(hn::Add(hn::Mul(u, a), hn::Mul(v, b)), hn::Mul(w, c));
        };
        // The similarity of the pixel's and the point's normals and positions (`likeness`): 1 if
        // both lie on the same surface, down to 0 if they lie on different surfaces.
        const Numbers cosine =
            along(there(Field::kNormal), there(Field::kNormal + 1), there(Field::kNormal + 2));
        const Numbers facing =
            hn::Min(hn::Max(hn::Mul(hn::Sub(cosine, number(0.7F)), number(4)), zero), one);
        const Numbers height =
            along(hn::Sub(there(Field::kPoint), x), hn::Sub(there(Field::kPoint + 1), y),
                  hn::Sub(there(Field::kPoint + 2), z));
        const Numbers pixels_away = hn::Div(hn::Abs(height), number(pixel_side));
        const Numbers beside = hn::Min(hn::Max(hn::Sub(number(2), pixels_away), zero), one);
        const Numbers likeness = hn::Mul(facing, beside);
        key.add(there(Field::kKeyVisible), there(Field::kKeyTraced), likeness);
        sky.add(there(Field::kSkyVisible), there(Field::kSkyTraced), likeness);
      }
    }
    hn::StoreU(key.share(0), Lanes(), key_shares + i);
    hn::StoreU(sky.share(1), Lanes(), sky_shares + i);
  }
}

void filter_visibility(const PointVisibility& points, std::size_t count,
                       const PixelVisibility& pixels, std::size_t pixel, bool consecutive,
                       float pixel_side, float* key, float* sky) {
  consecutive ? share<true>(points, count, pixels, pixel, pixel_side, key, sky)
              : share<false>(points, count, pixels, pixel, pixel_side, key, sky);
}

}  // namespace crowdface::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace crowdface {

HWY_EXPORT(filter_visibility);

void PixelVisibility::clear() {
  field_values_.assign(PointVisibility::kFields * kSize, 0.0F);
}

void filter_visibility(const PointVisibility& points, std::size_t count,
                       const PixelVisibility& pixels, std::size_t pixel, bool consecutive,
                       float pixel_side, float* key, float* sky) {
  HWY_DYNAMIC_DISPATCH(filter_visibility)
  (points, count, pixels, pixel, consecutive, pixel_side, key, sky);
}

}  // namespace crowdface
#endif
