// SPDX-License-Identifier: Apache-2.0
#include "crowdface/blend/crowd_blender.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <set>

#include "crowdface/blend/crowd_product_kernels.h"
#include "crowdface/blend/recipe_check.h"
#include "crowdface/core/parallel.h"
#include "crowdface/core/require.h"

namespace crowdface {
namespace {

constexpr std::size_t kPatchesPerTask = 16;
constexpr std::size_t kCoordinates = 3;
constexpr std::size_t kPatchValues = kCoordinates * kPatchVertices;

bool blends_alike(const BandRecipe& a, const BandRecipe& b) {
  return a.weights == b.weights && a.iterations == b.iterations &&
         a.extrapolation == b.extrapolation;
}

/// Returns whether two region recipes give the same result for faces that have the same target.
bool blends_alike(const RegionRecipe& a, const RegionRecipe& b) {
  if (band_count(a) != band_count(b)) return false;
  for (std::size_t i = 0; i < band_count(a); ++i) {
    if (!blends_alike(band_of(a, i), band_of(b, i))) return false;
  }
  return true;
}

/// A buffer of floats whose memory is aligned to cache lines.
class AlignedFloats {
 public:
  /// Resizes the buffer. Its content is undefined afterwards.
  float* resize(std::size_t count) {
    lines_.resize(count / kPatchPadding + 1);
    return lines_.front().values;
  }
  float* zeros(std::size_t count) {
    float* values = resize(count);
    std::fill_n(values, count, 0.0F);
    return values;
  }

 private:
  struct alignas(64) Line {
    float values[kPatchPadding];
  };
  std::vector<Line> lines_;
};

}  // namespace

CrowdBlender::CrowdBlender(const HeadSet& heads, std::vector<HeadSmoothing> levels,
                           FieldPatches patches, const RegionWeights& regions)
    : heads_(heads),
      head_smoothings_(std::move(levels)),
      patches_(std::move(patches)),
      regions_(regions) {
  const Index vertices = heads.topology.vertex_count;
  require(head_smoothings_.size() == heads.heads.size() &&
              patches_.head_count() == head_smoothings_.size(),
          "blend: fitted levels of ", head_smoothings_.size(), " heads, patches of ",
          patches_.head_count(), ", for ", heads.heads.size());
  require(patches_.vertex_count() == vertices && regions.alpha.rows() == vertices,
          "blend: patches of ", patches_.vertex_count(), " vertices and masks of ",
          regions.alpha.rows(), " for ", vertices);
  field_offsets_.push_back(0);
  for (const HeadSmoothing& head : head_smoothings_) {
    field_offsets_.push_back(field_offsets_.back() + static_cast<std::size_t>(head.fields.rank));
  }
  find_regions();
}

void CrowdBlender::find_regions() {
  region_offsets_.push_back(0);
  for (std::size_t patch = 0; patch < patches_.size(); ++patch) {
    for (Index k = 0; k < regions_.alpha.cols(); ++k) {
      const auto acts = [&](std::uint32_t v) { return regions_.alpha(v, k) != 0; };
      if (std::ranges::any_of(patches_[patch].vertices, acts)) {
        patch_regions_.push_back(static_cast<std::uint32_t>(k));
      }
    }
    region_offsets_.push_back(patch_regions_.size());
  }
}

std::vector<float> CrowdBlender::coefficients(const Recipe& recipe, std::size_t region) const {
  std::vector<double> sums(field_count(), 0.0);
  for (const LevelWeights& at : weights_by_level(recipe, region)) {
    // A head may occur twice, as the target and as a source, or as a source of adjacent bands. Add
    // up the head's weights before multiplying by the functions φ. Then weights that cancel give
    // exactly zero, and a target that is blended with itself does not change.
    std::vector<double> shares(head_smoothings_.size(), 0.0);
    for (const SourceWeight& part : at.weights) {
      shares[static_cast<std::size_t>(part.head)] += part.weight;
    }
    for (std::size_t h = 0; h < shares.size(); ++h) {
      if (shares[h] == 0) continue;
      std::size_t f = field_offsets_[h];
      for (const double function : head_smoothings_[h].functions(at.level)) {
        sums[f++] += shares[h] * function;  // Eq. 5
      }
    }
  }
  return {sums.begin(), sums.end()};
}

/// A batch of faces that are computed in one pass, with the coefficients of each face for the
/// fields of all heads.
class CrowdBlender::FaceBatch {
 public:
  FaceBatch(const CrowdBlender& blender, std::span<const Recipe* const> recipes,
            std::span<Positions> results)
      : recipes_(recipes), results_(results) {
    const auto regions = static_cast<std::size_t>(blender.regions_.alpha.cols());
    coefficients_.resize(regions * recipes.size());
    parallel_for_each(coefficients_.size(), [&](std::size_t i) {
      coefficients_[i] = blender.coefficients(*recipes[i % recipes.size()], i / recipes.size());
    });
    used_.resize(regions);
    used_by_any_face_.assign(regions, NonzeroFlags(blender.field_count()));
    for (std::size_t i = 0; i < coefficients_.size(); ++i) {
      const std::size_t region = i / recipes.size(), face = i % recipes.size();
      if (face % kMaxColumns == 0) used_[region].emplace_back(blender.field_count());
      for (std::size_t f = 0; f < blender.field_count(); ++f) {
        if (coefficients_[i][f] != 0) used_[region].back()[f] = used_by_any_face_[region][f] = 1;
      }
    }
    for (const Recipe* recipe : recipes) {
      for (const SourceWeight& part : target_head_weights(*recipe)) targets_.insert(part.head);
    }
  }
  std::size_t size() const { return recipes_.size(); }
  const Recipe& recipe(std::size_t face) const { return *recipes_[face]; }
  Positions& result(std::size_t face) const { return results_[face]; }
  const float* coefficients(std::size_t region, std::size_t face) const {
    return coefficients_[region * size() + face].data();
  }
  /// Returns whether the field has a non-zero coefficient in at least one of kMaxColumns faces,
  /// beginning with face `first`.
  bool uses(std::size_t region, std::size_t first, std::size_t field) const {
    return used_[region][first / kMaxColumns][field] != 0;
  }
  /// Returns whether the field has a non-zero coefficient in at least one face.
  bool uses(std::size_t region, std::size_t field) const {
    return used_by_any_face_[region][field] != 0;
  }
  /// The heads that at least one face uses as its target, alone or in a mixture.
  const std::set<Index>& targets() const { return targets_; }

