// SPDX-License-Identifier: Apache-2.0
#include "crowdface/blend/crowd_blender.h"

#include <algorithm>
#include <array>
#include <map>

#include "crowdface/blend/crowd_product_kernels.h"
#include "crowdface/blend/recipe_check.h"
#include "crowdface/blend/single_face_sums.h"
#include "crowdface/core/memory.h"
#include "crowdface/core/parallel.h"
#include "crowdface/core/require.h"

namespace crowdface {
namespace {

constexpr Index kBlocksATask = 8;

bool blends_alike(const BandRecipe& a, const BandRecipe& b) {
  return a.weights == b.weights && a.iterations == b.iterations &&
         a.extrapolation == b.extrapolation;
}

/// Whether two regions add the same to a face of the same target.
bool blends_alike(const RegionRecipe& a, const RegionRecipe& b) {
  if (band_count(a) != band_count(b)) return false;
  for (std::size_t i = 0; i < band_count(a); ++i) {
    if (!blends_alike(band_of(a, i), band_of(b, i))) return false;
  }
  return true;
}

}  // namespace

CrowdBlender::CrowdBlender(const FaceSet& faces, std::vector<HeadLevels> levels,
                           const RegionWeights& regions)
    : faces_(faces), levels_(std::move(levels)), regions_(regions) {
  const Index vertices = faces.topology.vertex_count;
  require(levels_.size() == faces.heads.size(), "blend: fitted levels of ", levels_.size(),
          " heads for ", faces.heads.size());
  first_field_.push_back(0);
  for (const HeadLevels& head : levels_) {
    const LevelFields& fields = head.fields;
    const std::size_t tiles = LevelFields::tile_count(static_cast<std::size_t>(vertices));
    require(fields.vertex_count == vertices && fields.first.size() == tiles + 1 &&
                fields.steps.size() == fields.first.back() &&
                fields.numbers.size() == fields.steps.size() * kTileValues,
            "blend: ", fields.numbers.size(), " numbers of ", fields.steps.size(), " fields of ",
            tiles, " tiles of ", vertices, " vertices");
    first_field_.push_back(first_field_.back() + static_cast<std::size_t>(fields.rank));
  }
  require(regions.alpha.rows() == vertices, "blend: masks of ", regions.alpha.rows(),
          " vertices for ", vertices);
  cut_into_blocks();
}

void CrowdBlender::cut_into_blocks() {
  std::map<std::vector<std::uint32_t>, std::vector<std::uint32_t>> by_regions;
  std::vector<std::uint32_t> active;
  for (Index v = 0; v < regions_.alpha.rows(); ++v) {
    active.clear();
    for (Index k = 0; k < regions_.alpha.cols(); ++k) {
      if (regions_.alpha(v, k) != 0) active.push_back(static_cast<std::uint32_t>(k));
    }
    by_regions[active].push_back(static_cast<std::uint32_t>(v));
  }
  for (const auto& [regions, vertices] : by_regions) {
    for (std::size_t begin = 0; begin < vertices.size(); begin += kBlockVertices) {
      Block block{{}, std::min(kBlockVertices, vertices.size() - begin), regions};
      for (std::size_t i = begin; i < begin + block.count; ++i) {
        if (block.runs.empty() || vertices[i] % kFieldTile == 0 ||
            vertices[i] != block.runs.back().first + block.runs.back().count) {
          block.runs.push_back({vertices[i], 0});
        }
        ++block.runs.back().count;
      }
      blocks_.push_back(std::move(block));
    }
  }
}

std::vector<float> CrowdBlender::coefficients(const Recipe& recipe, std::size_t region) const {
  std::vector<double> sums(field_count(), 0.0);
  for (const LevelShares& at : level_shares(recipe, region)) {
    // Where a head is both target and source, or lends to two bands alike, the shares are added
    // first, so that the target blended with itself leaves no trace.
    std::vector<double> shares(levels_.size(), 0.0);
    for (const SourceWeight& part : at.shares) {
      shares[static_cast<std::size_t>(part.head)] += part.weight;
    }
    for (std::size_t h = 0; h < shares.size(); ++h) {
      if (shares[h] == 0) continue;
      std::size_t f = first_field_[h];
      for (const double function : levels_[h].functions(at.level)) {
        sums[f++] += shares[h] * function;  // Eq. 5
      }
    }
  }
  return {sums.begin(), sums.end()};
}

CrowdBlender::Factors CrowdBlender::factors(std::span<const Recipe* const> recipes,
                                            std::size_t region) const {
  std::vector<std::vector<float>> of_face;
  of_face.reserve(recipes.size());
  for (const Recipe* recipe : recipes) of_face.push_back(coefficients(*recipe, region));
  Factors factors;
  for (std::size_t f = 0; f < field_count(); ++f) {
    const bool used =
        std::any_of(of_face.begin(), of_face.end(), [&](const auto& face) { return face[f] != 0; });
    if (used) factors.fields.push_back(static_cast<std::uint32_t>(f));
    for (std::size_t face = 0; face < kChunkFaces; ++face) {
      factors.coefficients.push_back(face < of_face.size() ? of_face[face][f] : 0.0F);
    }
  }
  return factors;
}

/// Brings the next block's numbers into a core's cache, a few lines at a time, while the product keeps the core
/// busy and memory waits.
class CrowdBlender::FieldsAhead {
 public:
  /// \param times  how often `fetch_some` will be called
  void aim(const CrowdBlender& blender, const Block& block, std::size_t times) {
    pieces_.clear();
    std::size_t lines = 0;
    for (const HeadLevels& head : blender.levels_) {
      for (const VertexRun& run : block.runs) {
        const TileFields tile = head.fields.at(run.first);
        if (tile.count == 0 || run.count < kFieldTile)
          continue;  // of a part of a tile most is not needed
        pieces_.push_back({tile.numbers, tile.count * kTileLines});
        lines += tile.count * kTileLines;
      }
    }
    a_time_ = times == 0 ? 0 : (lines + times - 1) / times;
    piece_ = line_ = 0;
  }
  void fetch_some() {
    for (std::size_t left = a_time_; left > 0 && piece_ < pieces_.size(); --left) {
      const Piece& piece = pieces_[piece_];
      __builtin_prefetch(piece.first + line_ * kLineNumbers, 0, 2);
      if (++line_ < piece.lines) continue;
      line_ = 0;
      ++piece_;
    }
  }

