// SPDX-License-Identifier: Apache-2.0
#include "crowdface/paint/face_marks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "crowdface/core/selection.h"
#include "crowdface/core/text.h"
#include "crowdface/mesh/adjacency.h"
#include "crowdface/mesh/normals.h"
#include "crowdface/parts/part_list.h"

namespace crowdface {
namespace {

constexpr Index kHeights = 720;  // number of samples of a profile

/// Profile of the skin near the symmetry plane: the front coordinate of the foremost skin at each
/// of kHeights heights.
class Profile {
 public:
  /// \param mm  length, in the unit of the positions, that stands for a millimetre of a face of
  ///            average size
  /// \param planes_mm  the profile is the median of the profiles in these planes, which are
  ///                   parallel to the symmetry plane; distances from `middle` along axes.side()
  Profile(const Topology& topology, const Positions& positions, const std::vector<bool>& skin,
          const HeadAxes& axes, double middle, double mm, const std::vector<double>& planes_mm) {
    low_ = std::numeric_limits<double>::infinity();
    double high = -low_;
    for (Index v = 0; v < positions.rows(); ++v) {
      if (!skin[static_cast<std::size_t>(v)]) continue;
      const double height = row3(positions, v).dot(axes.up);
      low_ = std::min(low_, height);
      high = std::max(high, height);
    }
    step_ = (high - low_) / static_cast<double>(kHeights - 1);
    front_.assign(kHeights, kNoSkin);
    if (!(step_ > 0)) return;
    std::vector<std::vector<double>> fronts(planes_mm.size());
    for (std::size_t i = 0; i < fronts.size(); ++i) {
      front_.assign(kHeights, kNoSkin);
      cut(topology, positions, skin, axes, middle + planes_mm[i] * mm);
      fill_gaps();
      fronts[i] = front_;
    }
    for (std::size_t h = 0; h < front_.size(); ++h) {
      std::vector<double> at;
      for (const std::vector<double>& front : fronts) at.push_back(front[h]);
      front_[h] = nth_smallest(at, at.size() / 2);
    }
    smooth(kSmoothingMm * mm);
  }

  double height(Index bin) const { return low_ + static_cast<double>(bin) * step_; }
  double at(double height) const {
    const double x = std::clamp((height - low_) / step_, 0.0, static_cast<double>(kHeights - 1));
    const auto bin = std::min(static_cast<std::size_t>(x), static_cast<std::size_t>(kHeights - 2));
    const double t = x - static_cast<double>(bin);
    return (1 - t) * front_[bin] + t * front_[bin + 1];
  }
  /// Returns a copy of the profile in which hollows are filled that are narrower than `width` (in
  /// the unit of the positions), such as a slightly open mouth.
  Profile without_slits(double width) const {
    Profile closed = *this;
    const auto reach = static_cast<std::ptrdiff_t>(width / (2 * step_));
    const auto extreme = [&](const std::vector<double>& values, const auto& pick) {
      std::vector<double> out(values.size());
      const auto count = static_cast<std::ptrdiff_t>(values.size());
      for (std::ptrdiff_t i = 0; i < count; ++i) {
        const auto begin = values.begin() + std::max<std::ptrdiff_t>(i - reach, 0);
        const auto end = values.begin() + std::min(i + reach + 1, count);
        out[static_cast<std::size_t>(i)] = *pick(begin, end);
      }
      return out;
    };
    const auto highest = [](auto begin, auto end) { return std::max_element(begin, end); };
    const auto lowest = [](auto begin, auto end) { return std::min_element(begin, end); };
    closed.front_ = extreme(extreme(front_, highest), lowest);
    return closed;
  }
  /// Returns the depth of the profile at `height`, measured from the straight line between the
  /// profile's points at `height` + `half_width` and `height` − `half_width`. Negative where the
  /// profile is convex.
  double hollow(double height, double half_width) const {
    return (at(height + half_width) + at(height - half_width)) / 2 - at(height);
  }
  /// Returns the height between `from` and `to` at which `measure(height)` is largest.
  template <class Measure>
  double best(double from, double to, const Measure& measure) const {
    double best = from, most = -std::numeric_limits<double>::infinity();
    for (double height = from; height <= to; height += step_) {
      const double value = measure(height);
      if (value > most) {
        most = value;
        best = height;
      }
    }
    return best;
  }

