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

constexpr std::size_t kMinHeads = 4, kMinFittedVertices = 50;
/// Height of the eyes above the mouth. All lengths in this file are millimetres on a face that is
/// scaled to this height.
constexpr double kEyesAboveMouthMm = 65;

/// A Gaussian window on the skin, seen from the front; in millimetres.
struct Window {
  /// the window's centre: its distance from the symmetry plane and its height above the mouth
  double across, above_mouth;
  /// the Gaussian's standard deviations in millimetres, across the face and along its height
  double sigma_across = 4, sigma_up = 3.5;
};

enum class Direction { kOutwards, kUp, kForwards };

/// One term of a movement's value: the mean displacement of the skin in a window, along a
/// direction, times `factor`.
struct Term {
  double factor;
  Window window;
  Direction direction;
};

/// A movement of one feature of the face, compared with the median head. The movement's value is
/// the sum of its `terms`: the displacement of the feature minus the displacement of the skin
/// around the feature. In a longer, wider or more prominent face, both displacements are about
/// equal, so the value is near 0.
struct Movement {
  std::vector<Term> terms;
  /// standard deviation of the movement's value among heads with a neutral expression (synthetic,
  /// ICT, MakeHuman)
  double neutral_deviation_mm;
  /// start of the warning about a head on which the movement has a large positive or negative
  /// value, in mm. Null: no warning, because such values also occur on neutral heads.
  const char *positive_text, *negative_text;
};

/// The movements of the mouth and the cheeks: open mouth, raised and lowered corners of the mouth,
/// pursed mouth, puffed cheeks. Each movement's windows and factors are chosen so that the
/// movement's value is large in the matching expression of the ICT model, compared with its
/// differences between neutral heads.
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

/// Raised and lowered upper lids, and raised brows. The windows and factors are chosen in the same
/// way as for mouth_movements.
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

/// The vertex-wise median of all heads. A single head with an expression hardly changes the median.
Positions median_head(const HeadSet& head_set) {
  Positions median(head_set.heads[0].positions.rows(), 3);
  parallel_for_each(static_cast<std::size_t>(median.rows()), [&](std::size_t v) {
    for (Index c = 0; c < 3; ++c) {
      std::vector<double> values;
      for (const Head& head : head_set.heads) {
        values.push_back(head.positions(static_cast<Index>(v), c));
      }
      median(static_cast<Index>(v), c) = nth_smallest(values, values.size() / 2);
    }
  });
  return median;
}

/// A linear function of the displacements of some vertices: the sum of the dot products of each
/// vertex's displacement and weight. A vertex may occur several times.
struct LinearForm {
  std::vector<Index> vertices;
  std::vector<Eigen::Vector3d> weights;
};

/// The skin vertices of a head, with their coordinates relative to the features of the face.
class FaceSkin {
 public:
  FaceSkin(const HeadShape& head, const FaceMarks& marks)
      : axes_(marks.axes), units_per_mm_(marks.eye_to_mouth() / kEyesAboveMouthMm) {
    for (Index v = 0; v < head.positions.rows(); ++v) {
      if (!head.is_skin[static_cast<std::size_t>(v)]) continue;
      const Eigen::Vector3d point = row3(head.positions, v);
      vertices_.push_back({v, (point.dot(axes_.side()) - marks.symmetry_offset) / units_per_mm_,
                           (point.dot(axes_.up) - marks.mouth_height) / units_per_mm_,
                           point.dot(axes_.front) / units_per_mm_});
    }
  }

  /// Returns the vertices of nose, cheeks and eyes: expressions move this part of the face least.
  std::vector<Index> middle_of_face() const {
    constexpr double kAboveMouth = 47.5, kHalfWidth = 55, kHalfHeight = 32.5, kDepth = 60;
    std::vector<Index> indices;
    for (const SkinVertex& v : front_vertices(0, kAboveMouth, kHalfWidth, kHalfHeight, kDepth)) {
      indices.push_back(v.index);
    }
    return indices;
  }

