// SPDX-License-Identifier: Apache-2.0
#include "crowdface/heads/shared_by_heads.h"

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/input_limits.h"
#include "crowdface/core/result_versions.h"
#include "crowdface/core/text.h"
#include "crowdface/heads/cached.h"
#include "crowdface/heads/heads_on_body.h"
#include "crowdface/heads/named_parts.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;

/// For heads with fewer vertices, reading from the cache takes as long as computing.
constexpr Index kMinCachedVertices = 50'000;

CacheFolder cache_of(const Inputs& inputs) {
  return inputs.head_set.topology.vertex_count >= kMinCachedVertices ? inputs.cache : fs::path();
}

Hasher& begin_key(Hasher& hasher, const Inputs& inputs) {
  return hasher.add(kSharedCacheVersion).add(inputs.topology_digest);
}

/// Adds to the hash everything that determines the skin of all heads.
Hasher& add_skins(Hasher& hasher, const Inputs& inputs) {
  for (const Digest& head : inputs.head_digests_before_placement) hasher.add(head);
  return hasher.add_array(std::span(inputs.skin_components.component_of_vertex))
      .add(inputs.skin_components.largest());
}

/// Whether the stored size of each component equals the number of vertices that are assigned to the
/// component.
bool are_component_sizes(const std::vector<std::uint32_t>& of_vertex,
                         const std::vector<std::uint32_t>& sizes) {
  if (!all_below(of_vertex, sizes.size())) return false;
  std::vector<std::uint32_t> counted(sizes.size(), 0);
  for (const std::uint32_t component : of_vertex) ++counted[component];
  return counted == sizes;
}

/// Whether all barycentric coordinates lie between 0 and 1, within rounding.
bool are_barycentric(const std::array<double, 3>& shares) {
  constexpr double kRounding = 1e-9;
  return std::ranges::all_of(
      shares, [](double share) { return share >= -kRounding && share <= 1 + kRounding; });
}

/// Hash of everything that the regions depend on, including the masks' bytes. Empty if the masks
/// have UDIM tiles (their files are known only after the mesh is read), or if a file cannot be read
/// (reading the masks reports the error).
std::optional<Digest> key_of_regions(const Config& config, const Inputs& inputs) {
  const InputLimits& limits = input_limits();
  Hasher key;
  add_skins(begin_key(key, inputs), inputs)
      .add_array(std::span(inputs.head_set.topology.corner_uvs))
      .add_array(numbers_of(inputs.head_set.uvs))
      .add(join(config.region_names()))
      .add(limits.image_pixels)
      .add(limits.image_bytes);
  for (const std::string& mask : config.regions.mask) {
    if (MaskSource(mask).is_tiled() || !is_file(mask)) return std::nullopt;
    key.add(fs::path(mask).filename().string()).add(hash_file(mask).digest);
  }
  return key.digest();
}

RegionWeights weights_of_masks(const Config& config, const Inputs& inputs) {
  return region_weights(inputs.head_set.topology, inputs.head_set.uvs,
                        {config.regions.mask.begin(), config.regions.mask.end()},
                        static_cast<Index>(config.region_names().size()), skin_of(inputs),
                        config.region_names(), inputs.head_files[0].path.string());
}

struct Neighbours {
  Adjacency adjacency;
  Components components;
};

constexpr auto kNeighbourArrays = [](auto& arrays, auto& found) {
  arrays("offsets", found.adjacency.offsets);
  arrays("neighbours", found.adjacency.items);
  arrays("boundary", found.adjacency.boundary);
  arrays("components", found.components.component_of_vertex);
  arrays("sizes", found.components.sizes);
};

bool are_neighbours(const Neighbours& found, std::size_t vertices) {
  const auto& [adjacency, components] = found;
  const auto& offsets = adjacency.offsets;
  return offsets.size() == vertices + 1 && offsets.front() == 0 &&
         offsets.back() == adjacency.items.size() && std::ranges::is_sorted(offsets) &&
         all_below(adjacency.items, vertices) && adjacency.boundary.size() == vertices &&
         components.component_of_vertex.size() == vertices &&
         are_component_sizes(components.component_of_vertex, components.sizes);
}

constexpr auto kMirrorArrays = [](auto& arrays, auto& found) {
  arrays("corners", found.map.corners);
  arrays("shares", found.map.barycentric);
  arrays("without", found.map.unpaired_vertices);
  arrays("added", found.map.unpaired_offsets);
  arrays("normal", found.map.plane.normal);
  arrays("offset", found.map.plane.offset);
  arrays("at vertices", found.paired_vertex_count);
  arrays("on surface", found.surface_mirrored_vertex_count);
  arrays("rms", found.rms_distance);
  arrays("largest", found.max_distance);
};

