// SPDX-License-Identifier: Apache-2.0
#include "head_models/synth/relief.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "crowdface/core/random.h"
#include "crowdface/core/smooth_step.h"
#include "crowdface/core/text.h"

namespace crowdface::synth {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

double bump(double x) {
  return biweight(std::min(1.0, std::abs(x)));
}

/// A fold: a quadratic Bézier curve in the front view (x, y), at x > 0.
struct Fold {
  std::string_view name;
  Vector2d start, control, end;
  double width, depth;  ///< width and depth of the groove, cm; a ridge has a negative depth
  /// Each person's fold has the depth `depth` times a random factor. The mean of this factor is
  /// `base` + 1.25 · `aged` · Person::scaled_age(); its standard deviation is `spread`.
  double base, aged, spread;
  double bulge;        ///< height of the ridge beside the groove, see Relief::Stroke::bulge
  bool paired = true;  ///< whether the fold is mirrored to x < 0
};

// clang-format off
const auto& fold_list() {
  static const std::array list = {
    Fold{"lid_crease", {1.75, 0.40}, {3.1, 1.42}, {4.8, 0.42}, 0.17, 0.055, 1, 0.1, 0.3, 0},
    Fold{"under_eye", {1.8, -0.6}, {2.9, -1.75}, {4.6, -0.9}, 0.32, 0.055, 0.1, 1.0, 0.2, 0},
    Fold{"nasolabial", {1.85, -3.8}, {2.8, -4.9}, {3.2, -7.1}, 0.5, 0.085, 0.1, 0.9, 0.2, 1.3},
    Fold{"nasolabial_crease", {1.75, -3.7}, {2.75, -4.8}, {3.2, -7.2}, 0.22, 0.05, -0.1, 0.8, 0.2, 0.3},
    Fold{"marionette", {2.75, -7.9}, {2.95, -8.6}, {2.8, -9.5}, 0.36, 0.02, 0, 0.8, 0.2, 1.2},
    Fold{"bag", {1.7, -0.9}, {2.6, -2.3}, {4.6, -1.7}, 0.22, 0.05, -0.3, 0.8, 0.3, 0},
    Fold{"philtrum_ridge", {0.3, -4.95}, {0.42, -5.5}, {0.5, -6.15}, 0.26, -0.07, 1, -0.3, 0.3, 0},
    Fold{"wing_crease", {1.25, -3.0}, {2.0, -3.5}, {1.8, -4.5}, 0.24, 0.07, 0.8, 0.2, 0.2, 0},
    Fold{"lip_edge", {0.4, -6.08}, {1.0, -6.15}, {2.3, -6.85}, 0.14, -0.035, 1, -0.3, 0.2, 0},
    Fold{"chin_crease", {-1.8, -8.7}, {0, -8.5}, {1.8, -8.7}, 0.5, 0.07, 0.6, 0.1, 0.4, 0, false},
    Fold{"neck_upper", {-4.2, -13.0}, {0, -14.2}, {4.2, -13.0}, 0.28, 0.04, 0.3, 0.4, 0.3, 0, false},
    Fold{"neck_lower", {-4.4, -14.4}, {0, -15.8}, {4.4, -14.4}, 0.28, 0.04, 0.2, 0.4, 0.3, 0, false},
  };
  return list;
}
// clang-format on

/// An area of wrinkles that are arcs around a pole, or rays from the pole, in the front view.
struct WrinkleArea {
  std::string_view name;
  Vector2d pole;  ///< centre of the arcs or rays, cm
  bool has_rays;
  Vector2d centre, radii;  ///< centre and radii of the ellipse in which the wrinkles lie, cm
  double spacing;          ///< mean distance between neighbouring wrinkles, cm
  double depth;            ///< depth of the wrinkles of old people, cm
  /// Person::scaled_age() at which wrinkles begin; at begin + 1, wrinkles have their full depth
  double begin;
  bool paired = true;  ///< whether the area is mirrored to x < 0
};
/// Half the width of a wrinkle, relative to the distance between wrinkles.
constexpr double kWrinkleHalfWidth = 0.27;

// clang-format off
const auto& wrinkle_areas() {
  static const std::array list = {
    WrinkleArea{"forehead", {0, -20}, false, {0, 5.0}, {6.0, 2.9}, 0.5, 0.05, 0.1, false},
    WrinkleArea{"frown", {0, -12}, true, {0, 2.0}, {1.3, 1.7}, 0.7, 0.02, 0.3, false},
    WrinkleArea{"crow", {3.7, 0.1}, true, {5.7, 0.0}, {1.6, 2.3}, 0.36, 0.075, 0.1},
    WrinkleArea{"under_eye", {3.1, 1.6}, false, {3.2, -1.5}, {2.3, 1.2}, 0.3, 0.065, 0.1},
    WrinkleArea{"cheek", {-1.5, -5.5}, false, {5.0, -4.6}, {2.2, 3.9}, 0.42, 0.02, 0.2},
    WrinkleArea{"upper_lip", {0.5, -14}, true, {1.4, -5.75}, {1.3, 0.9}, 0.34, 0.042, 0.4},
    WrinkleArea{"lower_lip", {0.5, -2}, true, {1.4, -8.4}, {1.3, 0.8}, 0.38, 0.012, 0.6},
    WrinkleArea{"neck", {0, 2}, false, {0, -13.6}, {6, 3}, 0.55, 0.06, 0.2, false},
  };
  return list;
}
// clang-format on

/// Factor on the amplitude of fine relief: largest on nose, cheeks and chin, smallest on the scalp.
double coarseness(const Vector3d& p) {
  const double face = smooth_step(2, 6, p.z());
  const double middle = bump(Vector2d(p.x() / 5.5, (p.y() + 4.2) / 6).norm());
  const double scalp = smooth_step(6, 8.5, p.y() + 0.5 * std::max(0.0, 4 - p.z()));
  return (0.5 + 0.5 * face + 0.8 * face * middle) * (1 - 0.6 * scalp);
}

/// Fraction of a wave's amplitude that a mesh can represent, for the given wavelength and edge
/// length.
double represented_fraction(double wavelength, double edge) {
  return smooth_step(2, 4, wavelength / edge);
}

}  // namespace