 private:
  static constexpr double kNoSkin = -std::numeric_limits<double>::infinity();
  static constexpr double kSmoothingMm = 1.5;

  /// Adds to `front_` the curve in which the plane at the lateral position `middle` cuts the skin.
  void cut(const Topology& topology, const Positions& positions, const std::vector<bool>& skin,
           const HeadAxes& axes, double middle) {
    const Eigen::Vector3d side = axes.side();
    for (Index f = 0; f < topology.face_count(); ++f) {
      const auto face = topology.face(f);
      if (!skin[face[0]]) continue;
      // Height and front coordinate of the points at which edges cross the plane.
      std::vector<Eigen::Vector2d> cut;
      for (std::size_t c = 0; c < face.size(); ++c) {
        const Eigen::Vector3d a = row3(positions, face[c]);
        const Eigen::Vector3d b = row3(positions, face[(c + 1) % face.size()]);
        const double da = a.dot(side) - middle, db = b.dot(side) - middle;
        if ((da < 0) == (db < 0)) continue;
        const Eigen::Vector3d at = a + da / (da - db) * (b - a);
        cut.emplace_back(at.dot(axes.up), at.dot(axes.front));
      }
      for (std::size_t i = 1; i < cut.size(); ++i) add(cut[i - 1], cut[i]);
    }
  }
  void add(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    const Eigen::Vector2d &lower = a.x() < b.x() ? a : b, &upper = a.x() < b.x() ? b : a;
    const auto first = static_cast<Index>(std::ceil((lower.x() - low_) / step_));
    const auto last = static_cast<Index>(std::floor((upper.x() - low_) / step_));
    for (Index i = std::max<Index>(first, 0); i <= std::min(last, kHeights - 1); ++i) {
      const double length = upper.x() - lower.x();
      const double t = length > 0 ? (height(i) - lower.x()) / length : 0;
      double& front = front_[static_cast<std::size_t>(i)];
      front = std::max(front, lower.y() + t * (upper.y() - lower.y()));
    }
  }
  /// Sets `front_` at heights at which the plane cuts no skin: interpolates linearly between the
  /// nearest heights with skin. Above and below all skin, repeats the nearest value.
  void fill_gaps() {
    std::vector<std::size_t> known;
    for (std::size_t i = 0; i < front_.size(); ++i) {
      if (front_[i] != kNoSkin) known.push_back(i);
    }
    if (known.empty()) return;
    for (std::size_t i = 0; i < known.front(); ++i) front_[i] = front_[known.front()];
    for (std::size_t i = known.back() + 1; i < front_.size(); ++i) front_[i] = front_[known.back()];
    for (std::size_t k = 1; k < known.size(); ++k) {
      const std::size_t a = known[k - 1], b = known[k];
      for (std::size_t i = a + 1; i < b; ++i) {
        const double t = static_cast<double>(i - a) / static_cast<double>(b - a);
        front_[i] = (1 - t) * front_[a] + t * front_[b];
      }
    }
  }
  /// Smooths the profile with a binomial filter.
  /// \param width  standard deviation of the filter, in the unit of the positions
  void smooth(double width) {
    const auto rounds = static_cast<int>(std::ceil(2 * (width / step_) * (width / step_)));
    for (int round = 0; round < rounds; ++round) {
      const std::vector<double> before = front_;
      for (std::size_t i = 1; i + 1 < front_.size(); ++i) {
        front_[i] = (before[i - 1] + 2 * before[i] + before[i + 1]) / 4;
      }
    }
  }

