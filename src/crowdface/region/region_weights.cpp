// SPDX-License-Identifier: Apache-2.0
#include "crowdface/region/region_weights.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <functional>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <utility>

#include "crowdface/core/error.h"
#include "crowdface/core/parallel.h"
#include "crowdface/core/problems.h"
#include "crowdface/core/require.h"
#include "crowdface/core/text.h"
#include "crowdface/io/tile_files.h"
#include "crowdface/region/uv_samples.h"
#include "crowdface/region/vertex_weights.h"

namespace crowdface {
namespace {

constexpr Index kBlock = 4096;

struct LoadedTile {
  Image image;
  std::vector<int> channels;  ///< indices of the image's channels that hold masks
};

/// A mask in memory: its tiles, or vertex weights.
struct LoadedMask {
  bool tiled = false;
  /// tiles by UDIM number; a single image has number kFirstTile
  std::map<int, LoadedTile> tiles;
  /// set if the mask is a file of vertex weights; then `tiles` is empty
  std::optional<VertexWeights> weights;
  std::vector<std::string> names;  ///< for each channel: its name; empty if no channel has a name

  std::size_t channels() const {
    if (weights) return weights->rows.width();
    return tiles.empty() ? 0 : tiles.begin()->second.channels.size();
  }
  /// The value of one channel at a texture coordinate; zero if the tile is not loaded.
  double at(const UvSample& sample, std::size_t channel) const {
    const auto found = tiles.find(tiled ? sample.tile : kFirstTile);
    if (found == tiles.end()) return 0;
    const LoadedTile& tile = found->second;
    const int number = tiled ? sample.tile - kFirstTile : 0;
    const int column = number % 10, row = number / 10;
    return sample_bilinear(tile.image, sample.u - column, sample.v - row, tile.channels[channel]);
  }
  /// The value of one channel at a vertex: the mean of the samples at the vertex's texture
  /// coordinates; nothing if the vertex has no texture coordinates.
  std::optional<double> at_vertex(Index vertex, std::span<const UvSample> samples,
                                  std::size_t channel) const {
    if (weights) {
      return weights->rows.values[static_cast<std::size_t>(vertex) * channels() + channel];
    }
    if (samples.empty()) return std::nullopt;
    double sum = 0;
    for (const UvSample& sample : samples) sum += at(sample, channel);
    return sum / static_cast<double>(samples.size());
  }
};

/// A function that returns the index of the channel to examine in a tile. This channel index may
/// differ between the tiles of one mask.
using ChannelOf = std::function<int(const LoadedTile&)>;

ChannelOf colour(std::size_t number) {
  return [number](const LoadedTile& tile) { return tile.channels[number]; };
}
ChannelOf alpha() {
  return [](const LoadedTile& tile) { return tile.image.alpha_channel; };
}

/// Whether a channel has the same value at all pixels of all tiles.
bool is_constant(const LoadedMask& mask, const ChannelOf& channel_of) {
  const LoadedTile& first = mask.tiles.begin()->second;
  const auto value = first.image.at(0, 0, channel_of(first));
  return std::ranges::all_of(mask.tiles, [&](const auto& numbered) {
    const Image& image = numbered.second.image;
    const int channel = channel_of(numbered.second);
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x) {
        if (image.at(x, y, channel) != value) return false;
      }
    }
    return true;
  });
}
/// Whether all colour channels are equal at all pixels of all tiles.
bool is_grey(const LoadedMask& mask) {
  return std::ranges::all_of(mask.tiles, [](const auto& numbered) {
    const auto& [image, channels] = numbered.second;
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x) {
        for (const int channel : channels) {
          if (image.at(x, y, channel) != image.at(x, y, channels[0])) return false;
        }
      }
    }
    return true;
  });
}

/// Whether all tiles have an alpha channel, and alpha is not constant.
bool has_varying_alpha(const LoadedMask& mask) {
  const bool is_there = std::ranges::all_of(
      mask.tiles, [](const auto& numbered) { return numbered.second.image.alpha_channel >= 0; });
  return is_there && !mask.tiles.empty() && !is_constant(mask, alpha());
}

void take_one_channel(LoadedMask& mask, const ChannelOf& channel_of) {
  for (auto& [number, tile] : mask.tiles) tile.channels = {channel_of(tile)};
  mask.names.clear();
}

/// Uses alpha as the mask if alpha varies and all colour channels are constant.
void use_alpha_of_constant_colours(LoadedMask& mask) {
  if (!has_varying_alpha(mask)) return;
  for (std::size_t number = 0; number < mask.channels(); ++number) {
    if (!is_constant(mask, colour(number))) return;
  }
  take_one_channel(mask, alpha());
}

