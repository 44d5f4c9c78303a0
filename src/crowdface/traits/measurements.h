// SPDX-License-Identifier: Apache-2.0
// The measurements of faces after Farkas (1994), and the landmarks that these measurements need.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "crowdface/mesh/topology.h"

namespace crowdface {

/// A landmark: a named point of the human face.
struct TraitLandmark {
  std::string name;           ///< name in landmark files, such as "eye_inner_left"
  std::string_view symbol;    ///< Farkas' abbreviation, such as "en"
  std::string_view location;  ///< where the landmark lies on the face, in words for the user
};
/// Returns all landmarks that measurements use.
const std::vector<TraitLandmark>& trait_landmarks();

/// A measurement of a human face.
struct Measurement {
  /// What is measured.
  enum class Kind {
    kDistance,  ///< distance between two landmarks, in millimetres
    /// angle at the second of three landmarks, between the directions to the first and the third,
    /// in degrees
    kAngle,
    /// how steeply the line from the first to the second landmark rises on an upright face, in
    /// degrees
    kSlope,
    kRatio,  ///< ratio of two other measurements
  };
  std::string_view name;    ///< key in configs, such as "nose_width"
  std::string_view symbol;  ///< the landmarks' symbols, such as "al-al"
  Kind kind;
  std::string_view definition;  ///< description for the user
  /// The landmarks for each side of the face, as indices into trait_landmarks(). If the measurement
  /// needs two landmarks, the third index repeats the second. Measurements taken on the left and on
  /// the right have two entries; their value is the mean of both. Other measurements have one
  /// entry, ratios none.
  std::vector<std::array<std::size_t, 3>> landmark_indices_by_face_side = {};
  std::size_t dividend = 0, divisor = 0;  ///< only for ratios: indices into measurements()
};
/// Returns all measurements, in the order of docs/traits.md. A ratio comes after its dividend and
/// its divisor.
const std::vector<Measurement>& measurements();
/// Returns the index of the measurement with this name; nothing if no measurement has the name.
std::optional<std::size_t> find_measurement(std::string_view name);

/// Returns the unit of a measurement with a space before it: " mm" or " degrees"; empty for a
/// ratio.
std::string_view unit_of(const Measurement& measurement);

/// Returns the landmarks that a measurement needs, as ascending indices into trait_landmarks().
std::vector<std::size_t> landmarks_of(const Measurement& measurement);

/// Returns the value of a measurement of a face: in millimetres, in degrees, or a ratio. Angles are
/// rounded to 10⁻⁶ degrees, because arc functions differ between versions of the C library.
///
/// \param landmarks  #landmarks by 3, positions in millimetres in the order of trait_landmarks().
///                   Rows that the measurement does not need may contain any values.
double measure(const Measurement& measurement, const Positions& landmarks);

}  // namespace crowdface
