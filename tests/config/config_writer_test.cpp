// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "crowdface/cast/diversity.h"
#include "crowdface/cast/family.h"
#include "crowdface/cast/sampling.h"
#include "crowdface/config/config.h"

#include "config/config_test_folder.h"

namespace crowdface {
namespace {

using testing::HasSubstr;
using testing::Not;

bool same(const WeightedHead& a, const WeightedHead& b) {
  return a.head == b.head && a.weight == b.weight;
}

bool same(const std::vector<WeightedHead>& a, const std::vector<WeightedHead>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const auto& x, const auto& y) { return same(x, y); });
}

bool same(const SmoothnessDistribution& a, const SmoothnessDistribution& b) {
  return a.unit == b.unit && a.range == b.range;
}

bool same(const RegionSampling& a, const RegionSampling& b) {
  return a.position.kind == b.position.kind && a.position.head == b.position.head &&
         a.position.radius == b.position.radius && a.position.at == b.position.at &&
         a.position.pull == b.position.pull && same(a.smoothness, b.smoothness) &&
         a.extrapolation == b.extrapolation;
}

bool same(const ManualRecipe::Region& a, const ManualRecipe::Region& b) {
  return a.position == b.position && same(a.weights, b.weights) &&
         a.smoothness.has_value() == b.smoothness.has_value() &&
         (!a.smoothness || same(*a.smoothness, *b.smoothness)) &&
         a.extrapolation == b.extrapolation;
}