/// Reduces an image to the mask of one region. The mask is the grey value if all colour channels
/// are equal, otherwise alpha.
/// \throws InvalidInput if the image is coloured and alpha does not vary.
void use_grey_or_alpha(LoadedMask& mask, const std::string& path) {
  if (mask.channels() < 2 || mask.tiles.empty()) return;
  if (is_grey(mask)) return take_one_channel(mask, colour(0));
  if (has_varying_alpha(mask)) return take_one_channel(mask, alpha());
  throw InvalidInput(
      concat(path,
             ": expected a grey image, because each region has its own image, found a colour "
             "image: save each mask in grey, or all masks as channels of one image"));
}

/// Loads a mask's tiles or vertex weights; adds errors to `problems`.
/// \param used    UDIM numbers of the tiles in which texture coordinates lie.
/// \param needed  UDIM numbers of the used tiles that must exist.
LoadedMask load(const MaskSource& source, const std::set<int>& used, const std::set<int>& needed,
                Index vertices, Problems& problems) {
  LoadedMask mask;
  mask.tiled = source.is_tiled();
  if (holds_vertex_weights(source.path())) {
    try {
      mask.weights = read_vertex_weights(source.path());
      mask.names = mask.weights->names;
      const std::size_t rows = mask.weights->rows.rows();
      if (rows != static_cast<std::size_t>(vertices)) {
        problems.add(ExitCode::kBadData,
                     concat("mask ", source.path(), ": expected a row for each of ", vertices,
                            " vertices, found ", rows,
                            mask.weights->rows.width() == static_cast<std::size_t>(vertices)
                                ? ": save its transpose"
                                : ""));
      }
    } catch (const RecoverableError& error) {
      problems.add(error);
    }
    return mask;
  }
  for (const int tile : mask.tiled ? used : std::set<int>{kFirstTile}) {
    try {
      Image image = source.read(tile);
      std::vector<int> channels = mask_channel_indices(image);
      mask.tiles.emplace(tile, LoadedTile{std::move(image), std::move(channels)});
    } catch (const MissingInput& error) {
      if (!mask.tiled) {
        problems.add(error);
      } else if (needed.contains(tile)) {
        problems.add(ExitCode::kMissingInput, concat("mask ", source.path(), ": tile ", tile,
                                                     " is used by texture coordinates, but ",
                                                     source.tile_path(tile), " cannot be found"));
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
    return mask;
  }
  if (mask.tiles.empty()) return mask;
  const Image& first = mask.tiles.begin()->second.image;
  for (const int channel : mask.tiles.begin()->second.channels) {
    if (first.channel_names.empty()) break;
    mask.names.push_back(first.channel_names[static_cast<std::size_t>(channel)]);
  }
  use_alpha_of_constant_colours(mask);
  // Painting programs save a grey mask as three equal channels.
  const bool is_grey_painting =
      mask.channels() > 1 && is_grey(mask) && !is_constant(mask, colour(0));
  if (is_grey_painting) take_one_channel(mask, colour(0));
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
                                " regions: remove this image"));
    }
    channels += static_cast<Index>(masks[i].channels());
  }
  // A single channel suffices for two regions: the second region gets 1 minus the weight of the
  // first.
  const bool second_gets_remainder = channels == 1 && regions == 2;
  if (channels < regions && !second_gets_remainder) {
    throw InvalidInput(concat("expected a mask channel for each of ", regions, " regions, found ",
                              channels, " in ", masks.empty() ? "no image" : join(found)));
  }
}

/// The index of the mask that holds a region's weights, and the index of the channel in this mask.
struct RegionChannel {
  std::size_t mask = 0, channel = 0;
};

/// The dot-separated parts of a channel's name, in lower case: "masks.top" gives "masks" and "top".
std::vector<std::string> names_of_channel(const std::string& name) {
  std::vector<std::string> names;
  for (const std::string_view part : split(name, '.')) names.push_back(lower_case(part));
  return names;
}

bool is_colour_name(const std::string& name) {
  static const std::set<std::string> colours = {"r",   "g",     "b",    "a", "y", "l",
                                                "red", "green", "blue", "z", "x", "value"};
  return colours.contains(lower_case(name));
}

