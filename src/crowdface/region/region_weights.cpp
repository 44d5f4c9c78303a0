// SPDX-License-Identifier: Apache-2.0
#include "crowdface/region/region_weights.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "crowdface/core/error.h"
#include "crowdface/core/parallel.h"
#include "crowdface/core/problems.h"
#include "crowdface/core/require.h"
#include "crowdface/core/text.h"
#include "crowdface/io/tile_files.h"
#include "crowdface/region/uv_samples.h"

namespace crowdface {
namespace {

constexpr Index kBlock = 4096;

struct LoadedTile {
  Image image;
  std::vector<int> channels;  ///< those that hold masks
};

/// A mask with the tiles it needs in memory.
struct LoadedMask {
  bool tiled = false;
  std::map<int, LoadedTile> tiles;  ///< a single picture stands as kFirstTile

  std::size_t channels() const { return tiles.empty() ? 0 : tiles.begin()->second.channels.size(); }
  /// Zero where no image is needed and none is there.
  double at(const UvSample& sample, std::size_t channel) const {
    const auto found = tiles.find(tiled ? sample.tile : kFirstTile);
    if (found == tiles.end()) return 0;
    const LoadedTile& tile = found->second;
    const int number = tiled ? sample.tile - kFirstTile : 0;
    const int column = number % 10, row = number / 10;
    return sample_bilinear(tile.image, sample.u - column, sample.v - row, tile.channels[channel]);
  }
};

/// \param needed  those of the used tiles that must be there.
LoadedMask load(const MaskSource& source, const std::set<int>& used, const std::set<int>& needed,
                Problems& problems) {
  LoadedMask mask;
  mask.tiled = source.tiled();
  for (const int tile : mask.tiled ? used : std::set<int>{kFirstTile}) {
    try {
      Image image = source.read(tile);
      std::vector<int> channels = mask_channels(image);
      mask.tiles.emplace(tile, LoadedTile{std::move(image), std::move(channels)});
    } catch (const MissingInput& error) {
      if (!mask.tiled) {
        problems.add(error);
      } else if (needed.contains(tile)) {
        problems.add(ExitCode::kMissingInput, concat("mask ", source.path(), ": tile ", tile,
                                                     " is used by texture coordinates, but ",
                                                     source.file_of(tile), " cannot be found"));
      }
    } catch (const InvalidInput& error) {
      problems.add(error);
    }
  }
  for (const auto& [number, tile] : mask.tiles) {
    if (tile.channels.size() == mask.channels()) continue;
    problems.add(ExitCode::kBadData, concat("mask ", source.path(), ": expected ", mask.channels(),
                                            " channels as in tile ", mask.tiles.begin()->first,
                                            ", found ", tile.channels.size(), " in tile ", number));
  }
  return mask;
}

void check_channels(const std::vector<MaskSource>& sources, const std::vector<LoadedMask>& masks,
                    Index regions) {
  std::vector<std::string> found;
  Index channels = 0;
  for (std::size_t i = 0; i < masks.size(); ++i) {
    found.push_back(concat(sources[i].path(), " (", masks[i].channels(), ")"));
    if (channels >= regions) {
      throw InvalidInput(concat("the masks before ", sources[i].path(), " have ", channels,
                                " channels, enough for all ", regions,
                                " regions: this image is left over"));
    }
    channels += static_cast<Index>(masks[i].channels());
  }
  if (channels < regions) {
    throw InvalidInput(concat("expected a mask channel for each of ", regions, " regions, found ",
                              channels, " in ", masks.empty() ? "no image" : join(found)));
  }
}

/// The mean of every region's mask over the places of one vertex, scaled to sum to one. False, and
/// nothing written, where no mask covers it.
bool normalised_mean(const std::vector<LoadedMask>& masks, std::span<const UvSample> samples,
                     Eigen::Ref<Eigen::RowVectorXd> row) {
  Index k = 0;
  double sum = 0;
  Eigen::RowVectorXd values = Eigen::RowVectorXd::Zero(row.size());
  for (const LoadedMask& mask : masks) {
    for (std::size_t c = 0; c < mask.channels() && k < row.size(); ++c, ++k) {
      for (const UvSample& sample : samples) values[k] += mask.at(sample, c);
      values[k] /= static_cast<double>(samples.size());
      sum += values[k];
    }
  }
  if (!(sum > 0)) return false;
  for (k = 0; k < row.size(); ++k) row[k] = values[k] / sum;  // Σ_k α_k = 1, as Eq. 7 needs
  return true;
}

}  // namespace

double sample_bilinear(const Image& image, double u, double v, int channel) {
  const double x = std::clamp(u * image.width - 0.5, 0.0, image.width - 1.0);
  const double y = std::clamp((1 - v) * image.height - 0.5, 0.0, image.height - 1.0);
  const int left = static_cast<int>(x);
  const int top = static_cast<int>(y);
  const int right = std::min(left + 1, image.width - 1);
  const int bottom = std::min(top + 1, image.height - 1);
  const double s = x - left;
  const double t = y - top;
  const double above = (1 - s) * image.at(left, top, channel) + s * image.at(right, top, channel);
  const double below =
      (1 - s) * image.at(left, bottom, channel) + s * image.at(right, bottom, channel);
  return (1 - t) * above + t * below;
}

RegionWeights whole_head(const Topology& topology) {
  return {RegionWeights::Alpha::Ones(topology.vertex_count, 1), 0};
}

RegionWeights region_weights(const Topology& topology, const TextureCoordinates& uvs,
                             const std::vector<MaskSource>& masks, Index regions,
                             const std::vector<bool>& needed) {
  require(regions >= 1, "region: weights of ", regions, " regions");
  if (masks.empty() && regions == 1) return whole_head(topology);
  const bool tiled = std::ranges::any_of(masks, [](auto& m) { return m.tiled(); });
  const UvSamples samples = gather_uv_samples(topology, uvs, tiled ? Tiles::kUdim : Tiles::kOne);
  const std::set<int> used = tiles_of(samples);
  const auto is_needed = [&](Index v) {
    return needed.empty() || needed[static_cast<std::size_t>(v)];
  };
  std::set<int> needed_tiles;
  for (Index v = 0; v < topology.vertex_count; ++v) {
    if (!is_needed(v)) continue;
    for (const UvSample& sample : samples.of(v)) needed_tiles.insert(sample.tile);
  }
  std::vector<LoadedMask> loaded;
  loaded.reserve(masks.size());
  Problems problems;
  for (const MaskSource& mask : masks) loaded.push_back(load(mask, used, needed_tiles, problems));
  problems.throw_if_any();
  check_channels(masks, loaded, regions);

  RegionWeights weights{RegionWeights::Alpha::Zero(topology.vertex_count, regions), 0};
  std::vector<std::uint8_t> uncovered(static_cast<std::size_t>(topology.vertex_count), 0);
  parallel_for_each(topology.vertex_count, kBlock, [&](Index i) {
    const auto places = samples.of(i);
    if (!places.empty() && normalised_mean(loaded, places, weights.alpha.row(i))) return;
    weights.alpha(i, regions - 1) = 1;
    uncovered[static_cast<std::size_t>(i)] = places.empty() || !is_needed(i) ? 0 : 1;
  });
  weights.uncovered_vertices = std::ranges::count(uncovered, 1);
  return weights;
}

std::vector<double> mask_values(const Topology& topology, const TextureCoordinates& uvs,
                                const MaskSource& mask) {
  const UvSamples samples =
      gather_uv_samples(topology, uvs, mask.tiled() ? Tiles::kUdim : Tiles::kOne);
  Problems problems;
  const std::set<int> used = tiles_of(samples);
  const LoadedMask loaded = load(mask, used, used, problems);
  problems.throw_if_any();
  check_channels({mask}, {loaded}, 1);
  std::vector<double> values(static_cast<std::size_t>(topology.vertex_count), 0.0);
  for (Index i = 0; i < topology.vertex_count; ++i) {
    const auto places = samples.of(i);
    double sum = 0;
    for (const UvSample& sample : places) sum += loaded.at(sample, 0);
    if (!places.empty()) {
      values[static_cast<std::size_t>(i)] = sum / static_cast<double>(places.size());
    }
  }
  return values;
}

}  // namespace crowdface
