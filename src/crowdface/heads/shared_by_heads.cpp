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
#include "crowdface/heads/named_parts.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;

constexpr Index kLeastKeptVertices = 50'000;

Hasher& begin_key(Hasher& hasher, const Inputs& inputs) {
  return hasher.add(kSharedVersion).add(inputs.topology_digest);
}

/// Of all that follows from where the skin of all heads is.
Hasher& add_skins(Hasher& hasher, const Inputs& inputs) {
  for (const Digest& head : inputs.head_digests) hasher.add(head);
  return hasher.add_array(std::span(inputs.skin.of_vertex)).add(inputs.skin.largest());
}

/// Whether each component has as many vertices as it says.
bool are_sizes(const std::vector<std::uint32_t>& of_vertex,
               const std::vector<std::uint32_t>& sizes) {
  if (!all_below(of_vertex, sizes.size())) return false;
  std::vector<std::uint32_t> counted(sizes.size(), 0);
  for (const std::uint32_t component : of_vertex) ++counted[component];
  return counted == sizes;
}

/// Of the corners of a triangle.
bool are_shares(const std::array<double, 3>& shares) {
  constexpr double kRounding = 1e-9;
  return std::ranges::all_of(
      shares, [](double share) { return share >= -kRounding && share <= 1 + kRounding; });
}

/// Nothing if the masks' bytes do not tell all: of tiles it depends on the mesh which are read, and of files
/// that cannot be read whoever reads them tells.
std::optional<Digest> key_of_regions(const Config& config, const Inputs& inputs) {
  const InputLimits& limits = input_limits();
  Hasher key;
  add_skins(begin_key(key, inputs), inputs)
      .add_array(std::span(inputs.faces.topology.corner_uvs))
      .add_array(numbers_of(inputs.faces.uvs))
      .add(join(config.region_names()))
      .add(limits.image_pixels)
      .add(limits.image_bytes);
  for (const std::string& mask : config.regions.mask) {
    if (MaskSource(mask).tiled() || !is_file(mask)) return std::nullopt;
    key.add(fs::path(mask).filename().string()).add(hash_file(mask).digest);
  }
  return key.digest();
}

RegionWeights weights_of_masks(const Config& config, const Inputs& inputs) {
  return region_weights(inputs.faces.topology, inputs.faces.uvs,
                        {config.regions.mask.begin(), config.regions.mask.end()},
                        static_cast<Index>(config.region_names().size()), skin_of(inputs),
                        config.region_names());
}

struct Neighbours {
  Adjacency adjacency;
  Components components;
};

Neighbours neighbours_in(const CacheEntry& entry, const Topology& topology) {
  const auto vertices = static_cast<std::size_t>(topology.vertex_count);
  Neighbours found;
  auto& [adjacency, components] = found;
  adjacency.offsets = entry.list<std::uint32_t>("offsets");
  adjacency.items = entry.list<std::uint32_t>("neighbours");
  const auto boundary = entry.get<std::uint8_t>("boundary");
  adjacency.boundary.assign(boundary.begin(), boundary.end());
  components = {entry.list<std::uint32_t>("components"), entry.list<std::uint32_t>("sizes")};
  const auto& offsets = adjacency.offsets;
  entry.require(offsets.size() == vertices + 1 && offsets.front() == 0 &&
                offsets.back() == adjacency.items.size() && std::ranges::is_sorted(offsets) &&
                all_below(adjacency.items, vertices) && boundary.size() == vertices &&
                components.of_vertex.size() == vertices &&
                are_sizes(components.of_vertex, components.sizes));
  return found;
}

/// Arrays of what was found of the mirror image.
constexpr const char *kCorners = "corners", *kShares = "shares", *kWithout = "without",
                     *kAdded = "added", *kPlane = "plane", *kDistances = "distances",
                     *kCounts = "counts";
using PlaneNumbers = std::array<double, 4>;
using Pair = std::array<double, 2>;
using Counts = std::array<std::int64_t, 2>;

FoundMirror mirror_in(const CacheEntry& entry, const Topology& topology) {
  const auto vertices = static_cast<std::size_t>(topology.vertex_count);
  FoundMirror found;
  MirrorMap& map = found.map;
  map.corners = entry.list<Triangle>(kCorners);
  map.shares = entry.list<std::array<double, 3>>(kShares);
  map.without = entry.list<std::uint32_t>(kWithout);
  map.kept = entry.matrix<Positions>(kAdded);
  const auto plane = entry.value<PlaneNumbers>(kPlane);
  map.plane = {{plane[0], plane[1], plane[2]}, plane[3]};
  const auto [rms, largest] = entry.value<Pair>(kDistances);
  found.rms = rms;
  found.largest = largest;
  const auto [at_vertices, on_surface] = entry.value<Counts>(kCounts);
  found.vertices = at_vertices;
  found.on_surface = on_surface;
  const auto is_place = [&](const Triangle& triangle) { return all_below(triangle, vertices); };
  entry.require(map.corners.size() == vertices && std::ranges::all_of(map.corners, is_place) &&
                map.shares.size() == vertices && std::ranges::all_of(map.shares, are_shares) &&
                all_below(map.without, vertices) &&
                map.kept.rows() == static_cast<Index>(map.without.size()));
  return found;
}

}  // namespace

