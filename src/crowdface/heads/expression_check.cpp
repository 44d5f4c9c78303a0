// SPDX-License-Identifier: Apache-2.0
#include "crowdface/heads/expression_check.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

#include "crowdface/core/parallel.h"
#include "crowdface/core/selection.h"
#include "crowdface/core/text.h"
#include "crowdface/mesh/alignment.h"
#include "crowdface/mesh/all_columns.h"
#include "crowdface/mesh/vector3.h"
#include "crowdface/paint/face_marks.h"

namespace crowdface {
namespace {

constexpr std::size_t kMinHeads = 4, kMinFitted = 50;
/// Lengths in this file are millimetres of a face with this distance from the mouth to the eyes.
constexpr double kEyesAboveMouth = 65;

/// Weights of a Gaussian window over the skin. `across` is the distance of the centre from the
/// symmetry plane, `above_mouth` its height.
struct Window {
  double across, above_mouth;
  double width = 4, height = 3.5;  ///< standard deviations
};

enum class Direction { kOutwards, kUp, kForwards };

/// The mean displacement in a window, times a factor.
struct Term {
  double factor;
  Window window;
  Direction direction;
};

/// A local movement of the face: a feature's displacement minus the displacement of the skin around
/// the feature. Longer, wider or more prominent faces displace both.
struct Movement {
  std::vector<Term> terms;
  double usual_mm;          ///< standard deviation among neutral heads (synthetic, ICT, MakeHuman)
  const char *more, *less;  ///< begin of the warning for a positive and a negative value; null if
                            ///< neutral heads differ as much
};

/// The windows and factors are chosen so that the movements of the ICT model's expressions are
/// large compared with the differences between neutral heads.
const std::vector<Movement>& mouth_movements() {
  constexpr Window kUpperLip{0, 4, 6, 2.5}, kLowerLip{0, -5, 6, 2.5}, kUpperSide{18, 5},
      kLowerSide{18, -5}, kCorner{26, 0}, kOuterCorner{30, 0, 5, 4}, kCheek{32, 14},
      kOuterCheek{44, 0}, kHighCheek{45, 15}, kJowl{34, -14}, kPhiltrum{0, 14}, kNoseBase{0, 22},
      kChinCrease{0, -16};
  constexpr Direction kUp = Direction::kUp, kForwards = Direction::kForwards,
                      kOutwards = Direction::kOutwards;
  static const std::vector<Movement> movements = {
      {{{1, kUpperLip, kUp}, {-1, kLowerLip, kUp}},
       1,
       "its mouth is open, the lips are apart by",
       nullptr},
      {{{1, kOuterCorner, kUp},
        {-0.25, kUpperLip, kUp},
        {-0.5, kLowerLip, kUp},
        {-0.25, kPhiltrum, kUp},
        {0.2, kOuterCorner, kOutwards},
        {-0.2, kUpperSide, kForwards},
        {-0.2, kCorner, kForwards},
        {0.2, kUpperLip, kForwards},
        {0.2, kJowl, kForwards}},
       0.7,
       "the corners of its mouth are higher by",
       "the corners of its mouth are lower by"},
      {{{0.5, kUpperSide, kForwards},
        {0.5, kLowerSide, kForwards},
        {-0.5, kChinCrease, kForwards},
        {-0.2, kJowl, kForwards},
        {-0.3, kNoseBase, kForwards},
        {-0.5, kCheek, kOutwards},
        {-0.5, kJowl, kOutwards},
        {0.3, kJowl, kUp},
        {-0.3, kChinCrease, kUp}},
       1.5,
       "its mouth is pursed, the lips are farther in front by",
       nullptr},
      {{{0.17, kUpperSide, kForwards},
        {0.17, kLowerSide, kForwards},
        {0.16, kCorner, kForwards},
        {-0.25, kUpperLip, kForwards},
        {-0.25, kLowerLip, kForwards},
        {0.3, kOuterCheek, kOutwards},
        {0.2, kCheek, kUp},
        {0.2, kHighCheek, kUp},
        {-0.2, kUpperLip, kUp},
        {-0.2, kPhiltrum, kUp}},
       0.7,
       "its cheeks are puffed beside the mouth by",
       nullptr}};
  return movements;
}

const std::vector<Movement>& eye_movements() {
  constexpr Window kUpperLid{31, 70, 7, 2.5}, kLidFold{31, 82, 7, 3}, kLowerLid{31, 58, 7, 3},
      kInnerCorner{14, 65}, kOuterCorner{48, 65}, kEye{31, 65, 7, 7}, kBelowBrow{31, 78},
      kInnerBrow{16, 86}, kBrow{26, 90}, kNoseBridge{0, 74}, kForehead{10, 106, 15, 4};
  constexpr Direction kUp = Direction::kUp;
  static const std::vector<Movement> movements = {{{{1, kUpperLid, kUp},
                                                    {-0.25, kLidFold, kUp},
                                                    {-0.25, kLowerLid, kUp},
                                                    {-0.25, kInnerCorner, kUp},
                                                    {-0.25, kOuterCorner, kUp}},
                                                   0.6,
                                                   "its upper lids are higher by",
                                                   "its upper lids are lower by"},
                                                  {{{0.4, kInnerBrow, kUp},
                                                    {0.3, kBrow, kUp},
                                                    {0.3, kNoseBridge, kUp},
                                                    {-0.33, kBelowBrow, kUp},
                                                    {-0.33, kEye, kUp},
                                                    {-0.34, kForehead, kUp}},
                                                   0.45,
                                                   "its brows are raised by",
                                                   nullptr}};
  return movements;
}

/// The vertex-wise median of all heads. A single odd head hardly changes this median.
Positions middle_head(const HeadSet& head_set) {
  Positions middle(head_set.heads[0].positions.rows(), 3);
  parallel_for_each(static_cast<std::size_t>(middle.rows()), [&](std::size_t v) {
    for (Index c = 0; c < 3; ++c) {
      std::vector<double> values;
      for (const Head& head : head_set.heads) {
        values.push_back(head.positions(static_cast<Index>(v), c));
      }
      middle(static_cast<Index>(v), c) = nth_smallest(values, values.size() / 2);
    }
  });
  return middle;
}

/// A linear function of the displacements of some vertices: the sum of the dot products with
/// `weights`.
struct LinearForm {
  std::vector<Index> vertices;
  std::vector<Eigen::Vector3d> weights;
};

/// The coordinates of the skin of a head in its face.
class FaceSkin {
 public:
  FaceSkin(const HeadShape& head, const FaceMarks& marks)
      : axes_(marks.axes), mm_(marks.eye_to_mouth() / kEyesAboveMouth) {
    for (Index v = 0; v < head.positions.rows(); ++v) {
      if (!head.is_skin[static_cast<std::size_t>(v)]) continue;
      const Eigen::Vector3d place = row3(head.positions, v);
      vertices_.push_back({v, (place.dot(axes_.side()) - marks.symmetry_offset) / mm_,
                           (place.dot(axes_.up) - marks.mouth_height) / mm_,
                           place.dot(axes_.front) / mm_});
    }
  }

