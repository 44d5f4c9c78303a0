// SPDX-License-Identifier: Apache-2.0
#include "crowdface/parts/part_list.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "head_models/synth/synthetic_head.h"

#include "parts/scene.h"

namespace crowdface {
namespace {

using ::testing::ElementsAre;
using testing::HeadComponent;

PartList parts_of(const Mesh& mesh, const PartOverrides& overrides = {}) {
  const Adjacency adjacency = build_adjacency(mesh.topology);
  return find_parts(mesh.topology, adjacency, find_components(adjacency), mesh.positions,
                    overrides);
}

TEST(Parts, AreToldApartByTheirShapes) {
  const PartList list = parts_of(testing::simple_head());
  EXPECT_THAT(list.classes, ElementsAre(PartClass::kSkin, PartClass::kRigid, PartClass::kRigid,
                                        PartClass::kRigid, PartClass::kRigid, PartClass::kRigid,
                                        PartClass::kBound, PartClass::kSkin));
  ASSERT_EQ(list.parts.size(), 4U);
  EXPECT_THAT(list.parts[0].components,
              ElementsAre(HeadComponent::kLeftEye, HeadComponent::kLeftIris))
      << "what lies inside an eyeball is part of it";
  EXPECT_TRUE(list.parts[0].is_eyeball);
  EXPECT_THAT(list.parts[1].components, ElementsAre(HeadComponent::kRightEye));
  EXPECT_TRUE(list.parts[1].is_eyeball);
  EXPECT_THAT(list.parts[2].components,
              ElementsAre(HeadComponent::kFirstTooth, HeadComponent::kSecondTooth))
      << "teeth side by side";
  EXPECT_FALSE(list.parts[2].is_eyeball);
  EXPECT_EQ(list.parts[3].part_class, PartClass::kBound);
}

TEST(Parts, KeepTheTeethOfTheTwoJawsApart) {
  testing::Shapes shapes;
  shapes.ball({0, 0, 0}, 10, 32);
  for (const double bottom : {-3.5, -2.45}) {  // two rows that nearly touch, of three teeth each
    for (const double x : {-1.5, -0.5, 0.5}) {
      shapes.box({x, bottom, 8.2}, {x + 0.95, bottom + 1, 8.7});
    }
  }
  const Mesh mesh = shapes.mesh();
  const PartList list = parts_of(mesh);
  ASSERT_EQ(list.parts.size(), 2U);
  EXPECT_THAT(list.parts[0].components, ElementsAre(1, 2, 3));
  EXPECT_THAT(list.parts[1].components, ElementsAre(4, 5, 6));
  PartOverrides overrides;
  overrides.joined_components = {{1, 2, 3, 4, 5, 6}};
  EXPECT_EQ(parts_of(mesh, overrides).parts.size(), 1U) << "what is said by hand counts";
}

TEST(Parts, KnowAnEyeballsSurface) {
  const PartList list = parts_of(testing::simple_head());
  const Part& eye = list.parts[0];
  EXPECT_EQ(eye.ball_component, HeadComponent::kLeftEye);
  EXPECT_EQ(static_cast<Index>(eye.ball_vertices.size()),
            list.shapes[HeadComponent::kLeftEye].vertex_count);
  EXPECT_TRUE(list.parts[2].ball_vertices.empty());
}

TEST(Parts, DoNotDependOnUnitsOrPlace) {
  Mesh mesh = testing::simple_head();
  const PartList cm = parts_of(mesh);
  mesh.positions = testing::moved(mesh.positions, 0.7, 10, {100, -50, 3});
  const PartList mm = parts_of(mesh);
  EXPECT_EQ(cm.classes, mm.classes);
  ASSERT_EQ(cm.parts.size(), mm.parts.size());
  for (std::size_t p = 0; p < cm.parts.size(); ++p) {
    EXPECT_EQ(cm.parts[p].components, mm.parts[p].components);
  }
}

TEST(Parts, OfOneComponentAreNone) {
  const Mesh mesh = testing::Shapes().ball({0, 0, 0}, 10).mesh();
  EXPECT_TRUE(parts_of(mesh).parts.empty());
}

TEST(Parts, FollowWhatIsSaidByHand) {
  PartOverrides overrides;
  overrides.classes.resize(8);
  overrides.classes[HeadComponent::kRightEye] = PartClass::kSkin;
  overrides.classes[HeadComponent::kLash] = PartClass::kRigid;
  overrides.joined_components = {{HeadComponent::kLeftIris, HeadComponent::kLash}};
  const PartList list = parts_of(testing::simple_head(), overrides);
  EXPECT_EQ(list.classes[HeadComponent::kRightEye], PartClass::kSkin);
  ASSERT_EQ(list.parts.size(), 3U);
  EXPECT_THAT(list.parts[0].components, ElementsAre(HeadComponent::kLeftEye));
  EXPECT_THAT(list.parts[1].components,
              ElementsAre(HeadComponent::kLeftIris, HeadComponent::kLash));
  EXPECT_EQ(list.parts[1].part_class, PartClass::kRigid);
}

TEST(Parts, HaveClosednessOfAnyResolution) {
  for (const int n : {4, 40}) {
    const Mesh mesh =
        testing::Shapes().ball({0, 0, 0}, 10, 32).strip({0, 0, 10}, {4, 0, 0}, {0, 1, 0}, n).mesh();
    const PartList list = parts_of(mesh);
    EXPECT_EQ(list.shapes[0].isoperimetric_ratio, 0);
    EXPECT_NEAR(list.shapes[1].isoperimetric_ratio, 10.0 * 10 / (4 * 3.14159265 * 4), 0.4) << n;
  }
}

TEST(Parts, OfVeryManyComponentsAreFound) {
  constexpr int kAlong = 28;  // 21,952 components
  testing::Shapes shapes;
  shapes.ball({0, 0, 0}, 10, 32);
  for (int i = 0; i < kAlong * kAlong * kAlong; ++i) {
    const int x = i % kAlong, y = i / kAlong % kAlong, z = i / kAlong / kAlong;
    const Eigen::Vector3d cell(x, y, z);
    if (i % 2 == 0) {
      shapes.tetrahedron({20 + cell.x(), cell.y(), cell.z()}, 0.01);  // by itself
    } else {
      shapes.tetrahedron({-20 + 1e-4 * cell.x(), 1e-4 * cell.y(), 1e-4 * cell.z()}, 0.01);
    }
  }
  const Mesh mesh = shapes.mesh();
  const PartList list = parts_of(mesh);
  ASSERT_EQ(list.parts.size(), 1U + kAlong * kAlong * kAlong / 2);
  EXPECT_THAT(list.parts[0].components, ElementsAre(1));
  EXPECT_EQ(list.parts[1].components.size(), kAlong * kAlong * kAlong / 2U);
}

TEST(JoinSkin, MakesOneOfAllSkin) {
  const Mesh mesh = testing::simple_head();
  const Components components = find_components(build_adjacency(mesh.topology));
  PartOverrides overrides;
  overrides.classes.resize(8);
  overrides.classes[HeadComponent::kRightEye] = PartClass::kSkin;
  const Components joined = join_skin(components, parts_of(mesh, overrides));
  EXPECT_EQ(joined.largest(), HeadComponent::kSkinBall);
  EXPECT_EQ(joined.sizes[0], components.sizes[0] + components.sizes[HeadComponent::kRightEye]);
  for (std::size_t v = 0; v < joined.component_of_vertex.size(); ++v) {
    const std::uint32_t c = components.component_of_vertex[v];
    EXPECT_EQ(joined.component_of_vertex[v], c == HeadComponent::kRightEye ? 0U : c);
  }
}

// Rows of teeth were eyeballs from 400,000 vertices on.
TEST(Parts, OfAHeadAreTheSameAtEveryResolution) {
  for (const Index vertices : {5000, 20000, 150000, 400000, 1200000}) {
    SCOPED_TRACE(vertices);
    const SyntheticHeads heads(vertices, SyntheticHeads::Parts::kEyesAndTeeth);
    const PartList list = parts_of({heads.topology(), heads.positions(1, 1), heads.uvs()});
    std::vector<bool> eyeballs;
    for (const Part& part : list.parts) {
      EXPECT_EQ(part.part_class, PartClass::kRigid);
      EXPECT_EQ(part.components.size(), 1U);
      eyeballs.push_back(part.is_eyeball);
    }
    EXPECT_EQ(eyeballs, (std::vector<bool>{true, true, false, false}));
  }
}

}  // namespace
}  // namespace crowdface