 private:
  std::span<const Recipe* const> recipes_;
  std::span<Positions> results_;
  /// for each field: whether the field's coefficient is non-zero
  using NonzeroFlags = std::vector<std::uint8_t>;
  /// #regions by #faces: the coefficients of all fields
  std::vector<std::vector<float>> coefficients_;
  /// #regions by #faces/kMaxColumns: which fields are used by each group of kMaxColumns faces
  std::vector<std::vector<NonzeroFlags>> used_;
  /// for each region, which fields are used by at least one face
  std::vector<NonzeroFlags> used_by_any_face_;
  std::set<Index> targets_;
};

/// Computes one patch at a time: the vertices of this patch in all faces of the batch. Each thread
/// needs its own instance.
class CrowdBlender::PatchBlender {
 public:
  /// \param blender, crowd  must outlive this object.
  PatchBlender(const CrowdBlender& blender, const FaceBatch& crowd)
      : blender_(blender), crowd_(crowd) {
    std::iota(all_of_skeleton_.begin(), all_of_skeleton_.end(), 0U);
  }

  void blend(std::size_t patch) {
    patch_ = blender_.patches_[patch];
    regions_ = blender_.regions_of_patch(patch);
    find_runs();
    fetch_targets();
    vertex_sums_ = added_values_.zeros(crowd_.size() * kPatchValues);
    skeleton_sums_ = skeleton_values_.resize(kMaxColumns * patch_.values_per_field());
    if (patch_.stored_vertex_count > 0) {
      find_fields();
      if (crowd_.size() == 1) {
        add_to_single_face();
      } else {
        add_to_all_faces();
      }
    }
    write();
  }

 private:
  /// Fills `fields_`: for each row of the patch's matrix, the index of the row's field among the
  /// fields of all heads.
  void find_fields() {
    fields_.clear();
    for (std::size_t h = 0; h < patch_.field_counts.size(); ++h) {
      const auto first = static_cast<std::uint32_t>(blender_.field_offsets_[h]);
      for (std::uint32_t p = 0; p < patch_.field_counts[h]; ++p) fields_.push_back(first + p);
    }
  }