/// Every field but the name of the config's file.
void expect_equal(const Config& a, const Config& b) {
  EXPECT_EQ(a.crowd.name, b.crowd.name);
  EXPECT_EQ(a.crowd.count, b.crowd.count);
  EXPECT_EQ(a.crowd.seed, b.crowd.seed);
  EXPECT_EQ(a.faces.files, b.faces.files);
  EXPECT_EQ(a.faces.names, b.faces.names);
  EXPECT_EQ(a.faces.units, b.faces.units);
  EXPECT_EQ(a.faces.up, b.faces.up);
  EXPECT_EQ(a.faces.front, b.faces.front);
  EXPECT_EQ(a.faces.align, b.faces.align);
  EXPECT_EQ(a.faces.tags, b.faces.tags);
  EXPECT_EQ(a.regions.names, b.regions.names);
  EXPECT_EQ(a.regions.mask, b.regions.mask);
  EXPECT_EQ(a.smoothing.max_size_mm, b.smoothing.max_size_mm);
  EXPECT_EQ(a.smoothing.max_iterations, b.smoothing.max_iterations);
  EXPECT_EQ(a.smoothing.boundary, b.smoothing.boundary);
  EXPECT_EQ(a.smoothing.operator_kind, b.smoothing.operator_kind);
  EXPECT_EQ(a.smoothing.levels, b.smoothing.levels);
  EXPECT_EQ(a.smoothing.tolerance_mm, b.smoothing.tolerance_mm);
  EXPECT_EQ(a.blending.normalization, b.blending.normalization);
  EXPECT_EQ(a.parts.follow_skin, b.parts.follow_skin);
  EXPECT_EQ(a.parts.shape, b.parts.shape);
  EXPECT_EQ(a.parts.skin, b.parts.skin);
  EXPECT_EQ(a.parts.rigid, b.parts.rigid);
  EXPECT_EQ(a.parts.bound, b.parts.bound);
  EXPECT_EQ(a.parts.together, b.parts.together);
  EXPECT_EQ(a.plane.layout, b.plane.layout);
  EXPECT_EQ(a.plane.anchors, b.plane.anchors);
  EXPECT_TRUE(same(a.sampling->targets, b.sampling->targets));
  EXPECT_EQ(a.sampling->sources, b.sampling->sources);
  EXPECT_EQ(a.sampling->max_sources, b.sampling->max_sources);
  ASSERT_EQ(a.sampling->regions.size(), b.sampling->regions.size());
  for (std::size_t i = 0; i < a.sampling->regions.size(); ++i) {
    EXPECT_TRUE(same(a.sampling->regions[i], b.sampling->regions[i])) << i;
  }
  EXPECT_EQ(a.sampling->age, b.sampling->age);
  EXPECT_EQ(a.distance.area, b.distance.area);
  EXPECT_EQ(a.distance.mask, b.distance.mask);
  EXPECT_EQ(a.diversity->mode, b.diversity->mode);
  EXPECT_EQ(a.diversity->min_distance_mm, b.diversity->min_distance_mm);
  EXPECT_EQ(a.diversity->min_distance_to_heads_mm, b.diversity->min_distance_to_heads_mm);
  EXPECT_EQ(a.diversity->max_weight, b.diversity->max_weight);
  EXPECT_EQ(a.believability->check, b.believability->check);
  EXPECT_EQ(a.believability->max_deviation, b.believability->max_deviation);
  EXPECT_EQ(a.believability->max_flipped, b.believability->max_flipped);
  EXPECT_EQ(a.believability->meshes, b.believability->meshes);
  ASSERT_EQ(a.families.size(), b.families.size());
  for (std::size_t i = 0; i < a.families.size(); ++i) {
    EXPECT_EQ(a.families[i].name, b.families[i].name);
    EXPECT_EQ(a.families[i].member_count, b.families[i].member_count);
    EXPECT_EQ(a.families[i].target, b.families[i].target);
    EXPECT_EQ(a.families[i].parent_of_band, b.families[i].parent_of_band);
    EXPECT_EQ(a.families[i].parents.size(), b.families[i].parents.size());
    EXPECT_EQ(a.families[i].max_distance_mm, b.families[i].max_distance_mm);
    EXPECT_EQ(a.families[i].min_distance_mm, b.families[i].min_distance_mm);
    EXPECT_EQ(a.families[i].age, b.families[i].age);
  }
  ASSERT_EQ(a.recipes.size(), b.recipes.size());
  for (std::size_t i = 0; i < a.recipes.size(); ++i) {
    EXPECT_EQ(a.recipes[i].id, b.recipes[i].id);
    EXPECT_EQ(a.recipes[i].target, b.recipes[i].target);
    ASSERT_EQ(a.recipes[i].colours.size(), b.recipes[i].colours.size());
    for (std::size_t c = 0; c < a.recipes[i].colours.size(); ++c) {
      EXPECT_EQ(a.recipes[i].colours[c].head, b.recipes[i].colours[c].head);
      EXPECT_EQ(a.recipes[i].colours[c].weight, b.recipes[i].colours[c].weight);
    }
    ASSERT_EQ(a.recipes[i].regions.size(), b.recipes[i].regions.size());
    for (std::size_t k = 0; k < a.recipes[i].regions.size(); ++k) {
      EXPECT_TRUE(same(a.recipes[i].regions[k], b.recipes[i].regions[k])) << i << ' ' << k;
    }
  }
  EXPECT_EQ(a.output.directory, b.output.directory);
  EXPECT_EQ(a.output.meshes, b.output.meshes);
  EXPECT_EQ(a.output.gallery, b.output.gallery);
  ASSERT_EQ(a.output.surfaces.size(), b.output.surfaces.size());
  for (const auto& [name, surface] : a.output.surfaces) {
    EXPECT_EQ(surface.kind, b.output.surfaces.at(name).kind) << name;
    EXPECT_EQ(surface.colour, b.output.surfaces.at(name).colour) << name;
  }
  EXPECT_EQ(a.textures.blend, b.textures.blend);
  EXPECT_EQ(a.textures.size, b.textures.size);
  EXPECT_EQ(a.textures.formats, b.textures.formats);
  EXPECT_EQ(a.textures.colours, b.textures.colours);
  EXPECT_EQ(a.textures.matching_tags, b.textures.matching_tags);
  ASSERT_EQ(a.output.contact_sheet.has_value(), b.output.contact_sheet.has_value());
  if (a.output.contact_sheet) {
    EXPECT_EQ(a.output.contact_sheet->columns, b.output.contact_sheet->columns);
    EXPECT_EQ(a.output.contact_sheet->rows, b.output.contact_sheet->rows);
    EXPECT_EQ(a.output.contact_sheet->cell, b.output.contact_sheet->cell);
    EXPECT_EQ(a.output.contact_sheet->views, b.output.contact_sheet->views);
    EXPECT_EQ(a.output.contact_sheet->labels, b.output.contact_sheet->labels);
    EXPECT_EQ(a.output.contact_sheet->order, b.output.contact_sheet->order);
    EXPECT_EQ(a.output.contact_sheet->compare.reference, b.output.contact_sheet->compare.reference);
    EXPECT_EQ(a.output.contact_sheet->compare.file, b.output.contact_sheet->compare.file);
    EXPECT_EQ(a.output.contact_sheet->compare.scale_mm, b.output.contact_sheet->compare.scale_mm);
    EXPECT_EQ(a.output.contact_sheet->formats, b.output.contact_sheet->formats);
    EXPECT_EQ(a.output.contact_sheet->texture, b.output.contact_sheet->texture);
  }
}

