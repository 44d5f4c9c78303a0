// SPDX-License-Identifier: Apache-2.0
#include "crowdface/smooth/field_patches.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "crowdface/core/parallel.h"
#include "crowdface/core/require.h"
#include "crowdface/smooth/field_kernels.h"
#include "crowdface/smooth/tiles.h"

namespace crowdface {
namespace {

constexpr std::size_t kPatchesPerTask = 16;

/// Returns a weight w_p for each vector field of a head. The weights turn errors e_p of the fields
/// at a vertex into an upper bound for the vertex's error at every level L in `levels`:
///
///     |Σ_p φ_p(L) e_p| ≤ √(Σ_p w_p² |e_p|²)
///
/// φ_p are the level functions of the head (see HeadSmoothing). With m_p = max_L |φ_p(L)|, the
/// Cauchy–Schwarz inequality gives w_p = m_p √(max_L Σ_q (φ_q(L) / m_q)²).
std::vector<double> error_weights(const HeadSmoothing& head,
                                  std::span<const std::uint64_t> levels) {
  std::vector<std::vector<double>> functions;
  functions.reserve(levels.size());
  for (const std::uint64_t level : levels) functions.push_back(head.functions(level));
  std::vector<double> weights(static_cast<std::size_t>(head.fields.rank), 0.0);
  for (const auto& at : functions) {
    for (std::size_t p = 0; p < weights.size(); ++p) {
      weights[p] = std::max(weights[p], std::abs(at[p]));
    }
  }
  double most = 0;
  for (const auto& at : functions) {
    double squares = 0;
    for (std::size_t p = 0; p < weights.size(); ++p) {
      if (weights[p] > 0) squares += at[p] / weights[p] * (at[p] / weights[p]);
    }
    most = std::max(most, squares);
  }
  for (double& weight : weights) weight *= std::sqrt(most);
  return weights;
}

/// The data of consecutive patches, with the members of PatchArrays as growing vectors.
struct PatchLists {
  std::vector<std::uint32_t> stored_vertex_counts, field_counts;
  std::vector<float> quantization_steps, weights;
  std::vector<std::int16_t> quantized_values;
};

/// Chooses the skeleton of each patch (the vertices from which all others are interpolated) and
/// computes the patch's data. Each thread needs its own instance.
class PatchMaker {
 public:
  /// \param heads, weights  must outlive this object.
  /// \param weights         for each head, the result of error_weights.
  PatchMaker(std::span<const HeadSmoothing> heads, const std::vector<std::vector<double>>& weights,
             double tolerance)
      : heads_(heads), error_weights_(weights), tolerance_(tolerance) {}

  void add(std::span<const std::uint32_t> vertices, PatchLists& made) {
    const std::size_t fields = count_fields(vertices);
    choose_skeleton(vertices, fields);
    made.stored_vertex_counts.push_back(static_cast<std::uint32_t>(skeleton_.size()));
    made.field_counts.insert(made.field_counts.end(), counts_.begin(), counts_.end());
    if (skeleton_.size() < vertices.size()) add_weights(made.weights);
    add_quantized_values(vertices, made);
  }

 private:
  using PatchColumn = std::array<double, kPatchVertices>;

  std::size_t count_fields(std::span<const std::uint32_t> vertices) {
    counts_.assign(heads_.size(), 0);
    std::size_t fields = 0;
    for (std::size_t h = 0; h < heads_.size(); ++h) {
      for (const std::uint32_t v : vertices) {
        counts_[h] =
            std::max(counts_[h], static_cast<std::uint32_t>(heads_[h].fields.tile_fields(v).count));
      }
      fields += counts_[h];
    }
    return fields;
  }

  /// Fills columns_ with the coordinates of all fields, each scaled by its error weight. The size
  /// is 3·#fields by kPatchVertices.
  void fill_columns(std::span<const std::uint32_t> vertices, std::size_t fields) {
    columns_.assign(3 * fields * kPatchVertices, 0.0F);
    float* first = columns_.data();
    for (std::size_t h = 0; h < heads_.size(); ++h) {
      for (std::size_t i = 0; i < vertices.size(); ++i) {
        const TileFields tile = heads_[h].fields.tile_fields(vertices[i]);
        const std::int16_t* quantized = tile.quantized_values + 3 * (vertices[i] % kTileVertices);
        float* to = first + i;
        for (std::size_t p = 0; p < tile.count; ++p, quantized += kTileValues) {
          const float heavy = tile.quantization_steps[p] * static_cast<float>(error_weights_[h][p]);
          for (std::size_t c = 0; c < 3; ++c, to += kPatchVertices) {
            *to = heavy * static_cast<float>(quantized[c]);
          }
        }
      }
      first += 3 * counts_[h] * kPatchVertices;
    }
  }

