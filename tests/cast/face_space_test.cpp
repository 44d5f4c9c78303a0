// SPDX-License-Identifier: Apache-2.0
// Distances without meshes, held against meshes.
#include "crowdface/cast/face_space.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "crowdface/blend/blend.h"
#include "crowdface/cast/cast_crowd.h"
#include "crowdface/cast/compared_area.h"
#include "crowdface/cast/face_search.h"
#include "crowdface/cast/sample_cells.h"
#include "crowdface/core/text.h"
#include "crowdface/mesh/alignment.h"
#include "crowdface/plane/layout.h"

#include "cast/any_face.h"
#include "support/meshes.h"

namespace crowdface {
namespace {

using testing::draw_any_face;

constexpr std::uint64_t kMaxLevel = 120;
constexpr double kMmPerUnit = 10;

/// Four bowls of 61 by 61 vertices that bulge differently, about 14 units wide, looking along +z.
class FaceSpaceTest : public ::testing::Test {
 protected:
  static constexpr std::uint32_t kSide = 60;

  FaceSpaceTest() {
    faces_.topology = testing::grid_topology(kSide, kSide);
    const Index count = faces_.topology.vertex_count;
    for (std::uint64_t h = 0; h < 4; ++h) {
      const Positions at = testing::random_positions(8, 50), size = testing::random_positions(8, h);
      Positions positions(count, 3);
      for (Index i = 0; i < count; ++i) {
        const double s = 2. * static_cast<double>(i % (kSide + 1)) / kSide - 1;
        const Index row = i / (kSide + 1);
        const double t = 2. * static_cast<double>(row) / kSide - 1;
        double z = 6 - 3 * (s * s + t * t);
        for (Index b = 0; b < 8; ++b) {
          const double ds = s - at(b, 0), dt = t - at(b, 1);
          z += 1.2 * size(b, 0) * std::exp(-8 * (ds * ds + dt * dt));
        }
        positions.row(i) << (7 + 0.4 * size(0, 1)) * s, 8 * t, z;
      }
      faces_.heads.push_back({std::string(1, static_cast<char>('a' + h)), positions});
    }
    regions_ = whole_head_weights(faces_.topology);
    adjacency_ = build_adjacency(faces_.topology);
    filter_.emplace(SmoothingOperator(adjacency_, Boundary::kFixed, OperatorKind::kUmbrella),
                    faces_.heads[0].positions);
    Positions mean = Positions::Zero(count, 3);
    for (const Head& head : faces_.heads) mean += head.positions / 4;
    samples_ = choose_face_samples(faces_.topology, find_components(adjacency_), mean, {2, 1}, 900);
    for (const Head& head : faces_.heads) {
      const NodeFields fields = filter_nodes(*filter_, nodes_, head.positions);
      trajectories_.push_back(sample_smoothing_trajectory(*filter_, nodes_, fields, samples_));
    }
    mean_ = mean;
    const SampleCells cells = find_sample_cells(adjacency_, mean, samples_);
    weights_ = sample_weights(cells, samples_,
                              compared_vertex_areas(faces_.topology, find_components(adjacency_),
                                                    mean, ComparedArea::kFront, {2, 1}));
    space_.emplace(space_of(faces_));
  }

  FaceSpace space_of(const HeadSet& head_set) const {
    return FaceSpace(
        sample_heads(head_set, regions_, samples_, trajectories_, kMaxLevel, kMmPerUnit), weights_);
  }

  std::vector<Recipe> crowd(std::uint64_t count) const {
    CastingOptions casting;
    casting.name = "mob";
    casting.count = count;
    casting.anchors = circle_layout(4);
    casting.region_names = {"all"};
    casting.sampling.targets = {{0, 1}, {1, 1}, {2, 1}, {3, 1}};
    casting.sampling.sources = {0, 1, 2, 3};
    casting.sampling.regions.resize(1);
    casting.sampling.regions[0].extrapolation = {0.8, 1.3};
    casting.level_scale = {OperatorKind::kUmbrella, kMaxLevel, 2};
    std::vector<Recipe> crowd;
    for (std::uint64_t i = 1; i <= count; ++i) crowd.push_back(draw_any_face(casting, i).recipe);
    return crowd;
  }

