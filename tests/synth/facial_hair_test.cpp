// SPDX-License-Identifier: Apache-2.0
#include "head_models/synth/facial_hair.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include "head_models/synth/complexion.h"
#include "head_models/synth/identity.h"
#include "head_models/synth/synthetic_head.h"

namespace crowdface::synth {
namespace {

using Eigen::Vector3d;

/// Calls visit(point, opacity) at each vertex of the layer of a style.
void visit_layer(const FacialHair& style,
                 const std::function<void(const Vector3d&, double)>& visit) {
  static const SyntheticHeads heads(20'000, SyntheticHeads::Parts::kSkin);
  static const Mesh skin{heads.topology(), heads.average(), heads.uvs()};
  const FacialHairLayer layer = facial_hair_layer(style, skin);
  const Topology& topology = layer.mesh.topology;
  for (Index c = 0; c < topology.corner_count(); ++c) {
    const auto k = static_cast<std::size_t>(c);
    const auto uv = layer.mesh.uvs.row(topology.corner_uvs[k]);
    const int x = std::min(static_cast<int>(uv.x() * layer.width), layer.width - 1);
    const int y = std::min(static_cast<int>((1 - uv.y()) * layer.height), layer.height - 1);
    visit(layer.mesh.positions.row(topology.corner_vertices[k]).transpose(),
          layer.pixels[4 * static_cast<std::size_t>(y * layer.width + x) + 3] / 255.0);
  }
}

/// Mean opacity of a style around a place; 0 where the layer does not reach.
double cover_near(const FacialHair& style, const Vector3d& place) {
  double sum = 0, count = 0;
  visit_layer(style, [&](const Vector3d& p, double opacity) {
    if ((p - place).head<2>().norm() > 0.5 || p.z() < 5) return;
    sum += opacity;
    ++count;
  });
  return count > 0 ? sum / count : 0;
}

TEST(FacialHair, BeardsHaveAMoustacheThatReachesTheChinsBeard) {
  for (const FacialHair& style : facial_hairs()) {
    if (!style.is_beard || style.chin_beard < 1) continue;
    EXPECT_GT(cover_near(style, {1.2, -5.8, 10}), 0.5) << style.name;
    EXPECT_GT(cover_near(style, {2.6, -7.6, 9}), 0.4) << style.name << ": beside the mouth";
    EXPECT_GT(cover_near(style, {2.4, -8.8, 9}), 0.4) << style.name << ": below its corner";
    EXPECT_GT(cover_near(style, {1.3, -8.6, 9}), 0.4) << style.name << ": no bare patches";
  }
}

// Brows that rise steeply from the nose make a face look angry.
TEST(FacialHair, BrowsRiseLittleFromTheNose) {
  for (const FacialHair& style : facial_hairs()) {
    if (style.is_beard) continue;
    double inner = 0, inner_sum = 0, middle = 0, middle_sum = 0;
    visit_layer(style, [&](const Vector3d& p, double opacity) {
      const double x = std::abs(p.x());
      if (x > 1.2 && x < 2) inner += opacity * p.y(), inner_sum += opacity;
      if (x > 3 && x < 4) middle += opacity * p.y(), middle_sum += opacity;
    });
    ASSERT_GT(inner_sum, 0) << style.name;
    ASSERT_GT(middle_sum, 0) << style.name;
    const double rise = middle / middle_sum - inner / inner_sum;
    EXPECT_GT(rise, 0) << style.name;
    EXPECT_LT(rise, 0.45) << style.name;
  }
}

TEST(Complexion, MostWomenWearNoLipstickAndNoMan) {
  double women = 0, painted = 0;
  for (std::uint64_t i = 0; i < 1000; ++i) {
    const bool wears = random_complexion(1, i).lipstick > 0.1;
    if (random_person(1, i).maleness > 0) {
      EXPECT_FALSE(wears) << i;
      continue;
    }
    ++women;
    painted += wears ? 1 : 0;
  }
  EXPECT_GT(painted / women, 0.1);
  EXPECT_LT(painted / women, 0.3);
}

}  // namespace
}  // namespace crowdface::synth