Relief::Relief(const Identity& identity, double edge_cm, double omitted_edge_cm)
    : fold_offset_noise_x_(mix(identity.seed(), identity.index(), 11), 1.4),
      fold_offset_noise_y_(mix(identity.seed(), identity.index(), 12), 1.4),
      wrinkle_waves_(mix(identity.seed(), identity.index(), 14), 1.1),
      wrinkle_gaps_(mix(identity.seed(), identity.index(), 15), 0.9),
      lip_creases_(mix(identity.seed(), identity.index(), 13), 0.18) {
  const std::uint64_t seed = identity.seed(), index = identity.index();
  const double aged = identity.person().scaled_age();
  const auto drawn_fraction = [&](double wavelength) {
    return represented_fraction(wavelength, edge_cm) -
           represented_fraction(wavelength, omitted_edge_cm);
  };
  for (std::size_t i = 0; i < fold_list().size(); ++i) {
    const Fold& fold = fold_list()[i];
    for (const double side : {1.0, -1.0}) {
      if (side < 0 && !fold.paired) continue;
      const std::string purpose = concat("synth/fold/", fold.name);
      const std::string lean = concat(purpose, side > 0 ? "/left" : "/right");
      const double factor =
          fold.base + 1.25 * fold.aged * aged +
          fold.spread * std::clamp(random_normal({seed, index, purpose}), -2., 2.);
      const double lopsided = random_between({seed, index, lean}, 0.75, 1.25);
      const double depth = 1.5 * fold.depth * std::min(factor, 2.2) * lopsided;
      const double drawn = drawn_fraction(2.7 * fold.width);
      if (factor > 0.02 && drawn > 0) add_stroke(i, side, depth * drawn);
    }
  }
  for (const WrinkleArea& area : wrinkle_areas()) {
    const std::string purpose = concat("synth/wrinkles/", area.name);
    const auto [uniform, offset] = random_pair({seed, index, purpose});
    const double spacing = area.spacing * (0.75 + 0.5 * uniform);
    const double varied = std::clamp(1 + 0.35 * random_normal({seed, index, purpose}, 1), 0.7, 1.6);
    const double years = 1.9 * smooth_step(area.begin, area.begin + 1, aged);
    // Fade out wrinkles that are too narrow for the mesh. Such wrinkles would look like steps.
    const double drawn = drawn_fraction(2.7 * kWrinkleHalfWidth * spacing);
    wrinkles_.push_back({area.depth * varied * years * drawn, spacing, offset});
  }
  const double rough = 1 + 0.25 * aged + 0.15 * identity.person().maleness;
  const auto octave = [&](std::uint64_t lane, double spacing, double amplitude) {
    return Octave{{mix(seed, index, lane), spacing}, amplitude};
  };
  if (std::isinf(omitted_edge_cm))
    broad_octaves_ = {octave(21, 1.7, 0.018 * rough), octave(22, 0.75, 0.007 * rough)};
  // The wavelength of SmoothNoise is about 2.5 to 3 times its lattice spacing.
  for (const auto& [lane, spacing, amplitude] :
       {std::tuple{23U, 0.22, 0.0045}, std::tuple{24U, 0.1, 0.004}, std::tuple{25U, 0.05, 0.002}}) {
    const double part = drawn_fraction(2.5 * spacing);
    const double old = 1 + 0.3 * std::max(0.0, aged);
    if (part > 0) fine_octaves_.push_back(octave(lane, spacing, amplitude * rough * old * part));
  }
  lip_depth_ = 0.012 * drawn_fraction(0.45) * (1 + 0.4 * aged);
}

