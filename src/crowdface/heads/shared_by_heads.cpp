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
#include "crowdface/heads/kept_lists.h"
#include "crowdface/heads/named_parts.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;

constexpr Index kLeastKeptVertices = 50'000;

/// Each kind of entry has keys of its own.
enum class Kind { kNeighbours, kRegions, kSamples, kCells, kMirror };

Hasher& begin_key(Hasher& hasher, Kind kind, const Inputs& inputs) {
  return hasher.add(kSharedVersion).add(static_cast<int>(kind)).add(inputs.topology_digest);
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
  add_skins(begin_key(key, Kind::kRegions, inputs), inputs)
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

template <class Rows>
std::vector<double> list_of(const Rows& rows) {
  return {rows.data(), rows.data() + rows.size()};
}

template <class Rows>
Rows rows_of(const std::vector<double>& list, Index columns) {
  return Eigen::Map<const Rows>(list.data(), static_cast<Index>(list.size()) / columns, columns);
}

}  // namespace

fs::path folder_for(const fs::path& cache, const Topology& topology) {
  return topology.vertex_count >= kLeastKeptVertices ? cache : fs::path();
}

void find_neighbours(Inputs& inputs) {
  const auto vertices = static_cast<std::size_t>(inputs.faces.topology.vertex_count);
  Hasher key;
  begin_key(key, Kind::kNeighbours, inputs);
  using Numbers = std::vector<std::uint32_t>;
  auto [offsets, items, boundary, of_vertex, sizes] =
      kept_lists<std::uint32_t, std::uint32_t, std::uint8_t, std::uint32_t, std::uint32_t>(
          inputs.cache, key.digest(),
          [&] {
            Adjacency adjacency = build_adjacency(inputs.faces.topology);
            Components components = find_components(adjacency);
            return std::tuple(
                std::move(adjacency.offsets), std::move(adjacency.items),
                std::vector<std::uint8_t>(adjacency.boundary.begin(), adjacency.boundary.end()),
                std::move(components.of_vertex), std::move(components.sizes));
          },
          [&](const Numbers& offset, const Numbers& item, const auto& open, const Numbers& of,
              const Numbers& size) {
            return offset.size() == vertices + 1 && offset.front() == 0 &&
                   offset.back() == item.size() && std::ranges::is_sorted(offset) &&
                   all_below(item, vertices) && open.size() == vertices && of.size() == vertices &&
                   are_sizes(of, size);
          });
  inputs.adjacency.offsets = std::move(offsets);
  inputs.adjacency.items = std::move(items);
  inputs.adjacency.boundary.assign(boundary.begin(), boundary.end());
  inputs.components = {std::move(of_vertex), std::move(sizes)};
}

RegionWeights load_regions(const Config& config, const Inputs& inputs) {
  if (config.regions.names.empty()) return whole_head(inputs.faces.topology);
  const auto key = inputs.cache.empty() ? std::nullopt : key_of_regions(config, inputs);
  if (!key) return weights_of_masks(config, inputs);
  const auto vertices = inputs.faces.topology.vertex_count;
  const auto regions = static_cast<Index>(config.region_names().size());
  const auto [alpha, uncovered] = kept_lists<double, std::uint64_t>(
      inputs.cache, *key,
      [&] {
        const RegionWeights weights = weights_of_masks(config, inputs);
        return std::tuple(
            list_of(weights.alpha),
            std::vector<std::uint64_t>{static_cast<std::uint64_t>(weights.uncovered_vertices)});
      },
      [&](const auto& values, const auto& count) {
        return values.size() == static_cast<std::size_t>(vertices * regions) && count.size() == 1 &&
               std::ranges::all_of(values, [](double value) { return value >= 0 && value <= 1; });
      });
  return {rows_of<RegionWeights::Alpha>(alpha, regions), static_cast<Index>(uncovered.front())};
}

