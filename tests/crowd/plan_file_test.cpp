// SPDX-License-Identifier: Apache-2.0
#include "crowdface/crowd/plan_file.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "crowdface/core/text.h"
#include "crowdface/crowd/crowd_table.h"

#include "support/expect_error.h"
#include "support/temporary_folder.h"

namespace crowdface {
namespace {

const PlanNames kNames = {{"ann", "bob", "cyd"}, {"top", "low"}};
const Digest kSettings = {0x0123456789abcdefU, 0xfedcba9876543210U};

FacePlan example() {
  FacePlan face;
  face.id = "mob_0007";
  face.index = 7;
  face.recipe.target = 2;
  face.recipe.regions = {
      {{PlanePoint(0.1, -1.0 / 3), {{0, 1.0 / 3}, {2, 2.0 / 3}}, 0.45, 9000, 1.1}, {}},
      {{std::nullopt, {{1, 1.0}}, 0, 0, -0.30000000000000004}, {}},
  };
  face.notes.nearest = NearestNeighbours{1, 2.41239, "mob_0003", 1.00004};
  return face;
}

TEST(PlanFile, LineHasTheFieldsOfTheContractInOrder) {
  EXPECT_EQ(format_plan_line(example(), kNames, kSettings),
            R"({"id":"mob_0007","index":7,"family":null,"target":"cyd","attempt":0,"regions":{)"
            R"("top":{"position":[0.1,-0.3333333333333333],"weights":{"ann":0.3333333333333333,)"
            R"("cyd":0.6666666666666666},"smoothness":0.45,"iterations":9000,"extrapolation":1.1},)"
            R"("low":{"position":null,"weights":{"bob":1.0},"smoothness":0.0,"iterations":0,)"
            R"("extrapolation":-0.30000000000000004}},"nearest":{"face":"bob","face_mm":2.4124,)"
            R"("crowd":"mob_0003","crowd_mm":1.0},"settings":"0123456789abcdeffedcba9876543210"})");
}

TEST(PlanFile, ReadsBackToTheBit) {
  const FacePlan face = example();
  const PlanLine line =
      parse_plan_line(format_plan_line(face, kNames, kSettings), kNames, "plan:1");
  EXPECT_EQ(line.settings_hash, kSettings.hex());
  EXPECT_EQ(line.face.id, face.id);
  EXPECT_EQ(line.face.index, face.index);
  EXPECT_EQ(line.face.recipe.target, face.recipe.target);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_EQ(line.face.recipe.regions[k].position, face.recipe.regions[k].position);
    EXPECT_EQ(line.face.recipe.regions[k].weights, face.recipe.regions[k].weights);
    EXPECT_EQ(line.face.recipe.regions[k].smoothness, face.recipe.regions[k].smoothness);
    EXPECT_EQ(line.face.recipe.regions[k].iterations, face.recipe.regions[k].iterations);
    EXPECT_EQ(line.face.recipe.regions[k].extrapolation, face.recipe.regions[k].extrapolation);
  }
  // Distances to four decimals, so that pictures made from the plan tell what the plan tells.
  ASSERT_TRUE(line.face.notes.nearest);
  EXPECT_EQ(line.face.notes.nearest->head, 1);
  EXPECT_EQ(line.face.notes.nearest->head_distance_mm, 2.4124);
  EXPECT_EQ(line.face.notes.nearest->earlier_face, "mob_0003");
  EXPECT_EQ(line.face.notes.nearest->earlier_face_distance_mm, 1);
  EXPECT_EQ(format_plan_line(line.face, kNames, kSettings),
            format_plan_line(face, kNames, kSettings));
}

TEST(PlanFile, AgesStandAfterTheAttempt) {
  FacePlan face = example();
  face.age = 0.5;
  face.age_years = 45.5;
  const std::string text = format_plan_line(face, kNames, kSettings);
  EXPECT_NE(text.find(R"("attempt":0,"age":0.5,"age_years":45.5,)"), text.npos);
  const PlanLine line = parse_plan_line(text, kNames, "plan:1");
  EXPECT_EQ(line.face.age, face.age);
  EXPECT_EQ(line.face.age_years, face.age_years);
  const std::string table = whole_text(table_text({face, example()}, kNames));
  EXPECT_NE(table.find(",age,age_years\r\n"), table.npos);
  EXPECT_NE(table.find(",0.5,45.5\r\n"), table.npos);
}

TEST(PlanFile, ColoursOfAFacesOwnStandBesideItsTarget) {
  FacePlan face = example();
  face.recipe.colours = {{0, 0.25}, {2, 0.75}};
  const std::string text = format_plan_line(face, kNames, kSettings);
  EXPECT_NE(text.find(R"("target":"cyd","colours":{"ann":0.25,"cyd":0.75},"attempt")"), text.npos);
  const PlanLine line = parse_plan_line(text, kNames, "plan:1");
  EXPECT_EQ(line.face.recipe.colours, face.recipe.colours);
  std::string table;
  table_text({face, example()}, kNames)([&](std::string_view piece) { table += piece; });
  EXPECT_NE(table.find(",colours\r\n"), table.npos);
  EXPECT_NE(table.find(",ann:0.25;cyd:0.75\r\n"), table.npos);
  for (const char* wrong : {R"({"ann":0.5})", R"({"zed":1})", "[]", "{}"}) {
    std::string line_of = text;
    const std::size_t begin = line_of.find("\"colours\":") + 10;
    line_of.replace(begin, line_of.find('}', begin) + 1 - begin, wrong);
    EXPECT_THROW(parse_plan_line(line_of, kNames, "plan:1"), InvalidInput) << wrong;
  }
}

TEST(PlanFile, TheLongestIdsAreRead) {
  FacePlan face = example();
  face.family = std::string(64, 'f');
  face.id = concat(std::string(64, 'c'), '_', *face.family, "_1000");
  const PlanLine line =
      parse_plan_line(format_plan_line(face, kNames, kSettings), kNames, "plan:1");
  EXPECT_EQ(line.face.id, face.id);
  EXPECT_EQ(line.face.family, face.family);
  face.id = concat(std::string(64, 'c'), "_18446744073709551615");
  EXPECT_NO_THROW(parse_plan_line(format_plan_line(face, kNames, kSettings), kNames, "plan:1"));
}

TEST(PlanFile, WhatIsWrongAboutNearestIsLeftOut) {
  const std::string good = format_plan_line(example(), kNames, kSettings);
  for (const char* nearest :
       {"7", "{}", "{\"face\":\"zed\",\"face_mm\":1}", "{\"face\":\"bob\"}"}) {
    std::string line = good;
    const std::size_t begin = line.find("\"nearest\":") + 10;
    line.replace(begin, line.find('}', begin) + 1 - begin, nearest);
    EXPECT_FALSE(parse_plan_line(line, kNames, "plan:1").face.notes.nearest) << nearest;
  }
}

TEST(PlanFile, BrokenLinesAreRefusedWithTheirPlace) {
  const std::string good = format_plan_line(example(), kNames, kSettings);
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string line = good;
    return line.replace(line.find(from), from.size(), to);
  };
  constexpr std::size_t kDepth = 1'000'000;
  const std::string deep = std::string(kDepth, '[') + std::string(kDepth, ']');
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"", "line"},
      {"nonsense", "line"},
      {"[1,2]", "line"},
      {good.substr(0, good.size() - 3), "line"},
      {with("\"cyd\",\"attempt\"", "\"zed\",\"attempt\""), "target"},
      {with("\"bob\":1.0", "\"zed\":1.0"), "weights"},
      {with("\"bob\":1.0", "\"bob\":\"1\""), "weights"},
      {with("\"iterations\":9000", "\"iterations\":-1"), "iterations"},
      {with("\"iterations\":9000", "\"iterations\":1.5"), "iterations"},
      {with("\"iterations\":9000", "\"iterations\":18446744073709551616"), "iterations"},
      {with("\"extrapolation\":1.1", "\"extrapolation\":null"), "extrapolation"},
      {with("\"extrapolation\":1.1", "\"extrapolation\":1e999"), ""},
      {with("\"extrapolation\":1.1", "\"extrapolation\":4.1"), "from -4 to 4"},
      {with("\"extrapolation\":1.1", "\"extrapolation\":1e308"), "from -4 to 4"},
      {with("\"smoothness\":0.45", "\"smoothness\":1.1"), "smoothness"},
      {with("\"bob\":1.0", "\"bob\":-0.1"), "from 0 to 1"},
      {with("\"bob\":1.0", "\"bob\":1e308"), "from 0 to 1"},
      {with("\"bob\":1.0", "\"ann\":0.6,\"bob\":0.5"), "a sum of at most 1"},
      {with("[0.1,", "[1e7,"), "position"},
      {with("\"low\":", "\"high\":"), "low"},
      {with("[0.1,", "["), "position"},
      {with("\"index\":7", "\"index\":-7"), "index"},
      {with("\"id\":\"mob_0007\",", ""), "id"},
      {with("\"id\":\"mob_0007\"", "\"id\":\"../mob_0007\""), "id: expected a name"},
      {with("\"id\":\"mob_0007\"", "\"id\":\"\""), "id: expected a name"},
      {with("\"family\":null", "\"family\":\"a/b\""), "family: expected a name"},
      {with("\"settings\"", "\"setting\""), "settings"},
      {with("\"attempt\":0", "\"attempt\":4294967296"), "attempt"},
      {with("\"attempt\":0", concat("\"attempt\":", deep)), "attempt"},
      {with("\"regions\":{", concat("\"regions\":", deep, ",\"other\":{")), "regions"},
  };
  for (const auto& [line, field] : cases) {
    SCOPED_TRACE(line.substr(0, 1000));
    testing::expect_error(ExitCode::kBadData, {"plan.jsonl:12", field},
                          [&, &text = line] { parse_plan_line(text, kNames, "plan.jsonl:12"); });
  }
}

