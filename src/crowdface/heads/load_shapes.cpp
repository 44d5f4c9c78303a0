// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <map>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

#include "crowdface/core/error.h"
#include "crowdface/core/parallel.h"
#include "crowdface/core/text.h"
#include "crowdface/heads/common_mesh.h"
#include "crowdface/heads/heads_on_body.h"
#include "crowdface/heads/load_transferred.h"
#include "crowdface/heads/named_parts.h"
#include "crowdface/heads/read_heads.h"
#include "crowdface/mesh/all_columns.h"
#include "crowdface/mesh/vector3.h"
#include "crowdface/parts/component_shape.h"
#include "crowdface/parts/rigid_motion.h"
#include "crowdface/shapes/shape_transfer.h"

namespace crowdface {
namespace {

/// The parameters for reading shape meshes: the config, the topology that the meshes must have, and
/// the cache.
struct ShapeSource {
  const Config& config;
  const Topology& topology;
  const CacheFolder& cache;
};

/// Reads many meshes in parallel.
/// \param paths  paths of the meshes; empty paths are skipped
/// \param take   called as take(i, positions of paths[i]) for each mesh that can be read
template <class Take>
void read_meshes(const std::vector<std::filesystem::path>& paths, const ShapeSource& source,
                 Problems& problems, const Take& take) {
  std::vector<std::filesystem::path> files;
  std::vector<std::size_t> places;  // indices into `paths`
  for (std::size_t i = 0; i < paths.size(); ++i) {
    if (paths[i].empty()) continue;
    files.push_back(paths[i]);
    places.push_back(i);
  }
  std::vector<std::optional<HeadFile>> read =
      read_mesh_files(files, "shapes", source.cache, problems);
  std::vector<HeadFile> fitting;
  std::vector<std::size_t> numbers;
  std::map<const HeadMesh*, std::string> differences;
  for (std::size_t i = 0; i < files.size(); ++i) {
    if (!read[i]) continue;
    const HeadMesh* const mesh = read[i]->mesh.get();
    const auto [known, is_new] = differences.try_emplace(mesh);
    if (is_new) known->second = first_difference(source.topology, mesh->topology);
    if (known->second.empty()) {
      fitting.push_back(std::move(*read[i]));
      numbers.push_back(places[i]);
    } else if (const auto vertices = match_vertices_by_corners(source.topology, mesh->topology,
                                                               read[i]->file.positions)) {
      take(places[i], read[i]->file.positions(*vertices, kAllColumns));
    } else {
      problems.add(ExitCode::kBadData,
                   concat(files[i].string(), ": not the same mesh as ",
                          source.config.faces.files.front().string(), ": ", known->second));
    }
  }
  cache_heads(fitting, source.cache);
  parallel_for_each(fitting.size(),
                    [&](std::size_t i) { take(numbers[i], std::move(fitting[i].file.positions)); });
}

/// Changes a shape's displacements smoothly, so that the ring of the neck does not move: all faces
/// end in this ring.
void keep_ring_still(const Inputs& inputs, Displacements& moves) {
  if (inputs.heads_on_body) inputs.heads_on_body->seam.keep_rim_still(moves);
}

/// Loads the template's version of the shapes that the config names. Skips names for which there is
/// no file of the template.
ShapeSet load_template(const ShapeSource& source, const Inputs& inputs, double extent,
                       Problems& problems) {
  const Config::Shapes& asked = source.config.shapes;
  const std::size_t before = problems.size();
  ShapeSet set;
  std::vector<Positions> meshes(asked.template_files.size());
  read_meshes({asked.neutral}, source, problems,
              [&](std::size_t, Positions mesh) { set.neutral = std::move(mesh); });
  read_meshes(asked.template_files, source, problems,
              [&](std::size_t i, Positions mesh) { meshes[i] = std::move(mesh); });
  if (problems.size() > before) return set;
  if (extent == 0) extent = extent_of(set.neutral, skin_vertices(inputs));
  for (std::size_t s = 0; s < meshes.size(); ++s) {
    if (asked.template_files[s].empty()) continue;
    set.shapes.push_back(make_shape(asked.names[s], set.neutral, meshes[s], extent));
    keep_ring_still(inputs, set.shapes.back().moves);
  }
  return set;
}

/// A head as stored in its file, and the rigid motion to its position among the loaded heads.
struct HeadAsStored {
  Positions mesh;
  RigidMotion motion;
};

HeadAsStored head_as_stored(const Config& config, const Inputs& inputs, std::size_t head) {
  const Positions& used = inputs.head_set.heads[head].positions;
  if (config.faces.align != Align::kRigid && !inputs.heads_on_body) return {used, {}};
  Positions mesh = read_positions(config.faces.files[head], inputs.head_set.topology,
                                  config.faces.files.front().string());
  std::vector<std::uint32_t> all(static_cast<std::size_t>(mesh.rows()));
  std::iota(all.begin(), all.end(), 0U);
  const RigidMotion motion =
      fit_rigid_motion(mesh, used, all, std::vector<double>(all.size(), 1.0));
  return {std::move(mesh), motion};
}

void load_head(const ShapeSource& source, const Inputs& inputs, std::size_t head, double extent,
               std::vector<OwnShape>& shapes, Problems& problems) {
  const std::vector<std::filesystem::path>& files = source.config.shapes.head_files[head];
  const HeadAsStored rest = head_as_stored(source.config, inputs, head);
  read_meshes(files, source, problems, [&](std::size_t s, const Positions& mesh) {
    Displacements moves = make_shape({}, rest.mesh, mesh, extent).moves;
    for (Index row = 0; row < moves.moves.rows(); ++row) {
      moves.moves.row(row) = rest.motion.apply_to_direction(row3(moves.moves, row)).transpose();
    }
    keep_ring_still(inputs, moves);
    shapes[s] = make_own_shape(moves);
  });
}

/// Transfers the template's shapes to heads that lack them.
void transfer_missing_shapes(const Config& config, const Inputs& inputs,
                             const ShapeSet& of_template, ShapeSet& set) {
  std::optional<ShapeTransfer> transfer;
  for (std::size_t h = 0; h < set.head_shapes.size(); ++h) {
    const auto& files = config.shapes.head_files[h];
    if (std::ranges::none_of(files, [](const auto& file) { return file.empty(); })) continue;
    if (!transfer) {
      transfer.emplace(inputs.head_set, inputs.adjacency, inputs.parts, head_axes(config),
                       of_template);
    }
    const auto carried =
        transfer->transfer_to_face(static_cast<Index>(h), inputs.head_set.heads[h].positions);
    for (std::size_t s = 0, i = 0; s < files.size(); ++s) {
      if (config.shapes.template_files[s].empty()) continue;
      if (files[s].empty()) set.head_shapes[h][s] = make_own_shape(carried[i]);
      ++i;
    }
  }
}

/// Loads the shapes of each head. The shapes of the mean head are the averages of the heads'
/// shapes.
void load_heads(const ShapeSource& source, Inputs& inputs, Problems& problems) {
  const Config& config = source.config;
  const Config::Shapes& asked = config.shapes;
  ShapeSet& set = inputs.shapes;
  set.neutral = mean_head(inputs.head_set);
  const double extent = extent_of(set.neutral, skin_vertices(inputs));
  set.head_shapes.assign(inputs.head_set.heads.size(), std::vector<OwnShape>(asked.names.size()));
  const std::size_t before = problems.size();
  for (std::size_t h = 0; h < set.head_shapes.size(); ++h) {
    load_head(source, inputs, h, extent, set.head_shapes[h], problems);
  }
  if (problems.size() > before) return;
  if (!asked.neutral.empty()) {
    const ShapeSet of_template = load_template(source, inputs, extent, problems);
    if (problems.size() > before) return;
    transfer_missing_shapes(config, inputs, of_template, set);
  }
  for (std::size_t s = 0; s < asked.names.size(); ++s) {
    set.shapes.push_back({asked.names[s], mean_displacements(set.head_shapes, s)});
  }
}

/// Removes shapes that move no vertex of any head. Such a shape is the neutral pose, or a shape
/// that a head model lists without data.
void remove_shapes_without_motion(Inputs& inputs) {
  ShapeSet& set = inputs.shapes;
  for (std::size_t s = set.shapes.size(); s-- > 0;) {
    if (!set.shapes[s].moves.vertices.empty()) continue;
    inputs.warn(concat("the shape ", set.shapes[s].name,
                       " moves no vertex of any head and is left out: is it the neutral?"));
    const auto place = static_cast<std::ptrdiff_t>(s);
    set.shapes.erase(set.shapes.begin() + place);
    for (auto& of_head : set.head_shapes) of_head.erase(of_head.begin() + place);
  }
}

Digest digest_of_shapes(const ShapeSet& set) {
  Hasher hasher;
  hasher.add_array(numbers_of(set.neutral));
  for (const Shape& shape : set.shapes) {
    hasher.add(shape.name).add_array(std::span(shape.moves.vertices));
    hasher.add_array(numbers_of(shape.moves.moves));
  }
  for (const std::vector<OwnShape>& of_head : set.head_shapes) {
    for (const OwnShape& shape : of_head) {
      hasher.add_array(std::span(shape.vertices)).add_array(numbers_of(shape.moves));
    }
  }
  return hasher.digest();
}

}  // namespace

void load_shapes(const Config& config, const CacheFolder& cache, Inputs& inputs,
                 Problems& problems) {
  if (config.shapes.names.empty()) return;
  const ShapeSource source{config, inputs.head_set.topology, cache};
  const std::size_t before = problems.size();
  if (config.shapes.heads_directory.empty()) {
    inputs.shapes = load_template(source, inputs, 0, problems);
  } else {
    load_heads(source, inputs, problems);
  }
  if (problems.size() == before) remove_shapes_without_motion(inputs);
  if (problems.size() == before) inputs.shapes_digest = digest_of_shapes(inputs.shapes);
}

}  // namespace crowdface