  /// The vertices of nose, cheeks and eyes: expressions move this part of the face least.
  std::vector<Index> middle_of_face() const {
    constexpr double kAcross = 55, kCentre = 47.5, kHalfHeight = 32.5, kDepth = 60;
    std::vector<Index> indices;
    for (const Vertex& v : vertices_near(0, kCentre, kAcross, kHalfHeight, kDepth)) {
      indices.push_back(v.index);
    }
    return indices;
  }

  /// The function that measures a movement, in millimetres, on the left (`side` is 1) or right (−1)
  /// half of the face; nothing if a window contains too few vertices.
  std::optional<LinearForm> form_of(const Movement& movement, int side) const {
    LinearForm form;
    for (const Term& term : movement.terms) {
      constexpr double kReach = 2.4, kDepth = 15, kMinWeight = 0.5;
      const Window& window = term.window;
      const auto near = vertices_near(side * window.across, window.above_mouth,
                                      kReach * window.width, kReach * window.height, kDepth);
      std::vector<double> weights;
      for (const Vertex& v : near) {
        weights.push_back(std::exp(-(square((v.across - side * window.across) / window.width) +
                                     square((v.above_mouth - window.above_mouth) / window.height)) /
                                   2));
      }
      const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
      if (sum < kMinWeight) return std::nullopt;
      const Eigen::Vector3d direction = vector_of(term.direction, side);
      for (std::size_t i = 0; i < near.size(); ++i) {
        form.vertices.push_back(near[i].index);
        form.weights.emplace_back(term.factor * weights[i] / (sum * mm_) * direction);
      }
    }
    return form;
  }

 private:
  struct Vertex {
    Index index;
    double across, above_mouth, front;
  };
  static double square(double x) { return x * x; }

  /// The vertices in a rectangle, seen from the front, up to `depth` behind the foremost of them.
  std::vector<Vertex> vertices_near(double across, double above_mouth, double half_width,
                                    double half_height, double depth) const {
    std::vector<Vertex> inside;
    double foremost = -std::numeric_limits<double>::max();
    for (const Vertex& v : vertices_) {
      if (std::abs(v.across - across) > half_width) continue;
      if (std::abs(v.above_mouth - above_mouth) > half_height) continue;
      inside.push_back(v);
      foremost = std::max(foremost, v.front);
    }
    std::erase_if(inside, [&](const Vertex& v) { return v.front < foremost - depth; });
    return inside;
  }
  Eigen::Vector3d vector_of(Direction direction, int side) const {
    if (direction == Direction::kOutwards) return side * axes_.side();
    return direction == Direction::kUp ? axes_.up : axes_.front;
  }