  /// Adds the products of fields and coefficients to a single face. Multiplies the quantized values
  /// directly, for several regions at once: for a single face, unpacking the values first would
  /// take longer. The coefficients are multiplied by the quantization steps.
  void add_to_single_face() {
    for (std::size_t first = 0; first < regions_.size(); first += kMaxColumns) {
      const auto regions = regions_.subspan(first, std::min(kMaxColumns, regions_.size() - first));
      used_.clear();
      for (std::uint32_t row = 0; row < fields_.size(); ++row) {
        const auto uses = [&](std::uint32_t k) { return crowd_.uses(k, 0, fields_[row]); };
        if (std::ranges::any_of(regions, uses)) used_.push_back(row);
      }
      if (used_.empty()) continue;
      scaled_coefficients_.resize(regions.size() * fields_.size());
      for (std::size_t k = 0; k < regions.size(); ++k) {
        const float* coefficients = crowd_.coefficients(regions[k], 0);
        float* scaled = scaled_coefficients_.data() + k * fields_.size();
        columns_[k] = scaled;
        products_[k] = skeleton_sums_ + k * patch_.values_per_field();
        for (const std::uint32_t row : used_) {
          scaled[row] = coefficients[fields_[row]] * patch_.quantization_steps[row];
        }
      }
      multiply(MatrixRows<std::int16_t>{patch_.quantized_values, patch_.values_per_field(),
                                        patch_.values_per_field(), used_},
               std::span(columns_).first(regions.size()),
               std::span(products_).first(regions.size()));
      for (std::size_t k = 0; k < regions.size(); ++k) {
        copy_alpha(regions[k]);
        add_at_vertices(skeleton_sums_ + k * patch_.values_per_field(), 0, 1);
      }
    }
  }

  /// Adds the products of fields and coefficients to several faces. Unpacks the fields once, then
  /// multiplies the fields by the coefficients of kMaxColumns faces at a time.
  void add_to_all_faces() {
    float* unpacked = unpacked_values_.resize(blender_.field_count() * patch_.values_per_field());
    for (std::size_t row = 0; row < fields_.size(); ++row) {
      const auto uses = [&](std::uint32_t k) { return crowd_.uses(k, fields_[row]); };
      if (std::ranges::none_of(regions_, uses)) continue;
      dequantize(patch_.quantized_values + row * patch_.values_per_field(),
                 patch_.values_per_field(), patch_.quantization_steps[row],
                 unpacked + fields_[row] * patch_.values_per_field());
    }
    for (const std::uint32_t region : regions_) {
      copy_alpha(region);
      for (std::size_t first = 0; first < crowd_.size(); first += kMaxColumns) {
        used_.clear();
        for (const std::uint32_t field : fields_) {
          if (crowd_.uses(region, first, field)) used_.push_back(field);
        }
        if (used_.empty()) continue;
        const std::size_t count = std::min(kMaxColumns, crowd_.size() - first);
        for (std::size_t face = 0; face < count; ++face) {
          columns_[face] = crowd_.coefficients(region, first + face);
          products_[face] = skeleton_sums_ + face * patch_.values_per_field();
        }
        multiply(MatrixRows<float>{unpacked, patch_.values_per_field(), patch_.values_per_field(),
                                   used_},
                 std::span(columns_).first(count), std::span(products_).first(count));
        add_at_vertices(skeleton_sums_, first, count);
      }
    }
  }

  /// Copies the weights α of a region at the vertices of the patch to `alpha_`.
  void copy_alpha(std::uint32_t region) {
    for (std::size_t i = 0; i < patch_.vertices.size(); ++i) {
      alpha_[i] = static_cast<float>(blender_.regions_.alpha(patch_.vertices[i], region));
    }
  }

  /// Interpolates sums of fields (see skeleton_sums_) from the skeleton vertices to all vertices of
  /// the patch. Multiplies the interpolated sums by the region's weights α (`alpha_`), and adds the
  /// products to `vertex_sums_` of `count` faces (Eq. 7).
  ///
  /// \param at_skeleton  the sums, `count` by values_per_field(): for each face, the x coordinates
  ///                     at all skeleton vertices, then y, then z.
  void add_at_vertices(const float* at_skeleton, std::size_t first_face, std::size_t count) {
    float* added = vertex_sums_ + first_face * kPatchValues;
    // Returns a pointer to the sums of one coordinate of one face. i = 0, 1, 2 are x, y, z of the
    // first face; i = 3, 4, 5 are x, y, z of the second face; and so on.
    const auto coordinate = [&](std::size_t i) {
      return at_skeleton + i / kCoordinates * patch_.values_per_field() +
             i % kCoordinates * patch_.stored_vertex_count;
    };
    for (std::size_t first = 0; first < kCoordinates * count; first += kMaxColumns) {
      const std::size_t here = std::min(kMaxColumns, kCoordinates * count - first);
      for (std::size_t i = 0; i < here; ++i) {
        columns_[i] = coordinate(first + i);
        products_[i] = added + (first + i) * kPatchVertices;
      }
      if (patch_.stores_all_vertices()) {
        for (std::size_t i = 0; i < here; ++i) {
          for (std::size_t v = 0; v < patch_.stored_vertex_count; ++v) {
            products_[i][v] += alpha_[v] * columns_[i][v];
          }
        }
      } else {
        add_product({patch_.weights, kPatchVertices, kPatchVertices,
                     std::span(all_of_skeleton_).first(patch_.stored_vertex_count)},
                    std::span(columns_).first(here), alpha_.data(),
                    std::span(products_).first(here));
      }
    }
  }

