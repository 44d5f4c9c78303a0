// SPDX-License-Identifier: Apache-2.0
#include "crowdface/texture/texture_blender.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <optional>
#include <span>
#include <utility>

#include "crowdface/core/error.h"
#include "crowdface/core/parallel.h"
#include "crowdface/core/require.h"
#include "crowdface/texture/paint_picture.h"

namespace crowdface {

namespace {

constexpr Index kVerticesPerBlock = 1024;

/// The weight of each head in a blended colour. The weights sum to one, or all are zero.
using HeadWeights = std::vector<double>;

/// Each head's weight in the target colours: the recipe's colour weights if given, otherwise the
/// head's share of the target shape.
HeadWeights shares_by_head(const Recipe& recipe, std::size_t heads) {
  HeadWeights shares(heads, 0.0);
  for (const SourceWeight& share :
       recipe.colours.empty() ? target_head_weights(recipe) : recipe.colours) {
    shares[static_cast<std::size_t>(share.head)] = share.weight;
  }
  return shares;
}

HeadWeights mean_of(const HeadWeights& a, const HeadWeights& b) {
  HeadWeights mean(a.size());
  for (std::size_t h = 0; h < mean.size(); ++h) mean[h] = 0.5 * (a[h] + b[h]);
  return mean;
}

/// The weights W_h of TextureBlender: half the target's weights plus half the area-weighted mean of
/// the regions' weights.
HeadWeights weights_of_whole(const HeadWeights& target, const std::vector<HeadWeights>& regions,
                             const std::vector<double>& region_area_fractions) {
  HeadWeights mean(target.size(), 0.0);
  for (std::size_t k = 0; k < regions.size(); ++k) {
    for (std::size_t h = 0; h < mean.size(); ++h)
      mean[h] += region_area_fractions[k] * regions[k][h];
  }
  return mean_of(target, mean);
}

/// Normalizes weights over the heads that have a map. Uses the first weights in `choices` that are
/// positive for any head with a map. If there are none, all heads with a map get equal weights.
HeadWeights normalized_over_painted(std::initializer_list<const HeadWeights*> choices,
                                    const std::vector<std::shared_ptr<const TextureMap>>& maps) {
  HeadWeights weights(maps.size());
  const auto take = [&](const auto& of) {
    double sum = 0;
    for (std::size_t h = 0; h < maps.size(); ++h) sum += weights[h] = maps[h] ? of(h) : 0.0;
    for (double& weight : weights) weight = sum > 0 ? weight / sum : 0.0;
    return sum > 0;
  };
  for (const HeadWeights* choice : choices) {
    if (take([&](std::size_t h) { return (*choice)[h]; })) return weights;
  }
  take([](std::size_t) { return 1.0; });
  return weights;
}

/// The heads' weights in one texture image of one face.
struct FaceWeights {
  /// the heads' weights at vertices that get only the target's colours, such as vertices of eyes
  HeadWeights of_target;
  HeadWeights of_face;  ///< the weights W_h of TextureBlender
  /// for each region: the weights v_h of TextureBlender at vertices that lie only in this region
  std::vector<HeadWeights> of_region;
};

FaceWeights face_weights(const Recipe& recipe,
                         const std::vector<std::shared_ptr<const TextureMap>>& maps,
                         const std::vector<double>& region_area_fractions) {
  const HeadWeights target = shares_by_head(recipe, maps.size());
  const std::vector<HeadWeights> regions = colour_weights(recipe, maps.size());
  const HeadWeights face = weights_of_whole(target, regions, region_area_fractions);
  FaceWeights weights{
      normalized_over_painted({&target, &face}, maps), normalized_over_painted({&face}, maps), {}};
  for (const HeadWeights& region : regions) {
    const HeadWeights mixed = mean_of(face, region);
    weights.of_region.push_back(normalized_over_painted({&mixed}, maps));
  }
  return weights;
}

/// The gain g of TextureBlender, which restores the contrast of blended detail. The gain is limited
/// to the range from 1 to 1/√(Σ v_h²).
/// \param weights  v_h for each of the `heads`.
double gain_at(const SurfaceStatistics& statistics, std::size_t vertex,
               const std::vector<std::size_t>& heads, const std::vector<double>& weights) {
  double wanted = 0, left = 0, squares = 0;
  for (std::size_t s = 0; s < heads.size(); ++s) {
    if (weights[s] == 0) continue;
    const auto covariance = [&](std::size_t t) {
      return static_cast<double>(statistics.covariance(vertex, heads[s], heads[t]));
    };
    wanted += weights[s] * covariance(s);
    squares += weights[s] * weights[s];
    for (std::size_t t = 0; t < heads.size(); ++t) left += weights[s] * weights[t] * covariance(t);
  }
  if (!(wanted > left)) return 1;
  return left * squares > 0 && wanted * squares < left ? std::sqrt(wanted / left)
                                                       : 1 / std::sqrt(squares);
}

/// The common coding of all maps of a texture image. Its range is the smallest range that contains
/// the ranges of all maps; blended values are clamped to this range.
MapCoding common_coding(const std::vector<std::shared_ptr<const TextureMap>>& maps) {
  std::optional<MapCoding> common;
  float high = 0;
  for (const auto& map : maps) {
    if (!map) continue;
    const float top = map->decode(65535);
    if (!common) {
      common = map->coding;
      high = top;
    }
    require(map->coding.content == common->content && map->coding.channels == common->channels,
            "maps of different kinds in one picture");
    common->low = std::min(common->low, map->coding.low);
    high = std::max(high, top);
  }
  if (!common) return {};
  if (common->content == MapContent::kValues) {
    common = MapCoding::value_coding(common->channels, common->low, high);
  }
  return *common;
}

}  // namespace

std::vector<std::vector<double>> colour_weights(const Recipe& recipe, std::size_t heads) {
  const std::vector<double> of_target = shares_by_head(recipe, heads);
  std::vector<std::vector<double>> weights;
  if (!recipe.colours.empty()) return {recipe.regions.size(), of_target};
  for (const RegionRecipe& region : recipe.regions) {
    // A region without its own colour weights has the weights of its finest band.
    const BandRecipe& finest = band_of(region, band_count(region) - 1);
    std::vector<double> of_region(heads, 0.0);
    double sum = 0;
    for (const SourceWeight& source : region.colours.empty() ? finest.weights : region.colours) {
      of_region[static_cast<std::size_t>(source.head)] += source.weight;
      sum += source.weight;
    }
    const double rest = std::max(0.0, 1 - sum), total = std::max(1.0, sum);
    for (std::size_t h = 0; h < heads; ++h) {
      of_region[h] = (of_region[h] + rest * of_target[h]) / total;
    }
    weights.push_back(std::move(of_region));
  }
  return weights;
}

std::vector<double> region_area_fractions(const RegionWeights& regions,
                                          const std::vector<double>& vertex_areas) {
  std::vector<double> shares(static_cast<std::size_t>(regions.alpha.cols()), 0.0);
  double total = 0;
  for (std::size_t v = 0; v < vertex_areas.size(); ++v) {
    total += vertex_areas[v];
    for (std::size_t k = 0; k < shares.size(); ++k) {
      shares[k] += vertex_areas[v] * regions.alpha(static_cast<Index>(v), static_cast<Index>(k));
    }
  }
  require(total > 0, "a face of no area");
  for (double& share : shares) share /= total;
  return shares;
}

FaceColourWeights face_colour_weights(const Recipe& recipe, std::size_t heads,
                                      const std::vector<double>& region_area_fractions) {
  const HeadWeights target = shares_by_head(recipe, heads);
  return {weights_of_whole(target, colour_weights(recipe, heads), region_area_fractions), target};
}

TextureBlender::TextureBlender(const Topology& topology, std::shared_ptr<const LayoutTexels> texels,
                               const ChebyshevFilter& filter, const RegionWeights& regions,
                               const CrowdTextures& textures, TextureBlendOptions options,
                               const FindStatistics& find_statistics)
    : regions_(regions),
      textures_(textures),
      options_(std::move(options)),
      texels_(std::move(texels)) {
  const auto vertices = static_cast<std::size_t>(topology.vertex_count);
  require(textures.layout.picture_of_polygon.size() ==
                  static_cast<std::size_t>(topology.face_count()) &&
              textures.maps.size() == textures.layout.pictures.size() &&
              texels_->size() == textures.layout.pictures.size() &&
              options_.vertex_areas.size() == vertices,
          "textures of another mesh");
  for (std::size_t p = 0; p < texels_->size(); ++p) {
    const SurfaceTexels& of_picture = (*texels_)[p];
    for (const auto& map : textures.maps[p]) {
      require(!map || (map->width == of_picture.width() && map->height == of_picture.height()),
              "a texture of another size than the layout's");
    }
    codings_.push_back(common_coding(textures.maps[p]));
  }
  statistics_ = find_statistics([&] {
    return surface_statistics(filter, *texels_, textures.maps, options_.statistics_scale);
  });

  region_area_fractions_ = region_area_fractions(regions, options_.vertex_areas);
}

VertexFactorsOfImage TextureBlender::vertex_factors_of_image(std::size_t picture,
                                                             const Recipe& recipe) const {
  const auto& maps = textures_.maps[picture];
  const FaceWeights weights = face_weights(recipe, maps, region_area_fractions_);
  VertexFactorsOfImage fields;
  fields.channels = static_cast<std::size_t>(codings_[picture].channels);
  for (std::size_t h = 0; h < weights.of_face.size(); ++h) {
    // Leave out heads whose weights are all zero. A head has a weight in each region, and a weight
    // in the target's colours (see shares_by_head), which are the colours of eyes and teeth.
    double most = options_.uses_target_colours_only.empty() ? 0.0 : weights.of_target[h];
    for (const HeadWeights& of_region : weights.of_region) most = std::max(most, of_region[h]);
    if (most > 0) fields.heads.push_back(h);
  }
  const std::vector<std::uint32_t>& vertices = (*texels_)[picture].vertices();
  const std::size_t width = fields.values_per_vertex();
  fields.resize(vertices.size());
  parallel_blocks(
      static_cast<Index>(vertices.size()), kVerticesPerBlock, [&](Index begin, Index end) {
        std::vector<double> detail_weights(fields.heads.size());
        for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
          const std::size_t vertex = vertices[i];
          const bool is_part = !options_.uses_target_colours_only.empty() &&
                               options_.uses_target_colours_only[vertex];
          for (std::size_t s = 0; s < detail_weights.size(); ++s) {
            const std::size_t head = fields.heads[s];
            detail_weights[s] = is_part ? weights.of_target[head] : 0.0;
            for (std::size_t k = 0; !is_part && k < weights.of_region.size(); ++k) {
              detail_weights[s] +=
                  regions_.alpha(static_cast<Index>(vertex), static_cast<Index>(k)) *
                  weights.of_region[k][head];
            }
          }
          // Symbols as in TextureBlender. A map stores D_h as D_h = low_h + step_h · stored.
          // Therefore the base value is Σ W_h C_h + g Σ v_h (low_h − C_h), and the factor of head h
          // is g v_h step_h.
          const double gain = gain_at(statistics_, vertex, fields.heads, detail_weights);
          const auto coarse = [&](std::size_t head) -> Eigen::Array3d {
            return statistics_.coarse_values[head]
                .row(static_cast<Index>(vertex))
                .array()
                .transpose()
                .cast<double>();
          };
          Eigen::Array3d base = Eigen::Array3d::Zero();
          float* out = fields.values.data() + i * width;
          for (std::size_t s = 0; s < detail_weights.size(); ++s) {
            const MapCoding& coding = maps[fields.heads[s]]->coding;
            base += gain * detail_weights[s] * (double{coding.low} - coarse(fields.heads[s]));
            out[fields.channels + s] =
                static_cast<float>(gain * detail_weights[s] * static_cast<double>(coding.step));
          }
          const HeadWeights& of_coarse = is_part ? weights.of_target : weights.of_face;
          for (std::size_t h = 0; h < of_coarse.size(); ++h) {
            if (of_coarse[h] > 0) base += of_coarse[h] * coarse(h);
          }
          for (std::size_t c = 0; c < fields.channels; ++c) {
            out[c] = static_cast<float>(base[static_cast<Index>(c)]);
          }
        }
      });
  return fields;
}