  /// Rms distance over the face's area between two whole meshes, the second moved rigidly onto the
  /// first, in millimetres.
  double mesh_distance(const Positions& a, const Positions& b) const {
    // The face: what lies in front of the head's middle; each vertex stands for a share of area.
    std::vector<double> area(static_cast<std::size_t>(a.rows()), 0.0);
    for (Index f = 0; f < faces_.topology.face_count(); ++f) {
      for (const std::uint32_t v : faces_.topology.face(f)) {
        area[v] += face_area(f);
      }
    }
    const double middle = (mean_.col(2).maxCoeff() + mean_.col(2).minCoeff()) / 2;
    for (Index i = 0; i < a.rows(); ++i) {
      if (mean_(i, 2) < middle) area[static_cast<std::size_t>(i)] = 0;
    }
    return kMmPerUnit * face_distance(a, b, area);
  }
  double face_area(Index f) const {
    const auto face = faces_.topology.face(f);
    const Eigen::Vector3d d = (mean_.row(face[2]) - mean_.row(face[0])).transpose();
    const Eigen::Vector3d e = (mean_.row(face[3]) - mean_.row(face[1])).transpose();
    return d.cross(e).norm() / 2;
  }

  HeadSet faces_;
  RegionWeights regions_;
  Adjacency adjacency_;
  std::optional<ChebyshevFilter> filter_;
  LevelNodes nodes_{OperatorKind::kUmbrella, kMaxLevel};
  FaceSamples samples_;
  std::vector<Trajectory> trajectories_;
  std::optional<FaceSpace> space_;
  Positions mean_;
  std::vector<double> weights_;
};

TEST_F(FaceSpaceTest, DistancesAreThoseOfWholeMeshes) {
  std::vector<Recipe> faces = crowd(6);
  std::vector<FaceSpace::Point> points;
  std::vector<Positions> as_built, unit;
  for (Recipe recipe : faces) {
    points.push_back(space_->point(recipe));
    as_built.push_back(blend_exact(faces_, *filter_, regions_, recipe));
    recipe.regions[0].extrapolation = 1;
    unit.push_back(blend_exact(faces_, *filter_, regions_, recipe));
  }
  for (std::size_t a = 0; a < faces.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      const double expected =
          std::min(mesh_distance(as_built[a], as_built[b]), mesh_distance(unit[a], unit[b]));
      EXPECT_NEAR(FaceSpace::distance(points[a], points[b]), expected, 0.02 * expected);
    }
  }
}

/// The other side of the bowls' grid; \param next how much of the place is the next vertex instead.
MirrorMap mirror_of_grid(std::uint32_t side, double next) {
  MirrorMap map;
  for (std::uint32_t v = 0; v < (side + 1) * (side + 1); ++v) {
    const std::uint32_t column = v % (side + 1), partner = v + side - 2 * column;
    const std::uint32_t beside = column == side    ? partner + 1
                                 : column == 0     ? partner - 1
                                 : column % 2 == 0 ? partner - 1
                                                   : partner + 1;
    map.corners.push_back({partner, next > 0 ? beside : partner, partner});
    map.barycentric.push_back({1 - next, next, 0});
  }
  return map;
}

TEST_F(FaceSpaceTest, DistancesOfMirroredFacesAreThoseOfWholeMeshes) {
  for (const double next : {0.0, 0.4}) {
    const MirrorMap mirror = mirror_of_grid(kSide, next);
    samples_ = samples_and_mirror_images(
        choose_face_samples(faces_.topology, find_components(adjacency_), mean_, {2, 1}, 600),
        mirror);
    const FaceSamples traced = samples_and_mirror_corners(samples_, mirror);
    EXPECT_EQ(traced == samples_, next == 0);
    trajectories_.clear();
    for (const Head& head : faces_.heads) {
      const NodeFields fields = filter_nodes(*filter_, nodes_, head.positions);
      trajectories_.push_back(sample_smoothing_trajectory(*filter_, nodes_, fields, traced));
    }
    HeadsAtSamples heads =
        sample_heads(faces_, regions_, samples_, trajectories_, kMaxLevel, kMmPerUnit);
    heads.mirror_images = sample_mirror_images(faces_, regions_, mirror, samples_, traced, heads);
    const FaceSpace space(
        std::move(heads),
        sample_weights(find_sample_cells(adjacency_, mean_, samples_), samples_,
                       compared_vertex_areas(faces_.topology, find_components(adjacency_), mean_,
                                             ComparedArea::kFront, {2, 1})));
    EXPECT_EQ(space.head_point_count(), 8);
    const std::vector<Recipe> faces = crowd(2);
    std::vector<FaceSpace::Point> points;
    std::vector<Positions> as_built, unit;
    for (const Recipe& face : faces) {
      for (const auto& [asymmetry, is_mirrored] :
           {std::pair(1.0, false), {1.0, true}, {0.5, false}, {1.4, true}, {0.0, false}}) {
        Recipe recipe = face;
        recipe.asymmetry = asymmetry;
        recipe.mirrored = is_mirrored;
        points.push_back(space.point(recipe));
        const double w = mirror_image_weight(recipe);
        const auto built = [&](const Recipe& of) {
          const Positions blended = blend_exact(faces_, *filter_, regions_, of);
          return blend_with_mirrored(blended, mirrored(mirror, blended), w);
        };
        as_built.push_back(built(recipe));
        const Positions sampled = sample_face(space.heads_at_samples(), recipe);
        for (std::size_t s = 0; s < samples_.size(); ++s) {
          const Eigen::RowVector3d there = kMmPerUnit * as_built.back().row(samples_[s]);
          ASSERT_LT((sampled.row(static_cast<Index>(s)) - there).norm(), 0.05);
        }
        recipe.regions[0].extrapolation = 1;
        unit.push_back(built(recipe));
      }
    }
    EXPECT_GT(FaceSpace::distance(points[0], points[1]), 1) << "a face and its mirror image";
    for (std::size_t a = 0; a < points.size(); ++a) {
      for (std::size_t b = 0; b < a; ++b) {
        const double expected =
            std::min(mesh_distance(as_built[a], as_built[b]), mesh_distance(unit[a], unit[b]));
        EXPECT_NEAR(FaceSpace::distance(points[a], points[b]), expected, 0.03 * expected);
      }
    }
  }
}

TEST_F(FaceSpaceTest, DistancesOfBandsAreThoseOfWholeMeshes) {
  std::vector<Recipe> faces = crowd(12);
  const FaceSpace space(
      sample_heads(faces_, regions_, samples_, trajectories_, kMaxLevel, kMmPerUnit), weights_, 3);
  std::vector<FaceSpace::Point> points;
  std::vector<Positions> as_built, unit;
  for (std::size_t f = 0; f + 2 < faces.size(); f += 3) {
    RegionRecipe& region = faces[f].regions[0];
    for (std::size_t b = 1; b < 3; ++b) {
      BandRecipe& band = region.finer_bands.emplace_back(faces[f + b].regions[0]);
      band.iterations = band_of(region, b - 1).iterations / 10;
    }
    points.push_back(space.point(faces[f]));
    as_built.push_back(blend_exact(faces_, *filter_, regions_, faces[f]));
    for (std::size_t b = 0; b < 3; ++b) band_of(region, b).extrapolation = 1;
    unit.push_back(blend_exact(faces_, *filter_, regions_, faces[f]));
  }
  for (std::size_t a = 0; a < points.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      const double expected =
          std::min(mesh_distance(as_built[a], as_built[b]), mesh_distance(unit[a], unit[b]));
      EXPECT_NEAR(FaceSpace::distance(points[a], points[b]), expected, 0.02 * expected);
    }
  }
}

