// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/attachment_draw.h"

#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace crowdface {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// Two heads: a woman and an old man.
AttachmentDraw draw_of(std::vector<AttachmentItem> items, std::map<std::string, double> none = {}) {
  return {7, std::move(items), std::move(none), {{"female"}, {"male", "old"}}};
}

CastFace face_of(std::uint64_t index, Index target = 0) {
  CastFace face;
  face.id = "crowd_" + std::to_string(index);
  face.index = index;
  face.recipe.target = target;
  return face;
}

std::map<std::string, double> shares_of(const AttachmentDraw& draw, Index target = 0) {
  constexpr std::uint64_t kFaces = 20000;
  std::map<std::string, double> shares;
  for (std::uint64_t i = 1; i <= kFaces; ++i) {
    for (const std::string& name : draw_attachments(draw, face_of(i, target))) {
      shares[name] += 1.0 / kFaces;
    }
  }
  return shares;
}

TEST(AttachmentDraw, FollowsSharesAndNone) {
  const auto shares = shares_of(draw_of({{"bob", "hair", {}, 3, {}},
                                         {"bun", "hair", {}, 1, {}},
                                         {"wig", "hair", {}, 0, {}},
                                         {"round", "glasses", {}, 1, {}}},
                                        {{"glasses", 0.8}, {"hair", 0.1}}));
  EXPECT_NEAR(shares.at("bob"), 0.675, 0.015);
  EXPECT_NEAR(shares.at("bun"), 0.225, 0.015);
  EXPECT_NEAR(shares.at("round"), 0.2, 0.015);
  EXPECT_FALSE(shares.contains("wig"));
}

TEST(AttachmentDraw, GivesAtMostOneOfAKind) {
  const AttachmentDraw draw = draw_of({{"bob", "hair", {}, 1, {}}, {"bun", "hair", {}, 1, {}}});
  for (std::uint64_t i = 1; i < 100; ++i) {
    EXPECT_EQ(draw_attachments(draw, face_of(i)).size(), 1U);
  }
}

TEST(AttachmentDraw, IsForTargetsWithAllTags) {
  const AttachmentDraw draw = draw_of({{"bob", "hair", {"female"}, 1, {}},
                                       {"rim", "hair", {"male", "old"}, 1, {}},
                                       {"quiff", "hair", {"male", "young"}, 1, {}}});
  EXPECT_THAT(draw_attachments(draw, face_of(1, 0)), ElementsAre("bob"));
  EXPECT_THAT(draw_attachments(draw, face_of(1, 1)), ElementsAre("rim"));
}

TEST(AttachmentDraw, TakesAwayWhatIsExcluded) {
  EXPECT_THAT(draw_attachments(draw_of({{"bob", "hair", {}, 1, {}},
                                        {"cap", "hat", {}, 1, {"hair", "round"}},
                                        {"round", "glasses", {}, 1, {}},
                                        {"patch", "eye", {}, 1, {}}}),
                               face_of(1)),
              ElementsAre("cap", "patch"));
  EXPECT_THAT(
      draw_attachments(draw_of({{"cap", "hat", {}, 1, {"hair"}}, {"bob", "hair", {}, 1, {"cap"}}}),
                       face_of(1)),
      ElementsAre("cap"))
      << "of two that exclude each other the first stays";
}

/// Face 7 keeps its hair whatever else is drawn for it, how it was found and how many faces there are.
TEST(AttachmentDraw, DependsOnIndexAndKindAlone) {
  const std::vector<AttachmentItem> hair = {{"bob", "hair", {}, 1, {}}, {"bun", "hair", {}, 1, {}}};
  std::vector<AttachmentItem> more = hair;
  more.insert(more.begin(), {"round", "glasses", {}, 1, {}});
  std::size_t bobs = 0;
  for (std::uint64_t i = 1; i < 200; ++i) {
    CastFace other = face_of(i);
    other.id = "another";
    other.notes.attempt = 9;
    const auto names = draw_attachments(draw_of(hair), face_of(i));
    EXPECT_EQ(draw_attachments(draw_of(hair), other), names);
    EXPECT_THAT(draw_attachments(draw_of(more), face_of(i)), Contains(names.at(0)));
    bobs += names.at(0) == "bob" ? 1 : 0;
  }
  EXPECT_GT(bobs, 60U);
  EXPECT_LT(bobs, 140U);
}

TEST(AttachmentDraw, GoesByTheIdOfFacesThatAreNotSampled) {
  const AttachmentDraw draw = draw_of({{"bob", "hair", {}, 1, {}}, {"bun", "hair", {}, 1, {}}});
  std::map<std::string, int> found;
  for (int i = 0; i < 100; ++i) {
    CastFace face = face_of(1);
    face.index.reset();
    face.id = "kin_" + std::to_string(i);
    ++found[draw_attachments(draw, face).at(0)];
  }
  EXPECT_EQ(found.size(), 2U);
}

TEST(AttachmentDraw, LeavesAllWithoutAKindThatNobodyWears) {
  EXPECT_THAT(draw_attachments(draw_of({{"bob", "hair", {}, 1, {}}}, {{"hair", 1}}), face_of(3)),
              IsEmpty());
}

}  // namespace
}  // namespace crowdface
