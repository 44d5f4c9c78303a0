// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "crowdface/mesh/adjacency.h"
#include "crowdface/parts/ball_map.h"
#include "crowdface/parts/contact_place.h"
#include "crowdface/parts/eye_socket.h"
#include "crowdface/parts/rigid_motion.h"
#include "crowdface/shapes/shape_set.h"

namespace crowdface {

/// An eye of the template.
struct TemplateEye {
  BallMap ball;
  Lids lids;
  std::vector<std::uint32_t> skin;  ///< vertices around the eye, ascending
};

/// An eyeball of a face: the radius map of a head's eyeball, the motion that carries this eyeball
/// from the head to the face, and the distances between the surrounding skin and the eyeball at
/// rest.
struct FaceEye {
  const BallMap* ball;
  RigidMotion motion;
  std::vector<double> rest_gaps = {};  ///< #skin of the TemplateEye

  BallMap::Gap gap_at(const Eigen::Vector3d& point) const;
};
/// Makes the FaceEye of one eye of a face.
/// \param mesh  The face at rest, #V by 3.
FaceEye face_eye(const TemplateEye& eye, const BallMap& ball, const RigidMotion& motion,
                 const Positions& mesh);

/// Assigns the skin around an eye to the lid with the nearest rim vertex: 1 for the upper lid, −1
/// for the lower lid. Leaves other entries unchanged.
///
/// \param side  #V.
void lid_sides(const TemplateEye& eye, const Positions& neutral, std::vector<signed char>& side);

/// Adjusts how a shape moves the lids of one eye, so that a blink closes eyes of any size. With the
/// local linear maps alone, lids would stay open or overlap by millimetres: the opening is not part
/// of the skin, so no map measures its height. Where the shape closes the lids on the template,
/// this class scales the lids' vertical movement until the gap on the face equals the gap on the
/// template. The class also keeps the lids outside the eyeball, as on the template.
class LidClosure {
 public:
  /// \param shape  Shape of the template. Some of its vertices may be skin around the eye.
  LidClosure(const TemplateEye& eye, const Adjacency& adjacency, const Positions& neutral,
             const Displacements& shape, const HeadAxes& axes);

  /// Returns whether the shape leaves this eye's lids unmoved.
  bool empty() const { return lids_.empty(); }

  /// Gap between the rims of both lids at one place; negative where the upper lid is below the
  /// lower lid.
  struct Gap {
    double paired;    ///< gap between points that lie above each other on the template
    double vertical;  ///< vertical distance from the point of the upper rim to the lower rim
  };
  /// The gaps and distances that a face's lids should have: measured on a mesh with a known shape,
  /// and divided by the mesh's scale relative to the template.
  struct Goals {
    std::vector<Gap> gaps;  ///< #places
    /// #lids: each lid vertex's distance from the eyeball in the shape, and the difference between
    /// this distance and the distance at rest
    std::vector<double> ball_distances, distance_changes;
  };
  /// Measures the goals on a mesh.
  ///
  /// \param mesh   #V by 3, at rest.
  /// \param whole  Motion from the template to the mesh.
  /// \param moves  The mesh's displacements, with the rows of the shape.
  Goals goals(const Positions& mesh, const FaceEye& eye, const RigidMotion& whole,
              const Positions& moves) const;
  /// Returns the weighted mean of the goals of several sets of shapes.
  static Goals mean(std::span<const Goals> goals, std::span<const SetShare> shares);
  /// Returns whether the shape closes the lids.
  bool closes() const { return !places_.empty(); }
  /// Returns the rows of the shape's displacements that `fit` may change.
  std::vector<std::uint32_t> rows() const;

  /// Returns the largest gap, over all places, between lids that the shape should close, in radii
  /// of the eyeball. Gaps that are small enough to count as closed give 0.
  double opening(const Positions& face, const RigidMotion& whole, const Goals& goals,
                 const Positions& moves) const;
  /// Closes lids that other corrections have opened again, by scaling the vertical movement.
  void close_again(const Positions& face, const RigidMotion& whole, const Goals& goals,
                   Positions& moves) const;

  /// Adjusts a shape until it meets the goals.
  ///
  /// \param face   #V by 3, at rest.
  /// \param whole  Motion from the template to the face.
  /// \param moves  Displacements of the face, with the rows of the shape; adjusted.
  void fit(const Positions& face, const FaceEye& eye, const RigidMotion& whole, const Goals& goals,
           Positions& moves) const;
  /// Moves lid vertices out of the eyeball.
  ///
  /// \return  false if any vertex was noticeably too deep.
  bool keep_out(const Positions& face, const FaceEye& eye, const RigidMotion& whole,
                const Goals& goals, Positions& moves) const;

 private:
  /// A point of a lid's profile, on an edge of the mesh. Each row is the row of an end of the edge
  /// in the shape, or kNoIndex if this end does not move.
  struct Point {
    EdgePoint edge;
    std::uint32_t row_a, row_b;
  };
  struct LidPlace {
    std::vector<Point> low, high;
    double along;   ///< position along the lid opening
    double closed;  ///< length by which the shape narrows the gap on the template
  };
  /// Unit vectors of a face's eye: along the opening, and from the lower lid to the upper lid.
  struct EyeAxes {
    Eigen::Vector3d along, up;
  };
  /// A point of a lid's rim, in the plane of EyeAxes.
  struct RimPoint {
    double along, height;
  };
  struct LidVertex {
    std::uint32_t row, vertex;
    std::uint32_t number;  ///< index among the skin around the eye
    /// how strongly closing moves this vertex: 1 near the eye, less farther away
    double share;
    double hold;  ///< how strongly the vertex is kept off the eyeball: 1 near its surface
  };

  void add_places(const TemplateEye& eye, const Adjacency& adjacency, const Positions& neutral,
                  const Displacements& shape, const HeadAxes& axes);
  void put_profiles_first();
  std::span<const double> gain_effects(std::size_t lid) const {
    return {gain_effects_.data() + lid * places_.size(), places_.size()};
  }
  /// Applies gains to the vertical movement of the first `count` lid vertices.
  void close(std::size_t count, const Eigen::Vector3d& up, const Positions& carried,
             std::span<const double> gains, Positions& moves) const;
  /// Returns the smallest allowed distance of a lid vertex from the eyeball (negative: depth): the
  /// smallest of its distance at rest, its distance in the shape, and a small margin.
  double min_gap(std::size_t lid, double rest, double scale, const Goals& goals) const;
  void keep_off_ball(std::size_t count, const Positions& face, const FaceEye& eye, double scale,
                     const Goals& goals, Positions& moves) const;
  EyeAxes axes_on(const RigidMotion& whole) const;
  static RimPoint rim_point(const std::vector<Point>& points, double sign, const EyeAxes& axes,
                            const Positions& face, const Positions& moves);
  /// Returns, for each place, the current gap minus the wanted gap.
  static std::vector<double> missing_gaps(const std::vector<Gap>& now, const Goals& goals,
                                          double scale);
  std::vector<Gap> gaps(const EyeAxes& axes, const Positions& face, const Positions& moves) const;

  HeadAxes axes_;
  double radius_ = 0;
  std::vector<LidPlace> places_;
  std::vector<LidVertex> lids_;
  std::size_t in_profiles_ = 0;  ///< number of lid vertices in profiles; they come first in `lids_`
  /// #lids by #places: weight with which each place's gain moves each lid vertex
  std::vector<double> gain_effects_;
};

}  // namespace crowdface
