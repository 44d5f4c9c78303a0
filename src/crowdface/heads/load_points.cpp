// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "crowdface/config/yaml.h"
#include "crowdface/core/error.h"
#include "crowdface/core/text.h"
#include "crowdface/heads/heads_on_body.h"
#include "crowdface/heads/load_transferred.h"
#include "crowdface/heads/read_heads.h"

namespace crowdface {
namespace {

constexpr std::size_t kMaxPoints = 1000;
/// largest absolute value that a point's coordinate may have; the same limit holds for heads
constexpr double kFarthest = 1e7;

std::optional<Eigen::RowVector3d> read_position(const YamlNode& node, Complaints& complaints) {
  Eigen::RowVector3d position;
  bool good = node.kind == YamlNode::Kind::kList && node.items.size() == 3;
  for (Index c = 0; good && c < 3; ++c) {
    const auto number = parse_double(node.items[static_cast<std::size_t>(c)].text);
    good = number && std::abs(*number) <= kFarthest;
    if (good) position[c] = *number;
  }
  if (good) return position;
  return complaints.add_mismatch(node,
                                 concat("a position, [x, y, z], of numbers up to ", kFarthest));
}

/// Reads a mapping from point names to positions, such as `{eye_L: [3.1, 2.5, 7]}`.
/// \param names  the expected names, in order; if empty, receives the names of the mapping
Positions read_set(const YamlNode& node, std::vector<std::string>& names, Complaints& complaints) {
  if (!complaints.expect_map(node, "a mapping from names to positions, {eye_L: [3.1, 2.5, 7]}")) {
    return {};
  }
  if (names.empty()) {
    for (const YamlEntry& entry : node.entries) {
      if (!is_valid_name(entry.key))
        complaints.add_at(entry.value,
                          "not a valid name; expected letters (a-z), digits, '_', '-' and '.'");
      names.push_back(entry.key);
    }
    if (names.empty() || names.size() > kMaxPoints) {
      complaints.add_mismatch(node, concat("1 to ", kMaxPoints, " points"));
    }
  }
  Positions positions(static_cast<Index>(names.size()), 3);
  for (std::size_t p = 0; p < names.size(); ++p) {
    const YamlEntry* entry = node.find(names[p]);
    if (entry == nullptr) {
      complaints.add_at(node, concat("the point ", crowdface::quoted(names[p]), " is missing"));
      continue;
    }
    if (const auto position = read_position(entry->value, complaints)) {
      positions.row(static_cast<Index>(p)) = *position;
    }
  }
  for (const YamlEntry& entry : node.entries) {
    if (std::ranges::find(names, entry.key) != names.end()) continue;
    complaints.add_at(
        entry.value,
        "no point of the first head has this name; expected the same points for all heads");
  }
  return positions;
}

void read_head_points(const YamlNode& node, Inputs& inputs, Complaints& complaints) {
  if (!complaints.expect_map(node, "a mapping from heads to points")) return;
  PointSet& points = inputs.points;
  for (const Head& head : inputs.head_set.heads) {
    const YamlEntry* entry = node.find(head.name);
    if (entry == nullptr) {
      complaints.add_at(node, concat("the head ", quoted(head.name), " is missing"));
      continue;
    }
    points.positions.push_back(read_set(entry->value, points.names, complaints));
    if (inputs.heads_on_body) {
      const RigidMotion& placed = inputs.heads_on_body->heads[points.meshes.size()].placement;
      Positions& own = points.positions.back();
      for (Index p = 0; p < own.rows(); ++p) own.row(p) = placed.apply(row3(own, p)).transpose();
    }
    points.meshes.push_back(head.positions);
  }
}

/// The vertex positions of the mesh to which the points belong. The file's key `template` names
/// the mesh file; without this key, the mesh file is `neutral`.
Positions template_of(const YamlNode& root, const std::filesystem::path& file,
                      const std::filesystem::path& neutral, const Inputs& inputs,
                      Complaints& complaints) {
  const YamlEntry* entry = root.find("template");
  const Topology& topology = inputs.head_set.topology;
  if (entry == nullptr) {
    if (!neutral.empty()) return read_positions(neutral, topology, "the heads");
    complaints.add_at(root,
                      "the key template is missing; write the OBJ file that the points belong to");
    return {};
  }
  return read_positions(file.parent_path() / entry->value.text, topology, "the heads");
}

/// Reads the named points from a parsed file. The file has the points of a single mesh (key
/// `points`) or of each head (key `heads`).
/// \param neutral  file of the template at rest (`shapes.template`), from which blend shapes are
///                 transferred; empty if there is none
void read_points_file(const std::filesystem::path& file, const YamlNode& root,
                      const std::filesystem::path& neutral, Inputs& inputs,
                      Complaints& complaints) {
  constexpr const char* kExpected =
      "a mapping with the keys template, points, or with the key heads";
  if (!complaints.expect_map(root, kExpected)) return;
  for (const YamlEntry& entry : root.entries) {
    if (entry.key == "template" || entry.key == "points" || entry.key == "heads") continue;
    complaints.add(entry.key_place, concat("unknown key ", quoted(entry.key),
                                           "; expected one of template, points, heads"));
  }
  const YamlEntry *points = root.find("points"), *heads = root.find("heads");
  if ((points == nullptr) == (heads == nullptr)) {
    complaints.add_mismatch(root, kExpected);
  } else if (heads != nullptr) {
    read_head_points(heads->value, inputs, complaints);
  } else {
    inputs.points.positions = {read_set(points->value, inputs.points.names, complaints)};
    inputs.points.meshes = {template_of(root, file, neutral, inputs, complaints)};
  }
}

}  // namespace

void load_points(const Config& config, Inputs& inputs, Problems& problems) {
  if (config.points.empty()) return;
  Complaints complaints;
  try {
    if (const auto root = read_yaml(config.points.string(), complaints)) {
      read_points_file(config.points, *root, config.shapes.neutral, inputs, complaints);
    }
  } catch (const RecoverableError& error) {
    problems.add(error);
  }
  complaints.report_to(problems);
  Hasher hasher;
  for (const std::string& name : inputs.points.names) hasher.add(name);
  for (const auto* sets : {&inputs.points.positions, &inputs.points.meshes}) {
    for (const Positions& rows : *sets) hasher.add_array(numbers_of(rows));
  }
  inputs.points_digest = hasher.digest();
}

}  // namespace crowdface