  HeadAxes axes_;
  double mm_;  ///< the unit of `Vertex` in the unit of the positions
  std::vector<Vertex> vertices_;
};

/// The displacements of all heads from their median, each after a similarity fit of `fitted`.
class HeadDisplacements {
 public:
  HeadDisplacements(const HeadSet& heads, const Positions& middle, const std::vector<Index>& fitted)
      : heads_(heads), middle_(middle) {
    const Positions to = middle(fitted, kAllColumns);
    for (const Head& head : heads.heads) {
      fits_.push_back(fit_similarity(head.positions(fitted, kAllColumns), to, ScaleFit::kUniform));
    }
  }

  /// The value of a form on each head, minus the median of these values.
  std::vector<double> deviations(const LinearForm& form) const {
    std::vector<double> values;
    for (std::size_t h = 0; h < fits_.size(); ++h) {
      const Positions moved =
          fits_[h].apply(heads_.heads[h].positions(form.vertices, kAllColumns)) -
          middle_(form.vertices, kAllColumns);
      double value = 0;
      for (std::size_t i = 0; i < form.weights.size(); ++i) {
        value += form.weights[i].dot(row3(moved, static_cast<Index>(i)));
      }
      values.push_back(value);
    }
    const double middle = nth_smallest(values, values.size() / 2);
    for (double& value : values) value -= middle;
    return values;
  }

 private:
  const HeadSet& heads_;
  const Positions& middle_;
  std::vector<Similarity> fits_;
};

/// The largest deviation of a head from the others, as a multiple of the usual deviation.
struct Oddity {
  double times_usual = 0;
  double mm = 0, usual_mm = 0;
  const char* text = nullptr;
};

/// Replaces each head's oddity by that of this movement where the latter is larger. The usual
/// deviation is the root of the mean square of the other heads' deviations and of `usual_mm`, which
/// counts like kHeads heads.
void compare(const Movement& movement, const FaceSkin& skin, const HeadDisplacements& displacements,
             std::vector<Oddity>& oddities) {
  constexpr double kHeads = 6;
  std::vector<std::vector<double>> sides;
  for (const int side : {1, -1}) {
    const auto form = skin.form_of(movement, side);
    if (!form) return;
    sides.push_back(displacements.deviations(*form));
  }
  const auto squares = [&](std::size_t h) {
    return (sides[0][h] * sides[0][h] + sides[1][h] * sides[1][h]) / 2;
  };
  double sum = 0;
  for (std::size_t h = 0; h < oddities.size(); ++h) sum += squares(h);
  for (std::size_t h = 0; h < oddities.size(); ++h) {
    const double others = static_cast<double>(oddities.size() - 1);
    const double usual = std::sqrt(
        (sum - squares(h) + kHeads * movement.usual_mm * movement.usual_mm) / (others + kHeads));
    for (const std::vector<double>& side : sides) {
      const double times = std::abs(side[h]) / usual;
      const char* const text = side[h] > 0 ? movement.more : movement.less;
      if (text != nullptr && times > oddities[h].times_usual) {
        oddities[h] = {times, std::abs(side[h]), usual, text};
      }
    }
  }
}

}  // namespace

std::vector<std::string> odd_expression_warnings(const HeadSet& head_set,
                                                 const std::vector<bool>& skin,
                                                 const HeadAxes& axes) {
  constexpr double kTold = 3.8;  // times the usual deviation
  if (head_set.heads.size() < kMinHeads) return {};
  HeadShape head = mean_head_shape({head_set.topology, {}, {{"", middle_head(head_set)}}});
  head.is_skin = skin;
  const auto marks = find_face_marks(head_set.topology, head, axes);
  if (!marks) return {};
  const FaceSkin face(head, *marks);
  const std::vector<Index> fitted = face.middle_of_face();
  if (fitted.size() < kMinFitted) return {};
  const HeadDisplacements displacements(head_set, head.positions, fitted);
  std::vector<std::string> warnings;
  for (const auto* movements : {&mouth_movements(), &eye_movements()}) {
    std::vector<Oddity> oddities(head_set.heads.size());
    for (const Movement& movement : *movements) compare(movement, face, displacements, oddities);
    for (std::size_t h = 0; h < oddities.size(); ++h) {
      const Oddity& odd = oddities[h];
      if (odd.times_usual < kTold) continue;
      warnings.push_back(
          concat(head_set.heads[h].name, ": ", odd.text, " ", format_fixed(odd.mm, 1),
                 " mm compared with the median of all heads, where the others usually differ by ",
                 format_fixed(odd.usual_mm, 1),
                 " mm: is its expression neutral? Faces built from this head take over its "
                 "expression"));
    }
  }
  return warnings;
}

}  // namespace crowdface