BlendedPicture TextureBlender::blend(const Recipe& recipe, std::size_t picture) const {
  const auto& maps = textures_.maps[picture];
  BlendedPicture blended = paint_picture((*texels_)[picture], codings_[picture], maps,
                                         vertex_factors_of_image(picture, recipe));
  const auto is_truncated = [](const auto& map) {
    return map && map->mapped_file && map->mapped_file->was_truncated();
  };
  if (std::ranges::any_of(maps, is_truncated)) {
    throw IoError(
        "a texture in the cache was truncated while it was in use; run the same command again");
  }
  return blended;
}

std::size_t TextureBlender::memory_bytes() const {
  std::size_t bytes = statistics_.covariances.size() * sizeof(float) +
                      options_.vertex_areas.size() * sizeof(double);
  for (const auto& colours : statistics_.coarse_values) {
    bytes += static_cast<std::size_t>(colours.size()) * sizeof(float);
  }
  return bytes;
}

std::size_t TextureBlender::blend_bytes() const {
  constexpr std::size_t kBytesPerTexel = 3, kBytesPerWord = 2;
  std::size_t most = 0;
  for (std::size_t p = 0; p < texels_->size(); ++p) {
    const SurfaceTexels& texels = (*texels_)[p];
    const bool is_colour = codings_[p].content == MapContent::kColours;
    const std::size_t bytes =
        kBytesPerTexel * (is_colour ? 1 : kBytesPerWord) *
            static_cast<std::size_t>(texels.width()) * static_cast<std::size_t>(texels.height()) +
        texels.vertices().size() * (3 + statistics_.coarse_values.size()) * sizeof(float);
    most = std::max(most, bytes);
  }
  return most;
}

}  // namespace crowdface
