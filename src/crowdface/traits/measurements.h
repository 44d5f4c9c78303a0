// SPDX-License-Identifier: Apache-2.0
// The measurements of faces after Farkas (1994), and the landmarks that they need.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "crowdface/mesh/topology.h"

namespace crowdface {

/// A landmark of a face.
struct TraitLandmark {
  std::string name;         ///< as in landmark files: "eye_inner_left"
  std::string_view symbol;  ///< Farkas' abbreviation: "en"
  std::string_view where;   ///< description of the position for the user
};
/// All landmarks of the measurements.
const std::vector<TraitLandmark>& trait_landmarks();

/// A measurement of a face.
struct Measurement {
  enum class Kind {
    kDistance,  ///< distance between two landmarks, in millimetres
    kAngle,     ///< angle at the second of three landmarks, in degrees
    kSlope,     ///< inclination of the line from the first landmark to the second, in degrees
    kRatio,     ///< ratio of two other measurements
  };
  std::string_view name;    ///< key in configs: "nose_width"
  std::string_view symbol;  ///< "al-al"
  Kind kind;
  std::string_view definition;
  /// The landmarks of each side, as indices into trait_landmarks(). The value is the mean over the
  /// sides. Paired measurements have two sides, other measurements one side, ratios none.
  std::vector<std::array<std::size_t, 3>> sides = {};
  std::size_t dividend = 0, divisor = 0;  ///< for a ratio, indices into measurements()
};
/// All measurements, in the order of docs/traits.md. A ratio follows its dividend and divisor.
const std::vector<Measurement>& measurements();
/// The index of the measurement with this name; nothing if there is none.
std::optional<std::size_t> find_measurement(std::string_view name);

/// Unit of a measurement, preceded by a space: " mm", " degrees" or empty for a ratio.
std::string_view unit_of(const Measurement& measurement);

/// The landmarks that a measurement needs: ascending indices into trait_landmarks().
std::vector<std::size_t> landmarks_of(const Measurement& measurement);

/// Returns the value of a measurement of a face: in millimetres, in degrees, or a ratio. Angles are
/// rounded to 10⁻⁶ degrees, because arc functions differ between versions of the C library.
/// \param landmarks  #landmarks by 3, positions in millimetres in the order of trait_landmarks();
///                   rows that the measurement does not need may hold anything.
double measure(const Measurement& measurement, const Positions& landmarks);

}  // namespace crowdface
