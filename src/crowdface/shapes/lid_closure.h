// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "crowdface/mesh/adjacency.h"
#include "crowdface/parts/ball_radii.h"
#include "crowdface/parts/eye_socket.h"
#include "crowdface/parts/gap_section.h"
#include "crowdface/parts/rigid_motion.h"
#include "crowdface/shapes/shape_set.h"

namespace crowdface {

/// An eye of the template.
struct TemplateEye {
  BallRadii ball;  ///< radius of the eyeball in each direction
  Lids lids;
  std::vector<std::uint32_t> skin_vertices;  ///< indices of skin vertices around the eye, ascending
};

/// An eyeball of a face. The eyeball is a copy of the eyeball of one input head: `motion` carries
/// it from the head to the face.
struct FaceEye {
  const BallRadii* ball;  ///< radii of the head's eyeball
  RigidMotion motion;     ///< moves the eyeball from its position in the head to that in the face
  /// distance of each of TemplateEye::skin_vertices from the eyeball on the face at rest
  std::vector<double> rest_gaps = {};

  /// Returns the gap between the eyeball and a point of the face.
  BallRadii::Gap gap_at(const Eigen::Vector3d& point) const;
};
/// Makes the FaceEye of one eye of a face.
/// \param mesh  The face at rest, #V by 3.
FaceEye make_face_eye(const TemplateEye& eye, const BallRadii& ball, const RigidMotion& motion,
                      const Positions& mesh);

/// Assigns each skin vertex around an eye to the lid with the nearest rim vertex: writes 1 for the
/// upper lid and −1 for the lower lid. Leaves the entries of all other vertices unchanged.
///
/// \param lid_sides  #V; modified.
void mark_lid_sides(const TemplateEye& eye, const Positions& neutral,
                    std::vector<signed char>& lid_sides);

/// Adjusts how a shape moves the lids of one eye, so that a blink closes eyes of any size. With the
/// local linear maps alone, lids would stay open or overlap by millimetres: the opening between the
/// lids has no skin, so no map follows the opening's height. Where the shape closes the lids on the
/// template, this class scales the lids' vertical movement until the gap on the face equals the gap
/// on the template. The class also keeps the lids outside the eyeball, as on the template.
class LidClosure {
 public:
  /// \param shape  A shape of the template, which may or may not move skin around the eye.
  LidClosure(const TemplateEye& eye, const Adjacency& adjacency, const Positions& neutral,
             const Displacements& shape, const HeadAxes& axes);

  /// Returns whether the shape leaves this eye's lids unmoved.
  bool empty() const { return lid_vertices_.empty(); }

  /// Two measures of the gap between the lids, at one section across the eye's opening. Both are
  /// negative if the upper lid is below the lower lid.
  struct Gap {
    /// gap between the section's two rim points, which lie above each other on the template
    double section_gap;
    /// vertical distance from the section's point on the upper rim down to the lower rim
    double vertical_gap;
  };
  /// The lengths that the lids of a face should have while the shape is applied: gaps between the
  /// lids, and distances of the lids from the eyeball. measure_targets measures these lengths on a
  /// mesh for which the shape was made (the template or a head), and divides them by the scale of
  /// this mesh relative to the template.
  struct LidTargets {
    std::vector<Gap> gaps;  ///< the gap between the lids at each section
    /// One entry per lid vertex. `ball_distances`: distance from the eyeball with the shape
    /// applied. `distance_changes`: the distance with the shape applied minus the distance at rest.
    std::vector<double> ball_distances, distance_changes;
  };
  /// Measures LidTargets on a mesh for which the blend shape was made: on the template or on a
  /// head.
  ///
  /// \param mesh   The template or the head at rest, #V by 3.
  /// \param face_motion  Motion from the template to the mesh.
  /// \param moves  The displacements by which the shape moves the mesh, one row for each moved
  ///               vertex.
  LidTargets measure_targets(const Positions& mesh, const FaceEye& eye,
                             const RigidMotion& face_motion, const Positions& moves) const;
  /// Returns the weighted mean of targets. Each head may have its own set of shapes; `targets` are
  /// the targets that were measured for each set.
  /// \param shares  the sets, and their weights.
  static LidTargets mean_targets(std::span<const LidTargets> targets,
                                 std::span<const ShapeSetShare> shares);
  /// Returns whether the shape closes the lids.
  bool closes_lids() const { return !sections_.empty(); }
  /// Returns the indices of the rows in the shape's displacements that `fit_lids` may change.
  std::vector<std::uint32_t> adjustable_rows() const;