  /// Returns the linear form that computes a movement's value, in millimetres, from displacements
  /// in the unit of the positions. Returns nothing if a window of the movement (Term::window)
  /// contains too few vertices.
  /// \param side  half of the face: 1 left, −1 right.
  std::optional<LinearForm> linear_form_of(const Movement& movement, int side) const {
    LinearForm form;
    for (const Term& term : movement.terms) {
      // kReach: half the size of the window, in standard deviations. kDepth: how far behind the
      // foremost vertex of the window a vertex may lie, in millimetres. kMinWeightSum: smallest sum
      // of the vertices' Gaussian weights; windows with a smaller sum contain too few vertices.
      constexpr double kReach = 2.4, kDepth = 15, kMinWeightSum = 0.5;
      const Window& window = term.window;
      const double across = side * window.across;
      const auto vertices = front_vertices(across, window.above_mouth, kReach * window.sigma_across,
                                           kReach * window.sigma_up, kDepth);
      std::vector<double> weights;
      for (const SkinVertex& v : vertices) {
        weights.push_back(
            std::exp(-(square((v.across - across) / window.sigma_across) +
                       square((v.above_mouth - window.above_mouth) / window.sigma_up)) /
                     2));
      }
      const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
      if (sum < kMinWeightSum) return std::nullopt;
      const Eigen::Vector3d direction = vector_of(term.direction, side);
      for (std::size_t i = 0; i < vertices.size(); ++i) {
        form.vertices.push_back(vertices[i].index);
        form.weights.emplace_back(term.factor * weights[i] / (sum * units_per_mm_) * direction);
      }
    }
    return form;
  }

 private:
  struct SkinVertex {
    Index index;
    /// coordinates of the vertex in millimetres: to the left of the symmetry plane, above the
    /// mouth, and forwards
    double across, above_mouth, front;
  };
  static double square(double x) { return x * x; }

  /// Returns the vertices in a rectangle of the front view, without the vertices that lie farther
  /// than `depth` behind the foremost vertex.
  /// \param across, above_mouth  centre of the rectangle.
  std::vector<SkinVertex> front_vertices(double across, double above_mouth, double half_width,
                                         double half_height, double depth) const {
    std::vector<SkinVertex> inside;
    double foremost = -std::numeric_limits<double>::max();
    for (const SkinVertex& v : vertices_) {
      if (std::abs(v.across - across) > half_width) continue;
      if (std::abs(v.above_mouth - above_mouth) > half_height) continue;
      inside.push_back(v);
      foremost = std::max(foremost, v.front);
    }
    std::erase_if(inside, [&](const SkinVertex& v) { return v.front < foremost - depth; });
    return inside;
  }
  Eigen::Vector3d vector_of(Direction direction, int side) const {
    if (direction == Direction::kOutwards) return side * axes_.side();
    return direction == Direction::kUp ? axes_.up : axes_.front;
  }

  HeadAxes axes_;
  double units_per_mm_;  ///< length of one millimetre, in the unit of the positions
  std::vector<SkinVertex> vertices_;
};

/// Measures the displacements of all heads from the median head. First aligns each head with the
/// median head, by the similarity transform that fits best at some of the vertices.
class HeadDisplacements {
 public:
  /// \param heads, median    must outlive this object.
  /// \param fitted_vertices  the vertices to which the similarity transforms are fitted.
  HeadDisplacements(const HeadSet& heads, const Positions& median,
                    const std::vector<Index>& fitted_vertices)
      : heads_(heads), median_(median) {
    const Positions to = median(fitted_vertices, kAllColumns);
    for (const Head& head : heads.heads) {
      alignments_.push_back(
          fit_similarity(head.positions(fitted_vertices, kAllColumns), to, ScaleFit::kUniform));
    }
  }

  /// Returns the value of a linear form for each head, minus the median of these values.
  std::vector<double> deviations(const LinearForm& form) const {
    std::vector<double> values;
    for (std::size_t h = 0; h < alignments_.size(); ++h) {
      const Positions displacements =
          alignments_[h].apply(heads_.heads[h].positions(form.vertices, kAllColumns)) -
          median_(form.vertices, kAllColumns);
      double value = 0;
      for (std::size_t i = 0; i < form.weights.size(); ++i) {
        value += form.weights[i].dot(row3(displacements, static_cast<Index>(i)));
      }
      values.push_back(value);
    }
    const double median = nth_smallest(values, values.size() / 2);
    for (double& value : values) value -= median;
    return values;
  }