const PlanNames kBandNames = {{"ann", "bob", "cyd"}, {"top", "low"}, {"build", "skin"}};

FacePlan banded() {
  FacePlan face = example();
  face.parents = {"ann", "bob"};
  face.inherited_from = {"mother", "father", "father", "mother"};
  face.recipe.regions[0].finer_bands = {{PlanePoint(0.5, 0.25), {{1, 1.0}}, 0.1, 2000, 0.8}};
  face.recipe.regions[1].finer_bands = {{std::nullopt, {{0, 0.5}, {2, 0.5}}, 0, 0, 1}};
  return face;
}

TEST(PlanFile, BandsAreReadBackToTheBit) {
  const std::string line = format_plan_line(banded(), kBandNames, kSettings);
  EXPECT_NE(line.find(R"("extrapolation":1.1,"bands":{"skin":{"position":[0.5,0.25],)"
                      R"("weights":{"bob":1.0},"smoothness":0.1,"iterations":2000,)"
                      R"("extrapolation":0.8}}},"low")"),
            line.npos)
      << line;
  EXPECT_NE(line.find(R"("inherits":{"top":{"build":"mother","skin":"father"},)"
                      R"("low":{"build":"father","skin":"mother"}})"),
            line.npos)
      << line;
  const FacePlan back = parse_plan_line(line, kBandNames, "plan:1").face;
  EXPECT_EQ(format_plan_line(back, kBandNames, kSettings), line);
  ASSERT_EQ(back.recipe.regions[0].finer_bands.size(), 1U);
  EXPECT_EQ(back.recipe.regions[0].finer_bands[0].iterations, 2000U);
  EXPECT_EQ(back.inherited_from, banded().inherited_from);
}

