// SPDX-License-Identifier: Apache-2.0
#include "crowdface/validity/leaf_boxes.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "crowdface/validity/leaf_boxes.cpp"
#include "hwy/foreach_target.h"
// Highway requires this order: foreach_target.h first, then code compiled once for each target.
#include <algorithm>
#include <cmath>
#include <limits>

#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace crowdface::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr std::size_t kMaxTriangles = LeafCorners::kMaxTriangles;
constexpr hn::CappedTag<float, kMaxTriangles> kLanes;
using Lanes = hn::VFromD<decltype(kLanes)>;

struct Lanes3 {
  Lanes x[3];
};

/// Returns the positions of corner `k` (0 to 2) of consecutive triangles, beginning with triangle
/// `begin`.
Lanes3 corner_of(const LeafCorners& corners, std::size_t k, std::size_t begin,
                 const float* points) {
  const hn::RebindToSigned<decltype(kLanes)> integers;
  const auto vertex = hn::LoadU(integers, &corners.vertex[k][begin]);
  const auto row = hn::Add(hn::Add(vertex, vertex), vertex);
  Lanes3 corner;
  for (int c = 0; c < 3; ++c) {
    corner.x[c] = hn::GatherIndex(kLanes, points, hn::Add(row, hn::Set(integers, c)));
  }
  return corner;
}

void measure_normals(const LeafCorners& corners, const float* points, LeafNormals& normals) {
  for (std::size_t begin = 0; begin < kMaxTriangles; begin += hn::Lanes(kLanes)) {
    const Lanes3 p = corner_of(corners, 0, begin, points), q = corner_of(corners, 1, begin, points),
                 r = corner_of(corners, 2, begin, points);
    Lanes a[3], b[3], n[3];
    for (std::size_t c = 0; c < 3; ++c) {
      a[c] = hn::Sub(q.x[c], p.x[c]);
      b[c] = hn::Sub(r.x[c], p.x[c]);
    }
    auto square = hn::Zero(kLanes);
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t d = (c + 1) % 3, e = (c + 2) % 3;
      n[c] = hn::Sub(hn::Mul(a[d], b[e]), hn::Mul(a[e], b[d]));
      square = hn::Add(square, hn::Mul(n[c], n[c]));
    }
    const auto length = hn::Sqrt(square);
    for (std::size_t c = 0; c < 3; ++c) {
      hn::StoreU(hn::Div(n[c], length), kLanes, &normals.components[c][begin]);
    }
  }
}

/// Compares each triangle of one leaf with each triangle of another leaf. Bit number 8·i + j of the
/// result is the value of `compare` for triangle i of the first leaf and triangle j of the second.
template <class Compare>
std::uint64_t compared(const Compare& compare) {
  std::uint64_t all = 0;
  for (std::size_t begin = 0; begin < kMaxTriangles; begin += hn::Lanes(kLanes)) {
    const auto with_each = compare(begin);
    for (std::size_t i = 0; i < kMaxTriangles; ++i) {
      std::uint8_t bits[8] = {};
      hn::StoreMaskBits(kLanes, with_each(i), bits);
      all |= std::uint64_t{bits[0]} << (kMaxTriangles * i + begin);
    }
  }
  return all;
}

std::uint64_t overlapping_boxes(const LeafBoxes& a, const LeafBoxes& b) {
  return compared([&](std::size_t begin) {
    Lanes3 low, high;
    for (std::size_t c = 0; c < 3; ++c) {
      low.x[c] = hn::LoadU(kLanes, &b.low[c][begin]);
      high.x[c] = hn::LoadU(kLanes, &b.high[c][begin]);
    }
    return [&a, low, high](std::size_t i) {
      const auto along = [&](std::size_t c) {
        return hn::And(hn::Le(hn::Set(kLanes, a.low[c][i]), high.x[c]),
                       hn::Le(low.x[c], hn::Set(kLanes, a.high[c][i])));
      };
      return hn::And(hn::And(along(0), along(1)), along(2));
    };
  });
}

std::uint64_t common_vertices(const LeafCorners& a, const LeafCorners& b) {
  const hn::RebindToSigned<decltype(kLanes)> integers;
  return compared([&](std::size_t begin) {
    hn::VFromD<decltype(integers)> of_b[3];
    for (std::size_t k = 0; k < 3; ++k) of_b[k] = hn::LoadU(integers, &b.vertex[k][begin]);
    return [&, of_b](std::size_t i) {
      const auto is_of_b = [&](std::size_t k) {
        const auto vertex = hn::Set(integers, a.vertex[k][i]);
        return hn::Or(hn::Or(hn::Eq(vertex, of_b[0]), hn::Eq(vertex, of_b[1])),
                      hn::Eq(vertex, of_b[2]));
      };
      return hn::RebindMask(kLanes, hn::Or(hn::Or(is_of_b(0), is_of_b(1)), is_of_b(2)));
    };
  });
}

std::uint64_t alike_normals(const LeafNormals& a, const LeafNormals& b, float min_cosine) {
  return compared([&](std::size_t begin) {
    Lanes3 n;
    for (std::size_t c = 0; c < 3; ++c) n.x[c] = hn::LoadU(kLanes, &b.components[c][begin]);
    return [&a, n, min_cosine](std::size_t i) {
      const auto part = [&](std::size_t c) {
        return hn::Mul(hn::Set(kLanes, a.components[c][i]), n.x[c]);
      };
      return hn::Gt(hn::Add(hn::Add(part(0), part(1)), part(2)), hn::Set(kLanes, min_cosine));
    };
  });
}

}  // namespace crowdface::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace crowdface {

