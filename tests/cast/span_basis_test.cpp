// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/span_basis.h"

#include <Eigen/SVD>
#include <gtest/gtest.h>

#include "crowdface/core/parallel.h"
#include "crowdface/core/random.h"

namespace crowdface {
namespace {

using Eigen::Index;

/// 200 rows in a space of 6 dimensions out of 90.
FloatRows low_rank_rows() {
  const auto draw = [](const char* what, Index i, Index j) {
    return static_cast<float>(
        random_pair({1, static_cast<std::uint64_t>(i), what, 0}, static_cast<std::uint32_t>(j))[0] -
        0.5);
  };
  FloatRows rows = FloatRows::Zero(200, 90);
  for (Index n = 0; n < 200; ++n) {
    for (Index r = 0; r < 6; ++r) {
      for (Index s = 0; s < 90; ++s) rows(n, s) += 10 * draw("left", n, r) * draw("right", r, s);
    }
  }
  return rows;
}

TEST(SpanBasis, KeepsRowsAndTheirProducts) {
  const FloatRows rows = low_rank_rows();
  const SpanBasis basis = span_basis(rows, 1e-3, 50);
  EXPECT_EQ(basis.directions.rows(), 6);
  const Eigen::MatrixXf gram = basis.directions * basis.directions.transpose();
  EXPECT_LT((gram - Eigen::MatrixXf::Identity(6, 6)).cwiseAbs().maxCoeff(), 1e-4);
  EXPECT_LT((basis.coordinates * basis.directions - rows).rowwise().norm().maxCoeff(), 2e-3);
}

TEST(SpanBasis, StopsAtTheToleranceOrTheCount) {
  const FloatRows rows = low_rank_rows();
  EXPECT_EQ(span_basis(rows, 1e-3, 4).directions.rows(), 4);
  const SpanBasis coarse = span_basis(rows, 20, 50);
  EXPECT_LT(coarse.directions.rows(), 6);
  EXPECT_LE((coarse.coordinates * coarse.directions - rows).rowwise().norm().maxCoeff(), 20.01);
  EXPECT_EQ(span_basis(FloatRows::Zero(5, 7), 1e-3, 4).directions.rows(), 0);
  EXPECT_EQ(span_basis(FloatRows(0, 7), 1e-3, 4).directions.rows(), 0);
}

TEST(SpanBasis, PrincipalDirectionsHoldMostWithFewCoordinates) {
  const FloatRows rows = low_rank_rows();
  const SpanBasis span = span_basis(rows, 1e-3, 50);
  const SpanBasis all = principal_basis(span, 1e-3);
  ASSERT_EQ(all.directions.rows(), 6);
  const Eigen::MatrixXf gram = all.directions * all.directions.transpose();
  EXPECT_LT((gram - Eigen::MatrixXf::Identity(6, 6)).cwiseAbs().maxCoeff(), 1e-4);
  EXPECT_LT((all.coordinates * all.directions - rows).rowwise().norm().maxCoeff(), 2e-3);
  // The lengths of the columns of coordinates are the singular values of the rows.
  const Eigen::VectorXf singular = Eigen::JacobiSVD<Eigen::MatrixXf>(rows).singularValues();
  for (Index p = 0; p < 6; ++p)
    EXPECT_NEAR(all.coordinates.col(p).norm(), singular[p], 1e-4F * singular[0]);

  // without the last direction, the longest remainder is the largest last coordinate
  const float last = all.coordinates.col(5).cwiseAbs().maxCoeff();
  EXPECT_EQ(principal_basis(span, 1.01 * static_cast<double>(last)).directions.rows(), 5);
  EXPECT_EQ(principal_basis(span, 0.99 * static_cast<double>(last)).directions.rows(), 6);
  EXPECT_EQ(principal_basis(span_basis(FloatRows::Zero(5, 7), 1e-3, 4), 1).directions.rows(), 0);
}

TEST(SpanBasis, SameBitsOnOneThread) {
  const FloatRows rows = low_rank_rows();
  const SpanBasis many = span_basis(rows, 1e-3, 50);
  const ThreadLimit one(1);
  const SpanBasis alone = span_basis(rows, 1e-3, 50);
  EXPECT_EQ(many.directions, alone.directions);
  EXPECT_EQ(many.coordinates, alone.coordinates);
}

}  // namespace
}  // namespace crowdface
