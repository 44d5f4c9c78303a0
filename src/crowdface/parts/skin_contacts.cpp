// SPDX-License-Identifier: Apache-2.0
#include "crowdface/parts/skin_contacts.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "crowdface/core/parallel.h"
#include "crowdface/mesh/edge_distances.h"
#include "crowdface/mesh/vector3.h"
#include "crowdface/parts/component_shape.h"

namespace crowdface {
namespace {

// Lengths are fractions of the skin's extent, about 43 cm.
constexpr double kSectionSpacing = 0.008;     // spacing of the sections
constexpr double kProfileHalfLength = 0.015;  // length of a profile to either side of a section
constexpr double kMotionReach = 0.07;         // radius of the skin that moves around a section
// Vertices within this distance of the contact are assigned to one of the contact's two sides (such
// as upper and lower lip). The distance is measured along the surface, as a fraction of the skin's
// extent.
constexpr double kSideReach = 0.09;
constexpr double kSideSmoothing = 0.006;  // width of the smoothing of the sides' borders
constexpr double kTolerance = 1e-5;       // tolerance of a gap
constexpr double kMinWeight = 1e-3;       // vertices with smaller weights do not move
constexpr std::size_t kRowsPerBlock = 8192, kMovedPerBlock = 1024;  // vertices per parallel block
// number of profile points in a parallel block; the derivatives of this many points fit into a
// core's L1 cache
constexpr std::size_t kPointsPerBlock = 256;
constexpr int kSweeps = 200;  // largest number of Gauss-Seidel sweeps in a round
constexpr int kRounds = 3;    // largest number of rounds of fit_gaps
/// Regularisation, so that neighbouring sections get similar corrections: the gap of a section may
/// be outside its allowed range by this fraction of the section's correction.
constexpr double kGapCompliance = 0.001;
/// Largest amplitude of a section (the size of the section's correction), as a multiple of the
/// largest deviation of any gap from its range before the correction.
constexpr double kMaxAmplitudeFactor = 4;

/// Smooth kernel: 1 at distance 0, and 0 at distances of 1 or more (Wendland 1995, C² in three
/// dimensions). The kernel is positive definite, so amplitudes exist for any wanted gaps.
double wendland_kernel(double distance) {
  if (distance >= 1) return 0;
  const double rest = 1 - distance;
  return rest * rest * rest * rest * (4 * distance + 1);
}

/// The skin around a group of facing vertices, and the side of the gap on which each vertex lies.
struct Sides {
  std::vector<std::uint32_t> vertices;  ///< vertex indices, ascending
  /// For each vertex: ½ on the high side of the gap (the side to which GapSection::up points), −½
  /// on the low side. Between the two sides, the value changes linearly along the surface.
  std::vector<double> side_weights;
};

Sides find_sides(const FacingGroup& group, const Adjacency& adjacency, const Positions& mean,
                 double reach) {
  std::vector<std::uint32_t> low, high;
  for (const FacingPair& pair : group) {
    low.push_back(pair.low_vertex);
    high.push_back(pair.high_vertex);
  }
  EdgeDistances from_low(adjacency, mean), from_high(adjacency, mean);
  parallel_for_each(2, [&](std::size_t i) {
    i == 0 ? from_low.search(low, reach) : from_high.search(high, reach);
  });
  Sides sides{from_low.reached(), std::vector<double>(static_cast<std::size_t>(mean.rows()), 0.0)};
  sides.vertices.insert(sides.vertices.end(), from_high.reached().begin(),
                        from_high.reached().end());
  std::ranges::sort(sides.vertices);
  sides.vertices.erase(std::unique(sides.vertices.begin(), sides.vertices.end()),
                       sides.vertices.end());
  for (const std::uint32_t v : sides.vertices) {
    const double to_low = std::min(from_low.distance(v), reach);
    const double to_high = std::min(from_high.distance(v), reach);
    const double both = to_low + to_high;
    sides.side_weights[v] = both > 0 ? (to_low - to_high) / both / 2 : 0;
  }
  return sides;
}

/// Smooths `sides.side_weights` over a length of about `size`. Each round averages each value with
/// the mean of its neighbours' values.
void smooth_sides(const Adjacency& adjacency, const Positions& mean, double size, Sides& sides) {
  double squares = 0, count = 0;
  for (const std::uint32_t v : sides.vertices) {
    for (const std::uint32_t n : adjacency.items_of(v)) {
      const Eigen::Vector3d edge = (mean.row(n) - mean.row(v)).transpose();
      squares += edge.squaredNorm();
      ++count;
    }
  }
  if (!(squares > 0)) return;
  const double edges = size * size * count / squares;
  constexpr double kMaxSteps = 1e4;
  const int steps = static_cast<int>(std::min(std::ceil(4 * edges), kMaxSteps));

  // Skin outside `sides.vertices` is neither on the low nor on the high side. One extra row, with
  // the value 0, represents all of this skin.
  const auto rows = sides.vertices.size();
  std::vector<std::uint32_t> row_of(sides.side_weights.size(), static_cast<std::uint32_t>(rows));
  for (std::size_t i = 0; i < rows; ++i) row_of[sides.vertices[i]] = static_cast<std::uint32_t>(i);
  std::vector<double> side(rows + 1, 0.0);
  CompressedRows<std::uint32_t> neighbours;
  for (std::size_t i = 0; i < rows; ++i) {
    side[i] = sides.side_weights[sides.vertices[i]];
    std::vector<std::uint32_t> around;
    for (const std::uint32_t n : adjacency.items_of(sides.vertices[i])) around.push_back(row_of[n]);
    neighbours.add_group(around);
  }
  std::vector<double> next = side;
  for (int step = 0; step < steps; ++step) {
    parallel_for_each(rows, kRowsPerBlock, [&](std::size_t i) {
      const auto around = neighbours.items_of(i);
      double sum = 0;
      for (const std::uint32_t n : around) sum += side[n];
      next[i] = (side[i] + sum / static_cast<double>(std::max<std::size_t>(around.size(), 1))) / 2;
    });
    std::swap(next, side);
  }
  for (std::size_t i = 0; i < rows; ++i) sides.side_weights[sides.vertices[i]] = side[i];
}

void append(const std::vector<double>& more, std::vector<double>& values) {
  values.insert(values.end(), more.begin(), more.end());
}

}  // namespace

SkinContacts::SkinContacts(const HeadSet& heads, const Adjacency& adjacency,
                           std::span<const std::uint32_t> skin) {
  head_gaps_.resize(heads.heads.size());
  if (skin.empty()) return;
  const Positions mean = mean_head(heads);
  const double extent = extent_of(mean, skin);
  tolerance_ = kTolerance * extent;
  for (const FacingGroup& group : find_facing_skin(heads.topology, adjacency, mean, skin)) {
    add(group, adjacency, mean, extent);
  }
  parallel_for_each(heads.heads.size(),
                    [&](std::size_t h) { head_gaps_[h] = gaps(heads.heads[h].positions); });
}

void SkinContacts::add(const FacingGroup& group, const Adjacency& adjacency, const Positions& mean,
                       double extent) {
  Sides sides = find_sides(group, adjacency, mean, kSideReach * extent);
  SectionGroup section_group;
  section_group.begin = sections_.size();
  for (GapSection& section : distribute_gap_sections(group, kSectionSpacing * extent)) {
    cut_profiles(adjacency, mean, sides.vertices, sides.side_weights, kProfileHalfLength * extent,
                 section);
    if (section.low_profile.empty() || section.high_profile.empty()) continue;
    clearances_.emplace_back(section, adjacency);
    sections_.push_back(std::move(section));
  }
  section_group.end = sections_.size();
  if (section_group.begin == section_group.end) return;
  smooth_sides(adjacency, mean, kSideSmoothing * extent, sides);
  compute_kernels(mean, sides.vertices, sides.side_weights, extent, section_group);
  compute_point_motions(section_group);
  section_groups_.push_back(std::move(section_group));
}

void SkinContacts::compute_kernels(const Positions& mean_head,
                                   std::span<const std::uint32_t> near_skin,
                                   const std::vector<double>& side_weights, double skin_extent,
                                   SectionGroup& section_group) const {
  const double reach = kMotionReach * skin_extent;
  for (const std::uint32_t v : near_skin) {
    std::vector<KernelValue> kernels;
    for (std::size_t p = section_group.begin; p < section_group.end; ++p) {
      const double distance = (row3(mean_head, v) - sections_[p].middle).norm() / reach;
      const double weight = side_weights[v] * wendland_kernel(distance);
      if (std::abs(weight) > kMinWeight) {
        kernels.push_back({static_cast<std::uint32_t>(p), weight});
      }
    }
    if (kernels.empty()) continue;
    section_group.vertices.push_back(v);
    section_group.kernels.add_group(kernels);
  }
}

void SkinContacts::compute_point_motions(SectionGroup& section_group) const {
  section_group.point_motions.resize(section_group.end - section_group.begin);
  for (std::size_t p = section_group.begin; p < section_group.end; ++p) {
    const Eigen::Vector3d &up = sections_[p].up, deep = sections_[p].inward();
    const auto add_vertex = [&](std::uint32_t v, double share) {
      const std::uint32_t row = index_in_list(section_group.vertices, v);
      if (row == kNoIndex) return;
      for (const auto& [section, weight] : section_group.kernels.items_of(row)) {
        PointMotions& point_motions = section_group.point_motions[section - section_group.begin];
        point_motions.heights.back() += share * weight * up.dot(sections_[section].up);
        point_motions.depths.back() += share * weight * deep.dot(sections_[section].up);
      }
    };
    for (const auto* profile : {&sections_[p].low_profile, &sections_[p].high_profile}) {
      for (const EdgePoint& point : *profile) {
        for (PointMotions& point_motions : section_group.point_motions) {
          point_motions.heights.push_back(0);
          point_motions.depths.push_back(0);
        }
        add_vertex(point.a, 1 - point.fraction);
        add_vertex(point.b, point.fraction);
      }
    }
  }
}

std::vector<double> SkinContacts::gaps(const Positions& positions) const {
  std::vector<double> gaps;
  gaps.reserve(clearances_.size());
  for (const Clearance& clearance : clearances_) gaps.push_back(clearance.gap(positions));
  return gaps;
}

double SkinContacts::max_gap_excess(const Positions& positions) const {
  const std::vector<double> here = gaps(positions);
  double most = 0;
  for (std::size_t p = 0; p < here.size(); ++p) {
    double widest = head_gaps_.front()[p];
    for (const auto& head : head_gaps_) widest = std::max(widest, head[p]);
    most = std::max(most, here[p] - widest);
  }
  return most;
}

std::vector<std::uint32_t> SkinContacts::movable_vertices() const {
  std::vector<std::uint32_t> vertices;
  for (const SectionGroup& section_group : section_groups_) {
    vertices.insert(vertices.end(), section_group.vertices.begin(), section_group.vertices.end());
  }
  return vertices;
}

/// Solves for the amplitudes (the sizes of the corrections) of all sections of a group, starting
/// from the previous amplitudes. A section has a positive amplitude only if its gap would otherwise
/// be too narrow, and a negative amplitude only if its gap would otherwise be too wide. So
/// neighbours rarely counteract each other. This is a linear complementarity problem, solved by
/// projected Gauss-Seidel (Cottle, Pang & Stone 1992, chapter 5). The smallest gap of a section may
/// move to another pair of opposite points during the iteration, so each step computes the gap
/// again.
std::vector<SkinContacts::AmplitudeChange> SkinContacts::find_kernel_amplitudes(
    const SectionGroup& section_group, std::span<const Range> ranges, double max_amplitude,
    Profiles& profiles, std::vector<double>& amplitudes) const {
  std::vector<AmplitudeChange> changes;
  double largest = std::numeric_limits<double>::max();
  for (int sweep = 0; sweep < kSweeps && largest > tolerance_; ++sweep) {
    largest = 0;
    for (std::size_t i = 0; i < amplitudes.size(); ++i) {
      const Range& range = ranges[section_group.begin + i];
      const double rest = amplitudes[i] - profiles.gap(i);
      const double wanted = std::clamp(0.0, (range.min + rest) / (1 + kGapCompliance),
                                       (range.max + rest) / (1 + kGapCompliance));
      const double change = std::clamp(wanted, -max_amplitude, max_amplitude) - amplitudes[i];
      if (change == 0) continue;
      amplitudes[i] += change;
      largest = std::max(largest, std::abs(change));
      changes.push_back({i, change});
      const std::vector<double>& heights = section_group.point_motions[i].heights;
      for (std::size_t k = 0; k < heights.size(); ++k) profiles.heights[k] += heights[k] * change;
    }
  }
  return changes;
}

void SkinContacts::move_depths(const SectionGroup& section_group,
                               std::span<const AmplitudeChange> changes,
                               std::vector<double>& depths) {
  parallel_blocks(depths.size(), kPointsPerBlock, [&](std::size_t begin, std::size_t end) {
    for (const AmplitudeChange& change : changes) {
      const std::vector<double>& point_motions = section_group.point_motions[change.section].depths;
      for (std::size_t k = begin; k < end; ++k) depths[k] += point_motions[k] * change.amount;
    }
  });
}

double SkinContacts::Profiles::gap(std::size_t section) const {
  return Clearance::gap(opposite_pairs[section], std::span(heights).subspan(begins[section]));
}

void SkinContacts::move(const SectionGroup& section_group, std::span<const double> amplitudes,
                        Positions& positions) const {
  std::vector<Eigen::Vector3d> ups;
  for (std::size_t p = section_group.begin; p < section_group.end; ++p)
    ups.push_back(sections_[p].up);
  parallel_for_each(section_group.vertices.size(), kMovedPerBlock, [&](std::size_t i) {
    double x = 0, y = 0, z = 0;
    for (const auto& [section, weight] : section_group.kernels.items_of(i)) {
      const Eigen::Vector3d& up = ups[section - section_group.begin];
      const double share = weight * amplitudes[section - section_group.begin];
      x += share * up.x();
      y += share * up.y();
      z += share * up.z();
    }
    positions(section_group.vertices[i], 0) += x;
    positions(section_group.vertices[i], 1) += y;
    positions(section_group.vertices[i], 2) += z;
  });
}

/// For each group of sections, determines the amplitudes of the sections' corrections in up to
/// kRounds rounds, and then displaces the skin. The corrections of a round change the depths of the
/// profile points, so the next round determines again which profile points lie opposite each other.
void SkinContacts::fit_gaps(std::span<const Range> ranges, Positions& positions) const {
  for (const SectionGroup& section_group : section_groups_) {
    Profiles profiles;
    for (std::size_t p = section_group.begin; p < section_group.end; ++p) {
      profiles.begins.push_back(profiles.heights.size());
      append(clearances_[p].heights(positions), profiles.heights);
      append(clearances_[p].depths(positions), profiles.depths);
    }
    std::vector<double> amplitudes(section_group.end - section_group.begin, 0.0);
    std::vector<AmplitudeChange> changes;
    double max_amplitude = 0;
    for (int round = 0; round < kRounds; ++round) {
      // Update the depths of the profile points, and find the opposite points again.
      move_depths(section_group, changes, profiles.depths);
      double largest_deviation = 0;
      profiles.opposite_pairs.clear();
      for (std::size_t i = 0; i < amplitudes.size(); ++i) {
        const std::span depths = std::span(profiles.depths).subspan(profiles.begins[i]);
        profiles.opposite_pairs.push_back(
            clearances_[section_group.begin + i].opposite_points(depths));
        const auto [least, widest] = ranges[section_group.begin + i];
        const double gap = profiles.gap(i);
        largest_deviation =
            std::max(largest_deviation, std::abs(std::clamp(gap, least, widest) - gap));
      }
      if (largest_deviation <= tolerance_) break;
      // The first round sets the largest allowed amplitude of a correction for all rounds.
      if (round == 0) max_amplitude = kMaxAmplitudeFactor * largest_deviation;
      // Each section has a correction of the skin. Determine the amplitudes of the corrections,
      // with the gaps measured at the current opposite points (Profiles::opposite_pairs).
      changes = find_kernel_amplitudes(section_group, ranges, max_amplitude, profiles, amplitudes);
    }
    if (max_amplitude > 0) move(section_group, amplitudes, positions);
  }
}

}  // namespace crowdface
