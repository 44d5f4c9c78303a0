// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "crowdface/mesh/topology.h"
#include "head_models/synth/loose_parts.h"
#include "head_models/synth/mean_head.h"

namespace crowdface {

/// Synthetic human heads in one quad-only topology: skull, brows, lids, nose, lips, ears, jaw and
/// neck, of both sexes and several ages. The skin is one component with six open boundaries (pupils
/// or the lids' linings, mouth, nostrils, neck). The layout is hand-made here, no scan is part of it.
class SyntheticHeads {
 public:
  enum class Parts {
    kSkin,          ///< eyes are cut into the skin, as sculptors do
    kEyesAndTeeth,  ///< two eyeballs and two rows of teeth are components of their own
  };
  enum class Scalp {
    kBare,    ///< skin alone
    kHaired,  ///< hair as a layer on it, in the style that fits the painted one (SyntheticSkins)
    kShorn,   ///< no more of it than lies under hair in cards (synth/hair_cards.h)
  };
  /// \param vertices  wanted number, 5,000 … 1,200,000; nearest the layout can give, within 10 %.
  /// \throws BrokenPrecondition outside that range.
  explicit SyntheticHeads(Index vertices, Parts parts = Parts::kSkin, Scalp scalp = Scalp::kBare);

  /// A component's name and the first of its faces, ascending.
  struct Piece {
    std::string name;
    Index first_face = 0;
  };
  std::vector<Piece> pieces() const;

  /// The same for every seed. Each corner has a texture coordinate.
  const Topology& topology() const { return topology_; }
  /// #T by 2 in [0, 1]², one tile without overlaps, cut open down the back of the head.
  const TextureCoordinates& uvs() const { return uvs_; }

  /// Head number `index` of a seed: #V by 3 in centimetres, +Y up, looking along +Z, the origin
  /// between the eyes' height and the ears. The same surface at every resolution, the same bits on
  /// every machine.
  Positions positions(std::uint64_t seed, std::uint64_t index) const;
  /// The usual length of an edge, centimetres: finer relief the mesh does not have.
  double edge_cm() const { return edge_cm_; }
  /// The average head, bare and smooth, on which hair in cards sits.
  Positions average() const;

 private:
  Topology topology_;
  TextureCoordinates uvs_;
  double edge_cm_ = 0;
  std::vector<synth::SkinPoint> mean_;
  Scalp scalp_;
  std::optional<synth::LooseParts> loose_;
};

/// A region mask that fits the heads' texture coordinates at every resolution: `size` × `size` × 3
/// bytes, row by row, first row at v = 1; channels top (brows and above), middle (eyes and nose),
/// bottom (mouth and below), which add up to 255 and run softly into one another.
/// \throws BrokenPrecondition if size < 1.
std::vector<std::uint8_t> synthetic_region_mask(int size);

}  // namespace crowdface
