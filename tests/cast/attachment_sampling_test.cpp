// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/attachment_sampling.h"

#include <algorithm>
#include <map>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace crowdface {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// Two heads: a woman and an old man.
AttachmentOptions draw_of(std::vector<AttachmentItem> items,
                          std::map<std::string, double> none = {}) {
  return {7, std::move(items), {{"", std::move(none)}}, {{"female"}, {"male", "old"}}};
}

FacePlan face_of(std::uint64_t index, Index target = 0) {
  FacePlan face;
  face.id = "crowd_" + std::to_string(index);
  face.index = index;
  face.recipe.target = target;
  return face;
}

/// Of a face that stands alone.
std::vector<std::string> attachments_of(const AttachmentOptions& draw, const FacePlan& face) {
  std::vector<FacePlan> crowd = {face};
  choose_attachments(draw, {}, crowd);
  return crowd[0].attachments;
}

std::size_t count(const std::vector<FacePlan>& crowd, const std::string& name) {
  return static_cast<std::size_t>(std::count_if(crowd.begin(), crowd.end(), [&](const auto& face) {
    return std::find(face.attachments.begin(), face.attachments.end(), name) !=
           face.attachments.end();
  }));
}

/// Sampled faces, women and men by turns.
std::vector<FacePlan> crowd_of(std::uint64_t faces) {
  std::vector<FacePlan> crowd;
  for (std::uint64_t i = 1; i <= faces; ++i) {
    crowd.push_back(face_of(i, static_cast<Index>(i % 2)));
  }
  return crowd;
}

std::vector<int> groups_of(const std::vector<FacePlan>& crowd) {
  std::vector<int> groups;
  for (const FacePlan& face : crowd) groups.push_back(static_cast<int>(face.recipe.target));
  return groups;
}

