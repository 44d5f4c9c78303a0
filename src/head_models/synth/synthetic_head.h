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
/// or insides of the lids, mouth, nostrils, neck). The shape is modelled by hand in code, without
/// scan data.
class SyntheticHeads {
 public:
  enum class Parts {
    kSkin,          ///< one surface: the skin continues over the fronts of the eyeballs
    kEyesAndTeeth,  ///< two eyeballs and two rows of teeth are separate components
  };
  enum class Scalp {
    kBare,    ///< no hair
    kHaired,  ///< a hair layer on the scalp, in the style that SyntheticSkins paints
    kShorn,   ///< a hair layer of at most 2 mm, for use below hair cards (synth/hair_cards.h)
  };
  /// \param vertices  desired number, 5,000 … 1,200,000. The result differs by at most 10 %.
  /// \throws BrokenPrecondition if `vertices` is outside this range.
  explicit SyntheticHeads(Index vertices, Parts parts = Parts::kSkin, Scalp scalp = Scalp::kBare);

  /// A connected component of the mesh: its name and the index of its first polygon.
  struct Piece {
    std::string name;
    Index first_face = 0;
  };
  /// Returns the components in ascending order of their first polygons.
  std::vector<Piece> pieces() const;

  /// Returns the topology, the same for every seed. Each corner has a texture coordinate.
  const Topology& topology() const { return topology_; }
  /// Returns the texture coordinates: #T by 2 in [0, 1]², one tile without overlaps, with a seam
  /// down the back of the head.
  const TextureCoordinates& uvs() const { return uvs_; }

  /// Returns the vertices of head number `index` of a seed: #V by 3, cm. +Y is up, the head faces
  /// +Z, the origin is inside the head at the height of the eyes. The surface is the same at every
  /// resolution, and the bits are the same on every machine.
  Positions positions(std::uint64_t seed, std::uint64_t index) const;
  /// Returns the typical edge length in cm. The mesh contains no relief finer than this length.
  double edge_cm() const { return edge_cm_; }
  /// Returns the average head, without hair and relief: #V by 3, cm. Hair cards are made for this
  /// head.
  Positions average() const;
  /// Returns a body for the heads: shoulders and chest below the rim of the average head, cm, with
  /// texture coordinates of its own. The first vertices are the vertices of the rim.
  Mesh body() const;

 private:
  Topology topology_;
  TextureCoordinates uvs_;
  double edge_cm_ = 0;                  ///< typical edge length of the mesh, see edge_cm()
  std::vector<synth::SkinPoint> mean_;  ///< the average head: one point per vertex of the skin
  std::vector<std::uint32_t> rim_;  ///< vertices of the neck's rim, counter-clockwise from above
  Scalp scalp_;
  std::optional<synth::LooseParts> loose_;  ///< eyeballs and teeth, if they are separate
};

/// Returns a region mask for the synthetic heads. One mask fits meshes of every resolution, because
/// all have the same texture coordinates. The mask has 3 bytes per pixel, row by row, first row at
/// v = 1. The bytes of a pixel are the weights of three regions: top (brows and above), middle
/// (eyes and nose), bottom (mouth and below). The three weights sum to 255 and have smooth
/// transitions.
/// \param size  width and height of the mask in pixels.
/// \throws BrokenPrecondition if size < 1.
std::vector<std::uint8_t> synthetic_region_mask(int size);

}  // namespace crowdface
