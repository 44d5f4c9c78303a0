// SPDX-License-Identifier: Apache-2.0
#include "crowdface/paint/face_relief.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <numeric>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include "crowdface/core/parallel.h"
#include "crowdface/mesh/all_columns.h"
#include "crowdface/mesh/normals.h"
#include "crowdface/mesh/polygon_sample.h"

namespace crowdface {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kRadians = std::numbers::pi / 180;

// The mean face, of 16 synthetic heads: depths in mm behind the tip of the nose, every 8 mm. Columns go from the middle to
// the side, rows from 32 mm above the eyes to 96 mm below.
constexpr int kRows = 17, kHalfColumns = 6, kColumns = 2 * kHalfColumns - 1;
constexpr int kCells = kRows * kColumns;
constexpr double kSpacingMm = 8, kTopMm = 32;
constexpr double kMiddleMm = kTopMm - kSpacingMm * (kRows - 1) / 2;  ///< the relief's middle row
constexpr std::array<std::array<double, kHalfColumns>, kRows> kMeanRelief = {{
    {-23, -24, -26, -29, -32, -36},
    {-21, -22, -25, -28, -32, -35},
    {-20, -21, -24, -28, -32, -34},
    {-20, -22, -28, -33, -33, -35},
    {-19, -22, -35, -33, -33, -35},
    {-15, -19, -31, -33, -33, -35},
    {-9, -14, -28, -30, -32, -34},
    {-3, -8, -23, -28, -29, -31},
    {0, -5, -18, -27, -28, -30},
    {-1, -4, -12, -27, -28, -31},
    {-14, -21, -26, -28, -29, -32},
    {-22, -22, -24, -28, -31, -34},
    {-16, -18, -22, -27, -32, -36},
    {-16, -18, -22, -27, -33, -38},
    {-18, -20, -24, -29, -34, -40},
    {-21, -22, -25, -30, -36, -43},
    {-21, -22, -25, -30, -37, -47},
}};

using Cells = std::array<double, kCells>;

int column_of(int cell) {
  return cell % kColumns - (kHalfColumns - 1);
}  ///< 0 in the middle
int row_of(int cell) {
  return cell / kColumns;
}
double across_mm(int cell) {
  return kSpacingMm * column_of(cell);
}
double height_mm(int cell) {
  return kTopMm - kSpacingMm * row_of(cell);
}
double relief_mm(int cell) {
  return kMeanRelief[static_cast<std::size_t>(row_of(cell))]
                    [static_cast<std::size_t>(std::abs(column_of(cell)))];
}

/// How depths compare with the mean face.
struct ReliefFit {
  double agreement = -1;
  double amplitude = 0;  ///< of the relief, 1 for the mean face
  double offset = 0;     ///< depth between the eyes less the relief's
  double slope_up = 0;   ///< of the depths beneath the relief
};

constexpr int kBetweenEyes = 4 * kColumns + kHalfColumns - 1;  ///< a cell

constexpr int kTerms = 6;  ///< of a fit: 1, x, y, x², y², relief
using Coefficients = Eigen::Matrix<double, kTerms, 1>;
using Products =
    Eigen::Matrix<double, kTerms + 1, kTerms + 1>;  ///< of terms, and of depths in the last row

constexpr double kUnitMm = 40;  ///< of x and y in the terms

Coefficients terms_at(double x, double y, double relief) {
  return Coefficients(1, x, y, x * x, y * y, relief);
}
const std::array<Coefficients, kCells>& terms_of_cells() {
  static const auto all = [] {
    std::array<Coefficients, kCells> terms;
    for (int c = 0; c < kCells; ++c) {
      terms[static_cast<std::size_t>(c)] =
          terms_at(across_mm(c) / kUnitMm, (height_mm(c) - kMiddleMm) / kUnitMm, relief_mm(c));
    }
    return terms;
  }();
  return all;
}

/// Least squares of depths by an offset, slopes, curvatures and the mean relief over the cells that have a depth.
/// The Cholesky factor of all products, depths last, holds what the relief explains of what the others leave.
ReliefFit fit_cells(const Cells& depths, std::array<bool, kCells>& used, Coefficients& by) {
  constexpr double kFewest = 0.72 * kCells, kFlatMm = 0.05;
  const auto& terms = terms_of_cells();
  const auto count = static_cast<double>(std::ranges::count(used, true));
  if (count < kFewest) return {};
  Products products = Products::Zero();
  for (std::size_t c = 0; c < kCells; ++c) {
    if (!used[c]) continue;
    Eigen::Matrix<double, kTerms + 1, 1> row;
    row << terms[c], depths[c];
    products.selfadjointView<Eigen::Lower>().rankUpdate(row);
  }
  const Eigen::LLT<Products> factor(products.selfadjointView<Eigen::Lower>());
  const Products lower = factor.matrixL();
  const double explained = lower(kTerms, kTerms - 1), left = lower(kTerms, kTerms);
  const double relief_and_rest = std::hypot(explained, left);
  if (factor.info() != Eigen::Success || !(relief_and_rest > kFlatMm * std::sqrt(count))) return {};
  by = lower.topLeftCorner<kTerms, kTerms>().transpose().triangularView<Eigen::Upper>().solve(
      lower.row(kTerms).head<kTerms>().transpose());
  const double eyes = -kMiddleMm / kUnitMm;
  return {explained / relief_and_rest, by(kTerms - 1), by(0) + by(2) * eyes + by(4) * eyes * eyes,
          by(2) / kUnitMm};
}

/// \param depths  in mm; cells without a surface are -infinity
ReliefFit fit_relief(Cells& depths) {
  constexpr double kDeepestMm = 75, kHoleMm = 14, kPromising = 0.25;
  const double foremost = *std::ranges::max_element(depths);
  if (foremost == -kInfinity) return {};
  std::array<bool, kCells> used{};
  for (std::size_t c = 0; c < kCells; ++c) {
    depths[c] -= foremost;
    used[c] = depths[c] > -kDeepestMm;
  }
  Coefficients by;
  ReliefFit fit = fit_cells(depths, used, by);
  // An open mouth and the openings of the eyes lie behind the face: what is too deep is left out, twice.
  for (int round = 0; round < 2 && fit.agreement > kPromising; ++round) {
    bool is_hollow = false;
    for (std::size_t c = 0; c < kCells; ++c) {
      if (!used[c] || depths[c] - by.dot(terms_of_cells()[c]) > -kHoleMm) continue;
      used[c] = false;
      is_hollow = true;
    }
    if (!is_hollow) break;
    fit = fit_cells(depths, used, by);
  }
  fit.offset += foremost;
  return fit;
}

/// The foremost depth of a surface in each square of a grid, seen from the front.
class DepthMap {
 public:
  DepthMap(const Positions& samples, const HeadAxes& axes, double square)
      : side_(axes.side()), up_(axes.up), front_(axes.front), square_(square) {
    for (Index i = 0; i < samples.rows(); ++i) {
      const Eigen::Vector3d p = row3(samples, i);
      box_.extend(Eigen::Vector2d(p.dot(side_), p.dot(up_)));
    }
    columns_ = static_cast<Index>(box_.sizes().x() / square_) + 1;
    rows_ = static_cast<Index>(box_.sizes().y() / square_) + 1;
    depths_.assign(static_cast<std::size_t>(columns_ * rows_), -kInfinity);
    for (Index i = 0; i < samples.rows(); ++i) {
      const Eigen::Vector3d p = row3(samples, i);
      double& depth = depths_[index(p.dot(side_), p.dot(up_))];
      depth = std::max(depth, p.dot(front_));
    }
  }

