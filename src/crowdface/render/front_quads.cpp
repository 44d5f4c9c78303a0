// SPDX-License-Identifier: Apache-2.0
#include "crowdface/render/front_quads.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "crowdface/render/front_quads.cpp"
#include "hwy/foreach_target.h"
// Highway requires this order: foreach_target.h first, then the code that is compiled once for each
// instruction set.
#include <algorithm>
#include <limits>

#include "hwy/cache_control.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace crowdface::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Lanes = hn::CappedTag<float, 16>;
using Numbers = hn::VFromD<Lanes>;

/// A corner of a quad, relative to several sample positions (one per SIMD lane).
struct Corner {
  Numbers x, y;
};

/// Twice the signed area of the triangle of two corners and the sample position. Swapping the
/// corners gives exactly the negative value, so that no sample falls between two triangles with a
/// common edge. (A fused multiply-add would break this symmetry.)
HWY_INLINE Numbers edge_function(const Corner& a, const Corner& b) {
  return hn::Sub(hn::Mul(a.x, b.y), hn::Mul(a.y, b.x));
}

/// Depth test of a triangle at several sample positions.
/// \param a, b, c        partial areas opposite to the corners
/// \param n_a, n_b, n_c  inverse_depth of the corners
HWY_INLINE void put_triangle(Numbers a, Numbers b, Numbers c, float n_a, float n_b, float n_c,
                             std::uint32_t front, float* inverse_depth, std::uint32_t* fronts) {
  const Lanes lanes;
  const hn::Rebind<std::uint32_t, Lanes> whole;
  const Numbers zero = hn::Zero(lanes);
  const auto inside = hn::Or(hn::And(hn::And(hn::Ge(a, zero), hn::Ge(b, zero)), hn::Ge(c, zero)),
                             hn::And(hn::And(hn::Le(a, zero), hn::Le(b, zero)), hn::Le(c, zero)));
  if (hn::AllFalse(lanes, inside)) return;
  const Numbers area = hn::Add(hn::Add(a, b), c);
  const Numbers sum =
      hn::Add(hn::Add(hn::Mul(a, hn::Set(lanes, n_a)), hn::Mul(b, hn::Set(lanes, n_b))),
              hn::Mul(c, hn::Set(lanes, n_c)));
  const Numbers near = hn::Div(sum, area);  // NaN if the area is 0: fails the test
  const Numbers before = hn::LoadU(lanes, inverse_depth);
  const auto nearer = hn::And(inside, hn::Gt(near, before));
  hn::StoreU(hn::IfThenElse(nearer, near, before), lanes, inverse_depth);
  hn::StoreU(hn::IfThenElse(hn::RebindMask(whole, nearer), hn::Set(whole, front),
                            hn::LoadU(whole, fronts)),
             whole, fronts);
}

/// Depth-tests a quad at all samples of one pixel.
HWY_INLINE void put_in_pixel(const QuadOnPixels& on, const Quad& quad,
                             const ProjectedVertex* placed, float left, float top,
                             const SampledPixel& pixel, float* inverse_depth,
                             std::uint32_t* fronts) {
  const Lanes lanes;
  const ProjectedVertex* const vertices[] = {placed + quad[0], placed + quad[1], placed + quad[2],
                                             placed + quad[3]};
  for (std::uint32_t i = 0; i < pixel.samples->count();
       i += static_cast<std::uint32_t>(hn::Lanes(lanes))) {
    const Numbers x = hn::Add(hn::Set(lanes, left), hn::LoadU(lanes, pixel.samples->x() + i));
    const Numbers y = hn::Add(hn::Set(lanes, top), hn::LoadU(lanes, pixel.samples->y() + i));
    Corner c[4];
    for (int k = 0; k < 4; ++k) {
      c[k] = {hn::Sub(hn::Set(lanes, vertices[k]->x), x),
              hn::Sub(hn::Set(lanes, vertices[k]->y), y)};
    }
    float* const near = inverse_depth + pixel.first_sample + i;
    std::uint32_t* const front = fronts + pixel.first_sample + i;
    const Numbers across = edge_function(c[1], c[3]);
    put_triangle(across, edge_function(c[3], c[0]), edge_function(c[0], c[1]),
                 vertices[0]->inverse_depth, vertices[1]->inverse_depth, vertices[3]->inverse_depth,
                 2 * on.quad, near, front);
    put_triangle(hn::Neg(across), edge_function(c[1], c[2]), edge_function(c[2], c[3]),
                 vertices[2]->inverse_depth, vertices[3]->inverse_depth, vertices[1]->inverse_depth,
                 2 * on.quad + 1, near, front);
  }
}