  double low_ = 0, step_ = 0;
  std::vector<double> front_;
};

// The following lengths are millimetres on a face of average size.
/// Hollows of the profile that are narrower than kMaxSlitMm are filled, such as an open mouth.
constexpr double kMaxSlitMm = 11;
/// Heights on the mean face, relative to the eyes: of the bridge of the nose and of its tip, which
/// is below the eyes.
constexpr double kBridgeMm = 5, kTipMm = -34;
/// The bridge of the nose is searched from kBridgeSearchMm below to kBridgeSearchMm above its
/// height on the mean face; kTipSearchMm is the same for the tip of the nose. kMouthSpreadMm: see
/// the height penalty of the mouth in mouth_and_chin.
constexpr double kBridgeSearchMm = 10, kTipSearchMm = 14, kMouthSpreadMm = 12;
/// Half widths, along the profile, of the hollow at the bridge of the nose, of the hollow between
/// the lips and of the chin.
constexpr double kBridgeHalfWidthMm = 15, kLipHalfWidthMm = 5, kChinHalfWidthMm = 10;
/// The search for the bridge and the tip of the nose prefers heights near the feature's height on
/// the mean face: the search subtracts a penalty from each measured depth. On a mesh with edges of
/// at most kFineMm, the penalty is this length at the highest and the lowest searched height, and
/// smaller between these two heights. On a mesh with longer edges, all penalties are multiplied by
/// a factor above 1.
constexpr double kMaxHeightPenaltyMm = 3;
/// kMaxMiddleOffsetMm: if the middle of the skin is farther than this length from the symmetry
/// plane of the relief, the symmetry plane of the relief is used. kMaxEyeOffsetMm: if the heights
/// of the eyeballs and of the relief's eyes differ by more than this length, the eyeballs are
/// ignored.
constexpr double kMaxMiddleOffsetMm = 4, kMaxEyeOffsetMm = 20;
constexpr double kFineMm = 5;  ///< edges up to this length resolve the lips
/// A mesh whose edges near the face are longer is too coarse to show a face.
constexpr double kMaxEdgeMm = 18;
struct MouthAndChin {
  double mouth = 0, chin = 0;  ///< heights of mouth and chin
};

/// Finds mouth and chin together. The mouth is a hollow of the profile between two convex lips. The
/// chin is convex. The mouth divides the distance from the tip of the nose to the chin in about the
/// same ratio in all faces.
/// \param tip      height of the tip of the nose
/// \param mm       length of a millimetre of the mean face, in the unit of the heights
/// \param stretch  vertical scale of the face divided by its horizontal scale
/// \param prior    weight of a penalty on unusual heights of the mouth. The penalty is
///                 prior / 2 · (d / kMouthSpreadMm)². Here d is the distance of the mouth from the
///                 mouth's height on the mean face.
MouthAndChin mouth_and_chin(const Profile& outline, double tip, double mm, double stretch,
                            double prior) {
  constexpr double kChinFromMm = 115, kChinToMm = 50, kMouthFromMm = 65, kMouthToMm = 18;
  constexpr double kStepMm = 0.5;
  constexpr double kRatio = 0.47, kRatioSpread = 0.04;
  constexpr double kMouthBelowTipMm = 38;
  // The part of a hollow's depth that exceeds kDeepMm is multiplied by kDeeperShare, because an
  // open mouth may be arbitrarily deep.
  constexpr double kDeepMm = 4, kDeeperShare = 0.25;
  constexpr double kMaxConvexMm = 4.5;
  // The mouth lies between two convex lips. The hollow above the chin has a lip only on its upper
  // side. kToLipMm: distance above and below the mouth at which the lips' convexity is measured.
  // kMaxLipMm: upper limit of the measured convexity.
  constexpr double kToLipMm = 6, kMaxLipMm = 2;
  const auto lip = [&](double height) {
    return std::clamp(-outline.hollow(height, kLipHalfWidthMm * mm), 0.0, kMaxLipMm * mm);
  };
  MouthAndChin best{tip - kMouthBelowTipMm * stretch * mm, tip - kMouthBelowTipMm / kRatio * mm};
  double most = -std::numeric_limits<double>::infinity();
  std::vector<double> of_mouth;
  for (double below = kMouthToMm; below <= kMouthFromMm; below += kStepMm) {
    const double hollow = outline.hollow(tip - below * mm, kLipHalfWidthMm * mm);
    const double deeper = std::max(hollow - kDeepMm * mm, 0.0);
    const double lips = lip(tip - (below - kToLipMm) * mm) + lip(tip - (below + kToLipMm) * mm);
    const double off = (below - kMouthBelowTipMm * stretch) / kMouthSpreadMm;
    of_mouth.push_back(hollow - (1 - kDeeperShare) * deeper + lips - prior / 2 * off * off);
  }
  for (double to_chin = kChinToMm; to_chin <= kChinFromMm; to_chin += kStepMm) {
    const double convex =
        std::min(-outline.hollow(tip - to_chin * mm, kChinHalfWidthMm * mm), kMaxConvexMm * mm);
    for (std::size_t i = 0; i < of_mouth.size(); ++i) {
      const double to_mouth = kMouthToMm + static_cast<double>(i) * kStepMm;
      const double off = (to_mouth / to_chin - kRatio) / kRatioSpread;
      const double sum = of_mouth[i] + convex - off * off * mm;
      if (sum <= most) continue;
      most = sum;
      best = {tip - to_mouth * mm, tip - to_chin * mm};
    }
  }
  return best;
}

/// The height of the eyes, estimated from the hollows at the inner corners of the eyes and between
/// the lids.
struct EyeHollows {
  double height = 0;
  double weight = 0;  ///< 0 (no hollows were found) … 1 (deep hollows)
};
/// \param eyes  height of the eyes of the matched relief
/// \param across  lateral position of the symmetry plane
EyeHollows find_eye_hollows(const Topology& topology, const HeadShape& head, const HeadAxes& axes,
                            double eyes, double across, double mm) {
  // On the mean face, the inner corners are 17 mm and the middles of the eyes 32 mm beside the
  // symmetry plane.
  constexpr std::array kBesideMm = {-32.0, -22.0, -17.0, 17.0, 22.0, 32.0};
  constexpr double kSearchMm = 18, kHalfWidthMm = 10, kMaxHoleMm = 7;
  // Depths above kMaxDepthMm are reduced to kMaxDepthMm: without eyeballs, an eye is a deep hole.
  constexpr double kMaxDepthMm = 8, kSureDepthMm = 2.5, kPenaltyMm = 0.5;
  std::vector<Profile> profiles;
  for (const double beside : kBesideMm) {
    profiles.push_back(Profile(topology, head.positions, head.is_skin, axes, across, mm, {beside})
                           .without_slits(kMaxHoleMm * mm));
  }
  const auto mean_depth_mm = [&](double height) {
    double sum = 0;
    for (const Profile& profile : profiles) {
      const double depth = profile.hollow(height, kHalfWidthMm * mm) / mm;
      if (depth > 0) sum += std::min(depth, kMaxDepthMm);  // NaN where a plane cuts no skin
    }
    return sum / static_cast<double>(profiles.size());
  };
  EyeHollows found;
  found.height =
      profiles.front().best(eyes - kSearchMm * mm, eyes + kSearchMm * mm, [&](double height) {
        const double off = (height - eyes) / (kSearchMm * mm);
        return mean_depth_mm(height) - kPenaltyMm * off * off;
      });
  found.weight = std::min(mean_depth_mm(found.height) / kSureDepthMm, 1.0);
  return found;
}

/// Returns the typical edge length of the skin within about 70 mm of the eyes: the square root of
/// the median polygon area. If no polygon is that near, uses all polygons of the skin.
/// \param face  position and size of the head's face, as found from its relief
double edge_length_near(const Topology& topology, const HeadShape& head, const ReliefMatch& face) {
  constexpr double kNearMm = 70;
  std::vector<double> areas, all_areas;
  for (Index f = 0; f < topology.face_count(); ++f) {
    const std::uint32_t first = topology.face(f)[0];
    const bool is_near =
        (row3(head.positions, first) - face.eye_midpoint).norm() < kNearMm * face.scale;
    if (!head.is_skin[first]) continue;
    all_areas.push_back(face_area_vector(topology, f, head.positions).norm());
    if (is_near) areas.push_back(all_areas.back());
  }
  if (areas.empty()) areas = std::move(all_areas);
  return areas.empty() ? 0 : std::sqrt(nth_smallest(areas, areas.size() / 2));
}

}  // namespace

HeadShape mean_head_shape(const HeadSet& heads) {
  HeadShape head;
  head.positions = mean_head(heads);
  const Adjacency adjacency = build_adjacency(heads.topology);
  const Components components = find_components(adjacency);
  const PartList parts = find_parts(heads.topology, adjacency, components, head.positions);
  for (const std::uint32_t c : components.component_of_vertex) {
    head.is_skin.push_back(parts.classes[c] == PartClass::kSkin);
  }
  for (const Part& part : parts.parts) {
    if (part.is_eyeball) head.eyeball_centres.push_back(parts.shapes[part.ball_component].centre);
  }
  return head;
}

double symmetry_offset(const Topology& topology, const HeadShape& head, const HeadAxes& axes) {
  const Eigen::Vector3d side = axes.side();
  double sum = 0, area = 0;
  for (Index f = 0; f < topology.face_count(); ++f) {
    const auto face = topology.face(f);
    if (!head.is_skin[face[0]]) continue;
    double middle = 0;
    for (const std::uint32_t v : face) middle += row3(head.positions, v).dot(side);
    const double weight = face_area_vector(topology, f, head.positions).norm();
    sum += weight * middle / static_cast<double>(face.size());
    area += weight;
  }
  return area > 0 ? sum / area : 0;
}

std::optional<ReliefMatch> find_face(const Topology& topology, const HeadShape& head,
                                     const HeadAxes& axes) {
  const Positions samples = sample_skin(topology, head.positions, head.is_skin, kSkinSamples);
  auto match = match_relief(samples, {axes}, head.eyeball_centres);
  if (!match || match->score < kMinScore || match->rotation_degrees > kMaxRotationDegrees)
    return {};
  if (edge_length_near(topology, head, *match) > kMaxEdgeMm * match->scale) return {};
  return match;
}

FaceMarks marks_of_face(const Topology& topology, const HeadShape& head, const ReliefMatch& match) {
  FaceMarks marks;
  marks.axes = match.axes;
  const double mm = match.scale, eyes = match.eye_midpoint.dot(match.fitted_axes.up);
  // Two estimates of the symmetry plane: through the middle between the left and the right half of
  // the skin, and through the middle of the matched relief of the face. The first estimate is more
  // accurate, except if hair or a cap shifts the middle of the skin. So use the second estimate if
  // both differ much.
  marks.symmetry_offset = symmetry_offset(topology, head, marks.axes);
  const double of_relief = match.eye_midpoint.dot(match.axes.side());
  if (std::abs(marks.symmetry_offset - of_relief) > kMaxMiddleOffsetMm * mm)
    marks.symmetry_offset = of_relief;
  // The profile is the outline of the face in its symmetry plane. Its axes are `fitted_axes`, in
  // which the face is upright, so that the posture of the head has no effect.
  const double across = match.eye_midpoint.dot(match.fitted_axes.side());
  // The median of several planes hides small holes and noise.
  const Profile outline(topology, head.positions, head.is_skin, match.fitted_axes, across, mm,
                        {-6, -3, 0, 3, 6});
  const Profile closed = outline.without_slits(kMaxSlitMm * mm);
  // A quadratic penalty keeps each feature near its height on the mean face, because shallow
  // hollows may be noise. A mesh with long edges does not show the slit between the lips, so the
  // penalty, and thus the mean face, has more weight on such a mesh.
  const double coarseness = std::max(1.0, edge_length_near(topology, head, match) / (kFineMm * mm));
  const double prior = kMaxHeightPenaltyMm * mm * coarseness * coarseness;
  const auto best_near = [&](double expected, double reach, const auto& measure) {
    const double middle = eyes + expected * match.stretch * mm;
    return outline.best(middle - reach * mm, middle + reach * mm, [&](double h) {
      const double off = (h - middle) / (reach * mm);
      return measure(h) - prior * off * off;
    });
  };
  const double tip = best_near(kTipMm, kTipSearchMm, [&](double h) { return closed.at(h); });
  const double bridge = best_near(kBridgeMm, kBridgeSearchMm, [&](double h) {
    return outline.hollow(h, kBridgeHalfWidthMm * mm);
  });
  const auto [mouth, chin] = mouth_and_chin(outline, tip, mm, match.stretch, prior);
  const auto place = [&](double h) -> Eigen::Vector3d {
    return across * match.fitted_axes.side() + h * match.fitted_axes.up +
           closed.at(h) * match.fitted_axes.front;
  };
  const auto height = [&](double h) { return place(h).dot(marks.axes.up); };
  marks.tip_height = height(tip);
  marks.bridge_height = height(bridge);
  marks.mouth_height = height(mouth);
  marks.chin_height = height(chin);
  marks.chin_front = place(chin).dot(marks.axes.front);
  // Eyeballs near the eyes of the matched relief give the height of the eyes. A head without
  // eyeballs has three estimates of this height: the hollows of the eyes, the eyes of the relief,
  // and a point at a fixed distance below the bridge. The last two depend on the fitted size and
  // stretch of the relief, which vary with small changes of the mesh. Therefore deep hollows alone
  // determine the height.
  double of_balls = 0;
  for (const Eigen::Vector3d& eye : head.eyeball_centres) {
    of_balls += eye.dot(marks.axes.up) / static_cast<double>(head.eyeball_centres.size());
  }
  const double of_relief_eyes = match.eye_midpoint.dot(marks.axes.up);
  if (!head.eyeball_centres.empty() && std::abs(of_balls - of_relief_eyes) < kMaxEyeOffsetMm * mm) {
    marks.eyes_height = of_balls;
    return marks;
  }
  const EyeHollows hollows = find_eye_hollows(topology, head, match.fitted_axes, eyes, across, mm);
  const double without_hollows =
      (of_relief_eyes + height(bridge - kBridgeMm * match.stretch * mm)) / 2;
  marks.eyes_height =
      hollows.weight * height(hollows.height) + (1 - hollows.weight) * without_hollows;
  return marks;
}

std::optional<FaceMarks> find_face_marks(const Topology& topology, const HeadShape& head,
                                         const HeadAxes& axes) {
  const auto face = find_face(topology, head, axes);
  if (!face) return std::nullopt;
  return marks_of_face(topology, head, *face);
}

HeadAxes axes_of(const Orientation& orientation) {
  return {unit_vector(orientation.front), unit_vector(orientation.up)};
}

std::vector<Orientation> all_orientations() {
  std::vector<Orientation> orientations;
  for (int up = 0; up < 3; ++up) {
    for (int front = 0; front < 3; ++front) {
      for (int signs = 0; signs < 4; ++signs) {
        if (up == front) continue;
        orientations.push_back({{up, signs % 2 == 0 ? 1 : -1}, {front, signs / 2 == 0 ? 1 : -1}});
      }
    }
  }
  return orientations;
}

std::optional<Orientation> find_orientation(const Topology& topology, const HeadShape& head) {
  const std::vector<Orientation> orientations = all_orientations();
  std::vector<HeadAxes> axes;
  for (const Orientation& orientation : orientations) axes.push_back(axes_of(orientation));
  const Positions samples = sample_skin(topology, head.positions, head.is_skin, kSkinSamples);
  const auto match = match_relief(samples, axes, head.eyeball_centres);
  if (!match || match->score < kMinScore) return std::nullopt;
  if (edge_length_near(topology, head, *match) > kMaxEdgeMm * match->scale) return std::nullopt;
  return orientations[match->nearest_orientation_index];
}

std::optional<std::string> long_edges_message(const Topology& topology, const HeadShape& head,
                                              const HeadAxes& axes) {
  const Positions samples = sample_skin(topology, head.positions, head.is_skin, kSkinSamples);
  const auto match = match_relief(samples, {axes}, head.eyeball_centres);
  if (!match || match->score < kMinScore) return std::nullopt;
  const double edge_mm = edge_length_near(topology, head, *match) / match->scale;
  if (edge_mm <= kMaxEdgeMm) return std::nullopt;
  return concat("the edges of its polygons are about ", format_fixed(edge_mm, 0),
                " mm long; above ", kMaxEdgeMm,
                " mm they do not show a face: use a mesh with more polygons");
}

std::string why_no_face_found(const Topology& topology, const HeadShape& head,
                              const HeadAxes& axes) {
  if (const auto found = find_orientation(topology, head)) {
    const HeadAxes other = axes_of(*found);
    if (other.up != axes.up || other.front != axes.front) {
      return concat("the heads look along ", name_of(found->front), " with ", name_of(found->up),
                    " up");
    }
  }
  return long_edges_message(topology, head, axes)
      .value_or("it has no relief of a face (nose, eye sockets, mouth and chin)");
}

}  // namespace crowdface
