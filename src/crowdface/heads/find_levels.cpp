// SPDX-License-Identifier: Apache-2.0
#include "crowdface/heads/find_levels.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "crowdface/core/interrupt.h"
#include "crowdface/core/text.h"
#include "crowdface/lod/level_error.h"
#include "crowdface/mesh/vector3.h"

namespace crowdface {
namespace {

LevelError in_mm(LevelError error, double mm) {
  return {error.most * mm, error.root_mean_square * mm};
}

/// The mean head as edges are to be collapsed on it: what is larger keeps more triangles. Eyes and the
/// lids around them are nearly twice their size, teeth a third.
Positions weighted(const Positions& mean, const PartList& parts) {
  constexpr double kEyes = 0.8, kTeeth = 0.3;
  Positions sizes = mean;
  for (const Part& part : parts.parts) {
    if (part.eyeball) {
      const ComponentShape& ball = parts.shapes[part.ball];
      for (Index v = 0; v < mean.rows(); ++v) {
        const Eigen::Vector3d away = row3(mean, v) - ball.centre;
        const double fall = 1 + dot3(away, away) / (4 * ball.radius * ball.radius);
        sizes.row(v) += (kEyes / (fall * fall) * away).transpose();
      }
    } else if (part.part_class == PartClass::kRigid) {
      Eigen::RowVector3d middle = Eigen::RowVector3d::Zero();
      for (const std::uint32_t v : part.vertices) middle += mean.row(v);
      middle /= static_cast<double>(part.vertices.size());
      for (const std::uint32_t v : part.vertices) {
        sizes.row(v) = middle + kTeeth * (mean.row(v) - middle);
      }
    }
  }
  return sizes;
}

/// A mesh in each of its shapes.
std::vector<Positions> shaped(const Positions& neutral, const std::vector<Displacements>& moves) {
  std::vector<Positions> meshes(moves.size(), neutral);
  for (std::size_t s = 0; s < meshes.size(); ++s) moves[s].add_to(meshes[s]);
  return meshes;
}

/// Over the template, or each head, in all its shapes.
LevelError error_in_shapes(const Inputs& inputs, const DetailLevel& level, const LevelMap& map) {
  const ShapeSet& set = inputs.shapes;
  if (set.shapes.empty()) return {};
  const auto error_on = [&](const Positions& neutral, const std::vector<Displacements>& moves) {
    const std::vector<Positions> meshes = shaped(neutral, moves);
    std::vector<const Positions*> all;
    for (const Positions& mesh : meshes) all.push_back(&mesh);
    return level_error(level, map, all);
  };
  std::vector<Displacements> moves;
  if (set.of_head.empty()) {
    for (const Shape& shape : set.shapes) moves.push_back(shape.moves);
    return error_on(set.neutral, moves);
  }
  LevelError error;
  double squares = 0;
  for (std::size_t h = 0; h < set.of_head.size(); ++h) {
    moves.clear();
    for (const OwnShape& shape : set.of_head[h]) moves.push_back(displacements_of(shape));
    const LevelError on_head = error_on(inputs.faces.heads[h].positions, moves);
    error.most = std::max(error.most, on_head.most);
    squares += on_head.root_mean_square * on_head.root_mean_square;
  }
  error.root_mean_square = std::sqrt(squares / static_cast<double>(set.of_head.size()));
  return error;
}

}  // namespace

void find_levels(const Config& config, Inputs& inputs) {
  if (config.output.lods.empty() || config.output.meshes.empty()) return;
  const Positions mean = mean_head(inputs.faces);
  std::vector<const Positions*> heads;
  for (const Head& head : inputs.faces.heads) heads.push_back(&head.positions);
  const double mm = mm_per(config.faces.units);
  std::vector<double> shares;
  for (const double percent : config.output.lods) shares.push_back(percent / 100);
  const FaceSet typical{
      inputs.faces.topology, inputs.faces.uvs, {{"mean", weighted(mean, inputs.parts)}}};
  for (DetailLevel& level : detail_levels(typical, inputs.materials.of_face, shares)) {
    throw_if_interrupted();
    const LevelMap map = map_to_level(inputs.faces.topology, inputs.adjacency, level, mean);
    const LevelError of_heads = in_mm(level_error(level, map, heads), mm);
    const LevelError of_shapes = in_mm(error_in_shapes(inputs, level, map), mm);
    inputs.levels.push_back({std::move(level), of_heads, of_shapes});
  }
}

std::string describe_levels(const Inputs& inputs) {
  std::vector<std::string> lines;
  for (std::size_t l = 0; l < inputs.levels.size(); ++l) {
    const auto& [level, heads, shapes] = inputs.levels[l];
    std::string line = concat("LOD", l + 1, ": ", level.topology.face_count(), " triangles, ",
                              level.vertices.size(), " vertices; of the heads' surface ",
                              format_fixed(heads.root_mean_square, 2), " mm (rms), ",
                              format_fixed(heads.most, 2), " mm at most");
    if (!inputs.shapes.shapes.empty()) {
      line += concat("; in shapes ", format_fixed(shapes.most, 2), " mm at most");
    }
    lines.push_back(std::move(line));
  }
  return join(lines, "\n");
}

}  // namespace crowdface