fs::path folder_for(const fs::path& cache, const Topology& topology) {
  return topology.vertex_count >= kLeastKeptVertices ? cache : fs::path();
}

void find_neighbours(Inputs& inputs) {
  const Topology& topology = inputs.faces.topology;
  Hasher key;
  begin_key(key, inputs);
  auto found = cached(
      inputs.cache, {"neighbours", key.digest()},
      [&](const CacheEntry& entry) { return neighbours_in(entry, topology); },
      [&] {
        Adjacency adjacency = build_adjacency(topology);
        Components components = find_components(adjacency);
        return Neighbours{std::move(adjacency), std::move(components)};
      },
      [](const Neighbours& made) {
        const std::vector<bool>& boundary = made.adjacency.boundary;
        return std::vector{
            array_of("offsets", made.adjacency.offsets),
            array_of("neighbours", made.adjacency.items),
            owned_array("boundary", std::vector<std::uint8_t>(boundary.begin(), boundary.end())),
            array_of("components", made.components.of_vertex),
            array_of("sizes", made.components.sizes)};
      });
  inputs.adjacency = std::move(found.adjacency);
  inputs.components = std::move(found.components);
}

RegionWeights load_regions(const Config& config, const Inputs& inputs) {
  if (config.regions.names.empty()) return whole_head(inputs.faces.topology);
  const auto key = inputs.cache.empty() ? std::nullopt : key_of_regions(config, inputs);
  if (!key) return weights_of_masks(config, inputs);
  return cached(
      inputs.cache, {"masks", *key},
      [&](const CacheEntry& entry) {
        RegionWeights weights{entry.matrix<RegionWeights::Alpha>("alpha"),
                              entry.value<Index>("uncovered")};
        const auto& alpha = weights.alpha;
        entry.require(alpha.rows() == inputs.faces.topology.vertex_count &&
                      alpha.cols() == static_cast<Index>(config.region_names().size()) &&
                      (alpha.array() >= 0 && alpha.array() <= 1).all());
        return weights;
      },
      [&] { return weights_of_masks(config, inputs); },
      [](const RegionWeights& made) {
        return std::vector{array_of("alpha", made.alpha),
                           value_array("uncovered", made.uncovered_vertices)};
      });
}

FaceSamples choose_samples(const Config& config, const Inputs& inputs, Index count) {
  Hasher key;
  add_skins(begin_key(key, inputs), inputs)
      .add(count)
      .add(config.faces.front.index)
      .add(config.faces.front.sign);
  return cached(
      inputs.cache, {"samples", key.digest()},
      [&](const CacheEntry& entry) {
        FaceSamples chosen = entry.list<std::uint32_t>("vertices");
        entry.require(!chosen.empty() && std::ranges::is_sorted(chosen) &&
                      std::ranges::adjacent_find(chosen) == chosen.end() &&
                      chosen.back() <
                          static_cast<std::uint32_t>(inputs.faces.topology.vertex_count));
        return chosen;
      },
      [&] {
        return choose_face_samples(inputs.faces.topology, inputs.skin, inputs.mean,
                                   config.faces.front, count);
      },
      [](const FaceSamples& made) { return std::vector{array_of("vertices", made)}; });
}

SampleCells find_cells(const Inputs& inputs, const FaceSamples& samples) {
  Hasher key;
  begin_key(key, inputs).add_array(std::span(samples));
  for (const Digest& head : inputs.head_digests) key.add(head);
  return cached(
      inputs.cache, {"cells", key.digest()},
      [&](const CacheEntry& entry) {
        static_assert(SampleCells::kNone == kNoIndex);
        SampleCells cells{entry.list<std::uint32_t>("samples")};
        entry.require(cells.of_vertex.size() ==
                          static_cast<std::size_t>(inputs.faces.topology.vertex_count) &&
                      are_rows(cells.of_vertex, samples.size()));
        return cells;
      },
      [&] { return find_sample_cells(inputs.adjacency, inputs.mean, samples); },
      [](const SampleCells& made) { return std::vector{array_of("samples", made.of_vertex)}; });
}

FoundMirror find_other_sides(const Inputs& inputs, const Eigen::Vector3d& side) {
  Hasher key;
  begin_key(key, inputs).add(kMirrorVersion);
  for (const Digest& head : inputs.head_digests) key.add(head);
  for (const double value : side) key.add(value);
  return cached(
      inputs.cache, {"mirror", key.digest()},
      [&](const CacheEntry& entry) { return mirror_in(entry, inputs.faces.topology); },
      [&] { return find_mirror(inputs.faces.topology, inputs.components, inputs.mean, side); },
      [](const FoundMirror& made) {
        const auto& [normal, offset] = made.map.plane;
        return std::vector{
            array_of(kCorners, made.map.corners),
            array_of(kShares, made.map.shares),
            array_of(kWithout, made.map.without),
            array_of(kAdded, made.map.kept),
            value_array(kPlane, PlaneNumbers{normal[0], normal[1], normal[2], offset}),
            value_array(kDistances, Pair{made.rms, made.largest}),
            value_array(kCounts, Counts{made.vertices, made.on_surface})};
      });
}

}  // namespace crowdface