 private:
  const HeadSet& heads_;
  const Positions& median_;
  std::vector<Similarity> alignments_;
};

/// The movement in which a head deviates most from the other heads.
struct LargestDeviation {
  double ratio = 0;  ///< deviation_mm / usual_mm
  /// difference between the movement's value (see Movement) in this head and the median of its
  /// values in all heads
  double deviation_mm = 0;
  double usual_mm = 0;  ///< root mean square of the other heads' deviations, see update_largest
  const char* text = nullptr;  ///< start of the warning about this deviation
};

/// Updates each head's largest deviation: stores `movement` for the heads that deviate more in
/// `movement` than in all earlier movements.
void update_largest(const Movement& movement, const FaceSkin& skin,
                    const HeadDisplacements& displacements,
                    std::vector<LargestDeviation>& largest) {
  // sides[s][h]: the deviation of head h on half s of the face, in millimetres
  std::vector<std::vector<double>> sides;
  for (const int side : {1, -1}) {
    const auto form = skin.linear_form_of(movement, side);
    if (!form) return;
    sides.push_back(displacements.deviations(*form));
  }
  const auto mean_square = [&](std::size_t h) {
    return (sides[0][h] * sides[0][h] + sides[1][h] * sides[1][h]) / 2;
  };
  double sum = 0;
  for (std::size_t h = 0; h < largest.size(); ++h) sum += mean_square(h);
  for (std::size_t h = 0; h < largest.size(); ++h) {
    // The usual deviation is the root mean square of the other heads' deviations. The other heads
    // are a small sample, so the mean also includes kAddedHeads imagined neutral heads, whose
    // deviation is known.
    constexpr double kAddedHeads = 6;
    const double others = static_cast<double>(largest.size() - 1);
    const double usual =
        std::sqrt((sum - mean_square(h) +
                   kAddedHeads * movement.neutral_deviation_mm * movement.neutral_deviation_mm) /
                  (others + kAddedHeads));
    for (const std::vector<double>& side : sides) {
      const double ratio = std::abs(side[h]) / usual;
      const char* const text = side[h] > 0 ? movement.positive_text : movement.negative_text;
      if (text != nullptr && ratio > largest[h].ratio) {
        largest[h] = {ratio, std::abs(side[h]), usual, text};
      }
    }
  }
}

}  // namespace

std::vector<std::string> odd_expression_warnings(const HeadSet& head_set,
                                                 const std::vector<bool>& is_skin,
                                                 const HeadAxes& axes) {
  constexpr double kMinRatio = 3.8;  // smallest LargestDeviation::ratio that causes a warning
  if (head_set.heads.size() < kMinHeads) return {};
  HeadShape median = mean_head_shape({head_set.topology, {}, {{"", median_head(head_set)}}});
  median.is_skin = is_skin;
  const auto marks = find_face_marks(head_set.topology, median, axes);
  if (!marks) return {};
  const FaceSkin skin(median, *marks);
  const std::vector<Index> fitted_vertices = skin.middle_of_face();
  if (fitted_vertices.size() < kMinFittedVertices) return {};
  const HeadDisplacements displacements(head_set, median.positions, fitted_vertices);
  std::vector<std::string> warnings;
  for (const auto* movements : {&mouth_movements(), &eye_movements()}) {
    std::vector<LargestDeviation> largest(head_set.heads.size());
    for (const Movement& movement : *movements)
      update_largest(movement, skin, displacements, largest);
    for (std::size_t h = 0; h < largest.size(); ++h) {
      const auto& [ratio, deviation_mm, usual_mm, text] = largest[h];
      if (ratio < kMinRatio) continue;
      warnings.push_back(
          concat(head_set.heads[h].name, ": ", text, " ", format_fixed(deviation_mm, 1),
                 " mm compared with the median of all heads, where the others usually differ by ",
                 format_fixed(usual_mm, 1),
                 " mm: is its expression neutral? Faces built from this head take over its "
                 "expression"));
    }
  }
  return warnings;
}

}  // namespace crowdface