  /// Means over three by three squares, of those that show the surface: noise counts less.
  void soften() {
    const std::vector<double> before = depths_;
    for (Index row = 1; row + 1 < rows_; ++row) {
      for (Index column = 1; column + 1 < columns_; ++column) {
        double sum = 0;
        int count = 0;
        for (const Index beside : {-columns_ - 1, -columns_, -columns_ + 1, Index{-1}, Index{0},
                                   Index{1}, columns_ - 1, columns_, columns_ + 1}) {
          const double depth = before[static_cast<std::size_t>(row * columns_ + column + beside)];
          if (depth == -kInfinity) continue;
          sum += depth;
          ++count;
        }
        if (count > 0) depths_[static_cast<std::size_t>(row * columns_ + column)] = sum / count;
      }
    }
  }

  const Eigen::AlignedBox2d& box() const { return box_; }

  /// \param across, height  between the eyes
  ReliefFit fit(double across, double height, double scale, double stretch = 1) const {
    Cells depths;
    for (int c = 0; c < kCells; ++c) {
      const double x = across + scale * across_mm(c), y = height + stretch * scale * height_mm(c);
      const bool is_inside = box_.contains(Eigen::Vector2d(x, y));
      depths[static_cast<std::size_t>(c)] = is_inside ? at(x, y) / scale : -kInfinity;
    }
    return fit_relief(depths);
  }