HWY_EXPORT(alike_normals);
HWY_EXPORT(common_vertices);
HWY_EXPORT(measure_normals);
HWY_EXPORT(overlapping_boxes);

BoxRay::BoxRay(const Eigen::Vector3d& from, const Eigen::Vector3d& direction) {
  // This number stands for 1/0: large but finite, so that the product with a distance of zero is
  // not NaN.
  constexpr double kInverseOfZero = 1e300;
  for (std::size_t c = 0; c < 3; ++c) {
    const auto axis = static_cast<Index>(c);
    origin[c] = from[axis];
    inverse_direction[c] = direction[axis] == 0 ? kInverseOfZero : 1 / direction[axis];
  }
}

bool ray_hits_box(const BoxRay& ray, const Box& box) {
  double near = 0, far = std::numeric_limits<double>::infinity();
  for (std::size_t c = 0; c < 3; ++c) {
    const double a = (box.low[c] - ray.origin[c]) * ray.inverse_direction[c];
    const double b = (box.high[c] - ray.origin[c]) * ray.inverse_direction[c];
    near = std::max(near, std::min(a, b));
    far = std::min(far, std::max(a, b));
  }
  return near <= far * BoxRay::kRounding;
}

unsigned hit_mask(const BoxRay& ray, const LeafBoxes& boxes) {
  constexpr std::size_t kCount = LeafBoxes::kMaxTriangles;
  std::array<double, kCount> near{}, far;
  far.fill(std::numeric_limits<double>::infinity());
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t i = 0; i < kCount; ++i) {
      const double a = (boxes.low[c][i] - ray.origin[c]) * ray.inverse_direction[c];
      const double b = (boxes.high[c][i] - ray.origin[c]) * ray.inverse_direction[c];
      near[i] = std::max(near[i], std::min(a, b));
      far[i] = std::min(far[i], std::max(a, b));
    }
  }
  unsigned mask = 0;
  for (std::size_t i = 0; i < kCount; ++i) {
    mask |= static_cast<unsigned>(near[i] <= far[i] * BoxRay::kRounding) << i;
  }
  return mask;
}

std::uint64_t overlap_mask(const LeafBoxes& a, const LeafBoxes& b) {
  return HWY_DYNAMIC_DISPATCH(overlapping_boxes)(a, b);
}

std::uint64_t shared_vertex_mask(const LeafCorners& a, const LeafCorners& b) {
  return HWY_DYNAMIC_DISPATCH(common_vertices)(a, b);
}

std::uint64_t similar_normal_mask(const LeafNormals& a, const LeafNormals& b, float min_cosine) {
  return HWY_DYNAMIC_DISPATCH(alike_normals)(a, b, min_cosine);
}

/// This code has no branches, because the processor could not predict them.
bool boxes_overlap(const Box& a, const Box& b) {
  unsigned apart = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    apart |= static_cast<unsigned>(a.low[c] > b.high[c]);
    apart |= static_cast<unsigned>(b.low[c] > a.high[c]);
  }
  return apart == 0;
}

LeafCorners::LeafCorners(std::span<const std::uint32_t> triangle_indices,
                         std::span<const Triangle> triangles)
    : count(triangle_indices.size()) {
  for (std::size_t i = 0; i < kMaxTriangles; ++i) {
    const Triangle& triangle = triangles[triangle_indices[i < count ? i : 0]];
    for (std::size_t k = 0; k < 3; ++k) vertex[k][i] = static_cast<std::int32_t>(triangle[k]);
  }
}

LeafBoxes::LeafBoxes(const LeafCorners& corners, const FloatPositions& points, double margin) {
  // Upper bound of the relative error that is caused by rounding coordinates and margins to single
  // precision.
  constexpr float kRounding = 1e-6F;
  constexpr float kEnd = std::numeric_limits<float>::infinity();
  const auto grown = static_cast<float>(margin);
  for (std::size_t i = 0; i < kMaxTriangles; ++i) {
    const auto &p = points.row(corners.vertex[0][i]), &q = points.row(corners.vertex[1][i]),
               &r = points.row(corners.vertex[2][i]);
    for (std::size_t c = 0; c < 3; ++c) {
      const auto axis = static_cast<Index>(c);
      const float least = std::min({p[axis], q[axis], r[axis]});
      const float most = std::max({p[axis], q[axis], r[axis]});
      const bool is_used = i < corners.count;
      low[c][i] = is_used ? least - (grown + kRounding * (std::abs(least) + grown)) : kEnd;
      high[c][i] = is_used ? most + (grown + kRounding * (std::abs(most) + grown)) : -kEnd;
    }
  }
}

LeafNormals::LeafNormals(const LeafCorners& corners, const FloatPositions& points) {
  HWY_DYNAMIC_DISPATCH(measure_normals)(corners, points.data(), *this);
}

Box LeafBoxes::bounding_box() const {
  Box box;
  for (std::size_t c = 0; c < 3; ++c) {
    std::array<float, kMaxTriangles> least = low[c], most = high[c];
    for (std::size_t half = kMaxTriangles / 2; half > 0; half /= 2) {
      for (std::size_t i = 0; i < half; ++i) {
        least[i] = std::min(least[i], least[i + half]);
        most[i] = std::max(most[i], most[i + half]);
      }
    }
    box.low[c] = least[0];
    box.high[c] = most[0];
  }
  return box;
}

}  // namespace crowdface
#endif  // HWY_ONCE