void Relief::add_stroke(std::size_t fold_index, double side, double depth) {
  const Fold& fold = fold_list()[fold_index];
  Stroke stroke{{}, fold.width, depth, fold.bulge * side, {}};
  for (int i = 0; i <= Stroke::kPieces; ++i) {
    const double t = static_cast<double>(i) / Stroke::kPieces;
    Vector2d p = (1 - t) * (1 - t) * fold.start + 2 * t * (1 - t) * fold.control + t * t * fold.end;
    p.x() *= side;
    stroke.points[static_cast<std::size_t>(i)] = p;
  }
  for (const Vector2d& p : stroke.points) stroke.affected_box.extend(p);
  stroke.affected_box.min().array() -= 3 * fold.width;
  stroke.affected_box.max().array() += 3 * fold.width;
  strokes_.push_back(stroke);
}

double Relief::stroke_height(const Stroke& stroke, const Vector2d& place) const {
  if (!stroke.affected_box.contains(place)) return 0;
  // Find the nearest point of the polyline, the parameter of this point, and the side of the curve
  // on which `place` lies.
  double nearest = 1e30, along = 0, side = 1;
  for (std::size_t i = 0; i < Stroke::kPieces; ++i) {
    const Vector2d a = stroke.points[i], ab = stroke.points[i + 1] - a, ap = place - a;
    const double t = std::clamp(ap.dot(ab) / ab.squaredNorm(), 0.0, 1.0);
    const double d2 = (ap - t * ab).squaredNorm();
    if (d2 >= nearest) continue;
    nearest = d2;
    along = (static_cast<double>(i) + t) / Stroke::kPieces;
    side = ab.x() * ap.y() - ab.y() * ap.x() > 0 ? 1 : -1;
  }
  // Fade out the fold at its ends; then add its groove, and the ridge beside the groove.
  const double distance = std::sqrt(nearest);
  const double taper = smooth_step(0, 0.25, along) * smooth_step(1, 0.75, along);
  double height = -bump(distance / stroke.width);
  const double beside = side * distance * (stroke.bulge < 0 ? -1 : 1);
  height += std::abs(stroke.bulge) * bump((beside - 1.5 * stroke.width) / (1.5 * stroke.width));
  return stroke.depth * taper * height;
}