  /// Chooses the skeleton (the vertices from which all others are interpolated) by a pivoted
  /// Cholesky factorization of the vertices' Gram matrix. In each step, the vertex with the largest
  /// error becomes the pivot. The diagonal that remains holds the squared error of each vertex.
  /// Stops when all errors are within the tolerance.
  void choose_skeleton(std::span<const std::uint32_t> vertices, std::size_t fields) {
    skeleton_.clear();
    factor_.clear();
    // The largest useful skeleton. A skeleton of s vertices needs s·#fields + s·kPatchVertices
    // numbers; storing all vertices needs kPatchVertices·#fields numbers.
    const std::size_t max_size = kPatchVertices * fields / (fields + kPatchVertices);
    fill_columns(vertices, fields);
    PatchColumn left{};
    for (std::size_t column = 0; column < 3 * fields; ++column) {
      for (std::size_t i = 0; i < kPatchVertices; ++i) {
        const double value = static_cast<double>(columns_[column * kPatchVertices + i]);
        left[i] += value * value;
      }
    }
    for (;;) {
      const auto pivot = static_cast<std::size_t>(std::ranges::max_element(left) - left.begin());
      if (left[pivot] <= tolerance_ * tolerance_) return;
      if (skeleton_.size() >= std::min(max_size, vertices.size() - 1)) break;
      // The next column of the factor is the column of the Gram matrix minus its projection onto
      // the earlier columns.
      PatchColumn& next = factor_.emplace_back();
      row_products(columns_.data(), 3 * fields, pivot, next.data());
      for (std::size_t j = 0; j + 1 < factor_.size(); ++j) {
        const double factor = factor_[j][pivot];
        for (std::size_t i = 0; i < kPatchVertices; ++i) next[i] -= factor * factor_[j][i];
      }
      const double scale = 1 / std::sqrt(left[pivot]);
      for (double& value : next) value *= scale;
      for (const std::size_t before : skeleton_) next[before] = 0;
      for (std::size_t i = 0; i < kPatchVertices; ++i) {
        left[i] = std::max(0.0, left[i] - next[i] * next[i]);
      }
      skeleton_.push_back(pivot);
      for (const std::size_t chosen : skeleton_) left[chosen] = 0;
    }
    // Interpolation from fewer vertices would not save memory in this patch: store all vertices.
    skeleton_.resize(vertices.size());
    for (std::size_t i = 0; i < vertices.size(); ++i) skeleton_[i] = i;
  }

  /// Appends the interpolation weights, #skeleton by kPatchVertices. `factor_` is a Cholesky factor
  /// with one row for each vertex of the patch. The row of any vertex is a linear combination of
  /// the skeleton vertices' rows. The coefficients, found by back substitution, are the vertex's
  /// weights.
  void add_weights(std::vector<float>& to) const {
    const std::size_t size = skeleton_.size();
    std::vector<PatchColumn> weights(size);
    for (std::size_t j = size; j-- > 0;) {
      weights[j] = factor_[j];
      for (std::size_t i = j + 1; i < size; ++i) {
        const double factor = factor_[j][skeleton_[i]];
        for (std::size_t v = 0; v < kPatchVertices; ++v) weights[j][v] -= factor * weights[i][v];
      }
      const double scale = 1 / factor_[j][skeleton_[j]];
      for (double& weight : weights[j]) weight *= scale;
      for (const std::size_t chosen : skeleton_) weights[j][chosen] = 0;
      weights[j][skeleton_[j]] = 1;
    }
    for (const PatchColumn& of_one : weights) {
      for (const double weight : of_one) to.push_back(static_cast<float>(weight));
    }
  }

  /// Quantizes the fields at the skeleton vertices of a patch, and appends the quantized values to
  /// `made`. The fields at all other vertices of the patch are interpolated from these values.
  void add_quantized_values(std::span<const std::uint32_t> vertices, PatchLists& made) {
    const std::size_t size = skeleton_.size(), values = FieldPatch::values_per_field(size);
    for (std::size_t h = 0; h < heads_.size(); ++h) {
      values_.assign(counts_[h] * values, 0.0F);
      for (std::size_t j = 0; j < size; ++j) {
        const std::uint32_t vertex = vertices[skeleton_[j]];
        const TileFields tile = heads_[h].fields.tile_fields(vertex);
        const std::int16_t* quantized = tile.quantized_values + 3 * (vertex % kTileVertices);
        for (std::size_t p = 0; p < tile.count; ++p, quantized += kTileValues) {
          for (std::size_t c = 0; c < 3; ++c) {
            values_[p * values + c * size + j] =
                tile.quantization_steps[p] * static_cast<float>(quantized[c]);
          }
        }
      }
      const std::size_t at = made.quantized_values.size();
      made.quantized_values.resize(at + values_.size());
      for (std::size_t p = 0; p < counts_[h]; ++p) {
        made.quantization_steps.push_back(
            quantize(std::span(std::as_const(values_)).subspan(p * values, values),
                     made.quantized_values.data() + at + p * values));
      }
    }
  }

