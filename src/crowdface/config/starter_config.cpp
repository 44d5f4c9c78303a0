// SPDX-License-Identifier: Apache-2.0
#include "crowdface/config/starter_config.h"

#include <algorithm>

#include "crowdface/config/config_values.h"
#include "crowdface/config/yaml.h"
#include "crowdface/core/name.h"
#include "crowdface/core/text.h"

namespace crowdface {
namespace {

constexpr Eigen::Index kMostJudged = 200'000;  // vertices of heads whose meshes casting builds

/// In a comment: what is no head's name might end the line.
std::string shown(const std::string& name) {
  return is_name(name) ? name : quoted(name);
}

std::string name_some(std::vector<std::string> names) {
  std::transform(names.begin(), names.end(), names.begin(), shown);
  if (names.empty()) return "none yet";
  if (names.size() < 3) return join(names, " and ");
  return concat(names.front(), ", ", names[1], ", … ", names.back());
}

std::string tags_of(const StarterFacts& facts) {
  if (facts.tags.empty()) {
    return "  # tags: {head_a: [old], head_b: [young]}   # groups of heads, to be named under "
           "sampling\n";
  }
  std::string text = "  tags:                  # groups of heads, to be named under sampling\n";
  for (const auto& [head, tags] : facts.tags) {
    text += concat("    ", head, ": [", join(tags), "]\n");
  }
  return text;
}

std::string faces_section(const StarterFacts& facts) {
  const double height_mm = facts.head_height * mm_per(facts.units);
  return concat(
      "# The heads: OBJ files that share one topology. This folder holds ", facts.names.size(),
      ": ", name_some(facts.names), ".\nfaces:\n  directory: ", write_scalar(facts.heads.string()),
      "\n  # What one unit of the OBJ files is: mm, cm, m or in. Guessed, because the first mesh "
      "is ",
      format_fixed(facts.head_height, 2), " units\n  # high, which makes ",
      format_fixed(height_mm / 10, 1),
      " cm. PLEASE CHECK: every size below rests on it.\n  units: ", name_of(facts.units),
      "\n  up: ", name_of(facts.up),
      "                 # the axis that points to the top of the head\n  front: ",
      name_of(facts.front), "              # the axis along which the faces look\n",
      "  align: check           # warn about heads that do not stand like the others; rigid moves "
      "them\n",
      tags_of(facts));
}

std::string regions_section(const StarterFacts& facts) {
  if (facts.mask.empty()) {
    return "# Parts of the face that are blended on their own need an image that tells them apart: "
           "one\n"
           "# colour channel a region, read at the meshes' UVs. Until then the head is one piece.\n"
           "regions: none\n"
           "# regions: {names: [top, middle, bottom], mask: bands.png}\n\n";
  }
  return concat(
      "# Parts of the face that are blended on their own: the image beside the heads tells them "
      "apart,\n# one colour channel a region. \"regions: none\" makes the head one piece.\n"
      "regions:\n  names: [top, middle, bottom]\n  mask: ",
      write_scalar(facts.mask), "\n\n");
}

}  // namespace

std::string starter_config(const StarterFacts& facts) {
  return concat(
      "# A first crowd. Run it with: crowdface generate THIS_FILE\n"
      "# Every key, with its range and default, is explained in docs/config.md.\n"
      "schema: 1\n\n"
      "crowd:\n  name: ",
      write_scalar(facts.crowd_name), "            # ids start with it: ", facts.crowd_name,
      "_0001, …\n"
      "  count: 24              # how many faces; a larger crowd starts with the same ones\n"
      "  seed: 1                # another number, another crowd\n\n",
      faces_section(facts), "\n", regions_section(facts),
      "sampling:\n"
      "  # How much of the target's own relief gives way to that of the others: 0 nothing, 1 all "
      "of\n"
      "  # it up to 240 mm. Or a size: [4 mm, 30 mm].\n"
      "  smoothness: [0.15, 0.7]\n"
      "  # Above 1 features are stronger than scanned, below 1 weaker.\n"
      "  extrapolation: [0.9, 1.2]\n"
      "  # How many heads lend their features to one face.\n"
      "  max_sources: 3\n\n"
      "diversity:\n"
      "  # No face comes nearer to one of the heads: below half a millimetre it is that person.\n"
      "  min_distance_to_faces: 0.8 mm\n\n",
      facts.vertices <= kMostJudged ? "believability:\n"
                                      "  # Casting builds each face and drops it if too much skin "
                                      "passes through other skin: lips, "
                                      "lids.\n"
                                      "  meshes: judge\n\n"
                                    : "",
      "output:\n  directory: ", write_scalar(concat("out/", facts.crowd_name)),
      "\n"
      "  meshes: [obj]          # and ply, glb, points; [] for pictures only\n"
      "  contact_sheet: {columns: 6, rows: 4, cell: 256, views: [front]}\n");
}

}  // namespace crowdface
