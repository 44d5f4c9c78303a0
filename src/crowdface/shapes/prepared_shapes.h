// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "crowdface/mesh/adjacency.h"
#include "crowdface/parts/ball_radii.h"
#include "crowdface/parts/head_axes.h"
#include "crowdface/parts/part_list.h"
#include "crowdface/region/region_weights.h"
#include "crowdface/shapes/frame_field.h"
#include "crowdface/shapes/gap_preserver.h"
#include "crowdface/shapes/lid_closure.h"
#include "crowdface/shapes/part_motion.h"
#include "crowdface/shapes/shape_set.h"
#include "crowdface/shapes/skin_crossings.h"

namespace crowdface {

/// An eye of the template, and the same eyeball in each head.
struct PreparedEye {
  std::size_t part;  ///< index into PreparedShapes::rigid_parts
  TemplateEye template_eye;
  std::vector<BallRadii> balls;  ///< for each head: the radii of this eyeball in the head
};

/// How a shape moves one rigid part.
struct PreparedPart {
  std::size_t part;                           ///< index into PreparedShapes::rigid_parts
  std::vector<std::uint32_t> moved_vertices;  ///< vertices of the part that the shape moves
  /// the row of each of `moved_vertices` in the shape's displacements
  std::vector<std::uint32_t> displacement_rows;
  std::vector<PartMotion> motions;  ///< the part's motion in each set of shapes
};

/// How a shape moves the lids of one eye.
struct PreparedLids {
  LidClosure lids;
  std::vector<LidClosure::LidTargets> targets;  ///< for each set of shapes: the targets of the lids
};

/// A vertex of a lash, or of another part that is bound to the skin of a lid. When LidClosure
/// corrects the lid's position, the vertex moves with the lid.
struct LidFollower {
  std::uint32_t row;  ///< the vertex's row in the shape's displacements
  /// for each corner of the skin triangle to which the vertex is bound: the corner's row in the
  /// shape's displacements, or kNoIndex if LidClosure never moves the corner
  std::array<std::uint32_t, 3> corner_rows;
  /// barycentric coordinates in the skin triangle to which the vertex is bound
  std::array<double, 3> barycentric;
};

/// Finds corrective shapes, which are meant to be applied together with another shape: ARKit's
/// `mouthClose` closes the lips while `jawOpen` opens the jaw. A shape is corrective if, applied
/// alone, it makes the lips overlap by several millimetres. The prerequisite of a corrective shape
/// is the other shape with which the lips overlap least; this shape must reduce the overlap to less
/// than half.
///
/// \param extent  Diagonal of the skin's bounding box.
/// \return        For each shape: the index of its prerequisite if the shape is corrective; nothing
///                if the shape is not corrective or no prerequisite is found.
std::vector<std::optional<std::size_t>> find_prerequisites(const ShapeSet& shape_set,
                                                           const GapPreserver& gap_preserver,
                                                           double extent);

/// One shape: the vertices and parts that it moves, and the data for its corrections on a face.
struct PreparedShape {
  /// only for a corrective shape: index of its prerequisite, see find_prerequisites. Lips and
  /// intersections are repaired after both shapes have been added.
  std::optional<std::size_t> prerequisite;
  /// one per row of the shape's displacements: index into PreparedShapes::moved_vertices
  std::vector<std::uint32_t> vertex_indices;
  /// #heads by #rows: displacements of each head's own version of the shape, normalised to the mean
  /// head; empty if all heads use the same set of shapes
  std::vector<FloatPositions> head_moves;
  std::vector<PreparedPart> parts;  ///< for each rigid part that the shape moves: how it moves
  std::vector<PreparedLids> lids;   ///< for each eye of the template: how the shape moves its lids
  std::vector<LidFollower> lid_followers;  ///< vertices, such as those of lashes, that follow lids
  SkinOverParts skin_over_parts;           ///< keeps skin in front of gums and teeth
  /// the part of the skin in which the shape may cause self-intersections
  SkinCrossings::SearchedSkin searched_skin;
  /// whether the shape moves skin at one of the gaps that GapPreserver preserves, such as the gap
  /// between the lips
  bool moves_gaps = false;
  /// #sets by #gaps: by how much the shape widens each gap, divided by the scale of the mesh
  /// relative to the template; empty unless `moves_gaps`
  std::vector<std::vector<double>> gap_changes;
};

/// The data that ShapeTransfer computes once for all faces: how the shapes of a template, or of
/// each head, move skin, parts, lids and lips.
struct PreparedShapes {
  /// For the parameters see ShapeTransfer.
  PreparedShapes(const HeadSet& all_heads, const Adjacency& adjacency, const PartList& parts,
                 const HeadAxes& head_axes, const ShapeSet& all_shapes,
                 const RegionWeights& regions);

