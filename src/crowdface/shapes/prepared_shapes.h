// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "crowdface/mesh/adjacency.h"
#include "crowdface/parts/ball_map.h"
#include "crowdface/parts/head_axes.h"
#include "crowdface/parts/part_list.h"
#include "crowdface/region/region_weights.h"
#include "crowdface/shapes/frame_field.h"
#include "crowdface/shapes/kept_contacts.h"
#include "crowdface/shapes/lid_closure.h"
#include "crowdface/shapes/rigid_turn.h"
#include "crowdface/shapes/shape_set.h"
#include "crowdface/shapes/skin_crossings.h"

namespace crowdface {

/// An eye of the template, and its eyeball in each head.
struct ActingEye {
  std::size_t part;  ///< of the rigid ones
  TemplateEye of_template;
  std::vector<BallMap> balls;  ///< #heads
};

/// A rigid part in a shape.
struct PartMove {
  std::size_t part;
  std::vector<std::uint32_t> rows, vertices;
  std::vector<RigidTurn> turns;  ///< #sets
};

/// The lids of an eye in a shape.
struct LidMove {
  LidClosure lids;
  std::vector<LidClosure::Goals> goals;  ///< #sets
};

/// A vertex of a bound part that goes along with lids.
struct Hanging {
  std::uint32_t row;
  std::array<std::uint32_t, 3> rows;  ///< of the skin it hangs on, or kNoIndex
  std::array<double, 3> shares;
};

/// #shapes: of those that take lips far through each other, such as ARKit's `mouthClose`, the one to which they are
/// made to be added: that with which lips go through each other least, and half as far at most.
/// \param extent  of the skin
std::vector<std::optional<std::size_t>> companions_of(const ShapeSet& set,
                                                      const KeptContacts& contacts, double extent);

/// One shape: what it moves, and what is to come of that on a face.
struct PreparedShape {
  std::optional<std::size_t> companion;  ///< lips and crossings are mended where that is added
  std::vector<std::uint32_t> used;       ///< #rows: numbers among the used vertices
  std::vector<SingleRows> of_head;       ///< #heads by #rows, as on the mean head; empty: one set
  std::vector<PartMove> parts;
  std::vector<LidMove> lids;  ///< of the eyes
  std::vector<Hanging> hanging;
  SkinOverParts over_parts;
  SkinCrossings::Watched watched;
  bool moves_contacts = false;
  std::vector<std::vector<double>> widening;  ///< #sets, if it does: of the gaps between lips
};

/// All that ShapeTransfer finds once: what a template's or heads' shapes do to skin, parts, lids and lips.
struct PreparedShapes {
  /// As ShapeTransfer has them.
  PreparedShapes(const FaceSet& all_faces, const Adjacency& adjacency, const PartList& parts,
                 const HeadAxes& head_axes, const ShapeSet& shape_set,
                 const RegionWeights& regions);

  const FaceSet& faces;
  const ShapeSet& set;
  HeadAxes axes;
  FacesAround around;
  std::vector<std::uint32_t> skin;  ///< ascending
  std::vector<RigidPart> rigid;
  std::vector<std::vector<double>> rigid_alpha;  ///< #rigid by #regions, of the skin at them
  std::vector<ActingEye> eyes;
  std::vector<std::uint32_t> used;  ///< vertices that some shape moves
  RegionWeights::Alpha alpha;       ///< #used by #regions: of the skin nearest to them
  KeptContacts contacts;
  RegionWeights::Alpha contact_alpha;  ///< #contacts by #regions
  FrameField field;
  double extent = 0;                 ///< of the template's skin
  std::vector<std::uint32_t> inner;  ///< vertices of parts away from eyes: gums and teeth
  SkinCrossings crossings;
  CrossingSearch watched;  ///< of any shape
  std::vector<PreparedShape> shapes;

  /// A face, and how it is turned and stretched.
  struct Carrier {
    const Positions& mesh;
    FrameField::Frames frames;
    std::vector<Eigen::Matrix3d> maps;  ///< #used
    std::vector<double> gaps;           ///< #contacts
    std::vector<bool> at_rest;          ///< #V: at crossings of its skin
  };
  Carrier carrier_to(const Positions& face) const;
  /// Of a part's skin, the mean.
  Eigen::Matrix3d map_of(const PartMove& part, const PreparedShape& state,
                         std::span<const Eigen::Matrix3d> maps) const;

 private:
  void find_inner(const PartList& parts);
  void add_part(const Part& part, const PartList& parts, const Positions& mean);
  void add_eye(const Part& part, const ComponentShape& ball, const Positions& mean);
  void look_up_regions(const RegionWeights& regions);
  void bind(const Displacements& moves, const Adjacency& adjacency, PreparedShape& state) const;
  void bind_lids(const Displacements& moves, const Adjacency& adjacency,
                 PreparedShape& state) const;
  SkinCrossings::Watched watch(const Displacements& moves, const PreparedShape& state) const;
  void add_sets();
  Displacements shape_of_set(std::size_t number, std::size_t shape) const;
  /// \param rest  what the shape is added to
  void add_set(const Carrier& carrier, const Positions& rest, const Displacements& shape,
               std::span<const FaceEye> at_eyes, PreparedShape& state) const;
  SingleRows undone(const Carrier& carrier, const PreparedShape& state,
                    const Positions& moves) const;
};

}  // namespace crowdface
