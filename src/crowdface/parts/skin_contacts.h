// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "crowdface/core/grouped.h"
#include "crowdface/mesh/adjacency.h"
#include "crowdface/mesh/topology.h"
#include "crowdface/parts/contact_place.h"

namespace crowdface {

/// Where skin nearly touches skin. Lips are near each other in space and far along the surface, so
/// blending parts them or pushes one into the other. Their gap is measured at places some millimetres
/// apart, and brought to what it should be by a smooth displacement of the skin around them.
class SkinContacts {
 public:
  /// \param faces  heads of one topology, at least one
  /// \param skin   the skin's vertices, ascending
  SkinContacts(const FaceSet& faces, const Adjacency& adjacency,
               std::span<const std::uint32_t> skin);

  std::size_t size() const { return places_.size(); }
  const ContactPlace& place(std::size_t i) const { return places_[i]; }
  /// Of all places, in the heads' unit.
  std::vector<double> gaps(const Positions& positions) const;
  /// The same of one of the heads.
  const std::vector<double>& head_gaps(Index head) const {
    return head_gaps_[static_cast<std::size_t>(head)];
  }

  /// How much wider the widest gap is than that of any head at its place; 0: none is wider.
  double wider(const Positions& positions) const;

  /// The vertices that bring_into may move.
  std::vector<std::uint32_t> moved() const;

  struct Range {
    double least, most;
  };
  /// Moves the skin so that the gap of each place lies in its range. Where all do, nothing moves.
  /// \param ranges     #places
  /// \param positions  #V by 3
  void bring_into(std::span<const Range> ranges, Positions& positions) const;

 private:
  /// How much a vertex moves by what is asked for at a place.
  struct Share {
    std::uint32_t place;
    double weight;  ///< positive on the high side, negative on the low one
  };
  /// How the points of all profiles of a contact move: those of one place after another.
  struct Motions {
    std::vector<double> heights, depths;
  };
  /// Places that act on the same skin: a mouth.
  struct Contact {
    std::size_t begin = 0, end = 0;       ///< of the places
    std::vector<std::uint32_t> vertices;  ///< that move, ascending
    Grouped<Share> shares;                ///< #vertices
    std::vector<Motions> motions;         ///< by what is asked for at each place
  };

  /// The profiles of a contact's places.
  struct Profiles {
    std::vector<double> heights, depths;  ///< of all points, those of one place after another
    std::vector<std::size_t> begins;      ///< of each place's points among them
    std::vector<std::vector<Clearance::Opposite>> opposites;  ///< of each place

    double gap(std::size_t place) const;
  };

  void add(const FacingGroup& group, const Adjacency& adjacency, const Positions& mean,
           double extent);
  void find_shares(const Positions& mean, std::span<const std::uint32_t> around,
                   const std::vector<double>& side, double extent, Contact& contact) const;
  void find_motions(Contact& contact) const;
  /// What was asked for at a place, beside what was before.
  struct Change {
    std::size_t place;  ///< of the contact's
    double by;
  };
  /// \return in this order; depths of profiles have not followed.
  std::vector<Change> ask(const Contact& contact, std::span<const Range> ranges, double most,
                          Profiles& profiles, std::vector<double>& asked) const;
  static void move_depths(const Contact& contact, std::span<const Change> changes,
                          std::vector<double>& depths);
  void move(const Contact& contact, std::span<const double> by, Positions& positions) const;

  double tolerance_ = 0;
  std::vector<ContactPlace> places_;
  std::vector<Clearance> clearances_;  ///< of all places
  std::vector<Contact> contacts_;
  std::vector<std::vector<double>> head_gaps_;  ///< #heads by #places
};

}  // namespace crowdface