FaceSamples choose_samples(const Config& config, const Inputs& inputs, Index count) {
  Hasher key;
  add_skins(begin_key(key, Kind::kSamples, inputs), inputs)
      .add(count)
      .add(config.faces.front.index)
      .add(config.faces.front.sign);
  auto [samples] = kept_lists<std::uint32_t>(
      inputs.cache, key.digest(),
      [&] {
        return std::tuple(choose_face_samples(inputs.faces.topology, inputs.skin, inputs.mean,
                                              config.faces.front, count));
      },
      [&](const auto& chosen) {
        return !chosen.empty() && std::ranges::is_sorted(chosen) &&
               std::ranges::adjacent_find(chosen) == chosen.end() &&
               chosen.back() < static_cast<std::uint32_t>(inputs.faces.topology.vertex_count);
      });
  return std::move(samples);
}

SampleCells find_cells(const Inputs& inputs, const FaceSamples& samples) {
  Hasher key;
  begin_key(key, Kind::kCells, inputs).add_array(std::span(samples));
  for (const Digest& head : inputs.head_digests) key.add(head);
  auto [of_vertex] = kept_lists<std::uint32_t>(
      inputs.cache, key.digest(),
      [&] {
        return std::tuple(find_sample_cells(inputs.adjacency, inputs.mean, samples).of_vertex);
      },
      [&](const auto& cells) {
        static_assert(SampleCells::kNone == kNoIndex);
        return cells.size() == static_cast<std::size_t>(inputs.faces.topology.vertex_count) &&
               are_rows(cells, samples.size());
      });
  return {std::move(of_vertex)};
}

FoundMirror find_other_sides(const Inputs& inputs, const Eigen::Vector3d& side) {
  const auto vertices = static_cast<std::size_t>(inputs.faces.topology.vertex_count);
  Hasher key;
  begin_key(key, Kind::kMirror, inputs).add(kMirrorVersion);
  for (const Digest& head : inputs.head_digests) key.add(head);
  for (const double value : side) key.add(value);
  const auto [corners, shares, without, kept, counts, measures] =
      kept_lists<Triangle, std::array<double, 3>, std::uint32_t, double, std::uint64_t, double>(
          inputs.cache, key.digest(),
          [&] {
            FoundMirror found =
                find_mirror(inputs.faces.topology, inputs.components, inputs.mean, side);
            const auto& [normal, offset] = found.map.plane;
            return std::tuple(
                std::move(found.map.corners), std::move(found.map.shares),
                std::move(found.map.without), list_of(found.map.kept),
                std::vector<std::uint64_t>{static_cast<std::uint64_t>(found.vertices),
                                           static_cast<std::uint64_t>(found.on_surface)},
                std::vector<double>{normal[0], normal[1], normal[2], offset, found.rms,
                                    found.largest});
          },
          [&](const auto& corner, const auto& share, const auto& lacking, const auto& added,
              const auto& count, const auto& measure) {
            const auto is_place = [&](const Triangle& triangle) {
              return all_below(triangle, vertices);
            };
            return corner.size() == vertices && std::ranges::all_of(corner, is_place) &&
                   share.size() == vertices && std::ranges::all_of(share, are_shares) &&
                   all_below(lacking, vertices) && added.size() == 3 * lacking.size() &&
                   are_coordinates(std::span(added)) && count.size() == 2 && measure.size() == 6 &&
                   are_coordinates(std::span(measure));
          });
  FoundMirror found;
  found.map.plane = {{measures[0], measures[1], measures[2]}, measures[3]};
  found.map.corners = corners;
  found.map.shares = shares;
  found.map.without = without;
  found.map.kept = rows_of<Positions>(kept, 3);
  found.vertices = static_cast<Index>(counts[0]);
  found.on_surface = static_cast<Index>(counts[1]);
  found.rms = measures[4];
  found.largest = measures[5];
  return found;
}

}  // namespace crowdface