template <class Weight>
double Relief::sum_of_strokes(const Vector3d& p, const Weight& weight) const {
  const double front = smooth_step(0.5, 2.5, p.z());
  if (front <= 0 || strokes_.empty()) return 0;
  const Vector2d place(p.x() + 0.08 * fold_offset_noise_x_.at(p),
                       p.y() + 0.08 * fold_offset_noise_y_.at(p));
  double sum = 0;
  for (const Stroke& stroke : strokes_) sum += weight(stroke) * stroke_height(stroke, place);
  return front * sum;
}

double Relief::wrinkle_height(const Vector3d& p) const {
  const double front = smooth_step(0.5, 2.5, p.z());
  if (front <= 0) return 0;
  double sum = 0;
  for (std::size_t i = 0; i < wrinkle_areas().size(); ++i) {
    const Wrinkles& wrinkles = wrinkles_[i];
    if (wrinkles.depth <= 0) continue;
    const WrinkleArea& area = wrinkle_areas()[i];
    const Vector2d place(area.paired ? std::abs(p.x()) : p.x(), p.y());
    const double inside = 1 - (place - area.centre).cwiseQuotient(area.radii).squaredNorm();
    if (inside <= 0) continue;
    // Coordinates along and across the wrinkles, cm.
    const Vector2d from = place - area.pole, axis = area.centre - area.pole;
    // Not std::atan2, whose last bits differ between machines.
    const double arc = axis.norm() * (axis.y() * from.x() - axis.x() * from.y()) / axis.dot(from);
    const double along = area.has_rays ? from.norm() : arc,
                 across = area.has_rays ? arc : from.norm();
    // One wavy wrinkle with gaps lies at each multiple of the spacing. `number` is the number of
    // the wrinkle nearest to the point. `lane` selects different noise for each area and each side
    // of the face.
    const double lane = 20 * static_cast<double>(i) + (area.paired && p.x() < 0 ? 10 : 0);
    const double wave = wrinkle_waves_.at({0.35 * along, 0.5 * across / wrinkles.spacing, lane});
    const double place_in_steps = across / wrinkles.spacing + wrinkles.offset + 0.45 * wave;
    const double number = std::round(place_in_steps);
    const double gaps = wrinkle_gaps_.at({0.4 * along, 7 * number, lane});
    const double off = std::abs(place_in_steps - number);
    const double line = bump(off / kWrinkleHalfWidth) - 0.4 * bump((off - 0.36) / 0.14);
    sum -= wrinkles.depth * std::min(1.0, 1.5 * inside) * smooth_step(-0.4, 0.9, gaps) * line;
  }
  return front * sum;
}

double Relief::fold_height(const Vector3d& p) const {
  return sum_of_strokes(p, [](const Stroke&) { return 1; }) + wrinkle_height(p);
}

double Relief::fold_shade(const Vector3d& p) const {
  // Divide the depth of a fold by a length that is never small and grows more slowly than the width
  // of the fold. If the divisor were the width, wide folds would hardly be visible.
  return -sum_of_strokes(p, [](const Stroke& stroke) {
    return 1.3 / (0.15 + 0.5 * stroke.width);
  }) - 4.5 * wrinkle_height(p);
}

double Relief::grain(const Vector3d& p) const {
  double sum = 0;
  for (const Octave& octave : broad_octaves_) sum += octave.amplitude * octave.noise.at(p);
  const double coarse = coarseness(p);
  for (const Octave& octave : fine_octaves_) sum += coarse * octave.amplitude * octave.noise.at(p);
  if (lip_depth_ <= 0) return sum;
  const double lips =
      bump(Vector2d(p.x() / 2.5, (p.y() + 7.05) / 0.95).norm()) * smooth_step(7, 8.5, p.z());
  if (lips > 0) {
    // Creases run across the lips: noise stretched along y.
    sum += lips * lip_depth_ * lip_creases_.at({p.x(), 0.2 * p.y(), 0.2 * p.z()});
  }
  return sum;
}

double Relief::height(const SkinPoint& mean) const {
  if (mean.relief_weight <= 0) return 0;
  return mean.relief_weight * (fold_height(mean.position) + grain(mean.position));
}

}  // namespace crowdface::synth
