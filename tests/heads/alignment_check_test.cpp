// SPDX-License-Identifier: Apache-2.0
#include "crowdface/heads/alignment_check.h"

#include <cmath>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "support/crowd_files.h"
#include "support/expect_error.h"
#include "support/meshes.h"
#include "support/small_crowd.h"

namespace crowdface {
namespace {

constexpr double kPi = 3.14159265358979;

/// Five bowls that differ like people do.
struct Bowls {
  HeadSet faces;
  Components components;
};
Bowls make_bowls() {
  Bowls bowls;
  bowls.faces.topology = testing::grid_topology(12, 12);
  for (std::uint64_t h = 0; h < 5; ++h) {
    Positions positions = 0.15 * testing::random_positions(169, h + 1);
    for (Index i = 0; i < 169; ++i) {
      const Index row = i / 13;
      const double s = static_cast<double>(i % 13) / 6 - 1, t = static_cast<double>(row) / 6 - 1;
      positions.row(i) += Eigen::RowVector3d(7 * s, 9 * t, 6 - 4 * s * s - 3 * t * t);
    }
    bowls.faces.heads.push_back({std::string(1, static_cast<char>('a' + h)), positions});
  }
  bowls.components = find_components(build_adjacency(bowls.faces.topology));
  return bowls;
}

Positions turned(const Positions& positions, double degrees) {
  return positions * Eigen::AngleAxisd(degrees * kPi / 180, Eigen::Vector3d(1, 2, 3).normalized())
                         .toRotationMatrix()
                         .transpose();
}

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(AlignmentCheck, HeadsInOneFrameAreNotMentioned) {
  Bowls bowls = make_bowls();
  for (const Align align : {Align::kCheck, Align::kRigid, Align::kNone}) {
    EXPECT_THAT(align_heads(bowls.faces, bowls.components, align), IsEmpty());
  }
}

TEST(AlignmentCheck, TurnedHeadIsNamedWithItsAngle) {
  for (std::size_t stray = 0; stray < 5; ++stray) {
    Bowls bowls = make_bowls();
    Positions& positions = bowls.faces.heads[stray].positions;
    positions = turned(positions, 15);
    const Positions before = positions;
    EXPECT_NEAR(head_poses(bowls.faces, bowls.components)[stray].angle_degrees, 15, 1);
    EXPECT_THAT(align_heads(bowls.faces, bowls.components, Align::kCheck),
                ElementsAre(AllOf(HasSubstr("head " + bowls.faces.heads[stray].name),
                                  HasSubstr("turned by 1"))));
    EXPECT_EQ(positions, before) << "check changes nothing";
    EXPECT_THAT(align_heads(bowls.faces, bowls.components, Align::kNone), IsEmpty());
    EXPECT_THAT(align_heads(bowls.faces, bowls.components, Align::kRigid), IsEmpty());
    EXPECT_LT(head_poses(bowls.faces, bowls.components)[stray].angle_degrees, 3);
  }
}

// The message said that the head is larger and turned.
TEST(AlignmentCheck, MirroredHeadIsRefused) {
  for (const Align align : {Align::kCheck, Align::kRigid}) {
    Bowls bowls = make_bowls();
    Positions& positions = bowls.faces.heads[3].positions;
    positions.col(0) *= -1;
    testing::expect_error(ExitCode::kBadData, {"head d is mirrored"},
                          [&] { align_heads(bowls.faces, bowls.components, align); });
    EXPECT_TRUE(align_heads(bowls.faces, bowls.components, Align::kNone).empty());
  }
}

TEST(AlignmentCheck, MovedHeadIsNamed) {
  Bowls bowls = make_bowls();
  bowls.faces.heads[2].positions.rowwise() += Eigen::RowVector3d(0, 3, 0);
  EXPECT_THAT(align_heads(bowls.faces, bowls.components, Align::kCheck),
              ElementsAre(AllOf(HasSubstr("head c"), HasSubstr("moved by"))));
  EXPECT_THAT(align_heads(bowls.faces, bowls.components, Align::kRigid), IsEmpty());
}

TEST(AlignmentCheck, RigidKeepsTheFirstHeadAndAllShapes) {
  Bowls bowls = make_bowls();
  bowls.faces.heads[3].positions = turned(bowls.faces.heads[3].positions, 40);
  const HeadSet before = bowls.faces;
  align_heads(bowls.faces, bowls.components, Align::kRigid);
  EXPECT_EQ(bowls.faces.heads[0].positions, before.heads[0].positions);
  for (std::size_t h = 0; h < 5; ++h) {
    const Positions &a = bowls.faces.heads[h].positions, &b = before.heads[h].positions;
    for (Index i = 1; i < a.rows(); ++i) {
      EXPECT_NEAR((a.row(i) - a.row(i - 1)).norm(), (b.row(i) - b.row(i - 1)).norm(), 1e-12);
    }
  }
}

TEST(AlignmentCheck, UnitsMixUpIsNamedAndNotCorrected) {
  for (const double factor : {10.0, 0.1, 2.54}) {
    Bowls bowls = make_bowls();
    bowls.faces.heads[1].positions *= factor;
    EXPECT_NEAR(head_poses(bowls.faces, bowls.components)[1].scale, factor, 0.05 * factor);
    for (const Align align : {Align::kCheck, Align::kRigid}) {
      if (factor == 2.54) {
        EXPECT_THAT(align_heads(bowls.faces, bowls.components, align),
                    ElementsAre(AllOf(HasSubstr("head b"), HasSubstr("units"))));
      } else {
        testing::expect_error(ExitCode::kBadData, {"head b", "one unit"},
                              [&] { align_heads(bowls.faces, bowls.components, align); });
      }
    }
    EXPECT_THAT(align_heads(bowls.faces, bowls.components, Align::kNone), ::testing::IsEmpty());
  }
}

TEST(AlignmentCheck, WarningsReachTheReportOnce) {
  testing::SmallCrowd crowd;
  crowd.count = 1;
  const testing::SmallCrowdFolder folder(crowd);
  testing::Bowl far = crowd.bowl;
  far.per_cm = 2;
  folder.folder().write("heads/bob.obj", testing::bowl_text(far, 2));
  run(folder, {"faces.align=check"});
  const auto warnings = testing::read_json(folder.out() / "report.json").at("warnings");
  ASSERT_EQ(warnings.size(), 1U) << warnings.dump();
  EXPECT_THAT(warnings[0].get<std::string>(), HasSubstr("bob"));
  EXPECT_THAT(testing::read_text(folder.out() / "crowdface.log"),
              HasSubstr(warnings[0].get<std::string>()));
}

}  // namespace
}  // namespace crowdface
