// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "crowdface/mesh/topology.h"
#include "crowdface/smooth/level_fields.h"

namespace crowdface {

/// An approximation of one head's shape after any number L of smoothing iterations:
///
///     S̃_L x = x + Σ_p φ_p(L)·c_p
///
/// Here, x are the head's positions, and S̃_L x approximates the positions after L iterations. The
/// vector fields c_p and the level functions φ_p, both numbered by p, come from a LevelBasis or a
/// CubicFit.
struct HeadSmoothing {
  LevelFields fields;  ///< the vector fields c_p, numbered by p; each has a vector at each vertex
  /// For a level (number of smoothing iterations), returns one factor for each of the fields: the
  /// values φ_0(L), φ_1(L), … of the level functions.
  std::function<std::vector<double>(std::uint64_t level)> functions;
};

/// The fields of all heads at the vertices of one patch. A patch is a group of nearby vertices.
struct FieldPatch {
  /// the vertices of the patch, as ascending indices in the mesh
  std::span<const std::uint32_t> vertices;
  /// for each head: number of its leading fields that the patch stores
  std::span<const std::uint32_t> field_counts;
  /// number of stored fields of all heads: the sum of `field_counts`
  std::size_t field_count = 0;
  /// number of vertices at which fields are stored (the skeleton, see FieldPatches)
  std::size_t stored_vertex_count = 0;
  /// quantization step of each stored field: a power of two, or zero
  const float* quantization_steps = nullptr;
  /// #fields by values_per_field(), in multiples of the quantization step. For each field: x of all
  /// skeleton vertices, then all y, then all z, then zeros as padding.
  const std::int16_t* quantized_values = nullptr;
  /// #skeleton by kPatchVertices: the value of a field at vertex v is Σ_s weights[s][v]·(value at
  /// skeleton vertex s). Null if the skeleton consists of all vertices of the patch, in the order
  /// of `vertices`.
  const float* weights = nullptr;

  /// Whether the patch stores the fields at all its vertices, so that no interpolation is needed.
  bool stores_all_vertices() const { return stored_vertex_count == vertices.size(); }
  /// Number of 16-bit values stored for each field: 3 coordinates at each of the
  /// `stored_vertex_count` vertices, rounded up to a multiple of kPatchPadding.
  std::size_t values_per_field() const { return values_per_field(stored_vertex_count); }
  /// Like values_per_field(), for a given number of vertices at which fields are stored.
  static std::size_t values_per_field(std::size_t stored_vertex_count) {
    return (3 * stored_vertex_count + kPatchPadding - 1) / kPatchPadding * kPatchPadding;
  }
};

/// The number of patches of a mesh with this many vertices.
inline std::size_t patch_count(std::size_t vertex_count) {
  return (vertex_count + kPatchVertices - 1) / kPatchVertices;
}

/// The data of all patches, concatenated.
struct PatchArrays {
  /// all vertex indices of the mesh, each once, ordered by patch
  std::span<const std::uint32_t> vertices;
  /// one per patch: see FieldPatch::stored_vertex_count
  std::span<const std::uint32_t> stored_vertex_counts;
  /// #patches by #heads: see FieldPatch::field_counts
  std::span<const std::uint32_t> field_counts;
  /// the arrays of the same names in FieldPatch, one patch after the other
  std::span<const float> quantization_steps, weights;
  /// FieldPatch::quantized_values of all patches, one patch after the other
  std::span<const std::int16_t> quantized_values;
  std::shared_ptr<const void> memory_owner;  ///< owns the memory of all lists
};

/// The fields of several heads, compressed patch by patch. On a smooth patch the fields of all
/// heads are strongly correlated: the fields' values at a few vertices, the skeleton, determine the
/// values at the other vertices by weighted sums, with the same weights for all heads. This is an
/// interpolative decomposition (Cheng, Gimbutas, Martinsson & Rokhlin 2005) of a matrix with one
/// row per vertex of the patch and one column per coordinate of each field. Blending therefore sums
/// the fields at the skeleton only. A patch that does not compress stores all its vertices.
class FieldPatches {
 public:
  FieldPatches() = default;
  /// Makes the patches from stored lists, if the lists are valid.
  /// \param head_field_counts  number of fields of each head.
  /// \return       nothing if the lists are invalid. In valid lists, each vertex occurs once, the
  ///               lengths and counts agree with each other and with `head_field_counts`, and all
  ///               numbers are finite.
  static std::optional<FieldPatches> from_arrays(PatchArrays arrays, Index vertex_count,
                                                 std::span<const Index> head_field_counts);

  /// Number of patches.
  std::size_t size() const { return patches_.size(); }
  Index vertex_count() const { return static_cast<Index>(arrays_.vertices.size()); }
  std::size_t head_count() const { return heads_; }
  /// The data of one patch, which lie in `arrays()`.
  FieldPatch operator[](std::size_t patch) const;
  const PatchArrays& arrays() const { return arrays_; }

 private:
  /// The number of fields of a patch, and where the patch's data begins in the lists of `arrays_`.
  struct Patch {
    std::size_t field_count;  ///< see FieldPatch::field_count
    /// index of the patch's first entry in `quantization_steps`, `quantized_values` and `weights`
    std::size_t first_field, first_value, first_weight;
  };
  PatchArrays arrays_;          ///< the data of all patches
  std::size_t heads_ = 0;       ///< number of heads
  std::vector<Patch> patches_;  ///< where each patch's data lies in `arrays_`
};

/// Orders all vertices along a space-filling curve (hilbert_order). Patches are consecutive ranges
/// of this order. Runs of up to 32 vertices with consecutive numbers and small distances stay
/// together, so that blending writes a new head's vertices in longer contiguous pieces.
/// \param positions  #V by 3, any head of the topology.
/// \param max_distance  largest distance between consecutive vertices of a run, in the unit of the
///                   positions.
std::vector<std::uint32_t> vertex_order_for_patches(const Positions& positions,
                                                    double max_distance);

/// Compresses the fields of all heads patch by patch.
/// \param heads      at least one head; all of the same mesh.
/// \param levels     levels at which the error must not exceed `tolerance`.
/// \param order  all vertex indices, ordered so that consecutive vertices are close to each other;
///                   for example the result of vertex_order_for_patches.
/// \param tolerance  largest allowed compression error of any vertex of any head at any of the
///                   levels, in the unit of the positions. Rounding to quantization steps adds to
///                   this error; no step of a patch exceeds the largest step of the tiles that
///                   contain the patch's vertices.
/// \param progress   any thread calls this function with the number of patches that the thread has
///                   just finished. If the function throws an exception, the work stops.
FieldPatches interpolate_fields(
    std::span<const HeadSmoothing> heads, std::span<const std::uint64_t> levels,
    std::span<const std::uint32_t> order, double tolerance,
    const std::function<void(std::size_t patches)>& progress = [](std::size_t) {});

}  // namespace crowdface
