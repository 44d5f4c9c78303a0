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
  std::vector<std::uint32_t> skin;  ///< around the eye, ascending
};

/// An eyeball of a face: a map of one, the motion that carries it there, and how far the skin around is from it at
/// rest.
struct FaceEye {
  const BallMap* ball;
  RigidMotion motion;
  std::vector<double> rest_gaps = {};  ///< #skin of the template's eye

  BallMap::Gap gap_at(const Eigen::Vector3d& point) const;
};
/// \param mesh  at rest, #V by 3
FaceEye face_eye(const TemplateEye& eye, const BallMap& ball, const RigidMotion& motion,
                 const Positions& mesh);

/// Writes 1 for skin around an eye that belongs to the upper lid and −1 for the lower one's, by what of the rim is
/// nearest.
/// \param side  #V
void lid_sides(const TemplateEye& eye, const Positions& neutral, std::vector<signed char>& side);

/// How the lids of one eye move in a shape, so that a blink closes on eyes of any size. Carried by frames
/// alone, lids meet or miss each other by millimetres, because an opening is no piece of skin that
/// could be measured. Where the shape closes the lids on the template, what they move up or down is
/// made so much more or less that they are as near to each other on the face; and lids keep off the
/// eyeball, as the template's do.
class LidClosure {
 public:
  /// \param shape  some of its rows are skin around the eye
  LidClosure(const TemplateEye& eye, const Adjacency& adjacency, const Positions& neutral,
             const Displacements& shape, const HeadAxes& axes);

  /// Whether the shape moves this eye's lids.
  bool empty() const { return lids_.empty(); }

  /// Between the rims at a place; negative where the upper lid reaches below the lower one.
  struct Gap {
    double paired;  ///< of the points that lie above each other on the template
    double plumb;   ///< straight down from the upper one, whatever lies there
  };
  /// What a face's lids are to be like, of a mesh whose shape is known, in the template's size.
  struct Goals {
    std::vector<Gap> gaps;                  ///< #places
    std::vector<double> least, gap_change;  ///< #lids: to the eyeball, in the shape; and since rest
  };
  /// \param mesh   #V by 3, at rest
  /// \param whole  from the template to the mesh
  /// \param moves  its own, as the shape's rows
  Goals goals(const Positions& mesh, const FaceEye& eye, const RigidMotion& whole,
              const Positions& moves) const;
  /// Between those of several sets.
  static Goals mean(std::span<const Goals> goals, std::span<const SetShare> shares);
  /// Whether the shape closes the lids.
  bool closes() const { return !places_.empty(); }
  /// The rows of the shape that `fit` may change.
  std::vector<std::uint32_t> rows() const;

  /// How far lids are open that are to be closed, at most, in radii of the eyeball; 0: as good as not.
  double open(const Positions& face, const RigidMotion& whole, const Goals& goals,
              const Positions& moves) const;
  /// Closes what is open again, by more of the shape's own movement.
  void close_again(const Positions& face, const RigidMotion& whole, const Goals& goals,
                   Positions& moves) const;

  /// \param face   #V by 3, at rest
  /// \param whole  from the template to the face
  /// \param moves  as the shape's, carried to the face; made to fit
  void fit(const Positions& face, const FaceEye& eye, const RigidMotion& whole, const Goals& goals,
           Positions& moves) const;
  /// Brings out what something else took into the eyeball. \return  whether there was nothing
  bool keep_out(const Positions& face, const FaceEye& eye, const RigidMotion& whole,
                const Goals& goals, Positions& moves) const;

 private:
  /// A point of a lid's profile; rows are of the shape, or kNoIndex for what does not move.
  struct Point {
    EdgePoint on;
    std::uint32_t row_a, row_b;
  };
  struct Place {
    std::vector<Point> low, high;
    double along;   ///< the opening
    double closed;  ///< by how much the template's gap is less than at rest
  };
  /// Of a face: along the opening, and from the lower lid to the upper one; unit.
  struct Axes {
    Eigen::Vector3d along, up;
  };
  /// A point of a rim in the plane of those.
  struct Rim {
    double along, height;
  };
  struct Lid {
    std::uint32_t row, vertex;
    std::uint32_t number;  ///< among the skin around the eye
    double share;          ///< of what closes the lids: 1 around the eye, less farther off
    double hold;           ///< of what holds it off the eyeball: 1 near it
  };

  void add_places(const TemplateEye& eye, const Adjacency& adjacency, const Positions& neutral,
                  const Displacements& shape, const HeadAxes& axes);
  void put_profiles_first();
  std::span<const double> heard(std::size_t lid) const {
    return {heard_.data() + lid * places_.size(), places_.size()};
  }
  /// Of the first `count` lids.
  void close(std::size_t count, const Eigen::Vector3d& up, const Positions& carried,
             std::span<const double> gains, Positions& moves) const;
  /// How near to the eyeball a lid may come, or how deep into it: as it is at rest, or as the shape has it.
  double least_gap(std::size_t lid, double rest, double scale, const Goals& goals) const;
  void hold_off(std::size_t count, const Positions& face, const FaceEye& eye, double scale,
                const Goals& goals, Positions& moves) const;
  Axes axes_on(const RigidMotion& whole) const;
  static Rim rim_point(const std::vector<Point>& points, double sign, const Axes& axes,
                       const Positions& face, const Positions& moves);
  /// By how much gaps are wider than they are to be; negative: narrower.
  static std::vector<double> missing_gaps(const std::vector<Gap>& now, const Goals& goals,
                                          double scale);
  std::vector<Gap> gaps(const Axes& axes, const Positions& face, const Positions& moves) const;

  HeadAxes axes_;
  double radius_ = 0;
  std::vector<Place> places_;
  std::vector<Lid> lids_;
  std::size_t in_profiles_ = 0;  ///< so many of them come first
  std::vector<double> heard_;    ///< #lids by #places: how much a lid hears of each
};

}  // namespace crowdface
