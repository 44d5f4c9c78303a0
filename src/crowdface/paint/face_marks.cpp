// SPDX-License-Identifier: Apache-2.0
#include "crowdface/paint/face_marks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "crowdface/mesh/adjacency.h"
#include "crowdface/mesh/normals.h"
#include "crowdface/parts/part_list.h"

namespace crowdface {
namespace {

constexpr Index kHeights = 720;

/// How far in front the skin reaches in a plane, at each of kHeights heights.
class Outline {
 public:
  Outline(const Topology& topology, const Positions& positions, const std::vector<bool>& skin,
          const HeadAxes& axes, double middle)
      : front_(kHeights, kNothing) {
    low_ = std::numeric_limits<double>::infinity();
    double high = -low_;
    for (Index v = 0; v < positions.rows(); ++v) {
      if (!skin[static_cast<std::size_t>(v)]) continue;
      const double height = row3(positions, v).dot(axes.up);
      low_ = std::min(low_, height);
      high = std::max(high, height);
    }
    step_ = (high - low_) / static_cast<double>(kHeights - 1);
    if (!(step_ > 0)) return;
    const Eigen::Vector3d side = axes.side();
    for (Index f = 0; f < topology.face_count(); ++f) {
      const auto face = topology.face(f);
      if (!skin[face[0]]) continue;
      std::vector<Eigen::Vector2d> cut;  // height and front of the places where edges cross
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
    fill_gaps();
    soften();
  }

  bool empty() const { return front_.empty() || front_[0] == kNothing; }
  double low() const { return low_; }
  double high() const { return height(kHeights - 1); }
  double height(Index bin) const { return low_ + static_cast<double>(bin) * step_; }
  double at(double height) const {
    const double x = std::clamp((height - low_) / step_, 0.0, static_cast<double>(kHeights - 1));
    const auto bin = std::min(static_cast<std::size_t>(x), static_cast<std::size_t>(kHeights - 2));
    const double t = x - static_cast<double>(bin);
    return (1 - t) * front_[bin] + t * front_[bin + 1];
  }
  /// The outline with whatever is hollow over less than `width` filled: a mouth that is open a little.
  Outline without_slits(double width) const {
    Outline closed = *this;
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
  /// How far the outline lies behind the line between the places a way above and below.
  double hollow(double height, double way) const {
    return (at(height + way) + at(height - way)) / 2 - at(height);
  }
  /// The height from `from` to `to` at which `measure` is largest.
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
  static constexpr double kNothing = -std::numeric_limits<double>::infinity();

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
  void fill_gaps() {
    std::vector<std::size_t> known;
    for (std::size_t i = 0; i < front_.size(); ++i) {
      if (front_[i] != kNothing) known.push_back(i);
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
  void soften() {
    for (int round = 0; round < 4; ++round) {
      const std::vector<double> before = front_;
      for (std::size_t i = 1; i + 1 < front_.size(); ++i) {
        front_[i] = (before[i - 1] + 2 * before[i] + before[i + 1]) / 4;
      }
    }
  }

  double low_ = 0, step_ = 0;
  std::vector<double> front_;
};

// Of the diagonal of the head's box, some 380 mm.
constexpr double kNoseWay = 0.055, kSlit = 0.03, kLeastNose = 0.01, kMostNose = 0.06,
                 kThroat = 0.25, kLeastThroat = 0.02, kInFront = 0.3, kLevel = 0.01;
// Where a nose may be, of the skin's height: a head without neck, and one with shoulders.
constexpr double kLowestNose = 0.28, kHighestNose = 0.85;
// Of people, as parts of the way from a nose's bridge to its tip, some 40 mm.
constexpr double kLeastMouth = 0.55, kMostMouth = 1.3, kLipWay = 0.12;
// Of the way from eyes to mouth, some 65 mm.
constexpr double kLeastChin = 0.4, kMostChin = 1.05, kChinWay = 0.15;
/// Eyes lie below the bridge by this part of the way from there to the mouth.
constexpr double kEyesBelowBridge = 0.05;
/// Halves of heads differ by less than 0.07 of the breadth, front and back by more than 0.09.
constexpr double kMostUneven = 0.09;

double diagonal_of(const Positions& positions, const std::vector<bool>& skin) {
  Eigen::AlignedBox3d box;
  for (Index v = 0; v < positions.rows(); ++v) {
    if (skin[static_cast<std::size_t>(v)]) box.extend(row3(positions, v));
  }
  return box.isEmpty() ? 0 : box.sizes().norm();
}

/// How far a head is from being its own mirror image across `side`: mean difference of the outlines
/// of its halves, as a part of its breadth.
double asymmetry(const Positions& positions, const std::vector<bool>& skin, const HeadAxes& axes) {
  constexpr int kCells = 24;
  const Eigen::Vector3d side = axes.side();
  const auto in_frame = [&](Index v) {
    const Eigen::Vector3d p = row3(positions, v);
    return Eigen::Vector3d(p.dot(side), p.dot(axes.up), p.dot(axes.front));
  };
  Eigen::AlignedBox3d box;
  for (Index v = 0; v < positions.rows(); ++v) {
    if (skin[static_cast<std::size_t>(v)]) box.extend(in_frame(v));
  }
  struct Reach {
    double least = std::numeric_limits<double>::infinity(), most = -least;
  };
  std::vector<Reach> reach(static_cast<std::size_t>(kCells) * kCells);
  const auto cell = [&](double x, int axis) {
    const double t = (x - box.min()[axis]) / std::max(box.sizes()[axis], 1e-300);
    return static_cast<std::size_t>(std::clamp(static_cast<int>(kCells * t), 0, kCells - 1));
  };
  for (Index v = 0; v < positions.rows(); ++v) {
    if (!skin[static_cast<std::size_t>(v)]) continue;
    const Eigen::Vector3d p = in_frame(v);
    Reach& at = reach[kCells * cell(p.y(), 1) + cell(p.z(), 2)];
    at.least = std::min(at.least, p.x());
    at.most = std::max(at.most, p.x());
  }
  // The mirror plane that fits the outlines best goes through the middle of the middles.
  std::vector<double> middles;
  for (const Reach& at : reach) {
    if (at.most >= at.least) middles.push_back((at.least + at.most) / 2);
  }
  if (middles.empty()) return 0;
  const auto half = middles.begin() + static_cast<std::ptrdiff_t>(middles.size() / 2);
  std::nth_element(middles.begin(), half, middles.end());
  const double middle = *half;
  double sum = 0;
  for (const double m : middles) sum += std::abs(m - middle);
  return 2 * sum / (static_cast<double>(middles.size()) * std::max(box.sizes().x(), 1e-300));
}

}  // namespace

HeadShape shape_of_mean(const FaceSet& faces) {
  HeadShape head;
  head.positions = mean_head(faces);
  const Adjacency adjacency = build_adjacency(faces.topology);
  const Components components = find_components(adjacency);
  const PartList parts = find_parts(faces.topology, adjacency, components, head.positions);
  for (const std::uint32_t c : components.of_vertex) {
    head.skin.push_back(parts.classes[c] == PartClass::kSkin);
  }
  for (const Part& part : parts.parts) {
    if (part.eyeball) head.eyeballs.push_back(parts.shapes[part.ball].centre);
  }
  return head;
}

double middle_of(const Topology& topology, const HeadShape& head, const HeadAxes& axes) {
  const Eigen::Vector3d side = axes.side();
  double sum = 0, area = 0;
  for (Index f = 0; f < topology.face_count(); ++f) {
    const auto face = topology.face(f);
    if (!head.skin[face[0]]) continue;
    double middle = 0;
    for (const std::uint32_t v : face) middle += row3(head.positions, v).dot(side);
    const double weight = face_area_vector(topology, f, head.positions).norm();
    sum += weight * middle / static_cast<double>(face.size());
    area += weight;
  }
  return area > 0 ? sum / area : 0;
}

std::optional<FaceMarks> find_face_marks(const Topology& topology, const HeadShape& head,
                                         const HeadAxes& axes) {
  const Positions& positions = head.positions;
  const std::vector<bool>& skin = head.skin;
  if (asymmetry(positions, skin, axes) > kMostUneven) return std::nullopt;
  FaceMarks marks;
  marks.middle = middle_of(topology, head, axes);
  const Outline outline(topology, positions, skin, axes, marks.middle);
  if (outline.empty()) return std::nullopt;
  const double size = diagonal_of(positions, skin), way = kNoseWay * size;
  const Outline closed = outline.without_slits(kSlit * size);
  // A nose stands out against what is above and what is below; a chin or a forehead does not.
  const auto stands_out = [&](double height) {
    const double front = closed.at(height);
    const double drop = front - std::max(closed.at(height + way), closed.at(height - way));
    const bool top = front >= std::max(closed.at(height + way / 2), closed.at(height - way / 2));
    return top ? drop : 0;
  };
  const double tall = closed.high() - closed.low();
  const double low = closed.low() + kLowestNose * tall, high = closed.low() + kHighestNose * tall;
  const double near = closed.best(low, high, stands_out);
  marks.stands_out = stands_out(near) / size;
  if (marks.stands_out < kLeastNose || marks.stands_out > kMostNose) return std::nullopt;
  const auto front_at = [&](double height) { return closed.at(height); };
  marks.tip = closed.best(near - way, near + way, front_at);
  const double around = kInFront * size;
  const double foremost = closed.best(marks.tip - around, marks.tip + around, front_at);
  if (closed.at(foremost) > closed.at(marks.tip) + kLevel * size)
    return std::nullopt;  // a neck seen from below
  // The throat lies farther behind the nose than the forehead does.
  const double far = kThroat * size;
  if (closed.at(marks.tip + far) - closed.at(marks.tip - far) < kLeastThroat * size) {
    return std::nullopt;
  }
  marks.bridge = outline.best(marks.tip + 0.06 * size, marks.tip + 0.2 * size,
                              [&](double h) { return outline.hollow(h, 0.04 * size); });
  const double nose = marks.bridge - marks.tip;
  marks.mouth = outline.best(marks.tip - kMostMouth * nose, marks.tip - kLeastMouth * nose,
                             [&](double h) { return outline.hollow(h, kLipWay * nose); });
  marks.eyes = marks.bridge - kEyesBelowBridge * (marks.bridge - marks.mouth);
  if (!head.eyeballs.empty()) {
    marks.eyes = 0;
    for (const Eigen::Vector3d& eye : head.eyeballs) {
      marks.eyes += eye.dot(axes.up) / static_cast<double>(head.eyeballs.size());
    }
  }
  const double face = marks.face();
  if (!(face > 0)) return std::nullopt;
  marks.chin = outline.best(marks.mouth - kMostChin * face, marks.mouth - kLeastChin * face,
                            [&](double h) { return -outline.hollow(h, kChinWay * face); });
  marks.chin_front = outline.at(marks.chin);
  return marks;
}

HeadAxes axes_of(const Bearing& bearing) {
  return {unit_vector(bearing.front), unit_vector(bearing.up)};
}

std::optional<Bearing> find_bearing(const Topology& topology, const HeadShape& head) {
  std::array<double, 3> uneven{};  // with each axis to the side
  for (int axis = 0; axis < 3; ++axis) {
    const Bearing bearing{{(axis + 1) % 3, 1}, {(axis + 2) % 3, 1}};
    uneven[static_cast<std::size_t>(axis)] = asymmetry(head.positions, head.skin, axes_of(bearing));
  }
  const auto side = static_cast<int>(std::ranges::min_element(uneven) - uneven.begin());
  std::optional<Bearing> best;
  double most = 0;
  for (const int up : {(side + 1) % 3, (side + 2) % 3}) {
    for (const int up_sign : {1, -1}) {
      for (const int front_sign : {1, -1}) {
        const Bearing bearing{{up, up_sign}, {3 - side - up, front_sign}};
        const auto marks = find_face_marks(topology, head, axes_of(bearing));
        if (!marks || marks->stands_out <= most) continue;
        most = marks->stands_out;
        best = bearing;
      }
    }
  }
  return best;
}

}  // namespace crowdface
