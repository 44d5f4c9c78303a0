// SPDX-License-Identifier: Apache-2.0
#include "crowdface/texture/texture_blender.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <optional>
#include <span>
#include <utility>

#include "crowdface/core/parallel.h"
#include "crowdface/core/require.h"

namespace crowdface {

/// What a picture is computed from for one face, at the vertices that it shows: numbers to begin with, and
/// the factor of what each head has stored. Between vertices all of it runs straight.
struct TextureBlender::Fields {
  std::size_t channels = 3;
  std::vector<std::size_t> heads;  ///< those that lend anything, ascending
  std::vector<float> values;       ///< #vertices by #channels + #heads
  std::size_t width() const { return channels + heads.size(); }
};

namespace {

constexpr int kRowsPerBlock = 16;
constexpr Index kVerticesPerBlock = 1024;

using HeadWeights = std::vector<double>;  ///< #heads, summing to one or all zero

HeadWeights shares_by_head(const Recipe& recipe, std::size_t heads) {
  HeadWeights shares(heads, 0.0);
  for (const SourceWeight& share : target_shares(recipe)) {
    shares[static_cast<std::size_t>(share.head)] = share.weight;
  }
  return shares;
}

HeadWeights mean_of(const HeadWeights& a, const HeadWeights& b) {
  HeadWeights mean(a.size());
  for (std::size_t h = 0; h < mean.size(); ++h) mean[h] = 0.5 * (a[h] + b[h]);
  return mean;
}

/// Gives the weight of heads that have no map here to those that have one: of the first of these weights
/// that leaves any, in proportion; else all of them have the same.
HeadWeights among_painted(std::initializer_list<const HeadWeights*> choices,
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

/// What heads lend to one face in one picture.
struct FaceWeights {
  HeadWeights of_target;               ///< τ, where the target alone counts
  HeadWeights of_face;                 ///< W
  std::vector<HeadWeights> of_region;  ///< v where a region is alone
};

FaceWeights face_weights(const Recipe& recipe,
                         const std::vector<std::shared_ptr<const TextureMap>>& maps,
                         const std::vector<double>& region_shares) {
  const HeadWeights target = shares_by_head(recipe, maps.size());
  const std::vector<HeadWeights> regions = colour_weights(recipe, maps.size());
  HeadWeights mean(maps.size(), 0.0);
  for (std::size_t k = 0; k < regions.size(); ++k) {
    for (std::size_t h = 0; h < mean.size(); ++h) mean[h] += region_shares[k] * regions[k][h];
  }
  const HeadWeights face = mean_of(target, mean);
  FaceWeights weights{among_painted({&target, &face}, maps), among_painted({&face}, maps), {}};
  for (const HeadWeights& region : regions) {
    const HeadWeights mixed = mean_of(face, region);
    weights.of_region.push_back(among_painted({&mixed}, maps));
  }
  return weights;
}

/// The factor that gives the detail of a mean the strength of its heads' own.
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

/// Texels of a row while they are computed.
struct RowBuffer {
  RowBuffer(int width, std::size_t fields) : width_(static_cast<std::size_t>(width)) {
    values_.resize(width_ * fields);
  }
  float* of(std::size_t field) { return values_.data() + field * width_; }

 private:
  std::size_t width_;
  std::vector<float> values_;
};

/// Writes the fields of a row's covered texels.
void interpolate(const SurfaceTexels& texels, int y, const std::vector<float>& values,
                 std::size_t fields, RowBuffer& buffer) {
  const auto row = static_cast<float>(y);
  for (const SurfaceTexels::Span& span : texels.row(y)) {
    const SurfaceTexels::Triangle& triangle = texels.triangle(span.triangle);
    const float* first = values.data() + fields * triangle.corners[0];
    const float* second = values.data() + fields * triangle.corners[1];
    const float* third = values.data() + fields * triangle.corners[2];
    const auto begin = static_cast<float>(span.begin);
    const float b = triangle.second[0] + row * triangle.second[2] + begin * triangle.second[1];
    const float c = triangle.third[0] + row * triangle.third[2] + begin * triangle.third[1];
    const int count = span.end - span.begin;
    for (std::size_t f = 0; f < fields; ++f) {
      const float to_second = second[f] - first[f], to_third = third[f] - first[f];
      const float start = first[f] + b * to_second + c * to_third;
      const float step = triangle.second[1] * to_second + triangle.third[1] * to_third;
      float* out = buffer.of(f) + span.begin;
      for (int i = 0; i < count; ++i) out[i] = start + static_cast<float>(i) * step;
    }
  }
}

void add_products(const Density* densities, const float* factors, int begin, int end, float* sum) {
  for (int x = begin; x < end; ++x) sum[x] += factors[x] * static_cast<float>(densities[x]);
}

/// The mean of the covered texels is what all beyond the gutter have.
/// \param values  height · width · `channels`
template <class Value>
void fill_rest(const SurfaceTexels& texels, std::size_t channels, std::vector<Value>& values) {
  std::vector<std::uint64_t> sums(channels);
  for (int y = 0; y < texels.height(); ++y) {
    for (const SurfaceTexels::Span& span : texels.row(y)) {
      const std::size_t row =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(texels.width());
      for (std::size_t i = row + span.begin; i < row + span.end; ++i) {
        for (std::size_t c = 0; c < channels; ++c) sums[c] += values[channels * i + c];
      }
    }
  }
  const std::uint64_t count = std::max<std::size_t>(1, texels.covered());
  std::vector<Value> fill;
  for (const std::uint64_t sum : sums) fill.push_back(static_cast<Value>(sum / count));
  for (int y = 0; y < texels.height(); ++y) {
    std::size_t x = static_cast<std::size_t>(y) * static_cast<std::size_t>(texels.width());
    const std::size_t row = x, end = x + static_cast<std::size_t>(texels.width());
    const auto fill_to = [&](std::size_t stop) {
      for (; x < stop; ++x) std::ranges::copy(fill, values.data() + channels * x);
    };
    for (const SurfaceTexels::Span& span : texels.row(y)) {
      fill_to(row + span.begin);
      x = row + span.end;
    }
    fill_to(end);
  }
  for (const SurfaceTexels::Gutter& texel : texels.gutter()) {
    for (std::size_t c = 0; c < channels; ++c) {
      values[channels * std::size_t{texel.to} + c] = values[channels * std::size_t{texel.from} + c];
    }
  }
}

std::uint16_t word_of(float share) {
  return static_cast<std::uint16_t>(std::clamp(65535 * share + 0.5F, 0.0F, 65535.0F));
}

/// A row's colours. \param sum  the densities of a channel, a texel each.
void write_colours(std::span<const SurfaceTexels::Span> spans, RowBuffer& sums, std::uint8_t* out) {
  const std::vector<std::uint8_t>& srgb8 = srgb8_of_densities();
  for (const SurfaceTexels::Span& span : spans) {
    for (std::size_t c = 0; c < 3; ++c) {
      const float* sum = sums.of(c);
      for (std::size_t x = span.begin; x < span.end; ++x) {
        const float density = std::clamp(sum[x] + 0.5F, 0.0F, kMostDensity);
        out[3 * x + c] = srgb8[static_cast<std::size_t>(static_cast<int>(density))];
      }
    }
  }
}

/// Slopes become unit normals.
void write_normals(std::span<const SurfaceTexels::Span> spans, RowBuffer& sums,
                   std::uint16_t* out) {
  for (const SurfaceTexels::Span& span : spans) {
    for (std::size_t x = span.begin; x < span.end; ++x) {
      const Eigen::Vector3f normal = Eigen::Vector3f(sums.of(0)[x], sums.of(1)[x], 1).normalized();
      for (Index c = 0; c < 3; ++c) {
        out[3 * x + static_cast<std::size_t>(c)] = word_of((normal[c] + 1) / 2);
      }
    }
  }
}

void write_values(std::span<const SurfaceTexels::Span> spans, RowBuffer& sums,
                  const BlendedPicture& picture, std::uint16_t* out) {
  const auto channels = static_cast<std::size_t>(picture.channels);
  for (const SurfaceTexels::Span& span : spans) {
    for (std::size_t c = 0; c < channels; ++c) {
      const float* sum = sums.of(c);
      for (std::size_t x = span.begin; x < span.end; ++x) {
        out[channels * x + c] = word_of((sum[x] - picture.low) / (65535 * picture.step));
      }
    }
  }
}

/// What all maps of a picture have in common, and the numbers that a blend of them can have: an overshoot
/// of detail beyond those of all heads is cut.
MapCoding common_coding(const std::vector<std::shared_ptr<const TextureMap>>& maps) {
  std::optional<MapCoding> common;
  float high = 0;
  for (const auto& map : maps) {
    if (!map) continue;
    const float top = map->number(65535);
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
  if (common->content == MapContent::kValues) common->step = (high - common->low) / 65535;
  return *common;
}

}  // namespace

std::vector<std::vector<double>> colour_weights(const Recipe& recipe, std::size_t heads) {
  const std::vector<double> of_target = shares_by_head(recipe, heads);
  std::vector<std::vector<double>> weights;
  for (const RegionRecipe& region : recipe.regions) {
    // Colour is the skin's, so it goes with the finest band.
    const BandRecipe& finest = band_of(region, band_count(region) - 1);
    std::vector<double> of_region(heads, 0.0);
    double sum = 0;
    for (const SourceWeight& source : finest.weights) {
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

TextureBlender::TextureBlender(const Topology& topology, const TextureCoordinates& uvs,
                               const Adjacency& adjacency, const RegionWeights& regions,
                               const CrowdTextures& textures, TextureBlending options)
    : regions_(regions), textures_(textures), options_(std::move(options)) {
  const auto vertices = static_cast<std::size_t>(topology.vertex_count);
  require(textures.layout.of_face.size() == static_cast<std::size_t>(topology.face_count()) &&
              textures.maps.size() == textures.layout.pictures.size() &&
              options_.areas.size() == vertices,
          "textures of another mesh");
  for (std::uint32_t p = 0; p < textures.layout.pictures.size(); ++p) {
    texels_.emplace_back(topology, uvs, textures.layout, p);
    for (const auto& map : textures.maps[p]) {
      require(!map || (map->width == texels_[p].width() && map->height == texels_[p].height()),
              "a texture of another size than the layout's");
    }
    codings_.push_back(common_coding(textures.maps[p]));
  }
  statistics_ = surface_statistics(adjacency, texels_, textures.maps, options_.scale);

  region_shares_.assign(static_cast<std::size_t>(regions.alpha.cols()), 0.0);
  double total = 0;
  for (std::size_t v = 0; v < vertices; ++v) {
    total += options_.areas[v];
    for (std::size_t k = 0; k < region_shares_.size(); ++k) {
      region_shares_[k] +=
          options_.areas[v] * regions.alpha(static_cast<Index>(v), static_cast<Index>(k));
    }
  }
  require(total > 0, "a face of no area");
  for (double& share : region_shares_) share /= total;
}

TextureBlender::Fields TextureBlender::fields(std::size_t picture, const Recipe& recipe) const {
  const auto& maps = textures_.maps[picture];
  const FaceWeights weights = face_weights(recipe, maps, region_shares_);
  Fields fields;
  fields.channels = static_cast<std::size_t>(codings_[picture].channels);
  for (std::size_t h = 0; h < weights.of_face.size(); ++h) {
    double most = options_.of_target.empty() ? 0.0 : weights.of_target[h];
    for (const HeadWeights& of_region : weights.of_region) most = std::max(most, of_region[h]);
    if (most > 0) fields.heads.push_back(h);
  }
  const std::vector<std::uint32_t>& vertices = texels_[picture].vertices();
  const std::size_t width = fields.width();
  fields.values.resize(vertices.size() * width);
  parallel_blocks(
      static_cast<Index>(vertices.size()), kVerticesPerBlock, [&](Index begin, Index end) {
        std::vector<double> lent(fields.heads.size());
        for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
          const std::size_t vertex = vertices[i];
          const bool is_part = !options_.of_target.empty() && options_.of_target[vertex];
          for (std::size_t s = 0; s < lent.size(); ++s) {
            const std::size_t head = fields.heads[s];
            lent[s] = is_part ? weights.of_target[head] : 0.0;
            for (std::size_t k = 0; !is_part && k < weights.of_region.size(); ++k) {
              lent[s] += regions_.alpha(static_cast<Index>(vertex), static_cast<Index>(k)) *
                         weights.of_region[k][head];
            }
          }
          const double gain = gain_at(statistics_, vertex, fields.heads, lent);
          const auto coarse = [&](std::size_t head) -> Eigen::Array3d {
            return statistics_.coarse[head]
                .row(static_cast<Index>(vertex))
                .array()
                .transpose()
                .cast<double>();
          };
          Eigen::Array3d base = Eigen::Array3d::Zero();
          float* out = fields.values.data() + i * width;
          for (std::size_t s = 0; s < lent.size(); ++s) {
            const MapCoding& coding = maps[fields.heads[s]]->coding;
            base += gain * lent[s] * (double{coding.low} - coarse(fields.heads[s]));
            out[fields.channels + s] =
                static_cast<float>(gain * lent[s] * static_cast<double>(coding.step));
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

BlendedPicture TextureBlender::paint(std::size_t picture, const Fields& fields) const {
  const SurfaceTexels& texels = texels_[picture];
  const MapCoding& coding = codings_[picture];
  BlendedPicture result{texels.width(), texels.height(), {}};
  const auto width = static_cast<std::size_t>(texels.width());
  const std::size_t count = width * static_cast<std::size_t>(texels.height());
  if (coding.content == MapContent::kColours) {
    result.srgb.resize(3 * count);
  } else {
    if (coding.content == MapContent::kValues) {
      result.channels = coding.channels;
      result.low = coding.low;
      result.step = coding.step;
    }
    result.words.resize(static_cast<std::size_t>(result.channels) * count);
  }
  const auto channels = static_cast<std::size_t>(result.channels);
  parallel_blocks(texels.height(), kRowsPerBlock, [&](int begin, int end) {
    RowBuffer buffer(texels.width(), fields.width());
    for (int y = begin; y < end; ++y) {
      const auto spans = texels.row(y);
      if (spans.empty()) continue;
      interpolate(texels, y, fields.values, fields.width(), buffer);
      const int first = spans.front().begin, last = spans.back().end;
      for (std::size_t s = 0; s < fields.heads.size(); ++s) {
        const TextureMap& map = *textures_.maps[picture][fields.heads[s]];
        for (std::size_t c = 0; c < fields.channels; ++c) {
          add_products(map.row(static_cast<int>(c), y), buffer.of(fields.channels + s), first, last,
                       buffer.of(c));
        }
      }
      const std::size_t row = channels * width * static_cast<std::size_t>(y);
      if (coding.content == MapContent::kColours) {
        write_colours(spans, buffer, result.srgb.data() + row);
      } else if (coding.content == MapContent::kSlopes) {
        write_normals(spans, buffer, result.words.data() + row);
      } else {
        write_values(spans, buffer, result, result.words.data() + row);
      }
    }
  });
  if (result.words.empty()) {
    fill_rest(texels, channels, result.srgb);
  } else {
    fill_rest(texels, channels, result.words);
  }
  return result;
}

std::vector<BlendedPicture> TextureBlender::blend(const Recipe& recipe) const {
  std::vector<BlendedPicture> pictures;
  for (std::size_t p = 0; p < texels_.size(); ++p) {
    pictures.push_back(paint(p, fields(p, recipe)));
  }
  return pictures;
}

std::size_t TextureBlender::memory_bytes() const {
  std::size_t bytes =
      statistics_.covariances.size() * sizeof(float) + options_.areas.size() * sizeof(double);
  for (const auto& colours : statistics_.coarse) {
    bytes += static_cast<std::size_t>(colours.size()) * sizeof(float);
  }
  for (const SurfaceTexels& texels : texels_) bytes += texels.memory_bytes();
  return bytes;
}

std::size_t TextureBlender::blend_bytes() const {
  constexpr std::size_t kBytesATexel = 3, kBytesAWord = 2;
  std::size_t bytes = 0, most_vertices = 0;
  for (std::size_t p = 0; p < texels_.size(); ++p) {
    const SurfaceTexels& texels = texels_[p];
    const bool is_colour = codings_[p].content == MapContent::kColours;
    bytes += kBytesATexel * (is_colour ? 1 : kBytesAWord) *
             static_cast<std::size_t>(texels.width()) * static_cast<std::size_t>(texels.height());
    most_vertices = std::max(most_vertices, texels.vertices().size());
  }
  return bytes + most_vertices * (3 + statistics_.coarse.size()) * sizeof(float);
}

}  // namespace crowdface
