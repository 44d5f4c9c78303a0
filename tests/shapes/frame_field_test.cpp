// SPDX-License-Identifier: Apache-2.0
#include "crowdface/shapes/frame_field.h"

#include <numeric>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "parts/scene.h"

namespace crowdface {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kBallExtent = 34.6;  // of a ball of 10

std::vector<std::uint32_t> all_of(const Positions& positions) {
  std::vector<std::uint32_t> all(static_cast<std::size_t>(positions.rows()));
  std::iota(all.begin(), all.end(), 0U);
  return all;
}

Mesh ball() {
  return testing::Shapes().ball({1, 2, 3}, 10, 16).mesh();
}

FrameField field_over(const Positions& positions) {
  const auto all = all_of(positions);
  return {positions, all, kBallExtent, all};
}

/// Largest difference of the frames of a face from one map.
double farthest_frame(const FrameField& field, const Positions& face, const Matrix3d& expected) {
  const FrameField::Frames frames = field.frames(face);
  double most = 0;
  for (std::size_t v = 0; v < static_cast<std::size_t>(face.rows()); ++v) {
    most = std::max(most, (field.map_at(v, frames) - expected).cwiseAbs().maxCoeff());
  }
  return most;
}

TEST(FrameField, OfTheTemplateItselfIsTheIdentity) {
  const Mesh mesh = ball();
  EXPECT_LT(farthest_frame(field_over(mesh.positions), mesh.positions, Matrix3d::Identity()),
            1e-12);
}

TEST(FrameField, OfATurnedMovedAndScaledTemplateIsThatTurnAndScale) {
  const Mesh mesh = ball();
  const Eigen::RowVector3d shift(30, -4, 5);
  const Positions face = testing::moved(mesh.positions, 0.4, 1.7, shift);
  Positions axes = Positions::Zero(4, 3);
  axes.bottomRows(3) = Matrix3d::Identity();
  const Positions turned = testing::moved(axes, 0.4, 1.7, shift);
  Matrix3d map;
  for (Index c = 0; c < 3; ++c) map.col(c) = (turned.row(c + 1) - turned.row(0)).transpose();
  EXPECT_LT(farthest_frame(field_over(mesh.positions), face, map), 1e-12);
}

TEST(FrameField, OfAStretchedTemplateIsNearlyThatStretch) {
  const Mesh mesh = ball();
  const Matrix3d stretch = Vector3d(1.3, 1, 0.9).asDiagonal();
  const Positions face = mesh.positions * stretch;
  EXPECT_LT(farthest_frame(field_over(mesh.positions), face, stretch), 0.2);
}

/// As the header says it, in the plainest form: each place's map by least squares over the skin
/// around it, and between places their mean by nearness.
TEST(FrameField, IsThePlainLeastSquaresFit) {
  const Mesh mesh = ball();
  const Positions& x = mesh.positions;
  Positions y = x;
  for (Index v = 0; v < y.rows(); ++v) {
    y(v, 1) += 0.02 * x(v, 0) * x(v, 1);
    y(v, 2) += std::sin(x(v, 0));
  }
  const FrameField field = field_over(x);
  const FrameField::Frames frames = field.frames(y);

  const auto bump = [](double t) { return t < 1 ? (1 - t * t) * (1 - t * t) : 0; };
  std::vector<Index> places;
  std::vector<double> nearest(static_cast<std::size_t>(x.rows()), 1e300);
  for (Index next = 0; nearest[static_cast<std::size_t>(next)] > 0.06 * kBallExtent;) {
    places.push_back(next);
    for (Index v = 0; v < x.rows(); ++v) {
      auto& distance = nearest[static_cast<std::size_t>(v)];
      distance = std::min(distance, (x.row(v) - x.row(next)).norm());
    }
    next = std::max_element(nearest.begin(), nearest.end()) - nearest.begin();
  }
  Matrix3d whole;
  for (Index c = 0; c < 3; ++c)
    whole.col(c) = frames.face_motion.apply_to_direction(Vector3d::Unit(c));
  std::vector<Matrix3d> maps;
  for (const Index place : places) {
    double sum = 0;
    Vector3d mean_x = Vector3d::Zero(), mean_y = Vector3d::Zero();
    const auto weight = [&](Index v) {
      return bump((x.row(v) - x.row(place)).norm() / (0.1 * kBallExtent));
    };
    for (Index v = 0; v < x.rows(); ++v) {
      sum += weight(v);
      mean_x += weight(v) * x.row(v).transpose();
      mean_y += weight(v) * y.row(v).transpose();
    }
    Matrix3d xx = Matrix3d::Zero(), yx = Matrix3d::Zero();
    for (Index v = 0; v < x.rows(); ++v) {
      const Vector3d dx = x.row(v).transpose() - mean_x / sum,
                     dy = y.row(v).transpose() - mean_y / sum;
      xx += weight(v) * dx * dx.transpose();
      yx += weight(v) * dy * dx.transpose();
    }
    const double rest = 0.02 * xx.trace();
    maps.emplace_back((yx + rest * whole) * (xx + rest * Matrix3d::Identity()).inverse());
  }
  for (std::size_t v = 0; v < static_cast<std::size_t>(x.rows()); v += 7) {
    Matrix3d expected = Matrix3d::Zero();
    double sum = 0;
    for (std::size_t p = 0; p < places.size(); ++p) {
      const double share =
          bump((x.row(static_cast<Index>(v)) - x.row(places[p])).norm() / (0.1 * kBallExtent));
      expected += share * maps[p];
      sum += share;
    }
    EXPECT_LT((field.map_at(v, frames) - expected / sum).cwiseAbs().maxCoeff(), 1e-9) << v;
  }
}

}  // namespace
}  // namespace crowdface