  /// Returns the largest excess of a section's gap over the allowed gap, in radii of the eyeball; 0
  /// if no gap is too large. The allowed gap is the larger of two gaps: the target gap, and the gap
  /// that counts as closed. Only for shapes that close the lids.
  double largest_open_gap(const Positions& face, const RigidMotion& face_motion,
                          const LidTargets& targets, const Positions& moves) const;
  /// Closes lids that other corrections have opened, by scaling the lids' vertical movement.
  void restore_closure(const Positions& face, const RigidMotion& face_motion,
                       const LidTargets& targets, Positions& moves) const;

  /// Adjusts the displacements by which the shape moves a face. Afterwards, the gaps between the
  /// lids and the distances of the lids from the eyeball are about equal to `targets`.
  ///
  /// \param face   #V by 3, at rest.
  /// \param face_motion  Motion from the template to the face.
  /// \param moves  Displacements of the face, one row for each vertex of the shape; adjusted.
  void fit_lids(const Positions& face, const FaceEye& eye, const RigidMotion& face_motion,
                const LidTargets& targets, Positions& moves) const;
  /// Moves lid vertices that are too deep in the eyeball outwards.
  ///
  /// \return  false if any vertex was noticeably too deep before this call.
  bool move_out_of_eyeball(const Positions& face, const FaceEye& eye,
                           const RigidMotion& face_motion, const LidTargets& targets,
                           Positions& moves) const;

 private:
  /// A point of a lid's profile, on an edge of the mesh.
  struct ProfilePoint {
    EdgePoint edge;
    /// row of each of the edge's two ends in the shape's displacements; kNoIndex for an end that
    /// the shape does not move
    std::uint32_t row_a, row_b;
  };
  /// A section across the eye's opening, where a plane cuts both lids. A profile is the curve that
  /// the plane cuts out of a lid.
  struct LidSection {
    /// points of the lower and of the upper lid at which the plane cuts mesh edges
    std::vector<ProfilePoint> lower_profile, upper_profile;
    double along_opening;  ///< coordinate of the cutting plane along the head's side axis
    /// length by which the shape narrows the gap on the template
    double gap_reduction_on_template;
  };
  /// Unit vectors on a face: `along` the lid opening, and `up` from the lower lid to the upper lid.
  struct EyeAxes {
    Eigen::Vector3d along, up;
  };
  /// A point of a lid's rim, given by two coordinates along the axes of EyeAxes.
  struct RimPoint {
    double along_opening;  ///< coordinate along EyeAxes::along
    double height;         ///< coordinate along EyeAxes::up
  };
  /// A vertex of the skin around the eye. The shape moves this vertex.
  struct LidVertex {
    std::uint32_t row, vertex;  ///< row in the shape's displacements, and the vertex of this row
    std::uint32_t skin_index;   ///< index into TemplateEye::skin_vertices
    /// how strongly closing moves this vertex: 1 near the eye, less farther away
    double closing_weight;
    /// how strongly the vertex is kept outside the eyeball: 1 near the eyeball's surface, 0 far
    /// away
    double eyeball_weight;
  };