/// Returns, for each region, the channel with the region's name, if there is such a channel. If no
/// channel of any mask has the name of a region, returns nothing.
/// \throws InvalidInput if the channels of a mask have names of their own (other than red, green,
///         blue, …), but none of these is the name of a region.
std::optional<std::vector<std::optional<RegionChannel>>> channels_by_name(
    const std::vector<MaskSource>& sources, const std::vector<LoadedMask>& masks,
    const std::vector<std::string>& regions) {
  std::vector<std::optional<RegionChannel>> found(regions.size());
  bool any = false;
  for (std::size_t m = 0; m < masks.size(); ++m) {
    const std::vector<std::string>& channels = masks[m].names;
    bool of_this = false;
    for (std::size_t c = 0; c < channels.size(); ++c) {
      const std::vector<std::string> names = names_of_channel(channels[c]);
      for (std::size_t r = 0; r < regions.size(); ++r) {
        if (std::ranges::find(names, lower_case(regions[r])) == names.end()) continue;
        of_this = true;
        if (!found[r]) found[r] = RegionChannel{m, c};
      }
    }
    any = any || of_this;
    const bool are_named = !std::ranges::all_of(channels, is_colour_name);
    if (of_this || !are_named || channels.size() < 2) continue;
    throw InvalidInput(concat(
        sources[m].path(), ": its channels are called ", join(channels), ", and the regions ",
        join(regions),
        ": name the channels like the regions, because their order in the file is arbitrary"));
  }
  if (!any) return std::nullopt;
  return found;
}

/// Whether a file name contains a region's name as a word: `mask_brow` contains `brow`.
bool has_word(const std::string& file, const std::string& word) {
  const auto is_inside = [&](std::size_t at) {
    return at < file.size() && std::isalnum(static_cast<unsigned char>(file[at])) != 0;
  };
  for (std::size_t at = file.find(word); at != file.npos; at = file.find(word, at + 1)) {
    if ((at == 0 || !is_inside(at - 1)) && !is_inside(at + word.size())) return true;
  }
  return false;
}

/// The index of each region's image, for masks with as many images as regions. If all file names
/// match regions, the file names decide. Otherwise, image i belongs to region i.
std::vector<std::size_t> images_of_regions(const std::vector<MaskSource>& sources,
                                           const std::vector<std::string>& regions) {
  std::vector<std::size_t> by_order(sources.size());
  std::iota(by_order.begin(), by_order.end(), std::size_t{0});
  const auto named = [&](const auto& is_of) {
    std::vector<std::size_t> by_name;
    for (const std::string& region : regions) {
      for (std::size_t m = 0; m < sources.size(); ++m) {
        const std::string file = std::filesystem::path(sources[m].path()).stem().string();
        if (is_of(lower_case(file), lower_case(region))) by_name.push_back(m);
      }
    }
    return by_name;
  };
  for (const auto& by_name : {named(std::equal_to<std::string>()), named(has_word)}) {
    if (std::ranges::is_permutation(by_name, by_order)) return by_name;
  }
  return by_order;
}

/// The mask channel that holds the weights of each region. At most one region has no channel; its
/// weight at each vertex is 1 minus the sum of the weights of all other regions.
std::vector<std::optional<RegionChannel>> channels_of_regions(
    const std::vector<MaskSource>& sources, std::vector<LoadedMask>& masks, Index regions,
    const std::vector<std::string>& names) {
  const auto count = static_cast<std::size_t>(regions);
  if (auto named = channels_by_name(sources, masks, names)) {
    for (std::size_t r = 0; r + 1 < count; ++r) {
      if ((*named)[r]) continue;
      std::vector<std::string> channels;
      for (const LoadedMask& mask : masks) {
        channels.insert(channels.end(), mask.names.begin(), mask.names.end());
      }
      throw InvalidInput(concat("no mask channel has the name of the region ", names[r],
                                " (the channels are ", join(channels), ")"));
    }
    return *named;
  }
  std::size_t channels = 0;
  for (const LoadedMask& mask : masks) channels += mask.channels();
  std::vector<std::optional<RegionChannel>> found;
  if (count > 1 && masks.size() == count && channels >= count) {
    for (std::size_t m = 0; m < masks.size(); ++m) use_grey_or_alpha(masks[m], sources[m].path());
    for (const std::size_t m : images_of_regions(sources, names)) {
      found.emplace_back(RegionChannel{m, 0});
    }
    return found;
  }
  check_channels(sources, masks, regions);
  for (std::size_t m = 0; m < masks.size(); ++m) {
    for (std::size_t c = 0; c < masks[m].channels() && found.size() < count; ++c) {
      found.emplace_back(RegionChannel{m, c});
    }
  }
  found.resize(count);
  return found;
}