class EffectiveConfig : public ConfigTest {
 protected:
  /// Reads, writes into the output folder, reads again: the same config, and the same bytes.
  std::string round_trip(const std::string& text) {
    const auto first = read(text);
    EXPECT_TRUE(first) << told();
    if (!first) return "";
    std::string written = effective_config(*first, first->output.directory);
    const auto file = first->output.directory / "config.yaml";
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file) << written;
    const auto second = read_config(file, {}, problems_);
    EXPECT_TRUE(second) << told() << written;
    if (!second) return written;
    expect_equal(*first, *second);
    EXPECT_EQ(effective_config(*second, second->output.directory), written);
    return written;
  }
};

TEST_F(EffectiveConfig, KeepsWhatIsSaidOfParts) {
  EXPECT_THAT(round_trip(kPlain + "parts: none\n"), ::testing::HasSubstr("\nparts: none\n"));
  round_trip(kPlain +
             "parts: {shape: blend, skin: [M_Gums], rigid: [\"component 3\", 'a: b'],\n"
             "  bound: [Lashes], together: [[M_Teeth, M_Gums], [eye]]}\n");
}

TEST_F(EffectiveConfig, SpellsOutEveryDefault) {
  EXPECT_EQ(round_trip(kPlain),
            "schema: 1\n"
            "crowd:\n"
            "  name: mob\n"
            "  count: 3\n"
            "  seed: 1\n"
            "faces:\n"
            "  files:\n"
            "    - ../../heads/ann.obj\n"
            "    - ../../heads/bob.obj\n"
            "    - ../../heads/cyd.obj\n"
            "  units: cm\n"
            "  up: +Y\n"
            "  front: +Z\n"
            "  align: check\n"
            "  tags: {}\n"
            "regions: none\n"
            "smoothing:\n"
            "  max_size: 240 mm\n"
            "  boundary: fixed\n"
            "  operator: umbrella\n"
            "  levels: basis\n"
            "  tolerance: 0.05 mm\n"
            "blending:\n"
            "  normalization: partition\n"
            "  contacts: auto\n"
            "parts:\n"
            "  shape: target\n"
            "  skin: []\n"
            "  rigid: []\n"
            "  bound: []\n"
            "  together: []\n"
            "shapes: none\n"
            "points: none\n"
            "rig: none\n"
            "textures:\n"
            "  blend: auto\n"
            "  formats: [png]\n"
            "plane:\n"
            "  layout: circle\n"
            "  anchors: {}\n"
            "sampling:\n"
            "  targets: all\n"
            "  sources: all\n"
            "  position:\n"
            "    default: {distribution: anchored, pull: 0.25}\n"
            "  smoothness:\n"
            "    default: [0.2, 0.9]\n"
            "  extrapolation:\n"
            "    default: 1\n"
            "  max_sources: all\n"
            "  age: 0\n"
            "distance:\n"
            "  area: front\n"
            "diversity:\n"
            "  mode: first_fit\n"
            "  min_distance: 0 mm\n"
            "  min_distance_to_faces: 0 mm\n"
            "  max_weight: 1\n"
            "believability:\n"
            "  max_deviation: 2.5\n"
            "  max_stretch: 3\n"
            "  max_flipped: 0.003\n"
            "  max_intersecting: 0.01\n"
            "  max_gap: 0.5 mm\n"
            "  max_exposed: 3\n"
            "  meshes: auto\n"
            "recipes: []\n"
            "families: []\n"
            "review: []\n"
            "output:\n"
            "  directory: .\n"
            "  meshes: [obj]\n"
            "  lods: []\n"
            "  subdivision: none\n"
            "  gallery: auto\n"
            "  surfaces: {}\n"
            "  contact_sheet:\n"
            "    columns: 6\n"
            "    rows: 4\n"
            "    cell: 256\n"
            "    views: [front]\n"
            "    labels: [id]\n"
            "    order: plan\n"
            "    compare: none\n"
            "    compare_scale: 6 mm\n"
            "    formats: [png]\n"
            "    shapes: 0\n"
            "    texture: auto\n");
}