  /// Sets `sections_`: the sections at which the shape closes the lids.
  void add_sections(const TemplateEye& eye, const Adjacency& adjacency, const Positions& neutral,
                    const Displacements& shape, const HeadAxes& axes);
  /// Reorders lid_vertices_: the vertices of the sections' profiles come first.
  void move_profile_vertices_to_front();
  /// Returns the weights of `lid_vertices_[lid]`, one for each of `sections_`: how much the gain of
  /// the lids at this section changes the vertical movement of the vertex (see move_lids).
  std::span<const double> section_weights(std::size_t lid) const {
    return {section_weights_.data() + lid * sections_.size(), sections_.size()};
  }
  /// Multiplies the vertical movement of each of the first `count` lid vertices by 1 + Σ w_s g_s.
  /// Here, g_s is the gain of the lid section s, and w_s is the vertex's weight for this section
  /// (see section_weights).
  /// \param up              unit vector from the lower lid to the upper lid.
  /// \param unscaled_moves  displacements before scaling, one row for each vertex that the shape
  ///                        moves.
  /// \param gains           relative increase of the vertical movement at each of `sections_`.
  /// \param moves           receives the displacements after scaling.
  void move_lids(std::size_t count, const Eigen::Vector3d& up, const Positions& unscaled_moves,
                 std::span<const double> gains, Positions& moves) const;
  /// Returns the smallest allowed distance of a lid vertex from the eyeball; negative inside. This
  /// is the smallest of three distances: the vertex's distance at rest, the vertex's target
  /// distance, and a small margin. A target distance deep inside the eyeball is replaced by the
  /// distance at the largest allowed depth.
  /// \param lid            index of the vertex in lid_vertices_.
  /// \param rest_distance  the vertex's distance on the face at rest.
  /// \param scale          scale of the face relative to the template.
  double min_ball_distance(std::size_t lid, double rest_distance, double scale,
                           const LidTargets& targets) const;
  /// Moves each of the first `count` lid vertices along the eyeball's normal. The vertex's wanted
  /// distance from the eyeball is the larger of two distances: min_ball_distance, and the vertex's
  /// distance at rest plus its change in LidTargets::distance_changes. The vertex moves by
  /// LidVertex::eyeball_weight times (wanted distance − current distance).
  void keep_outside_eyeball(std::size_t count, const Positions& face, const FaceEye& eye,
                            double scale, const LidTargets& targets, Positions& moves) const;
  /// Returns the axes of the eye on the face that `face_motion` belongs to.
  EyeAxes eye_axes(const RigidMotion& face_motion) const;
  /// Returns the highest point of a lower lid's profile (`sign` = 1), or the lowest point of an
  /// upper lid's profile (`sign` = −1), after the displacements `moves`.
  static RimPoint rim_point(const std::vector<ProfilePoint>& points, double sign,
                            const EyeAxes& axes, const Positions& face, const Positions& moves);
  /// Returns, for each section, the larger of two lengths: the length by which section_gap exceeds
  /// its target, and the length by which vertical_gap exceeds its target. A negative target of
  /// vertical_gap counts as 0.
  static std::vector<double> gap_excesses(const std::vector<Gap>& now, const LidTargets& targets,
                                          double scale);
  /// Returns the gap at each section of a face with the displacements `moves` of the shape.
  std::vector<Gap> measure_gaps(const EyeAxes& axes, const Positions& face,
                                const Positions& moves) const;

  HeadAxes axes_;
  double radius_ = 0;                 ///< radius of the template's eyeball
  std::vector<LidSection> sections_;  ///< the sections at which the shape closes the lids
  /// The skin vertices around the eye that the shape moves. The vertices on whose edges the points
  /// of the lid profiles lie (see LidSection) come first.
  std::vector<LidVertex> lid_vertices_;
  /// number of lid vertices that belong to profiles; these come first in lid_vertices_
  std::size_t profile_vertex_count_ = 0;
  /// #lid_vertices_ by #sections_: for each lid vertex, a weight for each section. The vertical
  /// movement of the vertex is multiplied by 1 + the weighted sum of the sections' gains (see
  /// move_lids).
  std::vector<double> section_weights_;
};

}  // namespace crowdface