  const HeadSet& head_set;
  const ShapeSet& shape_set;
  HeadAxes axes;
  VertexFaces vertex_faces;
  std::vector<std::uint32_t> skin;  ///< vertex indices of the skin, ascending
  std::vector<RigidPart> rigid_parts;
  /// #rigid_parts by #regions: mean region weights of the skin near each part
  std::vector<std::vector<double>> rigid_part_weights;
  std::vector<PreparedEye> eyes;
  /// indices of the vertices that at least one shape moves, ascending
  std::vector<std::uint32_t> moved_vertices;
  /// #moved_vertices by #regions: region weights of the skin nearest to each vertex
  RegionWeights::Alpha vertex_region_weights;
  /// preserves gaps between skin surfaces that almost touch, such as the lips
  GapPreserver gap_preserver;
  /// #gaps by #regions: region weights at one skin vertex of each gap of `gap_preserver`
  RegionWeights::Alpha gap_region_weights;
  FrameField frame_field;
  double extent = 0;  ///< diagonal of the bounding box of the template's skin
  /// indices of the vertices behind the skin of lips and cheeks, such as gums and teeth: the
  /// vertices of all parts except eyeballs, without the vertices near an eye
  std::vector<std::uint32_t> inner_vertices;
  SkinCrossings crossings;  ///< removes self-intersections of the skin from shapes
  /// Finds intersections of the skin with itself on a face at rest. Searches only the skin in which
  /// at least one shape may cause such intersections.
  CrossingSearch resting_face_search;
  std::vector<PreparedShape> shapes;

  /// A face, with the local rotation and stretch of its skin relative to the template's skin.
  struct FaceFrames {
    const Positions& mesh;
    FrameField::Frames frames;  ///< the motion and the linear maps from the template to the face
    std::vector<Eigen::Matrix3d> maps;  ///< linear map at each of PreparedShapes::moved_vertices
    std::vector<double> gaps;           ///< width of each gap on the face, see `gap_preserver`
    /// whether each vertex belongs to a triangle that intersects another triangle on the face at
    /// rest
    std::vector<bool> crosses_at_rest;
  };
  /// \param face  #V by 3, at rest; must outlive the result.
  FaceFrames make_face_frames(const Positions& face) const;
  /// Returns the mean of `maps` over `part.moved_vertices`.
  /// \param maps  FaceFrames::maps of a face.
  Eigen::Matrix3d mean_map_of_part(const PreparedPart& part, const PreparedShape& prepared,
                                   std::span<const Eigen::Matrix3d> maps) const;

 private:
  /// Sets `inner_vertices`.
  void find_inner_vertices(const PartList& parts);
  /// Appends a rigid part to `rigid_parts`. \param mean  The mean head.
  void add_part(const Part& part, const PartList& parts, const Positions& mean);
  /// Appends an eye to `eyes`. The eye's eyeball is the last entry of `rigid_parts`.
  /// \param ball  Shape of the eyeball on the mean head.
  /// \param mean  The mean head.
  void add_eye(const Part& part, const ComponentShape& ball, const Positions& mean);
  /// Looks up the region weights of skin and parts. Masks do not cover lashes and eyeballs, so
  /// these get the weights of the nearest skin.
  void look_up_regions(const RegionWeights& regions);
  /// Fills all members of `prepared` except those that add_data_of_sets measures.
  /// \param moves  Displacements of the shape.
  void prepare_shape(const Displacements& moves, const Adjacency& adjacency,
                     PreparedShape& prepared) const;
  /// Sets `prepared.lids` (without targets) and `prepared.lid_followers`.
  void prepare_lids(const Displacements& moves, const Adjacency& adjacency,
                    PreparedShape& prepared) const;
  /// Returns the part of the skin in which the shape may cause intersections on blended heads.
  SkinCrossings::SearchedSkin find_searched_skin(const Displacements& moves,
                                                 const PreparedShape& prepared) const;
  /// Adds to `shapes` the data that depend on the sets of shapes: how the shapes of each set move
  /// parts, lids and lips (see add_data_of_set), and the heads' own shapes (see normalised_moves).
  void add_data_of_sets();
  /// Returns the displacements of one shape in one set of shapes.
  Displacements shape_of_set(std::size_t set, std::size_t shape) const;
  /// Adds to `prepared` the data of this shape in one set of shapes: how the shape moves parts,
  /// lids and lips, and which intersections to ignore.
  /// \param rest   The mesh to which the shape is added.
  /// \param shape  Displacements of the shape in this set.
  void add_data_of_set(const FaceFrames& face_frames, const Positions& rest,
                       const Displacements& shape, std::span<const FaceEye> face_eyes,
                       PreparedShape& prepared) const;
  /// Transforms a head's displacements to the mean head: undoes the local rotation and stretch by
  /// which the head differs from the mean head.
  FloatPositions normalised_moves(const FaceFrames& face_frames, const PreparedShape& prepared,
                                  const Positions& moves) const;
};

}  // namespace crowdface
