// SPDX-License-Identifier: Apache-2.0
#include "crowdface/heads/expression_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "crowdface/core/text.h"
#include "crowdface/paint/face_marks.h"
#include "head_models/synth/synthetic_head.h"

namespace crowdface {
namespace {

HeadSet synthetic_heads(std::uint64_t count) {
  const SyntheticHeads made(5000);
  HeadSet faces{made.topology(), made.uvs(), {}};
  for (std::uint64_t h = 0; h < count; ++h) {
    faces.heads.push_back({concat("head_", h), made.positions(3, h)});
  }
  return faces;
}

std::string warnings_of(const HeadSet& head_set) {
  return join(odd_expressions(head_set, shape_of_mean(head_set).skin, HeadAxes(), 10));
}

/// Lets the jaw drop by 2 cm.
void open_mouth(const FaceMarks& marks, Positions& head) {
  for (Index v = 0; v < head.rows(); ++v) {
    if (head(v, 2) > 3 && head(v, 1) < marks.mouth) head(v, 1) -= 2;
  }
}

TEST(ExpressionCheck, TellsOneHeadThatGrimacesAmongNeutralOnes) {
  HeadSet faces = synthetic_heads(8);
  EXPECT_EQ(warnings_of(faces), "");
  const auto marks = find_face_marks(faces.topology, shape_of_mean(faces), HeadAxes());
  ASSERT_TRUE(marks);
  open_mouth(*marks, faces.heads[5].positions);
  EXPECT_THAT(warnings_of(faces),
              ::testing::AllOf(::testing::StartsWith("head_5: the shape of its mouth"),
                               ::testing::HasSubstr("is its expression neutral?"),
                               ::testing::Not(::testing::HasSubstr("eyes"))));
  faces.heads.resize(3);
  EXPECT_EQ(warnings_of(faces), "");
}

}  // namespace
}  // namespace crowdface