TEST_F(FaceSpaceTest, DistancesOfHeadsAreThoseOfWholeMeshes) {
  const Eigen::MatrixXd distances = space_->head_distances();
  ASSERT_EQ(distances.rows(), 4);
  for (Index a = 0; a < 4; ++a) {
    EXPECT_EQ(distances(a, a), 0);
    for (Index b = 0; b < a; ++b) {
      EXPECT_EQ(distances(a, b), distances(b, a));
      const double expected = mesh_distance(faces_.heads[static_cast<std::size_t>(a)].positions,
                                            faces_.heads[static_cast<std::size_t>(b)].positions);
      EXPECT_NEAR(distances(a, b), expected, 0.02 * expected);
    }
  }
}

TEST_F(FaceSpaceTest, TargetAloneLiesOnItsHead) {
  Recipe recipe = crowd(1)[0];
  recipe.target = 2;
  recipe.regions[0].weights = {{2, 1}};
  recipe.regions[0].extrapolation = 1;
  EXPECT_LT(FaceSpace::distance(space_->point(recipe), space_->head_point(2)), 1e-3);
  EXPECT_GT(FaceSpace::distance(space_->point(recipe), space_->head_point(1)), 1);
}

TEST_F(FaceSpaceTest, ExtrapolationAloneIsTheSamePerson) {
  Recipe recipe = crowd(1)[0];
  const auto point = [&](double e) {
    recipe.regions[0].extrapolation = e;
    return space_->point(recipe);
  };
  EXPECT_LT(FaceSpace::distance(point(0.8), point(1.3)), 1e-3);
  EXPECT_GT((point(0.8).coordinates_with_extrapolation - point(1.3).coordinates_with_extrapolation)
                .norm(),
            0.5)
      << "though the meshes differ";
}