  /// Divides the patch's vertices into runs: ranges of consecutive vertex numbers.
  void find_runs() {
    runs_.clear();
    for (const std::uint32_t v : patch_.vertices) {
      if (runs_.empty() || v != runs_.back().first + runs_.back().count) runs_.push_back({v, 0});
      ++runs_.back().count;
    }
  }

  /// Prefetches the target positions that `write` reads, so that they are loaded while the products
  /// are computed.
  void fetch_targets() const {
    constexpr std::size_t kLine = 64 / sizeof(double);
    for (const Index h : crowd_.targets()) {
      const double* positions = blender_.heads_.heads[static_cast<std::size_t>(h)].positions.data();
      for (const VertexRun& run : runs_) {
        const double* first = positions + std::size_t{3} * run.first;
        const double* last = first + std::size_t{3} * run.count - 1;
        for (const double* line = first; line < last; line += kLine) __builtin_prefetch(line);
        __builtin_prefetch(last);
      }
    }
  }

  /// Writes the positions of the patch's vertices in each face: the position in the target plus the
  /// sum in `vertex_sums_`.
  void write() {
    for (std::size_t face = 0; face < crowd_.size(); ++face) {
      const Recipe& recipe = crowd_.recipe(face);
      Positions& result = crowd_.result(face);
      const auto head = [&](Index h) -> const Positions& {
        return blender_.heads_.heads[static_cast<std::size_t>(h)].positions;
      };
      const Positions* base = &head(recipe.target);
      if (!recipe.mixture.empty()) {
        base = &result;
        for (const std::uint32_t v : patch_.vertices) {
          result.row(v).setZero();
          for (const SourceWeight& part : recipe.mixture) {
            result.row(v) += part.weight * head(part.head).row(v);
          }
        }
      }
      write_sums(runs_, base->data(), vertex_sums_ + face * kPatchValues, result.data());
    }
  }

  const CrowdBlender& blender_;
  const FaceBatch& crowd_;
  FieldPatch patch_;
  std::span<const std::uint32_t> regions_;
  std::vector<std::uint32_t> fields_, used_;
  /// for each region and each field of the patch: coefficient times quantization step
  std::vector<float> scaled_coefficients_;
  std::vector<VertexRun> runs_;
  AlignedFloats unpacked_values_, skeleton_values_, added_values_;
  /// kMaxColumns by values_per_field(): sums of the fields, each multiplied by its coefficient, at
  /// the skeleton vertices of the patch (from which its other vertices are interpolated)
  float* skeleton_sums_ = nullptr;
  /// #faces by 3 by kPatchVertices: what is added to the target's positions in each face of the
  /// batch, at all vertices of the patch
  float* vertex_sums_ = nullptr;
  std::array<const float*, kMaxColumns> columns_{};
  std::array<float*, kMaxColumns> products_{};
  std::array<std::uint32_t, kPatchVertices> all_of_skeleton_{};
  alignas(64) std::array<float, kPatchVertices> alpha_{};
};

template <class Wanted>
void CrowdBlender::blend_patches(const Wanted& wanted, std::span<const Recipe* const> recipes,
                                 std::span<Positions> results) const {
  parallel_for_each(recipes.size(), [&](std::size_t f) {
    require_recipe_fits(heads_, regions_, *recipes[f]);
    Positions& result = results[f];
    result.resize(heads_.topology.vertex_count, 3);
  });
  const FaceBatch crowd(*this, recipes, results);
  parallel_blocks(patches_.size(), kPatchesPerTask, [&](std::size_t begin, std::size_t end) {
    PatchBlender blender(*this, crowd);
    for (std::size_t patch = begin; patch < end; ++patch) {
      if (wanted(patch)) blender.blend(patch);
    }
    wait_for_streaming_stores();
  });
}

void CrowdBlender::blend(std::span<const Recipe* const> recipes,
                         std::span<Positions> results) const {
  blend_patches([](std::size_t) { return true; }, recipes, results);
}

void CrowdBlender::update(const Recipe& before, const Recipe& after, Positions& face) const {
  const bool same_target = before.target == after.target && before.mixture == after.mixture;
  const auto differs = [&](std::size_t patch) {
    return !same_target || std::ranges::any_of(regions_of_patch(patch), [&](std::uint32_t k) {
      return !blends_alike(before.regions[k], after.regions[k]);
    });
  };
  const Recipe* recipe = &after;
  blend_patches(differs, {&recipe, 1}, {&face, 1});
}

Positions CrowdBlender::blend(const Recipe& recipe) const {
  Positions result;
  const Recipe* one = &recipe;
  blend({&one, 1}, {&result, 1});
  return result;
}

}  // namespace crowdface