 private:
  /// Linear between the middles of four squares if all of them show the surface.
  double at(double x, double y) const {
    const double column = (x - box_.min().x()) / square_ - 0.5;
    const double row = (y - box_.min().y()) / square_ - 0.5;
    const double left = std::floor(column), low = std::floor(row);
    if (left < 0 || low < 0 || left + 1 >= static_cast<double>(columns_) ||
        low + 1 >= static_cast<double>(rows_)) {
      return depths_[index(x, y)];
    }
    const double s = column - left, t = row - low;
    const double* corner = &depths_[static_cast<std::size_t>(static_cast<Index>(low) * columns_ +
                                                             static_cast<Index>(left))];
    const double depth = (1 - t) * ((1 - s) * corner[0] + s * corner[1]) +
                         t * ((1 - s) * corner[columns_] + s * corner[columns_ + 1]);
    return std::isfinite(depth) ? depth : depths_[index(x, y)];
  }

  std::size_t index(double x, double y) const {
    const auto column = std::min(static_cast<Index>((x - box_.min().x()) / square_), columns_ - 1);
    const auto row = std::min(static_cast<Index>((y - box_.min().y()) / square_), rows_ - 1);
    return static_cast<std::size_t>(row * columns_ + column);
  }

  Eigen::Vector3d side_, up_, front_;
  Eigen::AlignedBox2d box_;
  double square_;
  Index columns_ = 0, rows_ = 0;
  std::vector<double> depths_;
};

/// A place for the relief, and how well it agrees there.
struct Candidate {
  double across = 0, height = 0, scale = 1, stretch = 1;
  ReliefFit fit;
  double votes = -1;
};

double diagonal_of(const Positions& samples) {
  return (samples.colwise().maxCoeff() - samples.colwise().minCoeff()).norm();
}

HeadAxes turned(const HeadAxes& axes, const Eigen::Vector3d& about, double degrees) {
  const Eigen::AngleAxisd turn(degrees * kRadians, about);
  return {turn * axes.front, turn * axes.up};
}

/// Degrees of the turn that carries one frame into another.
double angle_between(const HeadAxes& a, const HeadAxes& b) {
  const double trace = a.front.dot(b.front) + a.up.dot(b.up) + a.side().dot(b.side());
  return std::acos(std::clamp((trace - 1) / 2, -1.0, 1.0)) / kRadians;
}

constexpr double kVoteOfEyes = 0.15;

/// What eyeballs say about a place for the eyes: 1, or -1 against it; 0 if there are none.
int vote_of_eyes(const std::vector<Eigen::Vector3d>& eyes, const HeadAxes& axes, double across,
                 double height, double scale) {
  constexpr double kNearMm = 20;
  if (eyes.empty()) return 0;
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& eye : eyes) middle += eye / static_cast<double>(eyes.size());
  return std::hypot(middle.dot(axes.side()) - across, middle.dot(axes.up) - height) <
                 kNearMm * scale
             ? 1
             : -1;
}

/// The best place for the relief in one view, over all sizes.
/// \param coarseness  steps as multiples of the finest
Candidate search_view(const Positions& samples, const HeadAxes& axes,
                      const std::vector<Eigen::Vector3d>& eyes, double coarseness) {
  constexpr double kLeastAmplitude = 0.45, kMostAmplitude = 2;
  constexpr double kSquares = 150;  // along the diagonal
  constexpr double kLeastShare = 0.15,
                   kMostShare = 0.85;  // of the breadth that the relief may have
  constexpr double kReliefMm = kSpacingMm * (kColumns - 1);
  const double grow = std::pow(1.15, coarseness), up_mm = 6 * coarseness,
               aside_mm = 10 * coarseness;
  const DepthMap map(samples, axes, diagonal_of(samples) / kSquares);
  const Eigen::AlignedBox2d& box = map.box();
  const double breadth = box.sizes().x();
  std::vector<Candidate> of_scale;
  for (double scale = kLeastShare * breadth / kReliefMm; scale < kMostShare * breadth / kReliefMm;
       scale *= grow) {
    of_scale.emplace_back().scale = scale;
  }
  parallel_for_each(of_scale.size(), [&](std::size_t k) {
    Candidate& best = of_scale[k];
    const double scale = best.scale;
    const double top = box.max().y() - 0.5 * kTopMm * scale, low = box.min().y() + kTopMm * scale;
    const int aside = static_cast<int>(std::floor(0.25 * breadth / (aside_mm * scale)));
    for (double height = low; height < top; height += up_mm * scale) {
      for (int i = -aside; i <= aside; ++i) {
        const double across = box.center().x() + i * aside_mm * scale;
        const ReliefFit fit = map.fit(across, height, scale);
        if (!(fit.amplitude >= kLeastAmplitude && fit.amplitude <= kMostAmplitude)) continue;
        const double votes =
            fit.agreement + kVoteOfEyes * vote_of_eyes(eyes, axes, across, height, scale);
        if (votes > best.votes) best = {across, height, scale, 1, fit, votes};
      }
    }
  });
  if (of_scale.empty()) return {};
  return *std::ranges::max_element(of_scale, {}, &Candidate::votes);
}