TEST_F(FaceSpaceTest, RigidMotionOfAHeadChangesNoDistance) {
  HeadSet moved = faces_;
  Similarity motion;
  motion.rotation =
      Eigen::AngleAxisd(0.1, Eigen::Vector3d(1, 1, 0).normalized()).toRotationMatrix();
  motion.translation = {1, -2, 0.5};
  moved.heads[1].positions = motion.apply(moved.heads[1].positions);
  const FaceSpace space = space_of(moved);
  EXPECT_LT((space.head_distances() - space_->head_distances()).cwiseAbs().maxCoeff(), 0.05);
}

TEST_F(FaceSpaceTest, NearestIsTheNearestOfAll) {
  CastingResult cast;
  std::vector<Recipe> recipes = crowd(40);
  recipes[20] = recipes[7];  // a twin
  for (const Recipe& recipe : recipes) {
    cast.crowd.emplace_back().id = concat("mob_", cast.crowd.size());
    cast.points.push_back(space_->point(recipe));
  }
  find_nearest_neighbours(FaceJudge(*space_, {}, {}), cast);
  const auto& faces = cast.crowd;
  const auto& points = cast.points;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    ASSERT_TRUE(faces[i].notes.nearest);
    double head_mm = HUGE_VAL, crowd_mm = HUGE_VAL;
    Index head = -1;
    std::size_t nearest = i;
    for (Index h = 0; h < 4; ++h) {
      const double d = FaceSpace::distance(points[i], space_->head_point(h));
      if (d < head_mm) head = h, head_mm = d;
    }
    for (std::size_t j = 0; j < i; ++j) {
      const double d = FaceSpace::distance(points[i], points[j]);
      if (d < crowd_mm) nearest = j, crowd_mm = d;
    }
    EXPECT_EQ(faces[i].notes.nearest->head, head);
    EXPECT_NEAR(faces[i].notes.nearest->head_distance_mm, head_mm, 1e-3);
    EXPECT_EQ(faces[i].notes.nearest->earlier_face.has_value(), i > 0);
    if (i == 0) continue;
    EXPECT_EQ(*faces[i].notes.nearest->earlier_face, faces[nearest].id);
    EXPECT_NEAR(faces[i].notes.nearest->earlier_face_distance_mm, crowd_mm, 1e-3);
  }
  EXPECT_EQ(faces[20].notes.nearest->earlier_face, faces[7].id);
  EXPECT_LT(faces[20].notes.nearest->earlier_face_distance_mm, 1e-3);
}

TEST_F(FaceSpaceTest, CandidatesTooNearToTheCrowdCountInARound) {
  const std::vector<Recipe> recipes = crowd(3);
  CrowdSoFar so_far(space_->dimensions());
  so_far.begin_sampled_faces();
  so_far.add({}, space_->point(recipes[0]));
  DiversityOptions diversity;
  diversity.min_distance_mm = 0.01;
  BelievabilityOptions limits;
  limits.max_deviation = 1e6;
  const FaceJudge judge(*space_, diversity, limits);
  // Searches in rounds of four. `drawn[a]` is the recipe of attempt a.
  const auto search = [&](const std::vector<std::size_t>& drawn, std::uint64_t too_near) {
    std::size_t count = 0;
    FaceSearch faces(
        [&](std::uint32_t attempt) {
          count = std::max<std::size_t>(count, attempt + 1);
          FacePlan face;
          face.recipe = recipes[drawn.at(attempt)];
          face.notes.attempt = attempt;
          return face;
        },
        judge, diversity, 4);
    const auto found = faces.choose_face(so_far);
    EXPECT_EQ(count, drawn.size());
    EXPECT_EQ(faces.rejections().of(RejectionReason::kMinDistance), too_near);
    return found ? found->face.notes.attempt : 0;
  };
  EXPECT_EQ(search({0, 0, 1, 0}, 3), 2);
  EXPECT_EQ(search({0, 0, 0, 0, 0, 2, 0, 0}, 7), 5) << "none in the first round";
  const bool second_is_farther =
      FaceSpace::distance(space_->point(recipes[1]), space_->point(recipes[0])) <
      FaceSpace::distance(space_->point(recipes[2]), space_->point(recipes[0]));
  EXPECT_EQ(search({1, 0, 2, 0}, 2), second_is_farther ? 2 : 0);
}