/// Samples every region's mask at one vertex and scales the values to sum to one. Returns false and
/// writes nothing if all masks are zero at the vertex or the vertex has no texture coordinates.
bool normalised_mean(const std::vector<LoadedMask>& masks,
                     const std::vector<std::optional<RegionChannel>>& channels, Index vertex,
                     std::span<const UvSample> samples, Eigen::Ref<Eigen::RowVectorXd> row) {
  double sum = 0;
  Eigen::RowVectorXd values = Eigen::RowVectorXd::Zero(row.size());
  for (Index k = 0; k < row.size(); ++k) {
    const auto& channel = channels[static_cast<std::size_t>(k)];
    if (channel) {
      const auto value = masks[channel->mask].at_vertex(vertex, samples, channel->channel);
      if (!value) return false;
      values[k] = *value;
    } else {
      values[k] = std::max(0.0, 1 - sum);
    }
    sum += values[k];
  }
  if (!(sum > 0)) return false;
  for (Index k = 0; k < row.size(); ++k) row[k] = values[k] / sum;  // Σ_k α_k = 1, as Eq. 7 needs
  return true;
}

bool all_hold_vertex_weights(const std::vector<MaskSource>& masks) {
  return !masks.empty() && std::ranges::all_of(masks, [](const MaskSource& mask) {
    return holds_vertex_weights(mask.path());
  });
}

/// The texture coordinates of all vertices; empty if all masks are files of vertex weights.
UvSamples samples_for(const Topology& topology, const TextureCoordinates& uvs,
                      const std::vector<MaskSource>& masks, const std::vector<bool>& is_needed,
                      const std::string& mesh_name) {
  if (all_hold_vertex_weights(masks)) {
    UvSamples none;
    none.offsets.assign(static_cast<std::size_t>(topology.vertex_count) + 1, 0);
    return none;
  }
  const bool tiled = std::ranges::any_of(masks, [](auto& m) { return m.is_tiled(); });
  return gather_uv_samples(topology, uvs, tiled ? UvTiling::kUdim : UvTiling::kOne, is_needed,
                           mesh_name);
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

RegionWeights whole_head_weights(const Topology& topology) {
  return {RegionWeights::Alpha::Ones(topology.vertex_count, 1), 0};
}

RegionWeights region_weights(const Topology& topology, const TextureCoordinates& uvs,
                             const std::vector<MaskSource>& masks, Index regions,
                             const std::vector<bool>& is_needed,
                             const std::vector<std::string>& names, const std::string& mesh_name) {
  require(regions >= 1, "region: weights of ", regions, " regions");
  if (masks.empty() && regions == 1) return whole_head_weights(topology);
  const UvSamples samples = samples_for(topology, uvs, masks, is_needed, mesh_name);
  const std::set<int> used = tiles_of(samples);
  const auto needs_mask = [&](Index v) {
    return is_needed.empty() || is_needed[static_cast<std::size_t>(v)];
  };
  std::set<int> needed_tiles;
  for (Index v = 0; v < topology.vertex_count; ++v) {
    if (!needs_mask(v)) continue;
    for (const UvSample& sample : samples.items_of(v)) needed_tiles.insert(sample.tile);
  }
  std::vector<LoadedMask> loaded;
  loaded.reserve(masks.size());
  Problems problems;
  for (const MaskSource& mask : masks) {
    loaded.push_back(load(mask, used, needed_tiles, topology.vertex_count, problems));
  }
  problems.throw_if_any();
  const auto channels = channels_of_regions(masks, loaded, regions, names);

  RegionWeights weights{RegionWeights::Alpha::Zero(topology.vertex_count, regions), 0};
  std::vector<std::uint8_t> uncovered(static_cast<std::size_t>(topology.vertex_count), 0);
  const bool by_vertex = all_hold_vertex_weights(masks);
  parallel_for_each(topology.vertex_count, kBlock, [&](Index i) {
    const auto places = samples.items_of(i);
    if (normalised_mean(loaded, channels, i, places, weights.alpha.row(i))) return;
    weights.alpha(i, regions - 1) = 1;
    uncovered[static_cast<std::size_t>(i)] =
        (places.empty() && !by_vertex) || !needs_mask(i) ? 0 : 1;
  });
  weights.uncovered_vertex_count = std::ranges::count(uncovered, 1);
  return weights;
}

std::vector<double> mask_values(const Topology& topology, const TextureCoordinates& uvs,
                                const MaskSource& mask, const std::vector<bool>& is_needed,
                                const std::string& mesh_name) {
  const UvSamples samples = samples_for(topology, uvs, {mask}, is_needed, mesh_name);
  Problems problems;
  const std::set<int> used = tiles_of(samples);
  const LoadedMask loaded = load(mask, used, used, topology.vertex_count, problems);
  problems.throw_if_any();
  check_channels({mask}, {loaded}, 1);
  std::vector<double> values(static_cast<std::size_t>(topology.vertex_count), 0.0);
  for (Index i = 0; i < topology.vertex_count; ++i) {
    values[static_cast<std::size_t>(i)] = loaded.at_vertex(i, samples.items_of(i), 0).value_or(0);
  }
  return values;
}

}  // namespace crowdface
