// SPDX-License-Identifier: Apache-2.0
#include "crowdface/heads/find_levels.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "crowdface/core/parallel.h"
#include "crowdface/core/result_versions.h"
#include "crowdface/core/text.h"
#include "crowdface/heads/cached.h"
#include "crowdface/heads/heads_on_body.h"
#include "crowdface/lod/level_error.h"
#include "crowdface/mesh/vector3.h"

namespace crowdface {
namespace {

LevelError in_mm(LevelError error, double mm) {
  return {error.max * mm, error.root_mean_square * mm};
}

/// The mean head, with some parts enlarged or reduced, because edge collapse keeps more triangles
/// in enlarged parts. Eyes and the lids around them are nearly doubled in size; other rigid parts,
/// such as teeth, are reduced to 30 %.
Positions with_resized_parts(const Positions& mean, const PartList& parts) {
  constexpr double kEyes = 0.8, kTeeth = 0.3;
  Positions sizes = mean;
  for (const Part& part : parts.parts) {
    if (part.is_eyeball) {
      const ComponentShape& ball = parts.shapes[part.ball_component];
      for (Index v = 0; v < mean.rows(); ++v) {
        const Eigen::Vector3d away = row3(mean, v) - ball.centre;
        const double fall = 1 + away.squaredNorm() / (4 * ball.radius * ball.radius);
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

/// The error of a level of detail over all shapes (expressions): over the shapes of the template
/// or, if the heads have shapes of their own, over the shapes of each head.
LevelError error_in_shapes(const Inputs& inputs, const DetailLevel& level,
                           const NearestLevelTriangles& map) {
  const ShapeSet& set = inputs.shapes;
  if (set.shapes.empty()) return {};
  const auto error_on = [&](const Positions& neutral, const std::vector<Displacements>& moves) {
    std::vector<Positions> meshes(moves.size(), neutral);
    std::vector<const Positions*> all;
    for (std::size_t s = 0; s < meshes.size(); ++s) {
      moves[s].add_to(meshes[s]);
      all.push_back(&meshes[s]);
    }
    return level_error(level, map, all);
  };
  std::vector<Displacements> moves;
  if (set.head_shapes.empty()) {
    for (const Shape& shape : set.shapes) moves.push_back(shape.moves);
    return error_on(set.neutral, moves);
  }
  LevelError error;
  double squares = 0;
  for (std::size_t h = 0; h < set.head_shapes.size(); ++h) {
    moves.clear();
    for (const OwnShape& shape : set.head_shapes[h]) moves.push_back(displacements_of(shape));
    const LevelError on_head = error_on(inputs.head_set.heads[h].positions, moves);
    error.max = std::max(error.max, on_head.max);
    squares += on_head.root_mean_square * on_head.root_mean_square;
  }
  error.root_mean_square = std::sqrt(squares / static_cast<double>(set.head_shapes.size()));
  return error;
}

/// Checks that a level of detail keeps every vertex of the ring at the neck, where the meshes end.
/// \throws InvalidInput if a vertex of the ring is missing.
void require_ring(const Inputs& inputs, const DetailLevel& level) {
  if (!inputs.heads_on_body) return;
  const Rim& rim = inputs.heads_on_body->seam.rim;
  const auto kept = std::ranges::count_if(
      rim, [&](std::uint32_t v) { return std::ranges::binary_search(level.vertices, v); });
  if (kept == static_cast<std::ptrdiff_t>(rim.size())) return;
  throw InvalidInput(concat("output.lods: a level of ", level.share * 100, " % keeps ", kept,
                            " of the ", rim.size(),
                            " vertices of neck.rim; levels keep all vertices of a ring only if the "
                            "ring is an open border"));
}

/// Makes a level of detail, and measures its error on the heads and their shapes.
/// \param resized_head  result of `with_resized_parts`, on which edges are collapsed
/// \param share    fraction of the triangles to keep
/// \param mm       millimetres per file unit
MeasuredLevel measured_level(const Inputs& inputs, const HeadSet& resized_head, double share,
                             double mm) {
  const Borders borders = inputs.heads_on_body ? Borders::kKeep : Borders::kCollapse;
  DetailLevel level = std::move(
      detail_levels(resized_head, inputs.materials.material_of_polygon, {&share, 1}, borders)[0]);
  require_ring(inputs, level);
  const NearestLevelTriangles map =
      find_level_triangles(inputs.head_set.topology, inputs.adjacency, level, inputs.mean_head);
  std::vector<const Positions*> heads;
  for (const Head& head : inputs.head_set.heads) heads.push_back(&head.positions);
  const LevelError of_heads = in_mm(level_error(level, map, heads), mm);
  const LevelError of_shapes = in_mm(error_in_shapes(inputs, level, map), mm);
  return {std::move(level), of_heads, of_shapes};
}

/// Hash of everything that a level of detail depends on. See measured_level for the parameters.
Digest key_of(const Inputs& inputs, const HeadSet& resized_head, double share, double mm) {
  Hasher key;
  key.add(kLevelsVersion).add(inputs.topology_digest).add(share).add(mm);
  key.add_array(std::span(inputs.head_set.topology.corner_uvs));
  key.add_array(numbers_of(inputs.head_set.uvs));
  key.add_array(std::span(inputs.materials.material_of_polygon));
  key.add_array(numbers_of(resized_head.heads[0].positions));
  for (const Digest& head : inputs.head_digests) key.add(head);
  if (!inputs.shapes.shapes.empty()) key.add(inputs.shapes_digest);
  if (inputs.heads_on_body) key.add(inputs.heads_on_body->digest);
  return key.digest();
}

/// Whether a level of detail from the cache is a consistent mesh; coordinates are not checked.
bool is_sound(const DetailLevel& level, const Topology& whole) {
  const auto& uvs = level.topology.corner_uvs;
  const auto end = [](Index count) { return static_cast<std::uint64_t>(count); };
  return all_below(level.vertices, end(whole.vertex_count)) &&
         all_below(level.source_faces, end(whole.face_count())) &&
         std::ranges::adjacent_find(level.vertices, std::greater_equal()) == level.vertices.end() &&
         level.topology.corner_vertices.size() == 3 * level.source_faces.size() &&
         all_below(level.topology.corner_vertices, level.vertices.size()) &&
         (uvs.empty() || uvs.size() == 3 * level.source_faces.size()) &&
         are_indices(uvs, end(level.uvs.rows()));
}

constexpr auto kLevelArrays = [](auto& arrays, auto& measured) {
  auto& level = measured.level;
  arrays("vertices", level.vertices);
  arrays("corner vertices", level.topology.corner_vertices);
  arrays("corner uvs", level.topology.corner_uvs);
  arrays("faces", level.source_faces);
  arrays("uvs", level.uvs);
  arrays("most of heads", measured.heads_error.max);
  arrays("rms of heads", measured.heads_error.root_mean_square);
  arrays("most of shapes", measured.shapes_error.max);
  arrays("rms of shapes", measured.shapes_error.root_mean_square);
};

/// Whether a level of detail and its errors, both from the cache, are valid. Also computes the
/// members of the level that the cache does not store.
bool is_sound(MeasuredLevel& measured, const Topology& whole, double share) {
  DetailLevel& level = measured.level;
  level.share = share;
  level.topology.vertex_count = static_cast<Index>(level.vertices.size());
  for (std::uint32_t t = 1; t <= level.source_faces.size(); ++t) {
    level.topology.face_offsets.push_back(3 * t);  // the initial 0 is already there
  }
  const auto is_error = [](const LevelError& error) {
    return error.max >= 0 && error.root_mean_square >= 0;
  };
  return is_sound(level, whole) && is_error(measured.heads_error) &&
         is_error(measured.shapes_error);
}

}  // namespace

void find_levels(const Config& config, const CacheFolder& cache, Inputs& inputs) {
  if (config.output.lods.empty() || config.output.meshes.empty()) return;
  const double mm = mm_per(config.faces.units);
  const HeadSet resized_head{inputs.head_set.topology,
                             inputs.head_set.uvs,
                             {{"mean", with_resized_parts(inputs.mean_head, inputs.parts)}}};
  inputs.detail_levels.resize(config.output.lods.size());
  parallel_for_each(inputs.detail_levels.size(), [&](std::size_t l) {
    const double share = config.output.lods[l] / 100;
    inputs.detail_levels[l] = read_or_make(
        cache, {"level", key_of(inputs, resized_head, share, mm)},
        [&] { return measured_level(inputs, resized_head, share, mm); }, kLevelArrays,
        [&](MeasuredLevel& found, const CacheEntry&) {
          return is_sound(found, inputs.head_set.topology, share);
        });
  });
}

std::string describe_detail_levels(const Inputs& inputs) {
  std::vector<std::string> lines;
  for (std::size_t l = 0; l < inputs.detail_levels.size(); ++l) {
    const auto& [level, heads, shapes] = inputs.detail_levels[l];
    std::string line = concat("LOD", l + 1, ": ", level.topology.face_count(), " triangles, ",
                              level.vertices.size(), " vertices; distance to the heads' surface ",
                              format_fixed(heads.root_mean_square, 2), " mm (rms), ",
                              format_fixed(heads.max, 2), " mm at most");
    if (!inputs.shapes.shapes.empty()) {
      line += concat("; in shapes ", format_fixed(shapes.max, 2), " mm at most");
    }
    lines.push_back(std::move(line));
  }
  return join(lines, "\n");
}

}  // namespace crowdface
