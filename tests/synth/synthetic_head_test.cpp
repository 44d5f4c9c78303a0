// SPDX-License-Identifier: Apache-2.0
#include "head_models/synth/synthetic_head.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "crowdface/core/parallel.h"
#include "crowdface/core/require.h"
#include "head_models/synth/layout.h"

namespace crowdface {
namespace {

using Eigen::Vector3d;

const SyntheticHeads& small_heads() {
  static const SyntheticHeads heads(5000);
  return heads;
}

TEST(SyntheticHeads, SameSeedSameBits) {
  const SyntheticHeads again(5000);
  const ThreadLimit one(1);
  EXPECT_EQ(small_heads().positions(3, 5), again.positions(3, 5));
  EXPECT_EQ(small_heads().uvs(), again.uvs());
}

TEST(SyntheticHeads, HeadsDiffer) {
  std::vector<Positions> heads;
  for (std::uint64_t i = 0; i < 8; ++i) heads.push_back(small_heads().positions(1, i));
  heads.push_back(small_heads().positions(2, 0));
  for (std::size_t i = 0; i < heads.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const double rms = std::sqrt((heads[i] - heads[j]).rowwise().squaredNorm().mean());
      EXPECT_GT(rms, 0.1) << i << " and " << j;  // centimetres
    }
  }
}

TEST(SyntheticHeads, LeftAndRightDifferALittle) {
  const synth::Layout layout = synth::make_layout(5000);
  const Positions head = small_heads().positions(1, 0);
  std::map<std::array<double, 4>, Index> at;
  for (Index i = 0; i < head.rows(); ++i) {
    const auto& a = layout.lattice_points[static_cast<std::size_t>(i)];
    at[{static_cast<double>(a.patch), a.side, a.a, a.b}] = i;
  }
  double largest = 0;
  for (const auto& [key, i] : at) {
    const bool strip = key[0] <= static_cast<double>(synth::SkinPatch::kCap);
    const auto other =
        at.find({key[0], strip ? key[1] : -key[1], strip ? -key[2] : key[2], key[3]});
    if (other == at.end()) continue;
    Vector3d mirror = head.row(other->second);
    mirror.x() = -mirror.x();
    largest = std::max(largest, (Vector3d(head.row(i)) - mirror).norm());
  }
  EXPECT_GT(largest, 0.05);
  EXPECT_LT(largest, 1.0);
}

/// Distance from a point to a triangle (Ericson 2005, "Real-time collision detection", 5.1.5).
double triangle_distance(const Vector3d& p, const Vector3d& a, const Vector3d& b,
                         const Vector3d& c) {
  const Vector3d ab = b - a, ac = c - a, ap = p - a;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0 && d2 <= 0) return ap.norm();
  const Vector3d bp = p - b;
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0 && d4 <= d3) return bp.norm();
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return (ap - d1 / (d1 - d3) * ab).norm();
  const Vector3d cp = p - c;
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0 && d5 <= d6) return cp.norm();
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return (ap - d2 / (d2 - d6) * ac).norm();
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    return (bp - (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b)).norm();
  }
  const double w = 1 / (va + vb + vc);
  return (ap - vb * w * ab - vc * w * ac).norm();
}

double surface_distance(const Vector3d& p, const Topology& topology, const Positions& positions) {
  double nearest = 1e9;
  for (Index f = 0; f < topology.face_count(); ++f) {
    const auto face = topology.face(f);
    const Vector3d a = positions.row(face[0]), c = positions.row(face[2]);
    if (((a + c) / 2 - p).norm() > nearest + 2) continue;
    const Vector3d b = positions.row(face[1]), d = positions.row(face[3]);
    nearest = std::min({nearest, triangle_distance(p, a, b, c), triangle_distance(p, a, c, d)});
  }
  return nearest;
}

TEST(SyntheticHeads, SameSurfaceAtEveryResolution) {
  const SyntheticHeads fine(80000);
  const Positions coarse_head = small_heads().positions(1, 3), fine_head = fine.positions(1, 3);
  for (Index i = 0; i < coarse_head.rows(); i += 37) {
    EXPECT_LT(surface_distance(coarse_head.row(i), fine.topology(), fine_head), 0.03) << i;
  }
}

TEST(SyntheticHeads, RefusesSizesOutOfRange) {
  EXPECT_THROW(SyntheticHeads(4999), BrokenPrecondition);
  EXPECT_THROW(SyntheticHeads(1200001), BrokenPrecondition);
}

}  // namespace
}  // namespace crowdface