TEST(PlanFile, BandsThatCannotBeAreRefusedWithTheirPlace) {
  const std::string good = format_plan_line(banded(), kBandNames, kSettings);
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string line = good;
    return line.replace(line.find(from), from.size(), to);
  };
  const std::vector<std::pair<std::string, std::string>> cases = {
      {with("\"skin\":{\"position\"", "\"fur\":{\"position\""), "skin: expected a value"},
      {with("\"iterations\":2000", "\"iterations\":9001"), "skin.iterations: expected at most"},
      {with("{\"bob\":1.0},\"smoothness\":0.1", "{\"bob\":1.0},\"smoothness\":2"), "smoothness"},
      {with("\"bands\":{", "\"other\":{"), "bands: expected an object of 1 bands"},
      {with("\"bands\":{", "\"bands\":7,\"other\":{"), "bands: expected an object of 1 bands"},
  };
  for (const auto& [line, field] : cases) {
    testing::expect_error(ExitCode::kBadData, {"plan.jsonl:12", field}, [&, &text = line] {
      parse_plan_line(text, kBandNames, "plan.jsonl:12");
    });
  }
  testing::expect_error(ExitCode::kBadData, {"plan.jsonl:12", "bands: expected an object of 0"},
                        [&] { parse_plan_line(good, kNames, "plan.jsonl:12"); });
}

