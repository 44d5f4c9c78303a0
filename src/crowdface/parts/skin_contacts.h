// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "crowdface/core/compressed_rows.h"
#include "crowdface/mesh/adjacency.h"
#include "crowdface/mesh/topology.h"
#include "crowdface/parts/contact_place.h"

namespace crowdface {

/// Preserves the gaps between skin that nearly touches skin. Lips are close in space but far apart
/// along the surface, so blending moves them apart or through each other. Gaps are measured at
/// places a few millimetres apart, and corrected by a smooth displacement of the surrounding skin.
class SkinContacts {
 public:
  /// \param faces  Heads of one topology; at least one.
  /// \param skin   The skin's vertices, ascending.
  SkinContacts(const HeadSet& faces, const Adjacency& adjacency,
               std::span<const std::uint32_t> skin);

  std::size_t size() const { return places_.size(); }
  const ContactPlace& place(std::size_t i) const { return places_[i]; }
  /// Returns the gaps at all places, in the heads' unit.
  std::vector<double> gaps(const Positions& positions) const;
  /// Returns the gaps of a head.
  const std::vector<double>& head_gaps(Index head) const {
    return head_gaps_[static_cast<std::size_t>(head)];
  }

  /// Returns the largest difference, over all places, between a gap and the widest gap of any head
  /// at the same place; 0 if no gap is wider than in the heads.
  double wider(const Positions& positions) const;

  /// Returns the vertices that bring_into may move.
  std::vector<std::uint32_t> moved() const;

  struct Range {
    double least, most;
  };
  /// Moves the skin so that every gap lies in its range. If all gaps already lie in their ranges,
  /// nothing moves.
  ///
  /// \param ranges     #places.
  /// \param positions  #V by 3; adjusted.
  void bring_into(std::span<const Range> ranges, Positions& positions) const;

 private:
  /// The smooth displacement is a sum of one kernel per place, each with an amplitude. A Share is
  /// the value of one place's kernel at one vertex.
  struct Share {
    std::uint32_t place;
    double weight;  ///< positive on the high side, negative on the low side
  };
  /// How far the profile points of a contact move, place after place, if the amplitude of one place
  /// grows by one.
  struct Motions {
    std::vector<double> heights, depths;
  };
  /// Places that affect the same skin, such as a mouth.
  struct Contact {
    std::size_t begin = 0, end = 0;       ///< range of places
    std::vector<std::uint32_t> vertices;  ///< vertices that move, ascending
    CompressedRows<Share> shares;         ///< #vertices
    std::vector<Motions> motions;         ///< #places of the contact: see Motions
  };

  /// The current profiles at a contact's places.
  struct Profiles {
    /// coordinates of all points, place after place
    std::vector<double> heights, depths;
    std::vector<std::size_t> begins;  ///< index of each place's first point
    /// #places: opposite points of the two profiles
    std::vector<std::vector<Clearance::Opposite>> opposites;

    double gap(std::size_t place) const;
  };

  void add(const FacingGroup& group, const Adjacency& adjacency, const Positions& mean,
           double extent);
  void find_shares(const Positions& mean, std::span<const std::uint32_t> around,
                   const std::vector<double>& side, double extent, Contact& contact) const;
  void find_motions(Contact& contact) const;
  /// A change of a place's amplitude.
  struct DepthChange {
    std::size_t place;  ///< index within the contact
    double by;
  };
  /// Finds the amplitudes that bring the gaps into their ranges (skin_contacts.cpp explains the
  /// method).
  ///
  /// \param most   Largest amplitude.
  /// \param asked  Amplitudes of the contact's places; updated.
  /// \return       Changes in the order in which they were made. The depths of `profiles` are not
  ///               updated.
  std::vector<DepthChange> ask(const Contact& contact, std::span<const Range> ranges, double most,
                               Profiles& profiles, std::vector<double>& asked) const;
  static void move_depths(const Contact& contact, std::span<const DepthChange> changes,
                          std::vector<double>& depths);
  void move(const Contact& contact, std::span<const double> by, Positions& positions) const;

  double tolerance_ = 0;
  std::vector<ContactPlace> places_;
  std::vector<Clearance> clearances_;  ///< #places
  std::vector<Contact> contacts_;
  std::vector<std::vector<double>> head_gaps_;  ///< #heads by #places
};

}  // namespace crowdface