void rasterize_quads(const QuadOnPixels* begin, const QuadOnPixels* end, const Quad* quads,
                     const ProjectedVertex* placed, int corner_x, int corner_y,
                     const SampledPixel* pixels, float* inverse_depth, std::uint32_t* fronts) {
  constexpr std::ptrdiff_t kQuadsAhead = 16, kCornersAhead = 8;
  for (; begin != end; ++begin) {
    // Prefetch: on a large mesh, quads and vertices are not in the caches.
    if (end - begin > kQuadsAhead) hwy::Prefetch(quads + begin[kQuadsAhead].quad);
    if (end - begin > kCornersAhead) {
      for (const std::uint32_t vertex : quads[begin[kCornersAhead].quad]) {
        hwy::Prefetch(placed + vertex);
      }
    }
    for (int y = begin->top; y <= begin->bottom; ++y) {
      for (int x = begin->left; x <= begin->right; ++x) {
        const SampledPixel& pixel = pixels[y * kRimmedSide + x];
        if (pixel.samples == nullptr) continue;
        put_in_pixel(*begin, quads[begin->quad], placed, static_cast<float>(corner_x + x),
                     static_cast<float>(corner_y + y), pixel, inverse_depth, fronts);
      }
    }
  }
}

/// Margin around bounding boxes, in pixels: larger than the rounding errors of positions.
constexpr float kBoxMargin = 1e-2F;

/// The bounding boxes of kCount quads on the image. Coordinates are pixels, relative to a point
/// that lies kRimWidth pixels above and left of the image's upper left corner. This point is the
/// upper left corner of the rim of the image's first square (see kSquareSide).
struct Boxes {
  static constexpr std::size_t kCount = 8;
  alignas(64) std::int32_t left[kCount], top[kCount], right[kCount], bottom[kCount];
  /// index of the last square of the image that the box overlaps; −1: the quad is not visible
  alignas(64) std::int32_t square[kCount];
  /// not 0: the box overlaps no other square than `square`
  alignas(64) std::int32_t in_one_square[kCount];
  alignas(64) std::int32_t no_pixel_centre[kCount];  ///< 1: no pixel centre is in the box
  /// The quad's box in pixels, relative to the upper left corner of the rim of square `square`.
  /// Four bytes hold the box: left (lowest byte), top, right, bottom.
  alignas(64) std::int32_t in_square[kCount];
};