  std::span<const HeadSmoothing> heads_;
  const std::vector<std::vector<double>>& error_weights_;
  double tolerance_;
  /// for each head: number of its leading fields that the patch stores
  std::vector<std::uint32_t> counts_;
  std::vector<float> columns_, values_;
  std::vector<PatchColumn> factor_;  ///< columns of the Cholesky factor, one per skeleton vertex
  /// the skeleton vertices, as indices into the vertices of the patch
  std::vector<std::size_t> skeleton_;
};

/// Owns the memory that the spans of PatchArrays refer to.
struct OwnedPatches {
  std::vector<std::uint32_t> vertices;
  PatchLists made;
};

/// Concatenates the member `list` of all parts, and empties `list` in each part.
template <class T>
std::vector<T> join(std::vector<PatchLists>& parts, std::vector<T> PatchLists::*list) {
  std::size_t count = 0;
  for (const PatchLists& part : parts) count += (part.*list).size();
  std::vector<T> all;
  all.reserve(count);
  for (PatchLists& part : parts) {
    all.insert(all.end(), (part.*list).begin(), (part.*list).end());
    part.*list = {};
  }
  return all;
}

bool is_step(float step) {
  int exponent = 0;
  return step == 0 || (std::isfinite(step) && std::frexp(step, &exponent) == 0.5F);
}

/// Whether `vertices` is a permutation of the vertex indices 0 … `vertex_count` − 1 in which the
/// indices of each patch (kPatchVertices consecutive entries) ascend.
bool is_valid_patch_order(std::span<const std::uint32_t> vertices, std::size_t vertex_count) {
  if (vertices.size() != vertex_count) return false;
  std::vector<bool> seen(vertex_count);
  for (std::size_t i = 0; i < vertex_count; ++i) {
    if (vertices[i] >= vertex_count || seen[vertices[i]]) return false;
    if (i % kPatchVertices != 0 && vertices[i] < vertices[i - 1]) return false;
    seen[vertices[i]] = true;
  }
  return true;
}

}  // namespace

std::optional<FieldPatches> FieldPatches::from_arrays(PatchArrays arrays, Index vertex_count,
                                                      std::span<const Index> head_field_counts) {
  const auto vertices = static_cast<std::size_t>(vertex_count);
  const std::size_t patches = patch_count(vertices);
  if (!is_valid_patch_order(arrays.vertices, vertices) ||
      arrays.stored_vertex_counts.size() != patches ||
      arrays.field_counts.size() != patches * head_field_counts.size()) {
    return std::nullopt;
  }
  FieldPatches result;
  result.heads_ = head_field_counts.size();
  result.patches_.reserve(patches);
  Patch end{};
  for (std::size_t i = 0; i < patches; ++i) {
    const std::size_t here = std::min(kPatchVertices, vertices - i * kPatchVertices);
    const std::size_t skeleton = arrays.stored_vertex_counts[i];
    if (skeleton > here) return std::nullopt;
    end.field_count = 0;
    for (std::size_t h = 0; h < head_field_counts.size(); ++h) {
      const std::uint32_t count = arrays.field_counts[i * head_field_counts.size() + h];
      if (count > static_cast<std::uint64_t>(head_field_counts[h])) return std::nullopt;
      end.field_count += count;
    }
    result.patches_.push_back(end);
    end.first_field += end.field_count;
    end.first_value += end.field_count * FieldPatch::values_per_field(skeleton);
    if (skeleton < here) end.first_weight += skeleton * kPatchVertices;
  }
  if (end.first_field != arrays.quantization_steps.size() ||
      end.first_value != arrays.quantized_values.size() ||
      end.first_weight != arrays.weights.size() ||
      !std::ranges::all_of(arrays.quantization_steps, is_step) ||
      !std::ranges::all_of(arrays.weights, [](float weight) { return std::isfinite(weight); })) {
    return std::nullopt;
  }
  result.arrays_ = std::move(arrays);
  return result;
}

FieldPatch FieldPatches::operator[](std::size_t patch) const {
  const Patch& place = patches_[patch];
  const std::size_t first = patch * kPatchVertices;
  FieldPatch result;
  result.vertices =
      arrays_.vertices.subspan(first, std::min(kPatchVertices, arrays_.vertices.size() - first));
  result.field_counts = arrays_.field_counts.subspan(patch * heads_, heads_);
  result.field_count = place.field_count;
  result.stored_vertex_count = arrays_.stored_vertex_counts[patch];
  result.quantization_steps = arrays_.quantization_steps.data() + place.first_field;
  result.quantized_values = arrays_.quantized_values.data() + place.first_value;
  if (!result.stores_all_vertices()) result.weights = arrays_.weights.data() + place.first_weight;
  return result;
}

std::vector<std::uint32_t> vertex_order_for_patches(const Positions& positions,
                                                    double max_distance) {
  constexpr std::uint32_t kLongest = 32;
  const auto vertices = static_cast<std::uint32_t>(positions.rows());
  // Cut the sequence of vertices where two successive vertices are far apart. `firsts` holds the
  // first vertex of each piece. Its last entry is the total number of vertices.
  std::vector<std::uint32_t> firsts;
  for (std::uint32_t v = 0; v < vertices; ++v) {
    const bool goes_on = !firsts.empty() && v - firsts.back() < kLongest &&
                         (positions.row(v) - positions.row(v - 1)).norm() <= max_distance;
    if (!goes_on) firsts.push_back(v);
  }
  Positions at(static_cast<Index>(firsts.size()), 3);
  for (std::size_t i = 0; i < firsts.size(); ++i) {
    at.row(static_cast<Index>(i)) = positions.row(firsts[i]);
  }
  firsts.push_back(vertices);
  std::vector<std::uint32_t> order;
  order.reserve(vertices);
  for (const std::uint32_t i : hilbert_order(at)) {
    for (std::uint32_t v = firsts[i]; v < firsts[i + 1]; ++v) order.push_back(v);
  }
  return order;
}

FieldPatches interpolate_fields(std::span<const HeadSmoothing> heads,
                                std::span<const std::uint64_t> levels,
                                std::span<const std::uint32_t> order, double tolerance,
                                const std::function<void(std::size_t)>& progress) {
  require(!heads.empty(), "patches of no head");
  std::vector<Index> ranks;
  for (const HeadSmoothing& head : heads) {
    const LevelFields& fields = head.fields;
    const std::size_t tiles = LevelFields::tile_count(order.size());
    require(static_cast<std::size_t>(fields.vertex_count) == order.size() &&
                fields.first_field_of_tile.size() == tiles + 1 &&
                fields.quantization_steps.size() == fields.first_field_of_tile.back() &&
                fields.quantized_values.size() == fields.quantization_steps.size() * kTileValues,
            "patches: ", fields.quantized_values.size(), " numbers of ",
            fields.quantization_steps.size(), " fields of ", tiles, " tiles of ", order.size(),
            " vertices");
    ranks.push_back(fields.rank);
  }
  std::vector<std::vector<double>> weights(heads.size());
  parallel_for_each(heads.size(),
                    [&](std::size_t h) { weights[h] = error_weights(heads[h], levels); });
  auto all = std::make_shared<OwnedPatches>();
  all->vertices.assign(order.begin(), order.end());
  const std::size_t patches = patch_count(order.size());
  std::vector<PatchLists> parts((patches + kPatchesPerTask - 1) / kPatchesPerTask);
  parallel_blocks(patches, kPatchesPerTask, [&](std::size_t begin, std::size_t end) {
    PatchMaker maker(heads, weights, tolerance);
    for (std::size_t i = begin; i < end; ++i) {
      const std::size_t first = i * kPatchVertices;
      const auto vertices =
          std::span(all->vertices).subspan(first, std::min(kPatchVertices, order.size() - first));
      std::ranges::sort(vertices);
      maker.add(vertices, parts[begin / kPatchesPerTask]);
    }
    progress(end - begin);
  });
  const PatchLists& made = all->made = {
      join(parts, &PatchLists::stored_vertex_counts), join(parts, &PatchLists::field_counts),
      join(parts, &PatchLists::quantization_steps), join(parts, &PatchLists::weights),
      join(parts, &PatchLists::quantized_values)};
  auto result =
      FieldPatches::from_arrays({all->vertices, made.stored_vertex_counts, made.field_counts,
                                 made.quantization_steps, made.weights, made.quantized_values, all},
                                static_cast<Index>(order.size()), ranks);
  require(result.has_value(), "patches: not each vertex once, or numbers that are none");
  return *std::move(result);
}

}  // namespace crowdface
