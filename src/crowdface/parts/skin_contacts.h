// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "crowdface/core/compressed_rows.h"
#include "crowdface/mesh/adjacency.h"
#include "crowdface/mesh/topology.h"
#include "crowdface/parts/gap_section.h"

namespace crowdface {

/// Preserves the gaps between skin that nearly touches skin. Lips are close in space but far apart
/// along the surface, so blending moves them apart or through each other. Gaps are measured at
/// sections a few millimetres apart, and corrected by a smooth displacement of the surrounding
/// skin.
class SkinContacts {
 public:
  /// \param heads  Heads of one topology; at least one.
  /// \param skin   The skin's vertices, ascending.
  SkinContacts(const HeadSet& heads, const Adjacency& adjacency,
               std::span<const std::uint32_t> skin);

  /// Returns the number of sections.
  std::size_t size() const { return sections_.size(); }
  const GapSection& section(std::size_t i) const { return sections_[i]; }
  /// Returns, for each section, the gap between its two sides of skin in a mesh with these
  /// positions, in the heads' unit. See GapSection.
  std::vector<double> gaps(const Positions& positions) const;
  /// Returns the result of gaps() for the head with this index.
  const std::vector<double>& head_gaps(Index head) const {
    return head_gaps_[static_cast<std::size_t>(head)];
  }

  /// Returns by how much the gap at a section exceeds the widest gap of any head at this section:
  /// the maximum over all sections, or 0.
  double max_gap_excess(const Positions& positions) const;

  /// Returns the vertices that fit_gaps may move.
  std::vector<std::uint32_t> movable_vertices() const;

  /// The allowed range of a gap, in the heads' unit.
  struct Range {
    double min, max;
  };
  /// Moves the skin so that the gap at each section lies in its range. Moves nothing if all gaps
  /// are already in their ranges.
  ///
  /// \param ranges     The wanted range of each section's gap.
  /// \param positions  #V by 3; adjusted.
  void fit_gaps(std::span<const Range> ranges, Positions& positions) const;

 private:
  /// The value of the kernel of one section at one vertex. The smooth displacement is the sum of
  /// the kernels of all sections, each multiplied by an amplitude.
  struct KernelValue {
    std::uint32_t section;
    /// value of the kernel: positive at vertices on the high side of the section's gap (see
    /// GapSection), negative on the low side
    double weight;
  };
  /// How the correction of one section moves the profile points of a group, per unit of the
  /// correction's amplitude. The points have the same order as in Profiles.
  struct PointMotions {
    /// for each profile point: the change of its height and the change of its depth if the
    /// amplitude increases by 1
    std::vector<double> heights, depths;
  };
  /// Sections whose corrections move the same skin, such as all sections of a mouth.
  struct SectionGroup {
    /// the group consists of `sections_[begin]` to `sections_[end - 1]`
    std::size_t begin = 0, end = 0;
    std::vector<std::uint32_t> vertices;  ///< vertices that the corrections move, ascending
    /// for each vertex: the kernels of the nearby sections, evaluated at the vertex
    CompressedRows<KernelValue> kernels;
    /// for each section of the group: how its amplitude moves the profile points
    std::vector<PointMotions> point_motions;
  };

  /// The current positions of the profile points of all sections of a group. Each section has two
  /// profiles, see GapSection.
  struct Profiles {
    /// heights and depths of all profile points: first the points of the group's first section,
    /// then the points of its second section, and so on
    std::vector<double> heights, depths;
    std::vector<std::size_t> begins;  ///< for each section: index of its first point in `heights`
    /// for each section: opposite points of the two profiles
    std::vector<std::vector<Clearance::OppositePoints>> opposite_pairs;

    /// Returns the smallest gap between the two profiles of a section, in the unit of the heights.
    /// \param section  Index of the section within the SectionGroup.
    double gap(std::size_t section) const;
  };

  /// Adds sections (see GapSection) along the gap of one group of facing pairs.
  ///
  /// \param mean    The mean head, #V by 3.
  /// \param extent  Extent of the whole skin.
  void add(const FacingGroup& group, const Adjacency& adjacency, const Positions& mean,
           double extent);
  /// Computes which vertices move when the gaps of a section group are corrected, and the kernel
  /// values (see KernelValue) at these vertices.
  ///
  /// \param mean_head     The mean head, #V by 3.
  /// \param near_skin     The vertices of the skin around the group, ascending.
  /// \param side_weights  For each vertex of the mesh: ½ on the gap's high side, −½ on the low
  ///                      side, smooth in between.
  /// \param skin_extent   Extent of the whole skin.
  void compute_kernels(const Positions& mean_head, std::span<const std::uint32_t> near_skin,
                       const std::vector<double>& side_weights, double skin_extent,
                       SectionGroup& section_group) const;
  /// Sets the point motions of a group, from the kernels of the group.
  void compute_point_motions(SectionGroup& section_group) const;
  /// A change of a section's amplitude. Each section displaces the skin by its amplitude times its
  /// kernel.
  struct AmplitudeChange {
    std::size_t section;  ///< index of the section within its group
    double amount;        ///< number to add to the amplitude
  };
  /// Finds the amplitude of each section's kernel (see KernelValue) such that the gaps of the
  /// displaced skin are in their ranges; skin_contacts.cpp explains the method. Updates the heights
  /// of `profiles`.
  ///
  /// \param max_amplitude  Limit for the absolute value of each amplitude.
  /// \param amplitudes  Amplitudes of the group's sections; updated.
  /// \return       All changes of amplitudes, in the order in which they were made; move_depths
  ///               updates the depths of `profiles` from this list.
  std::vector<AmplitudeChange> find_kernel_amplitudes(const SectionGroup& section_group,
                                                      std::span<const Range> ranges,
                                                      double max_amplitude, Profiles& profiles,
                                                      std::vector<double>& amplitudes) const;
  /// Updates `depths`, the depths of all profile points of a group, after the amplitudes of
  /// sections have changed.
  static void move_depths(const SectionGroup& section_group,
                          std::span<const AmplitudeChange> changes, std::vector<double>& depths);
  /// Displaces the skin by the kernels of the group, times the amplitudes.
  void move(const SectionGroup& section_group, std::span<const double> amplitudes,
            Positions& positions) const;

  double tolerance_ = 0;  ///< a gap may be outside its range by this length, in the heads' unit
  std::vector<GapSection> sections_;
  /// for each of `sections_`: measures the gap between the section's two sides of skin
  std::vector<Clearance> clearances_;
  std::vector<SectionGroup> section_groups_;
  std::vector<std::vector<double>> head_gaps_;  ///< for each head: the result of gaps()
};

}  // namespace crowdface
