// SPDX-License-Identifier: Apache-2.0
// Configs that are refused, and the place that is told.
#include <gmock/gmock.h>

#include "crowdface/config/config_reader.h"

#include "config/config_test_folder.h"

namespace crowdface {
namespace {

using testing::HasSubstr;

/// What is wrong with one value: the text that follows kBands (so it starts in line 5), the place,
/// a phrase of the message.
struct Wrong {
  const char* text;
  const char* place;
  const char* phrase;
};

/// Names a case in test lists; without it they would show addresses.
void PrintTo(const Wrong& wrong, std::ostream* out) {
  *out << wrong.text;
}

class WrongConfig : public ConfigTest, public testing::WithParamInterface<Wrong> {
 protected:
  void SetUp() override {
    ConfigTest::SetUp();
    std::filesystem::rename(folder_, folder_.parent_path() / flat_name());
    folder_ = folder_.parent_path() / flat_name();
  }

 private:
  // A parameterized test's name holds a slash.
  static std::string flat_name() {
    std::string name = concat("crowdface_wrong_", getpid(), '_',
                              testing::UnitTest::GetInstance()->current_test_info()->name());
    for (char& c : name) c = c == '/' ? '_' : c;
    return name;
  }
};

TEST_P(WrongConfig, IsToldOnceWithItsPlace) {
  EXPECT_FALSE(read(kBands + GetParam().text));
  EXPECT_THAT(told(), testing::StartsWith(concat("c.yaml:", GetParam().place, ": ")));
  EXPECT_THAT(told(), HasSubstr(GetParam().phrase));
  EXPECT_EQ(problems_.size(), 1u) << told();
  EXPECT_EQ(problems_.code(), ExitCode::kUsage);
}

INSTANTIATE_TEST_SUITE_P(
    Colours, WrongConfig,
    testing::Values(
        Wrong{"textures: {colours: apart}", "5:21", "recipe or drawn"},
        Wrong{"points: \"C:\\users\\p.yaml\"", "5:18", "write paths with /"},
        Wrong{"textures: {blend: target, colours: drawn}", "5:36", "requires textures.blend: auto"},
        Wrong{"textures: {alike: []}", "5:19", "requires colours: drawn"},
        Wrong{"textures: {colours: drawn, alike: [amn]}", "5:35", "no head has the tag \"amn\""},
        Wrong{"textures: {colours: drawn, alike: all}", "5:35", "a list of tags, [female, male]"},
        Wrong{"recipes: [{id: r, target: ann, colours: {zed: 1}}]", "5:42", "no head is called"},
        Wrong{"recipes: [{id: r, target: ann, colours: {bob: 0}}]", "5:41", "sum to zero"},
        Wrong{"textures: {blend: none}\nrecipes: [{id: r, target: ann, colours: {bob: 1}}]", "6:41",
              "requires textures.blend: auto"},
        Wrong{"recipes: [{id: r, target: ann, colours: bob}]", "5:41", "{head: weight}"}));

INSTANTIATE_TEST_SUITE_P(
    Smoothing, WrongConfig,
    testing::Values(
        Wrong{"smoothing: {max_size: 240}", "5:23", "mm, cm, m or in?"},
        Wrong{"smoothing: {max_size: \"240\"}", "5:23", "length with its unit"},
        Wrong{"smoothing: {max_size: 240 ft}", "5:23", "found \"240 ft\""},
        Wrong{"smoothing: {max_size: 0 mm}", "5:23", "above 0 mm"},
        Wrong{"smoothing: {max_size: -5 mm}", "5:23", "from 0 mm to"},
        Wrong{"smoothing: {max_size: 11 m}", "5:23", "10000 mm"},
        Wrong{"smoothing: {max_size: 1e999 mm}", "5:23", "expected a length"},
        Wrong{"smoothing: {max_size: [1 mm]}", "5:23", "found a list of 1"},
        Wrong{"smoothing: {max_iterations: 0}", "5:29", "whole number from 1 to 10000000"},
        Wrong{"smoothing: {max_iterations: 1.5}", "5:29", "whole number"},
        Wrong{"smoothing: {max_iterations: 010}", "5:29", "ambiguous"},
        Wrong{"smoothing: {max_iterations: 0x10}", "5:29", "found \"0x10\""},
        Wrong{"smoothing: {max_iterations: 1_000}", "5:29", "found \"1_000\""},
        Wrong{"smoothing: {max_iterations: \"10\"}", "5:29", "leave the quotes out"},
        Wrong{"smoothing: {max_iterations: 99999999999999999999}", "5:29", "whole number"},
        Wrong{"smoothing: {boundary: fix}", "5:23", "did you mean \"fixed\"?"},
        Wrong{"smoothing: {operator: [lazy]}", "5:23", "found a list of 1"},
        Wrong{"smoothing: {levels: bases}", "5:21", "did you mean \"basis\"?"},
        Wrong{"smoothing: {tolerance: 0.05}", "5:24", "mm, cm, m or in?"},
        Wrong{"smoothing: {tolerance: 0.001 mm}", "5:24", "at least 0.005 mm"},
        Wrong{"smoothing: {tolerance: -1 mm}", "5:24", "expected a length"},
        Wrong{"smoothing: [max_size]", "5:12", "expected a mapping with the keys max_size"},
        Wrong{"smoothing:", "5:1", "no value"}, Wrong{"smoothing: ~", "5:1", "no value"},
        Wrong{"smoothing:\n  levels:\n", "6:3", "smoothing.levels: no value"}));

INSTANTIATE_TEST_SUITE_P(
    Basics, WrongConfig,
    testing::Values(
        Wrong{"parts: eyes", "5:8", "expected auto or none, found \"eyes\""},
        Wrong{"parts: {shape: targte}", "5:16", "did you mean \"target\"?"},
        Wrong{"parts: {rigid: Teeth}", "5:16", "expected a list of materials"},
        Wrong{"parts: {rigid: [[Teeth]]}", "5:17", "expected a material, a group"},
        Wrong{"parts: {together: [Teeth]}", "5:20", "expected a list of materials"},
        Wrong{"parts: {soft: []}", "5:9", "expected one of shape, skin, rigid"},
        Wrong{"blending: {normalization: print}", "5:27", "did you mean \"printed\"?"},
        Wrong{"blending: {normalisation: printed}", "5:12", "did you mean \"normalization\"?"},
        Wrong{"shapes: {}", "5:9", "expected neutral"},
        Wrong{"shapes: {neutral: heads/ann.obj}", "5:9", "and directory"},
        Wrong{"plane: {layout: manual, anchors: {ann: [0, 0]}}", "5:17",
              "missing in plane.anchors: "
              "bob, cyd"},
        Wrong{"plane: {layout: manual}", "5:17", "ann, bob, cyd"},
        Wrong{"plane: {anchors: {anna: [0, 0]}}", "5:19", "did you mean \"ann\"?"},
        Wrong{"plane: {anchors: {ann: 3}}", "5:24",
              "expected a list of two numbers, [x, y], found "
              "\"3\""},
        Wrong{"plane: {anchors: {ann: {x: 1}}}", "5:24", "found a mapping"},
        Wrong{"plane: {anchors: {ann: [0, 0, 0]}}", "5:24", "found a list of 3"},
        Wrong{"plane: {anchors: {ann: [0, nan]}}", "5:28", "plane.anchors.ann #2"},
        Wrong{"plane: {anchors: {ann: [.inf, 0]}}", "5:25", "expected a number"},
        Wrong{"plane: {anchors: {ann: [0, 2e6]}}", "5:28", "found \"2e6\""},
        Wrong{"plane: {anchors: {ann: [0, 1e999]}}", "5:28", "found \"1e999\""},
        Wrong{"plane: {anchors: [1]}", "5:18", "mapping from heads to points"},
        Wrong{"attachments: hair", "5:14", "none or a mapping"},
        Wrong{"attachments: {fitted_to: mean}", "5:14", "from or items is missing"},
        Wrong{"attachments: {items: [], hair_colours: {rad: 0.3}}", "5:46",
              "did you mean \"red\"?"},
        Wrong{"attachments: {items: [], hair_colours: {red: 0.7, black: 0.4}}", "5:58",
              "add up to more than 1"},
        Wrong{"attachments: {fitted_to: anna, items: []}", "5:26", "did you mean \"ann\"?"},
        Wrong{"attachments: {items: [{name: a, file: heads/ann.obj}]}", "5:23", "kind: missing"},
        Wrong{"attachments: {items: [{name: a, kind: hair, file: heads/ann.ply}]}", "5:51",
              "ends in .obj"},
        Wrong{"attachments: {items: [{name: a, kind: hair, file: heads/ann.obj, moves: stiff}]}",
              "5:73", "expected bend or rigid"},
        Wrong{"attachments: {items: [{name: a, kind: hair, file: heads/ann.obj, tags: [green]}]}",
              "5:72", "no head has all of these tags"},
        Wrong{"attachments: {items: [{name: a, kind: hair, file: heads/ann.obj, excludes: [hat]}]}",
              "5:77", "no attachment has the name or kind \"hat\""},
        Wrong{"attachments: {items: [{name: LOD1, kind: hair, file: heads/ann.obj}]}", "5:23",
              "choose another name"},
        Wrong{"attachments: {items: [{name: a, kind: hair, file: heads/ann.obj}, "
              "{name: a, kind: hat, file: heads/ann.obj}]}",
              "5:67", "two attachments are called \"a\""},
        Wrong{"attachments: {items: [{name: a, kind: hair, file: heads/ann.obj}], "
              "none: {hare: 0.5}}",
              "5:81", "did you mean \"hair\"?"},
        Wrong{"attachments: {items: [{name: a, kind: hair, file: heads/ann.obj}], "
              "none: {hair: 2}}",
              "5:81", "a number from 0 to 1"},
        Wrong{"attachments: {items: [{name: a, kind: hair, file: heads/ann.obj, colour: red}], "
              "quotas: {rad: 0.5}}",
              "5:95", "did you mean \"red\"?"},
        Wrong{"attachments: {items: [{name: a, kind: hair, file: heads/ann.obj, colour: red}], "
              "quotas: {hair: 0.5, red: 0.1}}",
              "5:106", "found both: hair"},
        Wrong{"attachments: {items: [{name: a, kind: hair, file: heads/ann.obj}], "
              "none: {hair: 0.5}, quotas: {hair: 0.5}}",
              "5:102", "keep only one of the two"},
        Wrong{"attachments: {items: [{name: a, kind: hair, file: heads/ann.obj, colour: red}, "
              "{name: b, kind: hair, file: heads/ann.obj}], quotas: {red: 0.7, b: 0.7}}",
              "5:147", "add up to more than 1"},
        Wrong{"output: {meshes: obj}", "5:18", "expected a list"},
        Wrong{"output: {meshes: [obj, obj]}", "5:24", "twice"},
        Wrong{"output: {meshes: [fbx]}", "5:19",
              "expected obj or ply or glb or points or usd, found \"fbx\""},
        Wrong{"output: {directory: ''}", "5:21", "expected a folder"},
        Wrong{"output: {directory: \"a\\0b\"}", "5:21", "expected a folder"},
        Wrong{"output: {lods: [50 %, 0.2]}", "5:23", "a decreasing list of up to 8 percentages"},
        Wrong{"output: {lods: [20 %, 20 %]}", "5:23", "a decreasing list"},
        Wrong{"output: {lods: [100 %]}", "5:17", "a decreasing list of up to 8 percentages"},
        Wrong{"output: {lods: 50 %}", "5:16", "a decreasing list of up to 8 percentages"},
        Wrong{"output: {contact_sheet: off}", "5:25", "none or a mapping"},
        Wrong{"output: {contact_sheet: {labels: [id, id]}}", "5:39", "named twice"},
        Wrong{"output: {contact_sheet: {labels: []}}", "5:34", "a list of labels"},
        Wrong{"output: {contact_sheet: {order: size}}", "5:33", "likeness"},
        Wrong{"output: {contact_sheet: {compare_scale: 0 mm}}", "5:41", "above 0"},
        Wrong{"output: {meshes: [], contact_sheet: {compare: target}}", "5:47", "needs meshes"},
        Wrong{"output: {gallery: yes}", "5:19", "auto"},
        Wrong{"output: {surfaces: {Skin: '#12345'}}", "5:27", "#c0a080"},
        Wrong{"output: {surfaces: {Skin: stone}}", "5:27", "hidden"},
        Wrong{"output: {contact_sheet: {columns: 33}}", "5:35", "from 1 to 32"},
        Wrong{"output: {contact_sheet: {rows: 0}}", "5:32", "from 1 to 64"},
        Wrong{"output: {contact_sheet: {cell: 31}}", "5:32", "from 32 to 2048"},
        Wrong{"output: {contact_sheet: {views: []}}", "5:33", "an empty list"},
        Wrong{"output: {contact_sheet: {views: [top]}}", "5:34", "found \"top\""},
        Wrong{"output: {contact_sheet: {views: [front, front]}}", "5:41", "twice"}));

INSTANTIATE_TEST_SUITE_P(
    Sampling, WrongConfig,
    testing::Values(
        Wrong{"sampling: {targets: ann}", "5:21", "all or a list of heads and tags"},
        Wrong{"sampling: {targets: []}", "5:21", "an empty list"},
        Wrong{"sampling: {targets: {}}", "5:21", "an empty mapping"},
        Wrong{"sampling: {targets: [bop]}", "5:22", "did you mean \"bob\"?"},
        Wrong{"sampling: {targets: {ann: 0}}", "5:27", "above 0"},
        Wrong{"sampling: {targets: {ann: -1}}", "5:27", "from 0 to"},
        Wrong{"sampling: {targets: {ann: ~}}", "5:22", "found no value"},
        Wrong{"sampling: {sources: {ann: 1}}", "5:21", "found a mapping"},
        Wrong{"sampling: {sources: [ann, nobody]}", "5:27", "no head and no tag"},
        Wrong{"sampling: {max_sources: 0}", "5:25", "from 1 to 50"},
        Wrong{"sampling: {max_source: 2}", "5:12", "did you mean \"max_sources\"?"},
        Wrong{"sampling: {smoothness: 2}", "5:24", "from 0 to 1"},
        Wrong{"sampling: {smoothness: 00.5}", "5:24", "write 0.5"},
        Wrong{"sampling: {smoothness: '0.5'}", "5:24", "leave the quotes out"},
        Wrong{"sampling: {smoothness: much}", "5:24", "a fraction from 0 to 1 or a size"},
        Wrong{"sampling: {smoothness: [0.5, 0.2]}", "5:24", "low at most high, found [0.5, 0.2]"},
        Wrong{"sampling: {smoothness: [0.5]}", "5:24", "a list of two"},
        Wrong{"sampling: {smoothness: [0.5, 8 mm]}", "5:24", "one of each"},
        Wrong{"sampling: {smoothness: 300 mm}", "5:24", "up to smoothing.max_size, 240 mm"},
        Wrong{"sampling: {smoothness: {}}", "5:24", "an empty mapping"},
        Wrong{"sampling: {smoothness: {tpo: 0.5}}", "5:25", "did you mean \"top\"?"},
        Wrong{"sampling: {smoothness: {top: ~}}", "5:25", "no value"},
        Wrong{"sampling: {smoothness: {default: 0.5, iterations: 3}}", "5:24", "found both"},
        Wrong{"sampling: {smoothness: {iterations: 0.5}}", "5:37", "whole number"},
        Wrong{"smoothing: {max_iterations: 9}\nsampling: {smoothness: {iterations: 10}}", "6:37",
              "from 0 to 9"},
        Wrong{"sampling: {extrapolation: 5}", "5:27", "from -4 to 4"},
        Wrong{"sampling: {extrapolation: {top: {low: 1}}}", "5:33", "found a mapping"},
        Wrong{"sampling: {extrapolation: {top: [1, 2, 3]}}", "5:33", "[low, high]"},
        Wrong{"sampling: {position: uniform}", "5:22", "expected a mapping"},
        Wrong{"sampling: {position: {distribution: unifrom}}", "5:37", "did you mean \"uniform\"?"},
        Wrong{"sampling: {position: {radius: 1}}", "5:22",
              "sampling.position.distribution: missing"},
        Wrong{"sampling: {position: {distribution: uniform, radius: 1}}", "5:46",
              "uniform does not use this key"},
        Wrong{"sampling: {position: {distribution: around}}", "5:22", "radius: missing"},
        Wrong{"sampling: {position: {distribution: around, radius: 0}}", "5:53", "above 0"},
        Wrong{"sampling: {position: {distribution: around, radius: 1, face: eve}}", "5:62",
              "no head is called \"eve\""},
        Wrong{"sampling: {position: {distribution: fixed}}", "5:22", "position: missing"},
        Wrong{"sampling: {position: {low: {distribution: fixed, position: [1]}}}", "5:60",
              "list of two numbers"}));

INSTANTIATE_TEST_SUITE_P(
    Recipes, WrongConfig,
    testing::Values(
        Wrong{"recipes: {id: a}", "5:10", "expected a list of recipes"},
        Wrong{"recipes: [a]", "5:11", "expected a mapping with the keys id"},
        Wrong{"recipes: [{target: ann}]", "5:11", "recipes #1.id: missing"},
        Wrong{"recipes: [{id: a/b}]", "5:16", "expected a name"},
        Wrong{"recipes: [{id: .a}]", "5:16", "not starting with '.'"},
        Wrong{"recipes: [{id: mob_0004}]", "5:16", "belong to the sampled faces"},
        Wrong{"recipes: [{id: a}, {id: a}]", "5:25", "twice; first at"},
        Wrong{"recipes: [{id: a, target: dan}]", "5:27", "no head is called \"dan\""},
        Wrong{"recipes: [{id: a, regions: {topp: {}}}]", "5:29", "did you mean \"top\"?"},
        Wrong{"recipes: [{id: a, regions: {top: 3}}]", "5:34", "found \"3\""},
        Wrong{"recipes: [{id: a, regions: {top: {weigths: {}}}}]", "5:35", "\"weights\"?"},
        Wrong{"recipes: [{id: a, regions: {top: {weights: {}}}}]", "5:44", "an empty mapping"},
        Wrong{"recipes: [{id: a, regions: {top: {weights: {ann: -1}}}}]", "5:50", "from 0 to"},
        Wrong{"recipes: [{id: a, regions: {top: {weights: {ann: 0, bob: 0}}}}]", "5:44",
              "sum to zero"},
        Wrong{"recipes: [{id: a, regions: {top: {weights: {ann: 1}, position: [0, 0]}}}]", "5:34",
              "either position or weights"},
        Wrong{"recipes: [{id: a, regions: {top: {smoothness: 0.5, iterations: 3}}}]", "5:34",
              "either smoothness or iterations"},
        Wrong{"recipes: [{id: a, regions: {top: {smoothness: {iterations: 3}}}}]", "5:47",
              "found a mapping"},
        Wrong{"blending: {normalization: printed}\n"
              "recipes: [{id: a, regions: {all: {weights: {ann: 1}}}}]",
              "6:44", "position instead of weights"}));

// Every key that takes a plain value, with every kind of wrong value in place of it.
TEST_F(ConfigTest, NoKeyTakesAValueOfAnotherKind) {
  const std::vector<std::string> keys = {
      "smoothing: {max_size: ",
      "smoothing: {max_iterations: ",
      "smoothing: {boundary: ",
      "smoothing: {operator: ",
      "smoothing: {levels: ",
      "smoothing: {tolerance: ",
      "blending: {normalization: ",
      "plane: {layout: ",
      "plane: {anchors: {bob: ",
      "sampling: {targets: ",
      "sampling: {targets: {bob: ",
      "sampling: {sources: ",
      "sampling: {max_sources: ",
      "sampling: {position: ",
      "sampling: {position: {distribution: ",
      "sampling: {position: {top: ",
      "sampling: {position: {default: {distribution: around, radius: ",
      "sampling: {position: {default: {distribution: around, radius: 1, face: ",
      "sampling: {position: {default: {distribution: fixed, position: ",
      "sampling: {smoothness: ",
      "sampling: {smoothness: {mid: ",
      "sampling: {smoothness: {iterations: ",
      "sampling: {extrapolation: {low: [0, ",
      "recipes: [{id: a, target: ",
      "recipes: [{id: a, regions: {all: {position: ",
      "recipes: [{id: a, regions: {all: {weights: ",
      "recipes: [{id: a, regions: {all: {weights: {bob: ",
      "recipes: [{id: a, regions: {all: {smoothness: ",
      "recipes: [{id: a, regions: {all: {iterations: ",
      "output: {contact_sheet: {columns: ",
      "output: {contact_sheet: {rows: ",
      "output: {contact_sheet: {cell: ",
      "output: {contact_sheet: {views: ",
  };
  for (const std::string& key : keys) {
    std::string closing;
    for (auto c = key.rbegin(); c != key.rend(); ++c) {
      if (*c == '{') closing += '}';
      if (*c == '[') closing += ']';
    }
    for (const char* value : {"[]", "{}", "[[1], 2]", "{x: 1}", "nonsense", "-7", "nan", ".inf",
                              "''", "1e999", "0x1F"}) {
      const std::string text = concat(key, value, closing);
      EXPECT_FALSE(read(kBands + text)) << text;
      ASSERT_FALSE(problems_.empty()) << text;
      EXPECT_THAT(told(), testing::StartsWith("c.yaml:5:")) << text;
      EXPECT_EQ(problems_.code(), ExitCode::kUsage) << text;
      const auto column = parse_unsigned(told().substr(9, told().find(':', 9) - 9));
      ASSERT_TRUE(column) << told();
      EXPECT_GE(*column, key.size() + 1) << text << '\n' << told();
    }
  }
}

class WrongHead : public ConfigTest {};

TEST_F(WrongHead, SectionsAreCheckedToo) {
  const auto first = [&](const std::string& text) {
    EXPECT_FALSE(read(text)) << text;
    return problems_.empty() ? "" : told();
  };
  const std::string schema = "schema: 1\n", crowd = "crowd: {name: a, count: 1}\n";
  EXPECT_THAT(first(""), HasSubstr("c.yaml:1:1: expected a value, found nothing"));
  EXPECT_THAT(first("- a\n"), HasSubstr("c.yaml:1:1: expected a mapping with the keys schema"));
  EXPECT_THAT(first("a:b\n"), HasSubstr("found \"a:b\""));
  EXPECT_THAT(first("{}\n"), HasSubstr("c.yaml:1:1: schema: missing; write \"schema: 1\"\n"
                                       "c.yaml:1:1: crowd: missing"));
  EXPECT_THAT(first("schema: '1'\n"),
              HasSubstr("c.yaml:1:9: schema: this crowdface reads schema 1"));
  const auto with_faces = [&](const std::string& faces) {
    return first(schema + crowd + "faces: " + faces + "\n");
  };
  EXPECT_THAT(with_faces("{units: cm}"), HasSubstr("3:8: faces: expected directory ("));
  EXPECT_THAT(with_faces("{units: cm, directory: a, files: [b.obj]}"), HasSubstr("found both"));
  EXPECT_THAT(with_faces("{units: cm, files: heads/ann.obj}"),
              HasSubstr("3:27: faces.files: expected a list"));
  EXPECT_THAT(with_faces("{units: cm, files: [heads/ann.obj]}"), HasSubstr("found 1 files"));
  EXPECT_THAT(with_faces("{units: cm, files: [a.max, b.obj]}"), HasSubstr("ends in .obj"));
  EXPECT_THAT(with_faces("{units: yards, directory: heads}"),
              HasSubstr("3:16: faces.units: expected mm, cm, m, in, ft, or a length"));
  EXPECT_THAT(with_faces("{units: cm, directory: heads, up: W}"),
              HasSubstr("3:42: faces.up: expected an axis"));
  EXPECT_THAT(with_faces("{units: cm, directory: heads, up: +Z}"), HasSubstr("two different axes"));
  EXPECT_THAT(with_faces("{units: cm, directory: heads, align: rigdi}"),
              HasSubstr("did you mean \"rigid\"?"));
  EXPECT_THAT(with_faces("{units: cm, directory: heads, tags: {amn: [x]}}"),
              HasSubstr("3:45: faces.tags: no head is called \"amn\"; did you mean \"ann\"?"));
  EXPECT_THAT(with_faces("{units: cm, directory: heads, tags: {ann: [bob]}}"),
              HasSubstr("also the name of a head"));
  EXPECT_THAT(with_faces("{units: cm, directory: heads, tags: {ann: [x, x]}}"),
              HasSubstr("3:54: faces.tags.ann #2: the tag \"x\" is named twice"));
  EXPECT_THAT(with_faces("{units: cm, directory: heads, tags: {ann: [all]}}"),
              HasSubstr("because the word is reserved; rename the tag"));
  EXPECT_THAT(with_faces("{units: cm, directory: heads, tags: {ann: old}}"),
              HasSubstr("a list of tags"));
  const auto with_regions = [&](const std::string& regions) {
    return first(kPlain + "regions: " + regions + "\n");
  };
  EXPECT_THAT(with_regions("some"), HasSubstr("4:10: regions: expected none or a mapping"));
  EXPECT_THAT(with_regions("{names: [a]}"), HasSubstr("regions.mask: missing"));
  EXPECT_THAT(with_regions("{mask: mask.png}"), HasSubstr("regions.names: missing"));
  EXPECT_THAT(with_regions("{names: a, mask: mask.png}"), HasSubstr("a list of 1 to 16 names"));
  EXPECT_THAT(with_regions("{names: [default], mask: mask.png}"),
              HasSubstr("a region cannot have the name \"default\""));
  EXPECT_THAT(with_regions("{names: [a, a], mask: mask.png}"),
              HasSubstr("4:22: regions.names #2: the region \"a\" is named twice"));
  EXPECT_THAT(with_regions("{names: [a], mask: []}"), HasSubstr("an image file or a list"));
  EXPECT_THAT(with_regions("{names: [a], mask: \"<UDIM>/a.png\"}"),
              HasSubstr("expected <UDIM> only once"));
  EXPECT_THAT(with_regions("{names: [a], mask: no.<UDIM>.png}"),
              HasSubstr("such as \"no.1001.png\""));
}

}  // namespace
}  // namespace crowdface
