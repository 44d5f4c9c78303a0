// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

namespace crowdface::synth {

/// The patches of the skin. The strip surrounds the head like a sleeve, from the edge of the crown
/// down to the neck; the cap closes the strip at the top. The strip has rectangular openings that
/// are filled with concentric rings. The rings of eyes, nostrils and mouth end in an open hole. The
/// rings of an ear end in a core.
enum class SkinPatch { kStrip, kCap, kEye, kNostril, kMouth, kEar, kEarCore };

/// A parametric location on the skin, independent of the tessellation. Some coordinates are in
/// lattice units; one lattice unit is about one quad of the smallest layout.
struct LatticePoint {
  SkinPatch patch = SkinPatch::kStrip;
  double side = 1;  ///< 1: the patch on the head's left (x > 0); −1: its mirror image
  /// First coordinate; its meaning depends on the patch.
  /// Strip and cap: signed distance around the head from the midline of the face, in lattice units.
  /// Rings: 0 … 4 along the sides of the opening, counter-clockwise from its upper left corner,
  /// seen on the side x > 0. Ear core: 0 … 1 across.
  double a = 0;
  /// Second coordinate; its meaning depends on the patch.
  /// Strip: distance down from the cap, in lattice units. Cap: distance from the cap's front edge
  /// backwards, in lattice units. Ear core: 0 … 1 downwards. Rings of eyes, nostrils and mouth,
  /// from outside to inside: 0 at the outline of the rectangle in the strip, 1 at the edge of the
  /// eye, nostril or mouth, 2 at the hole inside the head. Rings of an ear: 0 at the outline of the
  /// rectangle in the strip, 1 at the edge of the ear's core.
  double b = 0;
};

/// Number of columns and rows of the lattice on one half of the head. Columns go from the midline
/// of the face to the midline of the back. Distances on the lattice are in lattice units; one
/// lattice unit is about one quad of the smallest layout.
inline constexpr int kColumns = 14, kRows = 12;
inline constexpr int kFrontColumn = 5;  ///< column of the front corner of the cap
inline constexpr int kBackColumn = 8;   ///< column of the rear corner of the cap

/// Returns the distance from the midline of the face to a lattice column, in lattice units.
/// \param column  −13 … 13, negative at x < 0.
double column_distance(int column);
/// Returns the distance from the cap down to a lattice row, in lattice units.
/// \param row  0 … 11.
double row_distance(int row);

/// A rectangle of the lattice that is cut out of the strip (SkinPatch::kStrip, the skin around the
/// head from crown to neck). Another patch fills it: an eye, an ear, a nostril or the mouth.
struct Opening {
  SkinPatch patch;  ///< the patch that fills the opening
  /// first and last lattice column and row, at x > 0; for the mouth column0 = −column1
  int column0, column1, row0, row1;
};
/// Returns the opening that a patch fills. The patch must not be the strip or the cap.
const Opening& opening_of(SkinPatch patch);
/// Returns the openings at x > 0, and the mouth.
std::span<const Opening> openings();

}  // namespace crowdface::synth