TEST_F(EffectiveConfig, HoldsWhatFoldersList) {
  touch("heads/tags.yaml", "faces: {tags: {ann: [female]}}");
  touch("wardrobe/attachments.yaml",
        "attachments: {items: [{name: bob, kind: hair, file: bob.obj, tags: [female]}]}");
  touch("wardrobe/bob.obj");
  const std::string written = round_trip(kPlain +
                                         "attachments: {from: wardrobe}\n"
                                         "groups: [{name: women, none: {hair: 0.25}}]\n");
  EXPECT_THAT(written, testing::HasSubstr("none: {hair: 0.25}"));
  EXPECT_THAT(written, testing::HasSubstr("ann: [female]"));
  EXPECT_THAT(written, testing::HasSubstr("file: ../../wardrobe/bob.obj"));
}

TEST_F(EffectiveConfig, ReadsBackWithEverythingSet) {
  touch("heads/null.obj");
  touch("heads/007.obj");
  const std::string written = round_trip(
      "schema: 1\n"
      "crowd: {name: '2024', count: 1000000, seed: 18446744073709551615}\n"
      "faces: {directory: heads, units: in, up: -Z, front: x, align: rigid,\n"
      "        tags: {ann: [old, thin], 'null': [old], 007: ['yes']}}\n"
      "regions: {names: [face, no, low], mask: [mask.png, tiles.<UDIM>.png]}\n"
      "smoothing: {max_size: 12.34567890123 cm, boundary: free, operator: lazy, levels: cubic, "
      "tolerance: 0.125 mm}\n"
      "shapes: {neutral: heads/ann.obj, directory: heads}\n"
      "points: mask.png\n"
      "attachments:\n"
      "  fitted_to: 'null'\n"
      "  items: [{name: mop, kind: hair, file: heads/ann.obj, tags: [old, thin], share: 0.125, "
      "colour: black},\n"
      "          {name: cap, kind: hat, file: heads/bob.obj, moves: rigid, excludes: [hair]},\n"
      "          {name: bun, kind: hair, file: heads/cyd.obj, without: [old], tint: hair}]\n"
      "  hair_colours: {red: 0.25, light_brown: 0.125}\n"
      "  none: {hair: 0.1}\n"
      "  quotas: {hat: 0.3, black: 0.25}\n"
      "plane: {layout: similarity, anchors: {ann: [0.1, -1e-7], 'null': [1e5, "
      "0.30000000000000004]}}\n"
      "sampling:\n"
      "  targets: {old: 2.5, cyd: 1}\n"
      "  sources: [thin, bob]\n"
      "  position: {default: {distribution: uniform}, face: {distribution: around, face: ann, "
      "radius: 0.7},\n"
      "             low: {distribution: fixed, position: [3, -4]}}\n"
      "  smoothness: {default: [1 mm, 2.5 cm], face: 0.25, low: {iterations: [0, 10000000]}}\n"
      "  extrapolation: {low: [-4, 4], face: 1.1}\n"
      "  max_sources: 7\n"
      "  age: [0, 0.5]\n"
      "distance: {area: skin, mask: mask.png}\n"
      "diversity: {mode: spread, min_distance: 1.25 mm, min_distance_to_faces: 0.5 mm, max_weight: "
      "0.75,\n"
      "            min_distance_to_rejected: 1 mm}\n"
      "believability: {max_deviation: 4, max_stretch: 5, max_flipped: 0.125, meshes: all}\n"
      "textures: {blend: target, size: 512, formats: [jpeg, png]}\n"
      "families:\n"
      "  - {name: 'yes', members: 2, target: bob, max_distance: 1.5 mm}\n"
      "  - {name: kin, members: 3, parents: {mother: ann, father: yes_02}, inherit: {no: father},\n"
      "     max_distance: 2 mm, min_distance: 0.5 mm, age: [0, 0.25]}\n"
      "recipes:\n"
      "  - {id: aged, target: 'null', regions: {all: {weights: {ann: 3, bob: 0}, smoothness: "
      "0.5}}}\n"
      "  - {id: 'on', regions: {face: {position: [1, 2], iterations: [3, 10000000]}, low:\n"
      "      {smoothness: [0.1 mm, 8 mm], extrapolation: [1, 1.5]}}}\n"
      "output: {directory: 'x y/ü#1', meshes: [], lods: [33.3 %, 7%], contact_sheet: {columns: 32, "
      "rows: 1, cell: 64,\n"
      "         views: [profile, front, three_quarter], labels: [nearest, id, family], order: "
      "family,\n"
      "         compare_scale: 0.5 mm, formats: [pdf, png],\n"
      "         texture: true}, gallery: none,\n"
      "         surfaces: {M Lash: '#A0b1ff', 'no': hidden, M_Gum: gums}}\n");
  EXPECT_THAT(written, HasSubstr("name: \"2024\""));
  EXPECT_THAT(written, HasSubstr("iterations: [0, 10000000]"));
  EXPECT_THAT(written, HasSubstr("moves: rigid"));
  EXPECT_THAT(written, Not(HasSubstr(folder_.string()))) << "paths are relative";
}

