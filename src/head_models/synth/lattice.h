// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

namespace crowdface::synth {

/// The pieces the skin is sewn from. The strip runs around the head like a sleeve, from the crown's
/// edge down to the neck; the cap closes it above. In the strip, rectangles are cut out and filled
/// with rings: around eyes, nostrils and mouth they end in an open hole, around an ear in a core.
enum class Sheet { kStrip, kCap, kEye, kNostril, kMouth, kEar, kEarCore };

/// A place on the skin, the same for every tessellation.
struct Address {
  Sheet sheet = Sheet::kStrip;
  double side = 1;  ///< −1: the mirrored piece at the head's right (x < 0)
  /// Strip and cap: signed units around the head from the face's midline. Rings: 0 … 4 along the
  /// rectangle's sides, counter-clockwise from its upper left corner as seen on the side x > 0.
  /// Ear core: 0 … 1 across.
  double a = 0;
  /// Strip: units down from the cap. Cap: units from front to back. Rings: 0 at the rectangle, 1 at
  /// the opening's edge (ear: at the core), 2 at the hole. Ear core: 0 … 1 down.
  double b = 0;
};

/// The lattice that strip and cap are drawn on; columns from the face's midline to the back's.
inline constexpr int kColumns = 14, kRows = 12;
inline constexpr int kFrontColumn = 5;  ///< where front and side meet: the cap's front corners
inline constexpr int kBackColumn = 8;   ///< where side and back meet: its rear corners

/// Units from the midline to lattice column `column` (0 … 13), or from the cap to lattice row
/// `row`.
double column_unit(int column);
double row_unit(int row);

/// A cut-out rectangle, from one lattice column and row to another.
struct Window {
  Sheet sheet;
  int column0, column1, row0, row1;  ///< columns at the side x > 0; the mouth: ±column1
};
const Window& window_of(Sheet sheet);
std::span<const Window> windows();

}  // namespace crowdface::synth