bool is_mirror(const FoundMirror& found, std::size_t vertices) {
  const MirrorMap& map = found.map;
  const auto is_place = [&](const Triangle& triangle) { return all_below(triangle, vertices); };
  return map.corners.size() == vertices && std::ranges::all_of(map.corners, is_place) &&
         map.barycentric.size() == vertices &&
         std::ranges::all_of(map.barycentric, are_barycentric) &&
         all_below(map.unpaired_vertices, vertices) &&
         map.unpaired_offsets.rows() == static_cast<Index>(map.unpaired_vertices.size());
}

}  // namespace

void find_neighbours(Inputs& inputs) {
  const Topology& topology = inputs.head_set.topology;
  Hasher key;
  begin_key(key, inputs);
  auto found = read_or_make(
      cache_of(inputs), {"neighbours", key.digest()},
      [&] {
        Adjacency adjacency = build_adjacency(topology);
        Components components = find_components(adjacency);
        return Neighbours{std::move(adjacency), std::move(components)};
      },
      kNeighbourArrays,
      [&](const Neighbours& kept, const CacheEntry&) {
        return are_neighbours(kept, static_cast<std::size_t>(topology.vertex_count));
      });
  inputs.adjacency = std::move(found.adjacency);
  inputs.components = std::move(found.components);
}

RegionWeights load_regions(const Config& config, const Inputs& inputs) {
  if (config.regions.names.empty()) return whole_head_weights(inputs.head_set.topology);
  const auto key = cache_of(inputs).path.empty() ? std::nullopt : key_of_regions(config, inputs);
  if (!key) return weights_of_masks(config, inputs);
  return read_or_make(
      cache_of(inputs), {"masks", *key}, [&] { return weights_of_masks(config, inputs); },
      [](auto& arrays, auto& weights) {
        arrays("alpha", weights.alpha);
        arrays("uncovered", weights.uncovered_vertex_count);
      },
      [&](const RegionWeights& found, const CacheEntry&) {
        const auto& alpha = found.alpha;
        return alpha.rows() == inputs.head_set.topology.vertex_count &&
               alpha.cols() == static_cast<Index>(config.region_names().size()) &&
               (alpha.array() >= 0 && alpha.array() <= 1).all();
      });
}

FaceSamples choose_samples(const Config& config, const Inputs& inputs, Index count) {
  Hasher key;
  add_skins(begin_key(key, inputs), inputs)
      .add(count)
      .add(config.faces.front.index)
      .add(config.faces.front.sign);
  const Topology& topology = inputs.head_set.topology;
  return read_or_make(
      cache_of(inputs), {"samples", key.digest()},
      [&] {
        return choose_face_samples(topology, inputs.skin_components, mean_before_placement(inputs),
                                   config.faces.front, count);
      },
      [](auto& arrays, auto& samples) { arrays("vertices", samples); },
      [&](const FaceSamples& found, const CacheEntry&) {
        return !found.empty() && std::ranges::is_sorted(found) &&
               std::ranges::adjacent_find(found) == found.end() &&
               found.back() < static_cast<std::uint32_t>(topology.vertex_count);
      });
}

SampleCells find_cells(const Inputs& inputs, const FaceSamples& samples) {
  Hasher key;
  begin_key(key, inputs).add_array(std::span(samples));
  for (const Digest& head : inputs.head_digests_before_placement) key.add(head);
  return read_or_make(
      cache_of(inputs), {"cells", key.digest()},
      [&] { return find_sample_cells(inputs.adjacency, mean_before_placement(inputs), samples); },
      [](auto& arrays, auto& cells) { arrays("samples", cells.sample_of_vertex); },
      [&](const SampleCells& found, const CacheEntry&) {
        static_assert(SampleCells::kNone == kNoIndex);
        return found.sample_of_vertex.size() ==
                   static_cast<std::size_t>(inputs.head_set.topology.vertex_count) &&
               are_indices(found.sample_of_vertex, samples.size());
      });
}

FoundMirror find_cached_mirror(const Inputs& inputs, const Eigen::Vector3d& side) {
  Hasher key;
  begin_key(key, inputs).add(kMirrorVersion);
  for (const Digest& head : inputs.head_digests) key.add(head);
  for (const double value : side) key.add(value);
  const Topology& topology = inputs.head_set.topology;
  return read_or_make(
      cache_of(inputs), {"mirror", key.digest()},
      [&] { return find_mirror(topology, inputs.components, inputs.mean_head, side); },
      kMirrorArrays,
      [&](const FoundMirror& found, const CacheEntry&) {
        return is_mirror(found, static_cast<std::size_t>(topology.vertex_count));
      });
}

}  // namespace crowdface