/// Computes the bounding boxes of quads in pixels. \param quads  Boxes::kCount quads
void find_boxes(const Quad* quads, const ProjectedVertex* placed, int squares_per_row,
                Boxes& boxes) {
  const hn::CappedTag<float, Boxes::kCount> lanes;
  const hn::Rebind<std::int32_t, decltype(lanes)> whole;
  // Bounding boxes in image coordinates: left, top, right, bottom of each quad.
  alignas(64) float ends[4 * Boxes::kCount];
  for (std::size_t i = 0; i < Boxes::kCount; ++i) {
    const auto corner = [&](std::size_t c) {
      return Eigen::Map<const Eigen::Array4f, Eigen::Aligned16>(&placed[quads[i][c]].x);
    };
    const Eigen::Array4f low = corner(0).min(corner(1)).min(corner(2).min(corner(3)));
    const Eigen::Array4f high = corner(0).max(corner(1)).max(corner(2).max(corner(3)));
    std::copy_n(low.data(), 2, ends + 4 * i);
    std::copy_n(high.data(), 2, ends + 4 * i + 2);
  }
  const auto most =
      hn::Set(lanes, static_cast<float>(squares_per_row * kSquareSide + 2 * kRimWidth - 1));
  const auto zero = hn::Zero(lanes), half = hn::Set(lanes, 0.5F);
  const auto one = hn::Set(whole, 1), none = hn::Zero(whole),
             last = hn::Set(whole, squares_per_row - 1);
  const auto pixel = [&](auto place) { return hn::ConvertTo(whole, place); };
  const auto has_middle = [&](auto from, auto to) {
    return hn::Gt(pixel(hn::Add(to, half)), pixel(hn::Add(from, half)));
  };
  // Returns the first square that contains a pixel in its area or in its rim. Neighbouring squares
  // with their rims overlap by 2 · kRimWidth pixels.
  const auto first_square = [&](auto from) {
    return hn::ShiftRight<kLog2SquareSide>(
        hn::Max(hn::Sub(from, hn::Set(whole, 2 * kRimWidth)), none));
  };
  const auto last_square = [&](auto to) {
    return hn::Min(hn::ShiftRight<kLog2SquareSide>(to), last);
  };
  for (std::size_t i = 0; i < Boxes::kCount; i += hn::Lanes(lanes)) {
    hn::VFromD<decltype(lanes)> left, top, right, bottom;
    hn::LoadInterleaved4(lanes, ends + 4 * i, left, top, right, bottom);
    // Move the origin of the boxes from the upper left corner of the image to the upper left corner
    // of the rim around the image. Enlarge the boxes by kBoxMargin, and clip the boxes to the outer
    // edge of the rim.
    left = hn::Add(left, hn::Set(lanes, kRimWidth - kBoxMargin));
    top = hn::Add(top, hn::Set(lanes, kRimWidth - kBoxMargin));
    right = hn::Add(right, hn::Set(lanes, kRimWidth + kBoxMargin));
    bottom = hn::Add(bottom, hn::Set(lanes, kRimWidth + kBoxMargin));
    const auto outside = hn::Or(hn::Or(hn::Lt(right, zero), hn::Lt(bottom, zero)),
                                hn::Or(hn::Gt(left, most), hn::Gt(top, most)));
    const auto unseen = hn::Or(outside, hn::IsInf(right));
    left = hn::Max(left, zero);
    top = hn::Max(top, zero);
    right = hn::Min(right, most);
    bottom = hn::Min(bottom, most);
    // Round the box to pixels. Each square of the image has a rim around it (see kSquareSide). Find
    // the last square in reading order that overlaps the box or whose rim overlaps the box. Compute
    // the box relative to the upper left corner of this square's rim.
    const auto l = pixel(left), t = pixel(top), r = pixel(right), b = pixel(bottom);
    const auto column = last_square(r), row = last_square(b);
    const auto x = hn::ShiftLeft<kLog2SquareSide>(column), y = hn::ShiftLeft<kLog2SquareSide>(row);
    const auto low_ends = hn::Or(hn::Sub(l, x), hn::ShiftLeft<8>(hn::Sub(t, y)));
    const auto high_ends = hn::Or(hn::Sub(r, x), hn::ShiftLeft<8>(hn::Sub(b, y)));
    hn::Store(l, whole, boxes.left + i);
    hn::Store(t, whole, boxes.top + i);
    hn::Store(r, whole, boxes.right + i);
    hn::Store(b, whole, boxes.bottom + i);
    hn::Store(hn::IfThenElse(hn::RebindMask(whole, unseen), hn::Set(whole, -1),
                             hn::Add(hn::Mul(row, hn::Set(whole, squares_per_row)), column)),
              whole, boxes.square + i);
    hn::Store(hn::IfThenElseZero(
                  hn::And(hn::Eq(first_square(l), column), hn::Eq(first_square(t), row)), one),
              whole, boxes.in_one_square + i);
    hn::Store(hn::IfThenElse(hn::And(has_middle(left, right), has_middle(top, bottom)), none, one),
              whole, boxes.no_pixel_centre + i);
    hn::Store(hn::Or(low_ends, hn::ShiftLeft<16>(high_ends)), whole, boxes.in_square + i);
  }
}

