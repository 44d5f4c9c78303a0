// SPDX-License-Identifier: Apache-2.0
#include "crowdface/region/mask_painting.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "crowdface/core/error.h"
#include "crowdface/core/interrupt.h"
#include "crowdface/core/require.h"
#include "crowdface/core/text.h"
#include "crowdface/io/image.h"
#include "crowdface/io/tile_files.h"
#include "crowdface/region/uv_samples.h"

namespace crowdface {
namespace {

using Eigen::Vector2d;

constexpr int kBleed = 6;       // width in texels of the paint beyond a chart's border
constexpr int kMaxRounds = 60;  // largest number of correction rounds
/// Corrections stop when no sampled weight has a larger error than this: a fifth of an 8-bit step.
constexpr double kMaxSampleError = 0.2 / 255;

double cross(const Vector2d& a, const Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// The four texels from which sample_bilinear interpolates, and the weights of these texels.
struct BilinearSample {
  std::array<std::size_t, 4> at;
  std::array<double, 4> share;
};

/// The region weights of all texels of one tile.
class Canvas {
 public:
  Canvas(int size, Index regions)
      : size_(size),
        regions_(static_cast<std::size_t>(regions)),
        painted_(count(), 0),
        value_(count() * regions_, 0) {}

  /// Paints those texels of a triangle that are not painted yet.
  /// \param at  the corners of the triangle, in texels.
  void paint(const std::array<Vector2d, 3>& at, const std::array<const double*, 3>& weights) {
    const Vector2d low = at[0].cwiseMin(at[1]).cwiseMin(at[2]);
    const Vector2d high = at[0].cwiseMax(at[1]).cwiseMax(at[2]);
    const double area = cross(at[1] - at[0], at[2] - at[0]);
    if (area == 0) return;
    for (int y = texel(low.y()); y <= std::min(size_ - 1, texel(high.y()) + 1); ++y) {
      for (int x = texel(low.x()); x <= std::min(size_ - 1, texel(high.x()) + 1); ++x) {
        const Vector2d p(x + 0.5, y + 0.5);
        const double b = cross(p - at[0], at[2] - at[0]) / area;
        const double c = cross(at[1] - at[0], p - at[0]) / area;
        const std::size_t i = index(x, y);
        if (b < -1e-9 || c < -1e-9 || b + c > 1 + 1e-9 || painted_[i] != 0) continue;
        painted_[i] = 1;
        for (std::size_t k = 0; k < regions_; ++k) {
          value(i)[k] = static_cast<float>((1 - b - c) * weights[0][k] + b * weights[1][k] +
                                           c * weights[2][k]);
        }
      }
    }
  }

  /// Extends the painted area by one texel: each unpainted texel beside the area gets the mean of
  /// its painted neighbours.
  void bleed() {
    const std::vector<std::uint8_t> before = painted_;
    for (int y = 0; y < size_; ++y) {
      for (int x = 0; x < size_; ++x) {
        const std::size_t to = index(x, y);
        if (before[to] != 0) continue;
        int neighbours = 0;
        for (int j = std::max(0, y - 1); j <= std::min(size_ - 1, y + 1); ++j) {
          for (int i = std::max(0, x - 1); i <= std::min(size_ - 1, x + 1); ++i) {
            if (before[index(i, j)] == 0) continue;
            for (std::size_t k = 0; k < regions_; ++k) value(to)[k] += value(index(i, j))[k];
            ++neighbours;
          }
        }
        if (neighbours == 0) continue;
        painted_[to] = 1;
        for (std::size_t k = 0; k < regions_; ++k) value(to)[k] /= static_cast<float>(neighbours);
      }
    }
  }

  /// Adjusts texels iteratively until the samples match the given weights. Each round distributes
  /// the error of every sample over the four texels of the sample.
  /// \param places   the texels of each sample.
  /// \param weights  the region weights that each sample should have.
  void match_samples(const std::vector<BilinearSample>& places,
                     const std::vector<const double*>& weights) {
    std::vector<float> sum(value_.size()), share(count());
    for (const BilinearSample& place : places) {
      for (std::size_t c = 0; c < 4; ++c) share[place.at[c]] += static_cast<float>(place.share[c]);
    }
    for (int round = 0; round < kMaxRounds; ++round) {
      throw_if_interrupted();
      std::ranges::fill(sum, 0.0F);
      double worst = 0;
      for (std::size_t p = 0; p < places.size(); ++p) {
        for (std::size_t k = 0; k < regions_; ++k) {
          double off = weights[p][k];
          for (std::size_t c = 0; c < 4; ++c) {
            off -= places[p].share[c] * double{value(places[p].at[c])[k]};
          }
          worst = std::max(worst, std::abs(off));
          for (std::size_t c = 0; c < 4; ++c) {
            sum[places[p].at[c] * regions_ + k] += static_cast<float>(places[p].share[c] * off);
          }
        }
      }
      if (worst < kMaxSampleError) return;
      for (std::size_t i = 0; i < count(); ++i) {
        if (share[i] <= 0) continue;
        for (std::size_t k = 0; k < regions_; ++k) {
          value(i)[k] = std::clamp(value(i)[k] + sum[i * regions_ + k] / share[i], 0.0F, 1.0F);
        }
      }
    }
  }

  /// \param u, v  texture coordinates relative to the tile.
  BilinearSample bilinear_sample(double u, double v) const {
    const double x = std::clamp(u * size_ - 0.5, 0.0, size_ - 1.0);
    const double y = std::clamp((1 - v) * size_ - 0.5, 0.0, size_ - 1.0);
    const int left = static_cast<int>(x), top = static_cast<int>(y);
    const int right = std::min(left + 1, size_ - 1), bottom = std::min(top + 1, size_ - 1);
    const double s = x - left, t = y - top;
    return {{index(left, top), index(right, top), index(left, bottom), index(right, bottom)},
            {(1 - s) * (1 - t), s * (1 - t), (1 - s) * t, s * t}};
  }

  /// Converts weights to bytes. The largest byte of a texel is adjusted, so that the bytes of the
  /// texel add up to 255.
  std::vector<std::vector<std::uint8_t>> images() const {
    const std::size_t images = (regions_ + kRegionsPerImage - 1) / kRegionsPerImage;
    std::vector<std::vector<std::uint8_t>> out(
        images, std::vector<std::uint8_t>(kRegionsPerImage * count(), 0));
    std::vector<int> bytes(regions_);
    for (std::size_t i = 0; i < count(); ++i) {
      if (painted_[i] == 0) continue;
      double whole = 0;
      for (std::size_t k = 0; k < regions_; ++k) whole += double{value_[i * regions_ + k]};
      int rest = 255;
      for (std::size_t k = 0; k < regions_; ++k) {
        const double part = whole > 0 ? double{value_[i * regions_ + k]} / whole : 0;
        bytes[k] = static_cast<int>(std::floor(255 * part + 0.5));
        rest -= bytes[k];
      }
      *std::ranges::max_element(bytes) += rest;
      for (std::size_t k = 0; k < regions_; ++k) {
        out[k / kRegionsPerImage][kRegionsPerImage * i + k % kRegionsPerImage] =
            static_cast<std::uint8_t>(bytes[k]);
      }
    }
    return out;
  }

 private:
  static int texel(double x) { return std::max(0, static_cast<int>(std::floor(x - 0.5))); }
  std::size_t count() const {
    return static_cast<std::size_t>(size_) * static_cast<std::size_t>(size_);
  }
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(size_) +
           static_cast<std::size_t>(x);
  }
  float* value(std::size_t i) { return value_.data() + i * regions_; }

  int size_;
  std::size_t regions_;
  std::vector<std::uint8_t> painted_;
  std::vector<float> value_;
};

/// For each UDIM tile, the polygons that have a corner in the tile.
std::map<int, std::vector<Index>> polygons_by_tile(const Topology& topology,
                                                   const TextureCoordinates& uvs,
                                                   const std::string& mesh_name) {
  std::map<int, std::vector<Index>> tiles;
  for (Index f = 0; f < topology.face_count(); ++f) {
    const auto corners = topology.face_uvs(f);
    Vector2d middle = Vector2d::Zero();
    for (const std::uint32_t uv : corners) {
      if (uv == kNoIndex) {
        throw InvalidInput(concat(mesh_name, ": face ", f + 1, " has no texture coordinates"));
      }
      middle += uvs.row(uv).transpose() / static_cast<double>(corners.size());
    }
    std::set<int> of_face;
    for (const std::uint32_t uv : corners) {
      of_face.insert(
          tile_number(tile_index(uvs(uv, 0), middle.x()), tile_index(uvs(uv, 1), middle.y())));
    }
    for (const int tile : of_face) tiles[tile].push_back(f);
  }
  return tiles;
}

}  // namespace

bool PaintedMasks::is_tiled() const {
  return images_by_tile.size() > 1 ||
         (!images_by_tile.empty() && images_by_tile.begin()->first != kFirstTile);
}

PaintedMasks paint_masks(const Topology& topology, const TextureCoordinates& uvs,
                         const RegionWeights::Alpha& alpha, const std::vector<bool>& has_priority,
                         int size, const std::string& mesh_name) {
  require(size >= 1 && alpha.rows() == topology.vertex_count && alpha.cols() >= 1, "a mask of ",
          size, " texels for ", alpha.rows(), " vertices");
  if (topology.corner_uvs.empty()) {
    throw InvalidInput(
        concat(mesh_name, ": expected texture coordinates, which masks need, found none"));
  }
  const auto vertex_has_priority = [&](std::uint32_t v) {
    return has_priority.empty() || has_priority[v];
  };
  const UvSamples samples = gather_uv_samples(topology, uvs, UvTiling::kUdim, {}, mesh_name);
  PaintedMasks out;
  out.texels_per_side = size;
  for (const auto& [tile, faces] : polygons_by_tile(topology, uvs, mesh_name)) {
    throw_if_interrupted();
    Canvas canvas(size, alpha.cols());
    const int column = (tile - kFirstTile) % 10, row = (tile - kFirstTile) / 10;
    // First paint the polygons whose first corner has priority (`has_priority`), then the other
    // polygons. A later polygon does not paint over an earlier one.
    for (const bool is_first_pass : {true, false}) {
      for (const Index f : faces) {
        const auto corners = topology.face(f), face_uvs = topology.face_uvs(f);
        if (vertex_has_priority(corners[0]) != is_first_pass) continue;
        throw_if_interrupted();
        const auto at = [&](std::size_t c) -> Vector2d {
          return size * Vector2d(uvs(face_uvs[c], 0) - column, 1 - (uvs(face_uvs[c], 1) - row));
        };
        const auto weights = [&](std::size_t c) { return alpha.row(corners[c]).data(); };
        for (std::size_t c = 2; c < corners.size(); ++c) {
          canvas.paint({at(0), at(c - 1), at(c)}, {weights(0), weights(c - 1), weights(c)});
        }
      }
    }
    for (int i = 0; i < kBleed; ++i) {
      throw_if_interrupted();
      canvas.bleed();
    }
    // Take each vertex that has priority over other vertices and has texture coordinates in this
    // tile. A sample of the image at these coordinates interpolates four texels
    // (`bilinear_samples`). The result should equal the weights of the vertex (`weights`).
    std::vector<BilinearSample> bilinear_samples;
    std::vector<const double*> weights;
    for (std::uint32_t v = 0; v < static_cast<std::uint32_t>(topology.vertex_count); ++v) {
      if (!vertex_has_priority(v)) continue;
      for (const UvSample& sample : samples.items_of(v)) {
        if (sample.tile != tile) continue;
        bilinear_samples.push_back(canvas.bilinear_sample(sample.u - column, sample.v - row));
        weights.push_back(alpha.row(v).data());
      }
    }
    canvas.match_samples(bilinear_samples, weights);
    out.images_by_tile[tile] = canvas.images();
  }
  return out;
}

MaskFiles encode_masks(const PaintedMasks& masks, const std::filesystem::path& path) {
  MaskFiles out;
  for (std::size_t i = 0; i < masks.image_count(); ++i) {
    std::string stem = path.stem().string();
    const std::string number = i == 0 ? std::string() : concat('_', i + 1);
    const std::size_t tile = stem.find(concat('.', kTileWord));
    stem.insert(std::min(tile, stem.size()), number);
    if (masks.is_tiled() && stem.find(kTileWord) == std::string::npos)
      stem += concat('.', kTileWord);
    const auto mask = path.parent_path() / (stem + path.extension().string());
    out.mask_paths.push_back(mask);
    for (const auto& [number_of_tile, images] : masks.images_by_tile) {
      out.png_files.emplace_back(
          udim_tile_path(mask, number_of_tile),
          encode_png(masks.texels_per_side, masks.texels_per_side, kRegionsPerImage, images[i]));
    }
  }
  return out;
}

}  // namespace crowdface