TEST_F(FaceSpaceTest, MeshesAreJudgedWhereTheSamplesFindNothing) {
  const ProxySkin skin(
      cell_triangles(faces_.topology, find_sample_cells(adjacency_, mean_, samples_)),
      space_->heads_at_samples().mean, space_->heads_at_samples().heads);
  const Recipe recipe = crowd(1).front();
  int asked = 0;
  SkinDefects found{{}, 0};
  found.local.compared_triangle_count = 1000;
  BelievabilityOptions limits;
  limits.max_stretch = 1000;  // only what the mesh says is of interest
  limits.max_flipped = limits.max_intersecting = 0.5;
  const FaceJudge judge(*space_, {}, limits, &skin, [&](const Recipe&) {
    ++asked;
    return found;
  });
  EXPECT_EQ(judge.check_skin(recipe), std::nullopt);
  found.intersecting_triangle_count = 501;
  EXPECT_EQ(judge.check_skin(recipe), RejectionReason::kIntersecting);
  found.local.flipped_triangle_count = 501;
  EXPECT_EQ(judge.check_skin(recipe), RejectionReason::kFlipped);
  EXPECT_EQ(asked, 3);
  limits.max_stretch = 1;  // no face is stretched so little
  EXPECT_EQ(FaceJudge(*space_, {}, limits, &skin,
                      [&](const Recipe&) {
                        ++asked;
                        return found;
                      })
                .check_skin(recipe),
            RejectionReason::kStretched);
  EXPECT_EQ(asked, 3) << "a mesh is built only for what the samples let pass";
}

TEST_F(FaceSpaceTest, SampledFacesAreThoseOfWholeMeshes) {
  for (const Recipe& recipe : crowd(5)) {
    const Positions built = kMmPerUnit * blend_exact(faces_, *filter_, regions_, recipe);
    const Positions sampled = sample_face(space_->heads_at_samples(), recipe);
    for (std::size_t s = 0; s < samples_.size(); ++s) {
      EXPECT_LT((sampled.row(static_cast<Index>(s)) - built.row(samples_[s])).norm(), 0.05);
    }
  }
}

TEST_F(FaceSpaceTest, SamplesAreSpreadOverTheSkin) {
  EXPECT_NEAR(static_cast<double>(samples_.size()), 900, 60);
  EXPECT_TRUE(std::is_sorted(samples_.begin(), samples_.end()));
  EXPECT_EQ(std::set<std::uint32_t>(samples_.begin(), samples_.end()).size(), samples_.size());
  double left = 0, front = 0, counting = 0, sum = 0;
  const double middle = (mean_.col(2).maxCoeff() + mean_.col(2).minCoeff()) / 2;
  for (std::size_t s = 0; s < samples_.size(); ++s) {
    left += mean_(samples_[s], 0) < 0 ? 1 : 0;
    front += mean_(samples_[s], 2) > middle ? 1 : 0;
    counting += weights_[s] > 0 ? 1 : 0;
    sum += weights_[s];
  }
  EXPECT_NEAR(left, 450, 40);
  EXPECT_GT(front, 500) << "densest where the face is";
  EXPECT_GE(counting, front);
  EXPECT_NEAR(sum, 1, 1e-12);
  EXPECT_EQ(samples_,
            choose_face_samples(faces_.topology, find_components(adjacency_), mean_, {2, 1}, 900));
}

TEST_F(FaceSpaceTest, TrajectoriesAreTheLevels) {
  const auto levels = stored_smoothing_levels(kMaxLevel);
  EXPECT_EQ(levels.front(), 0U);
  EXPECT_EQ(levels.back(), kMaxLevel);
  EXPECT_TRUE(std::is_sorted(levels.begin(), levels.end()));
  EXPECT_EQ(std::set<std::uint64_t>(levels.begin(), levels.end()).size(), levels.size());
  const Positions& head = faces_.heads[0].positions;
  ASSERT_EQ(trajectories_[0].rows(), static_cast<Index>(levels.size()));
  for (const std::size_t l : {std::size_t{0}, std::size_t{5}, levels.size() - 1}) {
    Positions smoothed = head;
    for (std::uint64_t step = 0; step < levels[l]; ++step) {
      Positions next = smoothed;
      for (Index i = 0; i < head.rows(); ++i) {
        if (adjacency_.boundary[static_cast<std::size_t>(i)]) continue;
        next.row(i).setZero();
        for (const std::uint32_t j : adjacency_.items_of(i)) next.row(i) += smoothed.row(j) / 4;
      }
      smoothed = next;
    }
    for (std::size_t s = 0; s < samples_.size(); ++s) {
      for (Index c = 0; c < 3; ++c) {
        EXPECT_NEAR(trajectories_[0](static_cast<Index>(l), static_cast<Index>(3 * s) + c),
                    smoothed(samples_[s], c) - head(samples_[s], c), 1e-5);
      }
    }
  }
}

}  // namespace
}  // namespace crowdface