void add_to_squares(const Quad* quads, std::size_t begin, std::size_t end,
                    const ProjectedVertex* placed, int squares_per_row, SquareLists& squares) {
  Boxes boxes;
  std::array<Quad, Boxes::kCount> some;
  const auto byte = [](auto number) { return static_cast<std::uint8_t>(number); };
  const auto within = [&](int pixel, int square) {
    return byte(std::clamp(pixel - square * kSquareSide, 0, kRimmedSide - 1));
  };
  for (; begin < end; begin += Boxes::kCount) {
    const std::size_t count = std::min(Boxes::kCount, end - begin);
    for (std::size_t i = 0; i < Boxes::kCount; ++i) some[i] = quads[begin + std::min(i, count - 1)];
    find_boxes(some.data(), placed, squares_per_row, boxes);
    for (std::size_t i = 0; i < count; ++i) {
      if (boxes.square[i] < 0) continue;
      const auto quad = static_cast<std::uint32_t>(begin + i);
      const auto list = static_cast<std::size_t>(boxes.no_pixel_centre[i]);
      if (boxes.in_one_square[i] != 0) {
        const auto ends = static_cast<std::uint32_t>(boxes.in_square[i]);
        squares[static_cast<std::size_t>(boxes.square[i])][list].push_back(
            {quad, byte(ends), byte(ends >> 8U), byte(ends >> 16U), byte(ends >> 24U)});
        continue;
      }
      const int right = boxes.square[i] % squares_per_row,
                bottom = boxes.square[i] / squares_per_row;
      for (int y = std::max(boxes.top[i] - 2 * kRimWidth, 0) / kSquareSide; y <= bottom; ++y) {
        for (int x = std::max(boxes.left[i] - 2 * kRimWidth, 0) / kSquareSide; x <= right; ++x) {
          squares[static_cast<std::size_t>(y * squares_per_row + x)][list].push_back(
              {quad, within(boxes.left[i], x), within(boxes.top[i], y), within(boxes.right[i], x),
               within(boxes.bottom[i], y)});
        }
      }
    }
  }
}

}  // namespace crowdface::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace crowdface {
HWY_EXPORT(add_to_squares);
HWY_EXPORT(rasterize_quads);

PixelSamples::PixelSamples(std::vector<Eigen::Vector2f> positions)
    : positions_(std::move(positions)) {
  for (const Eigen::Vector2f& place : positions_) {
    x_.push_back(place.x());
    y_.push_back(place.y());
  }
  x_.resize(positions_.size() + kMaxLanes, std::numeric_limits<float>::quiet_NaN());
  y_.resize(positions_.size() + kMaxLanes, std::numeric_limits<float>::quiet_NaN());
}

DepthBuffer::DepthBuffer(std::size_t samples)
    : inverse_depth(samples + kMaxLanes, 0.0F), front_quads(samples + kMaxLanes, kNothing) {}

void add_to_squares(std::span<const Quad> quads, std::size_t first, std::size_t end,
                    std::span<const ProjectedVertex> placed, int squares_per_row,
                    SquareLists& squares) {
  HWY_DYNAMIC_DISPATCH(add_to_squares)
  (quads.data(), first, end, placed.data(), squares_per_row, squares);
}

void rasterize_quads(std::span<const QuadOnPixels> some, std::span<const Quad> quads,
                     std::span<const ProjectedVertex> placed, std::array<int, 2> corner,
                     std::span<const SampledPixel> pixels, DepthBuffer& fronts) {
  HWY_DYNAMIC_DISPATCH(rasterize_quads)
  (some.data(), some.data() + some.size(), quads.data(), placed.data(), corner[0], corner[1],
   pixels.data(), fronts.inverse_depth.data(), fronts.front_quads.data());
}

}  // namespace crowdface
#endif
