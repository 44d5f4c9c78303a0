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

/// The levels of a head as fields: S̃_L x = x + Σ_p φ_p(L)·c_p, fitted once (LevelBasis, or the
/// paper's CubicFit).
struct HeadLevels {
  LevelFields fields;                                                 ///< c_p
  std::function<std::vector<double>(std::uint64_t level)> functions;  ///< φ_0(L), φ_1(L), …
};

/// All heads' fields at some neighbouring vertices.
struct FieldPatch {
  std::span<const std::uint32_t> vertices;  ///< ascending
  std::span<const std::uint32_t> counts;  ///< #heads: how many of a head's first fields stand here
  std::size_t fields = 0;                 ///< of all heads
  std::size_t skeleton = 0;               ///< vertices that fields are told at
  const float* steps = nullptr;           ///< #fields: powers of two, or zero
  /// #fields by values(): x of all vertices of the skeleton, y, z, zeros; whole numbers of steps.
  const std::int16_t* numbers = nullptr;
  /// #skeleton by kPatchVertices: a field at a vertex is the sum of the skeleton's, each times its weight there.
  /// None if the skeleton is all vertices, in their order.
  const float* weights = nullptr;

  bool is_whole() const { return skeleton == vertices.size(); }
  std::size_t values() const { return values_of(skeleton); }
  static std::size_t values_of(std::size_t skeleton) {
    return (3 * skeleton + kPatchStep - 1) / kPatchStep * kPatchStep;
  }
};

/// Patches of a mesh of so many vertices.
inline std::size_t patch_count(std::size_t vertices) {
  return (vertices + kPatchVertices - 1) / kPatchVertices;
}

/// What patches are made of, one after the other.
struct PatchLists {
  std::span<const std::uint32_t> vertices;   ///< #V, each once
  std::span<const std::uint32_t> skeletons;  ///< #patches: vertices of each
  std::span<const std::uint32_t> counts;     ///< #patches by #heads
  std::span<const float> steps, weights;
  std::span<const std::int16_t> numbers;
  std::shared_ptr<const void> owner;  ///< of all of them
};

/// Fields of several heads, on patches of the surface. Heads of one topology are alike where they are smooth: what all
/// fields have at a few vertices of a patch, its skeleton, tells what they have at the others, as weighted sums with the
/// same weights for all of them. This is an interpolative decomposition (Cheng, Gimbutas, Martinsson & Rokhlin 2005) of
/// the matrix of the patch's vertices by all fields' coordinates. So blending adds up all heads' fields at the
/// skeleton only. A patch whose vertices are not alike keeps them all.
class FieldPatches {
 public:
  FieldPatches() = default;
  /// \return nothing unless these are lists that `interpolate_fields` could make of heads with so many fields.
  static std::optional<FieldPatches> of(PatchLists lists, Index vertex_count,
                                        std::span<const Index> ranks);

  std::size_t size() const { return places_.size(); }
  Index vertex_count() const { return static_cast<Index>(lists_.vertices.size()); }
  std::size_t head_count() const { return heads_; }
  FieldPatch operator[](std::size_t patch) const;
  const PatchLists& lists() const { return lists_; }

 private:
  struct Place {
    std::size_t fields, field, number, weight;
  };
  PatchLists lists_;
  std::size_t heads_ = 0;
  std::vector<Place> places_;
};

/// All vertices in an order for patches, along a curve through space (hilbert_order): but stretches of some that follow
/// each other in the mesh, and are near each other, stay together, so that faces are written in longer pieces.
/// \param positions  #V by 3, any head of the topology
/// \param near       in the positions' unit
std::vector<std::uint32_t> patch_order(const Positions& positions, double near);

/// \param heads      at least one, of the same mesh
/// \param levels     that errors are bounded at
/// \param order      #V: all vertices, those that follow each other near each other (patch_order)
/// \param tolerance  no vertex misses any of the levels of any head by more (without rounding: numbers are rounded once
///                   more to the steps of the patch, none of which exceeds the largest of its vertices' tiles), in the
///                   positions' unit.
/// \param progress   told of patches as they are done, by any thread; what it throws ends the work
FieldPatches interpolate_fields(
    std::span<const HeadLevels> heads, std::span<const std::uint64_t> levels,
    std::span<const std::uint32_t> order, double tolerance,
    const std::function<void(std::size_t patches)>& progress = [](std::size_t) {});

}  // namespace crowdface