 private:
  static constexpr std::size_t kLineNumbers = 64 / sizeof(std::int16_t);
  static constexpr std::size_t kTileLines = kTileValues / kLineNumbers;
  struct Piece {
    const std::int16_t* first;
    std::size_t lines;
  };
  std::vector<Piece> pieces_;
  std::size_t a_time_ = 0, piece_ = 0, line_ = 0;
};

/// Of all heads' fields, those that any vertex of the block has.
std::vector<std::uint8_t> CrowdBlender::fields_at(const Block& block) const {
  std::vector<std::uint8_t> present(field_count(), 0);
  for (std::size_t h = 0; h < levels_.size(); ++h) {
    for (const VertexRun& run : block.runs) {
      const auto first = present.begin() + static_cast<std::ptrdiff_t>(first_field_[h]);
      std::fill_n(first, levels_[h].fields.at(run.first).count, std::uint8_t{1});
    }
  }
  return present;
}

/// The block's values of the fields that are wanted: #chunks by #fields and one row for what `unpack` writes too
/// much; what is past its last vertex, or of another field, is any number.
void CrowdBlender::pack(const Block& block, const std::vector<std::uint8_t>& wanted,
                        std::vector<Chunk>& packed) const {
  static constexpr std::array<std::int16_t, kTileValues> kZeros{};
  packed.resize(kBlockChunks * packed_rows());
  for (std::size_t h = 0; h < levels_.size(); ++h) {
    for (std::size_t field = first_field_[h]; field < first_field_[h + 1]; ++field) {
      if (!wanted[field]) continue;
      std::size_t to = 0;
      for (const VertexRun& run : block.runs) {
        const std::size_t count = std::size_t{3} * run.count;
        const TileFields tile = levels_[h].fields.at(run.first);
        const std::size_t p = field - first_field_[h];
        const bool there = p < tile.count;
        unpack(
            there ? tile.numbers + p * kTileValues + 3 * (run.first % kFieldTile) : kZeros.data(),
            count, there ? tile.steps[p] : 0, to % kChunkValues,
            packed[to / kChunkValues * packed_rows() + field].values, packed_rows() * kChunkValues);
        to += count;
      }
    }
  }
}

/// α of the block's regions for each value: #regions by #values, zero past the last.
void CrowdBlender::spread_alpha(const Block& block, std::vector<BlockValues>& alpha) const {
  alpha.assign(block.regions.size(), BlockValues{});
  for (std::size_t k = 0; k < block.regions.size(); ++k) {
    auto to = alpha[k].begin();
    for (const VertexRun& run : block.runs) {
      for (std::uint32_t v = run.first; v < run.first + run.count; ++v, to += 3) {
        std::fill_n(to, 3, static_cast<float>(regions_.alpha(v, block.regions[k])));
      }
    }
  }
}

/// What a group of faces adds to the target at the block's vertices: Σ_k α_k times the product.
void CrowdBlender::displacements(const Block& block, const std::vector<Chunk>& packed,
                                 const std::vector<BlockValues>& alpha,
                                 const std::vector<std::uint8_t>& wanted,
                                 std::span<const Factors> of_region, FieldsAhead& ahead,
                                 std::array<BlockValues, kChunkFaces>& result) const {
  for (auto& face : result) face.fill(0);
  std::vector<std::uint32_t> fields;
  for (std::size_t k = 0; k < block.regions.size(); ++k) {
    const Factors& factors = of_region[block.regions[k]];
    fields.resize(factors.fields.size());
    std::size_t count = 0;
    for (const std::uint32_t field : factors.fields) {
      fields[count] = field;
      count += wanted[field];
    }
    if (count == 0) continue;
    for (std::size_t i = 0; i < 3 * block.count; i += kChunkValues) {
      ahead.fetch_some();
      add_product(packed[i / kChunkValues * packed_rows()].values, fields.data(), count,
                  factors.coefficients.data(), alpha[k].data() + i, result[0].data() + i,
                  kBlockValues);
    }
  }
}

/// The face at the block's vertices: the target's positions and what is added to them.
void CrowdBlender::write(const Block& block, const Recipe& recipe, const BlockValues& added,
                         Positions& result) const {
  const auto head = [&](Index h) {
    return faces_.heads[static_cast<std::size_t>(h)].positions.data();
  };
  const float* more = added.data();
  std::array<double, kBlockValues> mixed;
  for (const VertexRun& run : block.runs) {
    const std::size_t at = std::size_t{3} * run.first, count = std::size_t{3} * run.count;
    const double* base = head(recipe.target) + at;
    if (!recipe.mixture.empty()) {
      std::fill_n(mixed.begin(), count, 0.0);
      for (const SourceWeight& part : recipe.mixture) {
        const double* from = head(part.head) + at;
        for (std::size_t i = 0; i < count; ++i) mixed[i] += part.weight * from[i];
      }
      base = mixed.data();
    }
    write_sums(base, more, count, result.data() + at);
    more += count;
  }
}

void CrowdBlender::prepare(const Recipe& recipe, Positions& result) const {
  require_fit(faces_, regions_, recipe);
  if (result.rows() == faces_.topology.vertex_count) return;
  result.resize(faces_.topology.vertex_count, 3);
  lay_pages(result.data(), static_cast<std::size_t>(result.size()) * sizeof(double));
}

template <class Wanted>
void CrowdBlender::blend_one(const Recipe& recipe, const Wanted& wanted, Positions& result) const {
  prepare(recipe, result);
  WeightedFields fields{{}, first_field_, {}};
  for (const HeadLevels& head : levels_) fields.heads.push_back(&head.fields);
  for (std::size_t k = 0; k < recipe.regions.size(); ++k) {
    fields.coefficients.push_back(coefficients(recipe, k));
  }
  parallel_blocks(static_cast<Index>(blocks_.size()), kBlocksATask, [&](Index begin, Index end) {
    SingleFaceSums sums(fields);
    std::vector<BlockValues> alpha;
    std::vector<const float*> alpha_at;
    BlockValues added;
    for (Index b = begin; b < end; ++b) {
      const Block& block = blocks_[static_cast<std::size_t>(b)];
      if (!wanted(block)) continue;
      spread_alpha(block, alpha);
      sums.start(block.regions);
      std::size_t to = 0;
      for (std::size_t r = 0; r < block.runs.size(); ++r) {
        alpha_at.clear();
        for (const BlockValues& of_region : alpha) alpha_at.push_back(of_region.data() + to);
        const bool last = r + 1 == block.runs.size();
        const VertexRun& next = !last         ? block.runs[r + 1]
                                : b + 1 < end ? blocks_[static_cast<std::size_t>(b) + 1].runs[0]
                                              : block.runs[r];
        sums.add_up(block.runs[r], next, alpha_at, added.data() + to);
        to += std::size_t{3} * block.runs[r].count;
      }
      write(block, recipe, added, result);
    }
    finish_writing();
  });
}

void CrowdBlender::blend(std::span<const Recipe* const> recipes,
                         std::span<Positions> results) const {
  if (recipes.size() == 1) {
    return blend_one(
        *recipes[0], [](const Block&) { return true; }, results[0]);
  }
  parallel_for_each(recipes.size(), [&](std::size_t f) { prepare(*recipes[f], results[f]); });
  const auto regions = static_cast<std::size_t>(regions_.alpha.cols());
  const std::size_t groups = (recipes.size() + kChunkFaces - 1) / kChunkFaces;
  std::vector<Factors> all_factors(groups * regions);  // #groups by #regions
  parallel_for_each(all_factors.size(), [&](std::size_t i) {
    const std::size_t first = i / regions * kChunkFaces;
    all_factors[i] =
        factors(recipes.subspan(first, std::min(kChunkFaces, recipes.size() - first)), i % regions);
  });
  std::vector<std::vector<bool>> used(regions, std::vector<bool>(field_count(), false));
  for (std::size_t i = 0; i < all_factors.size(); ++i) {
    for (const std::uint32_t field : all_factors[i].fields) used[i % regions][field] = true;
  }
  parallel_blocks(static_cast<Index>(blocks_.size()), kBlocksATask, [&](Index begin, Index end) {
    std::vector<Chunk> packed;
    std::vector<BlockValues> alpha;
    std::array<BlockValues, kChunkFaces> added;
    FieldsAhead ahead;
    for (Index b = begin; b < end; ++b) {
      const Block& block = blocks_[static_cast<std::size_t>(b)];
      std::vector<std::uint8_t> wanted = fields_at(block);
      for (std::size_t f = 0; f < wanted.size(); ++f) {
        const auto uses = [&](std::uint32_t k) { return used[k][f]; };
        if (!std::any_of(block.regions.begin(), block.regions.end(), uses)) wanted[f] = 0;
      }
      pack(block, wanted, packed);
      spread_alpha(block, alpha);
      if (b + 1 < end) {
        const std::size_t chunks = (3 * block.count + kChunkValues - 1) / kChunkValues;
        ahead.aim(*this, blocks_[static_cast<std::size_t>(b) + 1],
                  all_factors.size() / regions * block.regions.size() * chunks);
      }
      for (std::size_t first = 0; first < recipes.size(); first += kChunkFaces) {
        displacements(block, packed, alpha, wanted,
                      std::span(all_factors).subspan(first / kChunkFaces * regions, regions), ahead,
                      added);
        for (std::size_t f = first; f < std::min(first + kChunkFaces, recipes.size()); ++f) {
          write(block, *recipes[f], added[f - first], results[f]);
        }
      }
    }
    finish_writing();
  });
}

void CrowdBlender::change(const Recipe& before, const Recipe& after, Positions& face) const {
  const bool same_target = before.target == after.target && before.mixture == after.mixture;
  const auto differs = [&](const Block& block) {
    return !same_target ||
           std::any_of(block.regions.begin(), block.regions.end(), [&](std::uint32_t k) {
             return !blends_alike(before.regions[k], after.regions[k]);
           });
  };
  blend_one(after, differs, face);
}

Positions CrowdBlender::blend(const Recipe& recipe) const {
  Positions result;
  blend_one(
      recipe, [](const Block&) { return true; }, result);
  return result;
}

}  // namespace crowdface