TEST_F(EffectiveConfig, ReadsBackWithColoursOfTheirOwn) {
  const auto written = round_trip(kBands +
                                  "textures: {colours: drawn, alike: []}\n"
                                  "recipes: [{id: r, target: ann, colours: {bob: 3, cyd: 1}}]\n");
  EXPECT_THAT(written, HasSubstr("alike: []"));
  EXPECT_THAT(round_trip(kBands), Not(HasSubstr("colours: recipe")));
}

TEST_F(EffectiveConfig, ReadsBackWithIterationsAndPrintedAndManual) {
  round_trip(kBands +
             "smoothing: {max_iterations: 10000000, max_size: 5 mm}\n"
             "blending: {normalization: printed}\n"
             "plane: {layout: manual, anchors: {ann: [0, 0], bob: [1, 0], cyd: [0, 1]}}\n"
             "sampling: {smoothness: 9 mm, position: {distribution: around, radius: 2}}\n"
             "recipes: [{id: a, regions: {top: {position: [0, 0.5]}}}]\n"
             "output: {contact_sheet: none}\n");
  round_trip(kPlain +
             "plane: {layout: grid}\nsampling: {targets: [bob], sources: [bob]}\n"
             "recipes: [{id: a, target: ann}]\n");
}

TEST_F(EffectiveConfig, DoesNotDependOnHowPathsWereWritten) {
  const auto one = read(kPlain + "output: {directory: out/mob}\n");
  const auto other = read(
      "schema: 1\ncrowd: {name: mob, count: 3}\n"
      "faces: {files: [./heads/ann.obj, heads/../heads/bob.obj, heads//cyd.obj], units: cm}\n"
      "output: {directory: heads/../out/mob/}\n");
  ASSERT_TRUE(one && other) << told();
  EXPECT_EQ(effective_config(*one, one->output.directory),
            effective_config(*other, other->output.directory));
  EXPECT_EQ(effective_config(*one, folder_ / "out/mob"),
            effective_config(*one, folder_ / "out/mob/"));
}

}  // namespace
}  // namespace crowdface
