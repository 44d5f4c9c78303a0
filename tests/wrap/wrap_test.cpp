// SPDX-License-Identifier: Apache-2.0
#include "crowdface/wrap/wrap.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "crowdface/core/parallel.h"
#include "crowdface/core/text.h"
#include "crowdface/wrap/report.h"
#include "crowdface/wrap/scan_face.h"
#include "crowdface/wrap/unfold.h"
#include "head_models/synth/synthetic_head.h"

#include "support/expect_error.h"
#include "wrap/truth_scan.h"

namespace crowdface::testing {
namespace {

constexpr double kMmPerCm = 10;

WrapTemplate synthetic(Index vertices, std::uint64_t index, const TemplateOptions& options = {}) {
  const SyntheticHeads heads(vertices, SyntheticHeads::Parts::kEyesAndTeeth);
  return make_template(heads.topology(), kMmPerCm * heads.positions(1, index), {}, options);
}

/// Landmarks far from each other on the visible skin, the first the foremost vertex.
std::vector<WrapLandmark> spread_landmarks(const WrapTemplate& head, std::size_t count) {
  const Positions skin = head.skin.rows_of(head.positions);
  Eigen::VectorXd distances = Eigen::VectorXd::Constant(skin.rows(), 1e300);
  for (Index v = 0; v < skin.rows(); ++v) {
    if (head.skin.ambient_visibility[static_cast<std::size_t>(v)] < 0.4) distances(v) = -1;
  }
  Index next = 0;
  skin.col(2).maxCoeff(&next);
  std::vector<WrapLandmark> landmarks;
  while (landmarks.size() < count) {
    landmarks.push_back({concat("landmark_", landmarks.size()),
                         head.skin.vertices[static_cast<std::size_t>(next)],
                         {}});
    distances = distances.cwiseMin((skin.rowwise() - skin.row(next)).rowwise().norm());
    distances.maxCoeff(&next);
  }
  return landmarks;
}

double percentile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

/// How far the wrapped vertices of the visible skin are from the head's own, in millimetres.
std::vector<double> errors_of(const WrapTemplate& head, const TruthScan& truth,
                              const WrapResult& result) {
  const Positions found = inverse(truth.pose).apply(result.pose.apply(result.positions));
  std::vector<double> errors;
  for (std::size_t i = 0; i < head.skin.vertices.size(); ++i) {
    const auto v = static_cast<Index>(head.skin.vertices[i]);
    if (head.skin.ambient_visibility[i] > 0.12) {
      errors.push_back((found.row(v) - head.positions.row(v)).norm());
    }
  }
  return errors;
}

class WrapAtTwoSizes : public ::testing::TestWithParam<Index> {};

TEST_P(WrapAtTwoSizes, FindsAHeadItHasNeverSeen) {
  const WrapTemplate shape = synthetic(GetParam(), 1), head = synthetic(GetParam(), 2);
  const TruthScan truth =
      make_truth_scan(head, spread_landmarks(head, 16), {.triangles = 40000, .seed = 3});
  const WrapResult result = wrap(shape, nullptr, truth.scan, truth.landmarks, std::nullopt);
  const std::vector<double> errors = errors_of(head, truth, result);
  EXPECT_LT(percentile(errors, 0.5), 1.8);
  EXPECT_LT(percentile(errors, 0.95), 6);
  EXPECT_LT(measure_distances(shape, result).percentile_95_mm, 0.5);
  EXPECT_EQ(result.folded_triangle_count, 0);
  EXPECT_NEAR(result.pose.scale / truth.pose.scale, 1, 0.1);
  EXPECT_TRUE(result.positions.allFinite());
  EXPECT_NO_THROW(refuse_bad_wrap(shape, result, {}));
}
INSTANTIATE_TEST_SUITE_P(Vertices, WrapAtTwoSizes, ::testing::Values(5000, 16000));

/// A head as a scan in centimetres that stands in no particular way, with a crown four times as high.
TEST(Wrap, AFaceIsFoundInAnyTurnAndBelowAHighCrown) {
  constexpr double kCrownMm = 60, kTimes = 4, kCm = 0.1;
  const WrapTemplate shape = synthetic(5000, 1), head = synthetic(5000, 2);
  Positions crowned = head.positions;
  for (double& height : crowned.col(1)) {
    if (height > kCrownMm) height = kCrownMm + kTimes * (height - kCrownMm);
  }
  for (const double degrees : {0.0, 100.0, 230.0}) {
    SCOPED_TRACE(degrees);
    Similarity turn;
    turn.rotation =
        Eigen::AngleAxisd(degrees * std::numbers::pi / 180, Eigen::Vector3d(1, 2, 3).normalized())
            .toRotationMatrix();
    turn.scale = kCm;
    const Scan scan{turn.apply(head.skin.rows_of(crowned)), head.skin.triangles};
    const auto face = find_scan_face(scan, std::nullopt);
    ASSERT_TRUE(face);
    WrapResult result = wrap(shape, nullptr, scan, {}, PoseHint{face->axes.up, face->axes.front});
    const Positions found = inverse(turn).apply(result.pose.apply(result.positions));
    std::vector<double> errors;
    for (const std::uint32_t v : head.skin.vertices) {
      const Eigen::Vector3d place = row3(head.positions, v);
      const bool is_face = place.z() > 50 && std::abs(place.y() + 40) < 70;
      if (is_face) errors.push_back((row3(found, v) - place).norm());
    }
    EXPECT_LT(percentile(errors, 0.5), 4) << "where each place of the face ends";
    ASSERT_TRUE(result.eye_midpoint_difference_mm);
    EXPECT_LT(*result.eye_midpoint_difference_mm, 10);
    result.eye_midpoint_difference_mm = 150;
    expect_error(ExitCode::kBadData, {""}, [&] { refuse_bad_wrap(shape, result, {}); });
  }
}

/// Rotations that are far from all axis-aligned orientations.
TEST(Wrap, AFaceIsFoundInRandomRotations) {
  const WrapTemplate head = synthetic(5000, 2);
  for (const std::uint64_t seed : {1, 2, 3}) {
    const TruthScan truth = make_truth_scan(head, {}, {.triangles = 20000, .seed = seed});
    const auto face = find_scan_face(truth.scan, std::nullopt);
    ASSERT_TRUE(face) << seed;
    EXPECT_GT(face->axes.up.dot(truth.pose.rotation.col(1)), 0.9) << seed;
    EXPECT_GT(face->axes.front.dot(truth.pose.rotation.col(2)), 0.9) << seed;
  }
}

TEST(Wrap, ATemplateThatIsTheScanStaysWhereItIs) {
  const WrapTemplate shape = synthetic(5000, 1);
  const Scan scan{shape.skin.rows_of(shape.positions), shape.skin.triangles};
  std::vector<WrapLandmark> landmarks = spread_landmarks(shape, 8);
  for (WrapLandmark& landmark : landmarks) {
    landmark.scan_position = shape.positions.row(landmark.vertex).transpose();
  }
  const WrapResult result = wrap(shape, nullptr, scan, landmarks, std::nullopt);
  const Eigen::VectorXd moved = (result.positions - shape.positions).rowwise().norm();
  EXPECT_LT(percentile({moved.begin(), moved.end()}, 0.99), 0.01);
  EXPECT_LT(moved.maxCoeff(), 0.5);
}

// Moved by a tenth of a micrometre a scan gave another head, by millimetres where it shows nothing.
TEST(Wrap, DoesNotHangOnWhereTheScanStands) {
  const WrapTemplate shape = synthetic(5000, 1), head = synthetic(5000, 2);
  const TruthScan truth =
      make_truth_scan(head, spread_landmarks(head, 16), {.triangles = 20000, .seed = 3});
  const WrapResult there = wrap(shape, nullptr, truth.scan, truth.landmarks, std::nullopt);
  for (const double by : {1e-4, 5000.0}) {
    Scan scan = truth.scan;
    scan.positions.col(0).array() += by;
    std::vector<WrapLandmark> landmarks = truth.landmarks;
    for (WrapLandmark& landmark : landmarks) landmark.scan_position.x() += by;
    const WrapResult moved = wrap(shape, nullptr, scan, landmarks, std::nullopt);
    EXPECT_LT((moved.positions - there.positions).rowwise().norm().maxCoeff(), 0.05) << by;
    EXPECT_NEAR(moved.pose.translation.x() - there.pose.translation.x(), by, 1e-4);
  }
}

TEST(Wrap, AModelFindsAHeadBetterThanItsMean) {
  const SyntheticHeads heads(5000, SyntheticHeads::Parts::kEyesAndTeeth);
  std::vector<Positions> others;
  for (std::uint64_t i = 1; i <= 12; ++i) others.emplace_back(kMmPerCm * heads.positions(1, i));
  const ShapeModel whole = make_shape_model(others);
  const WrapTemplate shape = make_template(heads.topology(), whole.mean, {});
  const ShapeModel model = skin_model(whole, shape);
  const WrapTemplate head = make_template(heads.topology(), kMmPerCm * heads.positions(1, 20), {});
  const TruthScan truth =
      make_truth_scan(head, spread_landmarks(head, 16), {.triangles = 40000, .seed = 4});
  const auto median = [&](const ShapeModel* used) {
    return percentile(
        errors_of(head, truth, wrap(shape, used, truth.scan, truth.landmarks, std::nullopt)), 0.5);
  };
  const double with = median(&model), without = median(nullptr);
  EXPECT_LT(with, without);
  EXPECT_LT(with, 1.2);
}

TEST(Wrap, ALargeSkinIsBentByWayOfAReducedOne) {
  const WrapTemplate whole = synthetic(16000, 1), head = synthetic(16000, 2);
  const WrapTemplate shape = synthetic(16000, 1, {.max_vertices = 8000, .reduced_vertices = 4000});
  ASSERT_TRUE(shape.reduced_skin);
  EXPECT_NEAR(static_cast<double>(shape.reduced_skin->mesh.vertices.size()), 4000, 400);
  const TruthScan truth =
      make_truth_scan(head, spread_landmarks(head, 16), {.triangles = 40000, .seed = 3});
  const WrapResult result = wrap(shape, nullptr, truth.scan, truth.landmarks, std::nullopt);
  EXPECT_LT(percentile(errors_of(head, truth, result), 0.5), 1.9);
  EXPECT_LT(measure_distances(shape, result).percentile_95_mm, 0.5);
  EXPECT_EQ(result.folded_triangle_count, 0);
}

/// The scan's surface, pores and all, from a template of as many vertices that has none.
TEST(Wrap, ReliefOfTwiceTheEdgesSurvives) {
  const Index vertices = 40000;
  const TemplateOptions options{.max_vertices = 8000, .reduced_vertices = 5000};
  const WrapTemplate shape = synthetic(vertices, 1, options),
                     head = synthetic(vertices, 2, options);
  const Positions skin = head.skin.rows_of(head.positions);
  const Positions normals = vertex_normals_or_zero(head.skin.triangles, skin);
  std::vector<double> edges;
  for (const Triangle& t : head.skin.triangles) {
    if (head.skin.ambient_visibility[t[0]] > 0.3)
      edges.push_back((skin.row(t[0]) - skin.row(t[1])).norm());
  }
  // Pits and bumps two edges across, and so four from pit to pit.
  const double wave = 1.57 / percentile(edges, 0.5);
  Scan scan{skin, head.skin.triangles};
  double relief = 0;
  for (Index v = 0; v < skin.rows(); ++v) {
    const double height = 0.3 * std::sin(wave * skin(v, 0)) * std::sin(wave * skin(v, 1));
    scan.positions.row(v) += height * normals.row(v);
    relief += height * height / static_cast<double>(skin.rows());
  }
  std::vector<WrapLandmark> landmarks = spread_landmarks(head, 16);
  for (WrapLandmark& landmark : landmarks) {
    landmark.scan_position = head.positions.row(landmark.vertex).transpose();
  }
  const WrapResult result = wrap(shape, nullptr, scan, landmarks, std::nullopt);
  double missed = 0, count = 0;
  for (std::size_t v = 0; v < shape.skin.vertices.size(); ++v) {
    if (shape.skin.ambient_visibility[v] < 0.3 || result.lacks_data[v]) continue;
    missed += std::pow(result.distance_mm(static_cast<Index>(v)), 2);
    ++count;
  }
  EXPECT_LT(std::sqrt(missed / count), 0.35 * std::sqrt(relief));
  EXPECT_EQ(result.folded_triangle_count, 0);
}

TEST(Wrap, OneThreadGivesWhatManyGive) {
  const WrapTemplate shape = synthetic(5000, 1), head = synthetic(5000, 2);
  const TruthScan truth =
      make_truth_scan(head, spread_landmarks(head, 8), {.triangles = 20000, .seed = 5});
  const auto run = [&](int threads) {
    const ThreadLimit limit(threads);
    return wrap(shape, nullptr, truth.scan, truth.landmarks, std::nullopt).positions;
  };
  EXPECT_EQ(run(1), run(3));
}

TEST(Wrap, WithoutLandmarksTheWayItLooksIsEnough) {
  const WrapTemplate shape = synthetic(5000, 1), head = synthetic(5000, 2);
  TruthScan truth = make_truth_scan(head, {}, {.triangles = 30000, .moved = false, .seed = 6});
  // Another unit, lying on its back: up is −Z, the face looks along +Y.
  truth.pose.rotation << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  truth.pose.scale = 0.001;
  truth.scan.positions = truth.pose.apply(truth.scan.positions);
  const WrapResult result = wrap(shape, nullptr, truth.scan, {},
                                 PoseHint{-Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitY()});
  EXPECT_LT(measure_distances(shape, result).percentile_95_mm, 0.8);
  EXPECT_LT(percentile(errors_of(head, truth, result), 0.5), 4);
  expect_error(ExitCode::kBadData, {"at least 4", "--scan-up"},
               [&] { wrap(shape, nullptr, truth.scan, {}, std::nullopt); });
}

TEST(Wrap, AMisplacedLandmarkIsNamed) {
  const WrapTemplate shape = synthetic(5000, 1), head = synthetic(5000, 2);
  TruthScan truth = make_truth_scan(head, spread_landmarks(head, 16),
                                    {.triangles = 30000, .landmark_error_mm = 0.5, .seed = 7});
  truth.landmarks[5].scan_position += truth.pose.scale * Eigen::Vector3d(14, 14, 14);
  const WrapResult result = wrap(shape, nullptr, truth.scan, truth.landmarks, std::nullopt);
  for (std::size_t i = 0; i < result.landmarks.size(); ++i) {
    EXPECT_EQ(result.landmarks[i].is_outlier, i == 5)
        << result.landmarks[i].name << ' ' << result.landmarks[i].final_distance_mm;
  }
}

TEST(Wrap, LandmarksItDoesNotKnowTellHowFarPlacesAreOff) {
  const WrapTemplate shape = synthetic(5000, 1), head = synthetic(5000, 2);
  const TruthOptions options{.triangles = 20000, .landmark_error_mm = 0, .seed = 5};
  TruthScan truth = make_truth_scan(head, spread_landmarks(head, 13), options);
  const auto unseen =
      cross_validate_wrap(shape, nullptr, truth.scan, truth.landmarks, std::nullopt);
  ASSERT_EQ(unseen.size(), truth.landmarks.size());
  // The same by hand, of a landmark of the second fold.
  std::vector<WrapLandmark> others;
  for (std::size_t i = 0; i < truth.landmarks.size(); ++i) {
    if (i % 4 != 1) others.push_back(truth.landmarks[i]);
  }
  const WrapResult result = wrap(shape, nullptr, truth.scan, others, std::nullopt);
  const WrapLandmark& left_out = truth.landmarks[5];
  Positions place(1, 3);
  place << left_out.scan_position.transpose();
  const Positions picked = inverse(result.pose).apply(place);
  EXPECT_NEAR(unseen.at(left_out.name),
              (result.positions.row(left_out.vertex) - picked.row(0)).norm(), 1e-9);
  truth.landmarks.resize(kMinLandmarks);
  EXPECT_TRUE(
      cross_validate_wrap(shape, nullptr, truth.scan, truth.landmarks, std::nullopt).empty());
}

TEST(Wrap, LandmarksThatBelongElsewhereAreRefused) {
  const WrapTemplate shape = synthetic(5000, 1);
  std::vector<WrapLandmark> landmarks = spread_landmarks(shape, 12);
  const Scan scan{shape.skin.rows_of(shape.positions), shape.skin.triangles};
  for (std::size_t i = 0; i < landmarks.size(); ++i) {
    const auto& other = landmarks[(i + 5) % landmarks.size()];
    landmarks[i].scan_position = shape.positions.row(other.vertex).transpose();
  }
  expect_error(ExitCode::kBadData, {"do not match", "swapped"}, [&] {
    refuse_bad_wrap(shape, wrap(shape, nullptr, scan, landmarks, std::nullopt), {});
  });
}

TEST(Wrap, ATemplateWithoutSkinIsRefused) {
  Topology topology;
  topology.vertex_count = 3;
  topology.corner_vertices = {0, 1, 2};
  topology.face_offsets = {0, 3};
  expect_error(ExitCode::kBadData, {"skin of at least"},
               [&] { make_template(topology, Positions::Identity(3, 3), {}); });
}

TEST(Unfold, TurnsFoldedTrianglesBackAndTouchesNothingElse) {
  const WrapTemplate shape = synthetic(5000, 1);
  const Positions rest = shape.skin.rows_of(shape.positions);
  Positions folded = rest;
  const Index v = 2000;
  for (const std::uint32_t n : shape.skin.adjacency.items_of(v)) {
    folded.row(v) += 0.9 * (rest.row(n) - rest.row(v));
  }
  folded.row(v) += 2.5 * (rest.row(shape.skin.adjacency.items_of(v)[0]) - rest.row(v));
  ASSERT_FALSE(folded_triangles(shape.skin, rest, folded).empty());
  Positions mended = folded;
  EXPECT_EQ(repair_folded_triangles(shape.skin, rest, mended), 0);
  EXPECT_TRUE(folded_triangles(shape.skin, rest, mended).empty());
  Index changed = 0;
  for (Index i = 0; i < rest.rows(); ++i) changed += mended.row(i) == folded.row(i) ? 0 : 1;
  EXPECT_GT(changed, 0);
  EXPECT_LT(changed, 100);
}

}  // namespace
}  // namespace crowdface::testing