ReliefMatch match_of(const Candidate& candidate, const HeadAxes& axes) {
  const double depth = candidate.fit.offset + candidate.fit.amplitude * relief_mm(kBetweenEyes);
  return {candidate.fit.agreement,
          candidate.votes,
          0,
          0,
          axes,
          candidate.across * axes.side() + candidate.height * axes.up +
              depth * candidate.scale * axes.front,
          candidate.scale,
          candidate.stretch};
}

/// Pattern search (Hooke & Jeeves 1961) for turn, place and size from a first match.
class Refinement {
 public:
  Refinement(const Positions& samples, const ReliefMatch& first) : best_(first) {
    constexpr double kAroundMm = 110, kBehindMm = 80;
    constexpr std::size_t kMost = 20'000;
    std::vector<Index> near;
    for (Index i = 0; i < samples.rows(); ++i) {
      const Eigen::Vector3d off = (row3(samples, i) - first.between) / first.scale;
      if (off.norm() < kAroundMm && off.dot(first.axes.front) > -kBehindMm) near.push_back(i);
    }
    if (const std::size_t step = near.size() / kMost; step > 1) {
      for (std::size_t i = 0; i * step < near.size(); ++i) near[i] = near[i * step];
      near.resize(near.size() / step);
    }
    near_ = samples(near, kAllColumns);
    square_ = kSquareMm * first.scale;
    try_match(first);
  }

  ReliefMatch find() {
    search();
    const double pitch = std::atan(slope_up_) / kRadians;
    if (std::abs(pitch) >
        kLeastPitch) {  // a smaller one is how the person holds the head, or the face's own form
      ReliefMatch next = best_;
      next.axes = turned(best_.axes, best_.axes.side(), pitch);
      best_.agreement = -1;
      try_match(next);
      search();
    }
    return best_;
  }

 private:
  static constexpr double kSquareMm = 2, kTurnDegrees = 8, kMoveMm = 6, kGrow = 0.08;
  static constexpr double kMostStretch = 0.25;  // of the logarithm
  static constexpr double kLeastPitch = 10;     // degrees

  void search() {
    for (double step = 1; step >= 1.0 / 16;) {
      const double before = best_.agreement;
      step_all(step);
      if (!(best_.agreement > before + 2e-5)) step /= 2;
    }
  }

  void step_all(double step) {
    for (const double sign : {1.0, -1.0}) {
      const HeadAxes axes = best_.axes;
      ReliefMatch next = best_;
      next.axes = turned(axes, axes.up, sign * step * kTurnDegrees);
      try_match(next);
      next = best_;
      next.axes = turned(axes, axes.front, sign * step * kTurnDegrees);
      try_match(next);
    }
    for (const double sign : {1.0, -1.0}) {
      const double move = sign * step * kMoveMm * best_.scale;
      ReliefMatch next = best_;
      next.between += move * best_.axes.side();
      try_match(next);
      next = best_;
      next.between += move * best_.axes.up;
      try_match(next);
      next = best_;
      next.scale *= 1 + sign * step * kGrow;
      try_match(next);
      next = best_;
      next.stretch *= 1 + sign * step * kGrow;
      try_match(next);
    }
  }

  void try_match(const ReliefMatch& match) {
    if (!map_ || match.axes.front != map_axes_.front || match.axes.up != map_axes_.up) {
      map_.emplace(near_, match.axes, square_).soften();
      map_axes_ = match.axes;
    }
    Candidate candidate{match.between.dot(match.axes.side()),
                        match.between.dot(match.axes.up),
                        match.scale,
                        match.stretch,
                        {},
                        0};
    candidate.fit =
        map_->fit(candidate.across, candidate.height, candidate.scale, candidate.stretch);
    const bool is_likely = std::abs(std::log(match.stretch)) < kMostStretch;
    if (is_likely && candidate.fit.agreement > best_.agreement) {
      best_ = match_of(candidate, match.axes);
      slope_up_ = candidate.fit.slope_up / match.stretch;
    }
  }