TEST(PlanFile, TableHasTheFinerBandsLast) {
  const std::string table = whole_text(table_text({banded()}, kBandNames));
  EXPECT_NE(table.find("group,mixture,top_skin_position_x,top_skin_position_y,top_skin_weights,"
                       "top_skin_smoothness,top_skin_iterations,top_skin_extrapolation,"
                       "low_skin_position_x,"),
            table.npos)
      << table;
  EXPECT_TRUE(table.ends_with(",0.5,0.25,bob:1,0.1,2000,0.8,,,ann:0.5;cyd:0.5,0,0,1\r\n")) << table;
}

TEST(PlanFile, HairColoursReadBack) {
  FacePlan face = example();
  face.hair = HairColour{0.55, 0.1, 0.3};
  const std::string line = format_plan_line(face, kNames, kSettings);
  EXPECT_EQ(parse_plan_line(line, kNames, "plan").face.hair, face.hair);
  EXPECT_FALSE(
      parse_plan_line(format_plan_line(example(), kNames, kSettings), kNames, "plan").face.hair);
  std::string grey = line;
  grey.replace(grey.find("\"grey\":0.3"), 10, "\"grey\":1.3");
  testing::expect_error(ExitCode::kBadData, {"hair.grey"},
                        [&] { parse_plan_line(grey, kNames, "plan"); });
}

TEST(PlanFile, FileErrorsNameTheLine) {
  const testing::TemporaryFolder folder;
  const std::string good = format_plan_line(example(), kNames, kSettings);
  EXPECT_EQ(read_plan(folder.write("good.jsonl", good + "\n\n" + good), kNames).size(), 2U);
  testing::expect_error(ExitCode::kBadData, {"bad.jsonl:3"}, [&] {
    read_plan(folder.write("bad.jsonl", good + "\n" + good + "\n{}\n"), kNames);
  });
  testing::expect_error(ExitCode::kMissingInput, {"none.jsonl"},
                        [&] { read_plan(folder / "none.jsonl", kNames); });
}

// The parents' family was empty.
TEST(PlanFile, TableTellsWhoAFaceIs) {
  FacePlan mother = example(), child = example(), stranger = example();
  mother.id = "mob_smith_mother";
  child.id = "mob_smith_01";
  child.family = "smith";
  child.parents = {"mob_smith_mother", "bob"};
  child.recipe.target = 1;
  child.age = 0.5;
  mother.attachments = {"cap", "bun"};
  PlanNames names = kNames;
  names.attachments = {"cap", "bun"};
  const HeadTagsAndAttachmentKinds facts{{{}, {"male", "old"}, {"female"}}, {"hat", "hair"}};
  const std::vector<FacePlan> crowd = {mother, child, stranger};
  const std::string table = whole_text(table_text(crowd, names, kNoNeckColours, facts));
  EXPECT_NE(table.find(",mixture,attachments,family_role,age,sex,tags,hair\r\n"), table.npos)
      << table;
  EXPECT_NE(table.find("mob_smith_mother,7,smith,"), table.npos) << table;
  EXPECT_NE(table.find(",mother,0,female,female,bun\r\n"), table.npos) << table;
  EXPECT_NE(table.find(",child,0.5,male,male;old,\r\n"), table.npos) << table;
  EXPECT_TRUE(table.ends_with(",,0,female,female,\r\n")) << table;
}

TEST(PlanFile, TableSaysTheSame) {
  FacePlan by_hand = example();
  by_hand.id = "mine";
  by_hand.index.reset();
  by_hand.notes.nearest.reset();
  EXPECT_EQ(whole_text(table_text({example(), by_hand}, kNames)),
            "id,index,family,target,top_position_x,top_position_y,top_weights,top_smoothness,"
            "top_iterations,top_extrapolation,low_position_x,low_position_y,low_weights,"
            "low_smoothness,low_iterations,low_extrapolation,nearest_face,nearest_face_mm,"
            "nearest_crowd,nearest_crowd_mm,group,mixture\r\n"
            "mob_0007,7,,cyd,0.1,-0.3333333333333333,ann:0.3333333333333333;cyd:0.6666666666666666,"
            "0.45,9000,1.1,,,bob:1,0,0,-0.30000000000000004,bob,2.4124,mob_0003,1,,\r\n"
            "mine,,,cyd,0.1,-0.3333333333333333,ann:0.3333333333333333;cyd:0.6666666666666666,"
            "0.45,9000,1.1,,,bob:1,0,0,-0.30000000000000004,,,,,,\r\n");
}

}  // namespace
}  // namespace crowdface