std::map<std::string, double> shares_of(const AttachmentOptions& draw, Index target = 0) {
  constexpr std::uint64_t kFaces = 20000;
  std::map<std::string, double> shares;
  for (std::uint64_t i = 1; i <= kFaces; ++i) {
    for (const std::string& name : attachments_of(draw, face_of(i, target))) {
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

TEST(AttachmentDraw, FollowsNoneOfTheGroup) {
  AttachmentOptions draw = draw_of({{"bob", "hair", {}, 1, {}}, {"round", "glasses", {}, 1, {}}},
                                   {{"hair", 0.1}, {"glasses", 0.8}});
  draw.fractions_without_item["men"] = {{"hair", 0.5}};
  std::vector<FacePlan> men = crowd_of(4000), others = men;
  for (FacePlan& face : men) face.group = "men";
  for (FacePlan& face : others) face.group = "women";
  choose_attachments(draw, {}, men);
  choose_attachments(draw, {}, others);
  EXPECT_NEAR(static_cast<double>(count(men, "bob")) / 4000, 0.5, 0.03);
  EXPECT_NEAR(static_cast<double>(count(men, "round")) / 4000, 0.2, 0.03);
  EXPECT_NEAR(static_cast<double>(count(others, "bob")) / 4000, 0.9, 0.03);
}

TEST(AttachmentDraw, LeavesOutWhatCoversTheEyes) {
  AttachmentOptions draw = draw_of({{"fringe", "hair", {}, 1, {}}, {"bob", "hair", {}, 1, {}}});
  draw.covers_eyes = [](const std::string& item, const FacePlan& face) {
    return item == "fringe" && *face.index % 2 == 0;
  };
  std::vector<FacePlan> crowd = crowd_of(40);
  choose_attachments(draw, {}, crowd);
  for (const FacePlan& face : crowd) {
    ASSERT_EQ(face.attachments.size(), 1U);
    if (*face.index % 2 == 0) {
      EXPECT_EQ(face.attachments[0], "bob");
    }
  }
  EXPECT_GE(count(crowd, "fringe"), 10U);
  draw.covers_eyes = [](const std::string&, const FacePlan&) { return true; };
  choose_attachments(draw, {}, crowd);
  EXPECT_EQ(count(crowd, "fringe") + count(crowd, "bob"), 0U);
}

TEST(AttachmentDraw, GivesAtMostOneOfAKind) {
  const AttachmentOptions draw = draw_of({{"bob", "hair", {}, 1, {}}, {"bun", "hair", {}, 1, {}}});
  for (std::uint64_t i = 1; i < 100; ++i) {
    EXPECT_EQ(attachments_of(draw, face_of(i)).size(), 1U);
  }
}

TEST(AttachmentDraw, IsForTargetsWithAllTags) {
  const AttachmentOptions draw = draw_of({{"bob", "hair", {"female"}, 1, {}},
                                          {"rim", "hair", {"male", "old"}, 1, {}},
                                          {"quiff", "hair", {"male", "young"}, 1, {}}});
  EXPECT_THAT(attachments_of(draw, face_of(1, 0)), ElementsAre("bob"));
  EXPECT_THAT(attachments_of(draw, face_of(1, 1)), ElementsAre("rim"));
}

TEST(AttachmentDraw, TakesAwayWhatIsExcluded) {
  EXPECT_THAT(attachments_of(draw_of({{"bob", "hair", {}, 1, {}},
                                      {"cap", "hat", {}, 1, {"hair", "round"}},
                                      {"round", "glasses", {}, 1, {}},
                                      {"patch", "eye", {}, 1, {}}}),
                             face_of(1)),
              ElementsAre("cap", "patch"));
  EXPECT_THAT(
      attachments_of(draw_of({{"cap", "hat", {}, 1, {"hair"}}, {"bob", "hair", {}, 1, {"cap"}}}),
                     face_of(1)),
      ElementsAre("cap"))
      << "of two that exclude each other the first stays";
}

/// Face 7 keeps its hair whatever else is drawn for it, how it was found and how many faces come
/// after it.
TEST(AttachmentDraw, DependsOnIndexAndKindAlone) {
  const std::vector<AttachmentItem> hair = {{"bob", "hair", {}, 1, {}}, {"bun", "hair", {}, 1, {}}};
  std::vector<AttachmentItem> more = hair;
  more.insert(more.begin(), {"round", "glasses", {}, 1, {}});
  std::size_t bobs = 0;
  for (std::uint64_t i = 1; i < 200; ++i) {
    FacePlan other = face_of(i);
    other.id = "another";
    other.notes.attempt = 9;
    const auto names = attachments_of(draw_of(hair), face_of(i));
    EXPECT_EQ(attachments_of(draw_of(hair), other), names);
    EXPECT_THAT(attachments_of(draw_of(more), face_of(i)), Contains(names.at(0)));
    bobs += names.at(0) == "bob" ? 1 : 0;
  }
  EXPECT_GT(bobs, 60U);
  EXPECT_LT(bobs, 140U);
}

/// Faces on one head are much alike: unlike hair tells them apart.
TEST(AttachmentDraw, FacesOnOneHeadTakeTurns) {
  const AttachmentOptions draw = draw_of({{"bob", "hair", {}, 1, {}},
                                          {"bun", "hair", {}, 1, {}},
                                          {"mop", "hair", {}, 1, {}},
                                          {"curls", "hair", {}, 1, {}}});
  std::vector<FacePlan> crowd = crowd_of(16);
  choose_attachments(draw, {}, crowd);
  for (const Index head : {0, 1}) {
    std::vector<std::string> placed;
    for (const FacePlan& face : crowd) {
      if (face.recipe.target == head) placed.push_back(face.attachments.at(0));
    }
    ASSERT_EQ(placed.size(), 8U);
    for (std::size_t i = 0; i < placed.size(); i += 4) {
      EXPECT_EQ(std::set<std::string>(placed.begin() + i, placed.begin() + i + 4).size(), 4U)
          << "head " << head << ", from its face " << i;
    }
  }
  for (const char* name : {"bob", "bun", "mop", "curls"}) EXPECT_EQ(count(crowd, name), 4U);
  std::vector<FacePlan> small = crowd_of(7);
  choose_attachments(draw, {}, small);
  for (std::size_t i = 0; i < small.size(); ++i)
    EXPECT_EQ(small[i].attachments, crowd[i].attachments) << "a larger crowd changes nobody";
}

TEST(AttachmentDraw, TurnsFollowShares) {
  const AttachmentOptions draw =
      draw_of({{"bob", "hair", {}, 3, {}}, {"bun", "hair", {}, 1, {}}, {"mop", "hair", {}, 0, {}}});
  std::vector<FacePlan> crowd = crowd_of(80);
  choose_attachments(draw, {}, crowd);
  EXPECT_NEAR(static_cast<double>(count(crowd, "bob")), 60, 2);
  EXPECT_NEAR(static_cast<double>(count(crowd, "bun")), 20, 2);
}

TEST(AttachmentDraw, SistersTakeTurnsWhateverOthersWear) {
  const AttachmentOptions draw =
      draw_of({{"bob", "hair", {}, 1, {}}, {"bun", "hair", {}, 1, {}}, {"mop", "hair", {}, 1, {}}});
  const auto sisters = [](const std::string& family) {
    std::vector<FacePlan> faces(3, face_of(1));
    for (std::size_t i = 0; i < faces.size(); ++i) {
      faces[i].index.reset();
      faces[i].id = family + std::to_string(i);
      faces[i].family = family;
    }
    return faces;
  };
  std::vector<FacePlan> alone = sisters("kin");
  choose_attachments(draw, {}, alone);
  std::set<std::string> placed;
  for (const FacePlan& face : alone) placed.insert(face.attachments.at(0));
  EXPECT_EQ(placed.size(), 3U);
  std::vector<FacePlan> crowd = sisters("others");
  const std::vector<FacePlan> kin = sisters("kin");
  crowd.insert(crowd.end(), kin.begin(), kin.end());
  crowd.push_back(face_of(1));
  choose_attachments(draw, {}, crowd);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(crowd[3 + i].attachments, alone[i].attachments);
  EXPECT_EQ(crowd[6].attachments, attachments_of(draw, face_of(1)))
      << "families change no sampled face";
}

/// A review draws some faces anew, on other heads; all others keep what they wear.
TEST(AttachmentDraw, RedrawnFacesAreDressedLast) {
  const AttachmentOptions draw =
      draw_of({{"bob", "hair", {}, 1, {}}, {"bun", "hair", {}, 1, {}}, {"mop", "hair", {}, 1, {}}});
  std::vector<FacePlan> before = crowd_of(20);
  choose_attachments(draw, {}, before);
  std::vector<FacePlan> after = crowd_of(20);
  std::vector<FacePlan> rejected = {after[2], after[5]};
  after[2].recipe.target = 1 - after[2].recipe.target;
  after[5].recipe.target = 1 - after[5].recipe.target;
  choose_attachments(draw, {}, after, rejected);
  for (std::size_t i = 0; i < after.size(); ++i) {
    EXPECT_EQ(after[i].attachments.size(), 1U) << i;
    if (i != 2 && i != 5) {
      EXPECT_EQ(after[i].attachments, before[i].attachments) << i;
    }
  }
  // A second review does not change what the first has changed.
  std::vector<FacePlan> twice = after;
  rejected.push_back(after[5]);
  twice[5].recipe.target = 1 - twice[5].recipe.target;
  choose_attachments(draw, {}, twice, rejected);
  for (std::size_t i = 0; i < twice.size(); ++i) {
    if (i != 5) {
      EXPECT_EQ(twice[i].attachments, after[i].attachments) << i;
    }
  }
}

TEST(AttachmentDraw, GoesByTheIdOfFacesThatAreNotSampled) {
  const AttachmentOptions draw = draw_of({{"bob", "hair", {}, 1, {}}, {"bun", "hair", {}, 1, {}}});
  std::map<std::string, int> found;
  for (int i = 0; i < 100; ++i) {
    FacePlan face = face_of(1);
    face.index.reset();
    face.id = "kin_" + std::to_string(i);
    ++found[attachments_of(draw, face).at(0)];
  }
  EXPECT_EQ(found.size(), 2U);
}

TEST(AttachmentDraw, LeavesAllWithoutAKindThatNobodyWears) {
  EXPECT_THAT(attachments_of(draw_of({{"bob", "hair", {}, 1, {}}}, {{"hair", 1}}), face_of(3)),
              IsEmpty());
}

TEST(AttachmentDraw, ServesQuotasExactlyInEachGroup) {
  AttachmentOptions draw = draw_of({{"round", "glasses", {}, 1, {}},
                                    {"full", "beard", {"male"}, 1, {}},
                                    {"bob", "hair", {}, 1, {}, "blond"},
                                    {"bun", "hair", {}, 1, {}, "black"}});
  draw.quotas = {{"glasses", 0.25}, {"beard", 0.5}, {"blond", 0.1}};
  std::vector<FacePlan> crowd = crowd_of(240);
  choose_attachments(draw, groups_of(crowd), crowd);
  EXPECT_EQ(count(crowd, "round"), 60U);
  EXPECT_EQ(count(crowd, "full"), 60U) << "half of the men";
  EXPECT_EQ(count(crowd, "bob"), 24U);
  EXPECT_EQ(count(crowd, "bun"), 216U) << "those whom a colour's quota passes over wear another";
  std::vector<FacePlan> small = crowd_of(100);
  choose_attachments(draw, groups_of(small), small);
  for (std::size_t i = 0; i < small.size(); ++i) {
    EXPECT_EQ(small[i].attachments, crowd[i].attachments) << "a larger crowd moves nobody";
  }
  EXPECT_GE(count(small, "round"), 24U) << "12 of 50 in each group, or one more";
  EXPECT_LE(count(small, "round"), 26U);
  std::size_t in_step = 0;
  for (std::size_t i = 8; i < crowd.size(); ++i) {
    in_step += crowd[i].attachments == crowd[i - 8].attachments ? 1 : 0;
  }
  EXPECT_LT(in_step, 200U) << "they do not wear the same in a row of the sheet as in the next";
}

TEST(AttachmentDraw, GivesOneFaceOneColour) {
  const AttachmentOptions draw = draw_of({{"quiff", "hair", {}, 1, {}, "black"},
                                          {"mop", "hair", {}, 1, {}, "brown"},
                                          {"full", "beard", {}, 1, {}, "black"},
                                          {"goatee", "beard", {}, 1, {}, "brown"},
                                          {"red", "brow", {}, 1, {}, "red"}});
  std::vector<FacePlan> crowd = crowd_of(60);
  choose_attachments(draw, {}, crowd);
  for (const FacePlan& face : crowd) {
    EXPECT_THAT(face.attachments, ::testing::AnyOf(ElementsAre("quiff", "full", "red"),
                                                   ElementsAre("mop", "goatee", "red")));
  }
  EXPECT_GT(count(crowd, "mop"), 10U);
  EXPECT_LT(count(crowd, "mop"), 50U);
}

/// A child of a mother and a father, on a mixture of heads.
FacePlan child_of(std::vector<SourceWeight> shares, std::vector<std::string> parents) {
  FacePlan child;
  child.id = "child";
  child.family = "kin";
  child.parents = std::move(parents);
  set_target_heads(child.recipe, std::move(shares));
  return child;
}

TEST(AttachmentDraw, GoesByWhatMostOfAMixtureIs) {
  AttachmentOptions draw =
      draw_of({{"bob", "hair", {"female"}, 1, {}}, {"crop", "hair", {"male"}, 1, {}}});
  draw.tags = {{"female", "young"}, {"male", "old"}, {"female", "young"}};
  // The man has the largest share, but women have more.
  EXPECT_THAT(attachments_of(draw, child_of({{0, 0.3}, {1, 0.4}, {2, 0.3}}, {})),
              ElementsAre("bob"));
  EXPECT_THAT(attachments_of(draw, child_of({{0, 0.2}, {1, 0.6}, {2, 0.2}}, {})),
              ElementsAre("crop"));
  draw.tags = {{}, {}, {}};
  EXPECT_EQ(typical_head(child_of({{0, 0.3}, {1, 0.4}, {2, 0.3}}, {}).recipe, draw.tags), 1);
}

TEST(AttachmentDraw, ChildrenHaveAParentsColourWhateverTheirHeadHas) {
  AttachmentOptions draw = draw_of({{"bob_red", "hair", {"female", "red_hair"}, 1, {}, "red"},
                                    {"bob_black", "hair", {"female", "black_hair"}, 1, {}, "black"},
                                    {"bob_grey", "hair", {"female", "grey_hair"}, 1, {}, "grey"},
                                    {"crop_red", "hair", {"male", "red_hair"}, 1, {}, "red"}});
  draw.tags = {{"female", "red_hair"},
               {"male", "red_hair"},
               {"female", "black_hair"},
               {"female", "grey_hair", "old"},
               {"male", "bald"}};
  draw.head_names = {"ann", "bob", "cyd", "dot", "eve"};
  const auto placed = [&](const std::string& mother, const std::string& father) {
    FacePlan child = child_of({{0, 0.1}, {2, 0.9}}, {mother, father});
    return attachments_of(draw, child);
  };
  EXPECT_THAT(placed("ann", "bob"), ElementsAre("bob_red")) << "of heads that are parents";
  EXPECT_THAT(placed("ann", "eve"), ElementsAre("bob_red")) << "a bald father has none to give";
  EXPECT_THAT(placed("dot", "eve"), ElementsAre("bob_black")) << "age is not inherited";
  FacePlan old = child_of({{3, 1}}, {"dot", "eve"});
  EXPECT_THAT(attachments_of(draw, old), ElementsAre("bob_grey"));
  // Faces that are parents, by what they wear.
  FacePlan mother = face_of(1, 0);
  std::vector<FacePlan> crowd = {mother, child_of({{2, 1}}, {mother.id, "eve"})};
  choose_attachments(draw, {}, crowd);
  EXPECT_THAT(crowd[1].attachments, ElementsAre("bob_red"));
}

TEST(AttachmentDraw, LetsColoursRunInFamilies) {
  const AttachmentOptions draw = draw_of({{"bob", "hair", {"female"}, 1, {}, "black"},
                                          {"braid", "hair", {"female"}, 1, {}, "red"},
                                          {"bun", "hair", {"female"}, 1, {}, "blond"},
                                          {"quiff", "hair", {"male"}, 1, {}, "black"},
                                          {"mop", "hair", {"male"}, 1, {}, "red"},
                                          {"rim", "hair", {"male", "old"}, 1, {}, "grey"}});
  const auto colour_of = [&](const FacePlan& face) {
    return std::find_if(draw.items.begin(), draw.items.end(),
                        [&](const auto& item) { return item.name == face.attachments.at(0); })
        ->colour;
  };
  std::map<std::string, int> from;
  for (int f = 0; f < 40; ++f) {
    const std::string name = "kin" + std::to_string(f);
    std::vector<FacePlan> crowd;
    const auto add = [&](const std::string& id, Index target) -> FacePlan& {
      FacePlan& face = crowd.emplace_back();
      face.id = name + id;
      face.recipe.target = target;
      return face;
    };
    add("_mother", 0);
    add("_father", 1);
    for (int child = 0; child < 4; ++child) {
      FacePlan& face = add("_child" + std::to_string(child), 0);
      face.family = name;
      face.parents = {name + "_mother", name + "_father"};
    }
    for (int twin = 0; twin < 3; ++twin)
      add("_alone" + std::to_string(twin), 0).family = name + "b";
    choose_attachments(draw, {}, crowd);
    const std::string mother = colour_of(crowd[0]), father = colour_of(crowd[1]);
    for (std::size_t child = 2; child < 6; ++child) {
      const std::string own = colour_of(crowd[child]);
      // What a father wears no daughter may: nobody makes her hair grey.
      EXPECT_TRUE(own == mother || own == father) << own << ", " << mother << ", " << father;
      if (mother != father) ++from[own == mother ? "mother" : "father"];
    }
    EXPECT_EQ(colour_of(crowd[7]), colour_of(crowd[6]));
    EXPECT_EQ(colour_of(crowd[8]), colour_of(crowd[6]));
  }
  EXPECT_GT(from["mother"], 20);
  EXPECT_GT(from["father"], 5);
}

AttachmentItem tinted_item(const std::string& name, const std::string& kind = "hair",
                           std::vector<std::string> tags = {}) {
  AttachmentItem item{name, kind, std::move(tags), 1, {}};
  item.tint = Tint::kHair;
  return item;
}

/// Four heads: a brown-haired and a red-haired woman, and two old women.
AttachmentOptions crowd_with_hair() {
  AttachmentOptions draw{7, {tinted_item("bob"), tinted_item("bun"), tinted_item("long")}, {}, {}};
  draw.tags = {{"female", "young", "brown_hair"},
               {"female", "young", "red_hair"},
               {"female", "old", "brown_hair"},
               {"female", "old", "red_hair"}};
  draw.head_names = {"ann", "bea", "cyd", "dot"};
  return draw;
}

std::vector<FacePlan> hair_crowd(std::uint64_t faces) {
  std::vector<FacePlan> crowd;
  for (std::uint64_t i = 1; i <= faces; ++i) crowd.push_back(face_of(i, static_cast<Index>(i % 4)));
  return crowd;
}

TEST(HairColour, IsOfFacesThatMayWearATint) {
  std::vector<FacePlan> crowd = crowd_of(4);
  choose_attachments(draw_of({{"bob", "hair", {}, 1, {}}}), {}, crowd);
  EXPECT_FALSE(crowd[0].hair);
  crowd = hair_crowd(40);
  choose_attachments(crowd_with_hair(), {}, crowd);
  double young = 0, old = 0;
  for (const FacePlan& face : crowd) {
    ASSERT_TRUE(face.hair);
    const bool red = face.recipe.target % 2 == 1;
    EXPECT_NEAR(face.hair->pheomelanin, red ? 0.8 : 0, 0.11) << face.id;
    (face.recipe.target < 2 ? young : old) += face.hair->grey_fraction / 20;
  }
  EXPECT_EQ(young, 0);
  EXPECT_GT(old, 0.5);
  std::vector<FacePlan> larger = hair_crowd(90);
  choose_attachments(crowd_with_hair(), {}, larger);
  for (std::size_t i = 0; i < crowd.size(); ++i) {
    EXPECT_EQ(larger[i].hair, crowd[i].hair);
    EXPECT_EQ(larger[i].attachments, crowd[i].attachments);
  }
}

/// Sampled faces of equal hair colour. Each but the first three is most similar to the third face
/// before it.
std::vector<FacePlan> crowd_of_similar_faces() {
  std::vector<FacePlan> crowd = hair_crowd(20);
  for (std::size_t i = 0; i < crowd.size(); ++i) {
    crowd[i].recipe.target = 0;
    crowd[i].notes.nearest = NearestNeighbours{};
    if (i >= 3) crowd[i].notes.nearest->earlier_face = crowd[i - 3].id;
  }
  return crowd;
}

TEST(AttachmentDraw, ARedrawnFaceWithOtherNeighboursChangesNoOtherFace) {
  std::vector<FacePlan> before = crowd_of_similar_faces();
  choose_attachments(crowd_with_hair(), {}, before);
  for (std::size_t redrawn = 3; redrawn < before.size(); ++redrawn) {
    std::vector<FacePlan> after = crowd_of_similar_faces();
    const std::vector<FacePlan> rejected = {after[redrawn]};
    after[redrawn].notes.nearest->earlier_face = after[redrawn - 2].id;
    choose_attachments(crowd_with_hair(), {}, after, rejected);
    for (std::size_t i = 0; i < after.size(); ++i) {
      if (i != redrawn)
        EXPECT_EQ(after[i].attachments, before[i].attachments) << redrawn << ' ' << i;
    }
  }
}

TEST(AttachmentDraw, HandWrittenFacesChangeNoSampledFace) {
  std::vector<FacePlan> sampled = crowd_of_similar_faces();
  choose_attachments(crowd_with_hair(), {}, sampled);
  for (std::size_t similar = 0; similar < sampled.size(); ++similar) {
    std::vector<FacePlan> crowd = crowd_of_similar_faces();
    FacePlan written = crowd[0];
    written.id = "written";
    written.index.reset();
    crowd.insert(crowd.begin(), written);
    choose_attachments(crowd_with_hair(), {}, crowd);
    const bool has_neighbour = crowd[similar + 1].notes.nearest->earlier_face.has_value();
    if (has_neighbour) continue;
    crowd[similar + 1].notes.nearest->earlier_face = written.id;
    choose_attachments(crowd_with_hair(), {}, crowd);
    for (std::size_t i = 0; i < sampled.size(); ++i)
      EXPECT_EQ(crowd[i + 1].attachments, sampled[i].attachments) << similar << ' ' << i;
  }
}

// Half of the age used to leave young hair as it was.
TEST(HairColour, GreysVisiblyWithHalfOfTheAge) {
  const auto mean_grey = [](double age) {
    std::vector<FacePlan> crowd = hair_crowd(200);
    for (FacePlan& face : crowd) {
      face.recipe.target = 0;  // young
      face.age = age;
    }
    choose_attachments(crowd_with_hair(), {}, crowd);
    double sum = 0;
    for (const FacePlan& face : crowd) sum += face.hair->grey_fraction / 200;
    return sum;
  };
  EXPECT_EQ(mean_grey(0), 0);
  EXPECT_GT(mean_grey(0.5), 0.2);
  EXPECT_GT(mean_grey(1), mean_grey(0.5) + 0.2);
}

// An old head whose detail came from young heads had white hair around a face of forty.
TEST(HairColour, GreysWithTheTargetAndTheHeadsThatLendTheDetail) {
  const auto mean_grey = [](Index target, Index source) {
    std::vector<FacePlan> crowd = hair_crowd(200);
    for (FacePlan& face : crowd) {
      face.recipe.target = target;
      face.recipe.regions.resize(2);
      for (RegionRecipe& region : face.recipe.regions) {
        region.weights = {{2, 1}};  // the coarse band does not show age
        region.finer_bands.resize(1);
        region.finer_bands[0].weights = {{source, 0.8}};
      }
    }
    choose_attachments(crowd_with_hair(), {}, crowd);
    double sum = 0;
    for (const FacePlan& face : crowd) sum += face.hair->grey_fraction / 200;
    return sum;
  };
  constexpr Index kYoung = 0, kOld = 2;
  EXPECT_EQ(mean_grey(kYoung, kYoung), 0);
  EXPECT_GT(mean_grey(kOld, kOld), 0.7);
  // The target has three quarters of the weight.
  EXPECT_LT(mean_grey(kYoung, kOld), 0.05);
  EXPECT_GT(mean_grey(kOld, kYoung), 0.1);
  EXPECT_LT(mean_grey(kOld, kYoung), 0.4);
}

TEST(HairColour, FollowsSharesExactlyInEachGroup) {
  AttachmentOptions draw = crowd_with_hair();
  draw.hair_colours = {{"", {{"blond", 0.3}}}, {"clan", {{"black", 1}}}};
  std::vector<FacePlan> crowd = hair_crowd(100);
  std::vector<int> groups;
  for (FacePlan& face : crowd) {
    const bool clan = *face.index % 2 == 0;
    face.recipe.target = clan ? 0 : 2;  // young and old, both brown
    face.group = clan ? "clan" : "others";
    groups.push_back(clan ? 1 : 0);
  }
  choose_attachments(draw, groups, crowd);
  int blond = 0, grey = 0;
  for (const FacePlan& face : crowd) {
    if (*face.group == "clan") {
      EXPECT_GE(face.hair->eumelanin, 0.9);
    } else {
      const bool is_blond = face.hair->eumelanin < 0.35;  // the others are brown
      blond += is_blond ? 1 : 0;
      grey += face.hair->grey_fraction > 0.3 ? 1 : 0;
    }
  }
  EXPECT_NEAR(blond, 15, 1);
  EXPECT_GT(grey, 10);
}

// Each group rounded down its part: of forty faces, four were red-haired where eight were asked.
TEST(HairColour, FollowsSharesOverAllGroupsAndAllWhoHaveNoParents) {
  AttachmentOptions draw = crowd_with_hair();
  draw.tags = {{"young"}, {"young"}};
  draw.hair_colours = {{"", {{"red", 0.2}, {"brown", 0.4}, {"black", 0.4}}}};
  for (draw.seed = 1; draw.seed <= 20; ++draw.seed) {
    std::vector<FacePlan> crowd;
    std::vector<int> groups;
    for (int p = 0; p < 6; ++p) {
      FacePlan& parent = crowd.emplace_back();
      parent.id = "parent_" + std::to_string(p);
    }
    for (std::uint64_t i = 1; i <= 34; ++i) {
      FacePlan& face = crowd.emplace_back(face_of(i, 0));
      groups.push_back(i <= 14 ? 0 : i <= 28 ? 1 : 2);
      face.group = std::to_string(groups.back());
    }
    choose_attachments(draw, groups, crowd);
    const auto red = [](const FacePlan& face) { return face.hair->pheomelanin > 0.5; };
    EXPECT_EQ(std::ranges::count_if(crowd, red), 8) << draw.seed;
    const std::vector<FacePlan> before = crowd;
    for (std::uint64_t i = 35; i <= 60; ++i) {
      crowd.push_back(face_of(i, 0));
      groups.push_back(-1);
    }
    choose_attachments(draw, groups, crowd);
    for (std::size_t i = 0; i < before.size(); ++i) EXPECT_EQ(crowd[i].hair, before[i].hair);
  }
}

// Two of thirteen old people were grey in a crowd with hair_colours.
TEST(HairColour, ThatIsAskedForGreysWithAge) {
  AttachmentOptions draw = crowd_with_hair();
  draw.hair_colours = {{"", {{"red", 1}}}};
  std::vector<FacePlan> crowd = hair_crowd(40);
  choose_attachments(draw, {}, crowd);
  int grey = 0;
  for (const FacePlan& face : crowd) {
    EXPECT_NEAR(face.hair->pheomelanin, 0.8, 0.11);
    const bool is_old = face.recipe.target >= 2;
    EXPECT_TRUE(is_old || face.hair->grey_fraction == 0) << face.hair->grey_fraction;
    grey += is_old && face.hair->grey_fraction > 0.5 ? 1 : 0;
  }
  EXPECT_GT(grey, 10) << "of twenty";
}

TEST(HairColour, OfAChildIsAParentsOrLiesBetween) {
  for (int i = 0; i < 60; ++i) {
    FacePlan child;
    child.id = "clan_" + std::to_string(i);
    child.family = "clan";
    child.parents = {"ann", "dot"};  // brown, and red that age has made grey
    child.recipe.target = 2;         // has the tag old, which makes the child's own hair grey
    std::vector<FacePlan> crowd = {child};
    choose_attachments(crowd_with_hair(), {}, crowd);
    const HairColour hair = *crowd[0].hair;
    EXPECT_GE(hair.eumelanin, 0.2);
    EXPECT_LE(hair.eumelanin, 0.55);
    EXPECT_LE(hair.pheomelanin, 0.9);
    // On the line from brown (0.5, 0) to red (0.25, 0.8).
    EXPECT_NEAR(hair.pheomelanin, (0.5 - hair.eumelanin) / 0.25 * 0.8, 0.3);
  }
}

TEST(HairColour, OfTwinsIsTheSame) {
  AttachmentOptions draw = crowd_with_hair();
  draw.twin_families = {"clan"};
  std::vector<FacePlan> crowd(2);
  for (std::size_t i = 0; i < 2; ++i) {
    crowd[i].id = "clan_" + std::to_string(i);
    crowd[i].family = "clan";
    crowd[i].parents = {"cyd", "dot"};
    crowd[i].recipe.target = 3;
  }
  choose_attachments(draw, {}, crowd);
  EXPECT_EQ(crowd[0].hair, crowd[1].hair);
}

TEST(AttachmentDraw, UsesAllThatFitBeforeItRepeatsOne) {
  std::vector<FacePlan> crowd = hair_crowd(30);
  choose_attachments(crowd_with_hair(), {}, crowd);
  for (std::size_t i = 0; i + 3 <= crowd.size(); i += 3) {
    std::set<std::string> worn;
    for (std::size_t k = i; k < i + 3; ++k) worn.insert(crowd[k].attachments.at(0));
    EXPECT_GE(worn.size(), 2U) << i;
  }
  for (const char* name : {"bob", "bun", "long"})
    EXPECT_NEAR(static_cast<double>(count(crowd, name)), 10, 1) << name;
}

TEST(AttachmentDraw, NeighboursDoNotShareCutAndColour) {
  AttachmentOptions draw = crowd_with_hair();
  draw.items[0].relative_frequency = 50;  // nearly everybody would wear it
  std::vector<FacePlan> crowd = hair_crowd(60);
  for (FacePlan& face : crowd) face.recipe.target = 0;
  choose_attachments(draw, {}, crowd);
  for (std::size_t i = 1; i < crowd.size(); ++i) {
    EXPECT_NE(crowd[i].attachments, crowd[i - 1].attachments) << crowd[i].id;
  }
  draw.items.resize(1);  // unless nothing else fits
  choose_attachments(draw, {}, crowd);
  EXPECT_EQ(count(crowd, "bob"), 60U);
}

TEST(AttachmentDraw, AFaceDoesNotShareCutAndColourWithTheMostSimilarEarlierFace) {
  AttachmentOptions draw = crowd_with_hair();
  draw.items[0].relative_frequency = 50;  // without the rule, nearly every face wears this item
  std::vector<FacePlan> crowd = hair_crowd(60);
  for (std::size_t i = 0; i < crowd.size(); ++i) {
    crowd[i].recipe.target = 0;
    if (i >= 2) crowd[i].notes.nearest = NearestNeighbours{0, 1, crowd[i - 2].id, 1};
  }
  choose_attachments(draw, {}, crowd);
  for (std::size_t i = 2; i < crowd.size(); ++i) {
    EXPECT_NE(crowd[i].attachments, crowd[i - 2].attachments) << crowd[i].id;
  }
}

TEST(AttachmentDraw, LeavesOutWhoseTagsAreExcluded) {
  AttachmentOptions draw = crowd_with_hair();
  for (AttachmentItem& item : draw.items) {
    if (item.name != "bun") item.excluded_tags = {"old"};
  }
  std::vector<FacePlan> crowd = hair_crowd(12);
  choose_attachments(draw, {}, crowd);
  for (const FacePlan& face : crowd) {
    if (face.recipe.target < 2) continue;
    EXPECT_THAT(face.attachments, ElementsAre("bun"));
  }
}

}  // namespace
}  // namespace crowdface
