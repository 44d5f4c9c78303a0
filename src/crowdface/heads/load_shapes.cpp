// SPDX-License-Identifier: Apache-2.0
#include "crowdface/heads/load_shapes.h"

#include <optional>
#include <span>
#include <utility>

#include "crowdface/core/error.h"
#include "crowdface/core/interrupt.h"
#include "crowdface/core/parallel.h"
#include "crowdface/core/text.h"
#include "crowdface/parts/component_shape.h"

namespace crowdface {
namespace {

Positions read_positions(const std::filesystem::path& file, const Config& config,
                         const Topology& topology) {
  ObjFile mesh = read_obj(file);
  const std::string difference = first_difference(topology, mesh.topology);
  if (difference.empty()) return std::move(mesh.positions);
  throw InvalidInput(concat(file.string(), ": not the same mesh as ",
                            config.faces.files.front().string(), ": ", difference));
}

std::vector<std::uint32_t> skin_of(const Inputs& inputs) {
  std::vector<std::uint32_t> skin;
  for (std::uint32_t v = 0; v < inputs.skin.of_vertex.size(); ++v) {
    if (inputs.skin.of_vertex[v] == inputs.skin.largest()) skin.push_back(v);
  }
  return skin;
}

}  // namespace

void load_shapes(const Config& config, Inputs& inputs, Problems& problems) {
  const Config::Shapes& asked = config.shapes;
  if (asked.files.empty()) return;
  std::vector<std::filesystem::path> files = asked.files;
  files.push_back(asked.neutral);
  std::vector<Positions> meshes(files.size());
  std::vector<std::optional<Error>> errors(files.size());
  parallel_for_each(files.size(), [&](std::size_t i) {
    throw_if_interrupted();
    try {
      meshes[i] = read_positions(files[i], config, inputs.faces.topology);
    } catch (const Error& error) {
      errors[i] = error;
    }
  });
  const std::size_t before = problems.size();
  for (const auto& error : errors) {
    if (error) problems.add(*error);
  }
  if (problems.size() > before) return;
  inputs.shapes.neutral = std::move(meshes.back());
  const double extent = extent_of(inputs.shapes.neutral, skin_of(inputs));
  Hasher hasher;
  const auto add = [&](const Positions& values) {
    hasher.add_array(
        std::span<const double>(values.data(), static_cast<std::size_t>(values.size())));
  };
  add(inputs.shapes.neutral);
  for (std::size_t i = 0; i < asked.files.size(); ++i) {
    Shape shape = shape_of(asked.names[i], inputs.shapes.neutral, meshes[i], extent);
    hasher.add(shape.name).add_array(std::span<const std::uint32_t>(shape.moves.vertices));
    add(shape.moves.moves);
    inputs.shapes.shapes.push_back(std::move(shape));
  }
  inputs.shapes_digest = hasher.digest();
}

}  // namespace crowdface