  Positions near_;
  std::optional<DepthMap> map_;  ///< along map_axes_
  HeadAxes map_axes_;
  double square_ = 1, slope_up_ = 0;
  ReliefMatch best_;
};

}  // namespace

Positions sample_skin(const Topology& topology, const Positions& positions,
                      const std::vector<bool>& skin, Index count) {
  double area = 0;
  const auto area_of = [&](Index f) {
    return skin[topology.face(f)[0]] ? face_area_vector(topology, f, positions).norm() : 0;
  };
  for (Index f = 0; f < topology.face_count(); ++f) area += area_of(f);
  if (!(area > 0) || !std::isfinite(area)) return {};
  Positions samples(count, 3);
  Index made = 0;
  double passed = 0;
  for (Index f = 0; f < topology.face_count(); ++f) {
    passed += area_of(f);
    const auto face = topology.face(f);
    const auto until = static_cast<Index>(passed / area * static_cast<double>(count));
    for (Index i = made; i < std::min(until, count); ++i) {
      const PolygonSample at = polygon_sample(static_cast<std::size_t>(i), face.size());
      const Eigen::Vector3d a = row3(positions, face[0]);
      const Eigen::Vector3d b = row3(positions, face[at.fan]);
      const Eigen::Vector3d c = row3(positions, face[at.fan + 1]);
      samples.row(i) = (a + at.s * (b - a) + at.t * (c - a)).transpose();
    }
    made = std::max(made, std::min(until, count));
  }
  samples.conservativeResize(made, 3);
  return samples;
}

std::optional<ReliefMatch> match_relief(const Positions& samples,
                                        const std::vector<HeadAxes>& all_axes,
                                        const std::vector<Eigen::Vector3d>& eyes) {
  constexpr std::size_t kRefined = 6;
  constexpr double kCoarser = 1.5;  // in the turned views, which are many
  constexpr double kTurn = 25;      // degrees, of the turned views
  constexpr double kStraight = 5;   // degrees within which a face is taken to stand along the axes
  if (samples.rows() == 0 || !(diagonal_of(samples) > 0)) return std::nullopt;
  const auto search = [&](const std::vector<HeadAxes>& views, double coarseness) {
    std::vector<Candidate> found(views.size());
    parallel_for_each(views.size(), [&](std::size_t i) {
      found[i] = search_view(samples, views[i], eyes, coarseness);
    });
    // The best views are compared after refinement: a view that is turned the wrong way ends at a lower agreement.
    std::vector<std::size_t> order(views.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, std::greater(), [&](std::size_t i) { return found[i].votes; });
    order.resize(std::min(order.size(), kRefined));
    std::vector<ReliefMatch> refined(order.size());
    parallel_for_each(order.size(), [&](std::size_t i) {
      const Candidate& one = found[order[i]];
      if (one.votes <= -1) return;
      ReliefMatch& match = refined[i];
      match = Refinement(samples, match_of(one, views[order[i]])).find();
      match.votes =
          match.agreement +
          kVoteOfEyes * vote_of_eyes(eyes, match.axes, match.between.dot(match.axes.side()),
                                     match.between.dot(match.axes.up), match.scale);
    });
    ReliefMatch match = *std::ranges::max_element(refined, {}, &ReliefMatch::votes);
    if (match.votes <= -1) return match;
    match.view = static_cast<std::size_t>(
        std::ranges::min_element(
            all_axes, {}, [&](const HeadAxes& asked) { return angle_between(match.axes, asked); }) -
        all_axes.begin());
    match.degrees_off = angle_between(match.axes, all_axes[match.view]);
    if (match.degrees_off < kStraight) match.axes = all_axes[match.view];
    return match;
  };
  std::vector<HeadAxes> others;
  for (const HeadAxes& axes : all_axes) {
    for (const double yaw : {0.0, kTurn, -kTurn}) {
      for (const double roll : {0.0, kTurn, -kTurn}) {
        if (yaw == 0 && roll == 0) continue;
        others.push_back(turned(turned(axes, axes.front, roll), axes.up, yaw));
      }
    }
  }
  // One pair of axes is the case of every run, so it must be fast: wide steps nearly always find the face, and the turned
  // views follow if they do not.
  const double coarseness = all_axes.size() == 1 ? 1.3 : 1;
  ReliefMatch match = search(all_axes, coarseness);
  if (match.votes < kLeastVotes || match.degrees_off > kTurn) {
    const ReliefMatch other = search(others, kCoarser);
    if (other.votes > match.votes) match = other;
  }
  return match;
}

}  // namespace crowdface
