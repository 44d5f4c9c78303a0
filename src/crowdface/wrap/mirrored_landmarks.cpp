// SPDX-License-Identifier: Apache-2.0
#include "crowdface/wrap/mirrored_landmarks.h"

#include <array>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "crowdface/core/error.h"
#include "crowdface/core/selection.h"
#include "crowdface/core/text.h"
#include "crowdface/mesh/vector3.h"

namespace crowdface {
namespace {

/// A typical residual of the landmarks up to this length is explained by natural differences
/// between people's faces.
constexpr double kMaxNaturalMm = 6;
constexpr double kTimesWorse = 2.5;

/// Minimum number of landmarks: four points cannot reveal a reflection.
constexpr std::size_t kMinCount = 5;

/// Distances in mm between corresponding landmarks of template and scan after the best similarity
/// fit.
std::vector<double> residuals_of(const Positions& positions,
                                 const std::vector<WrapLandmark>& landmarks) {
  const Similarity pose = pose_of_landmarks(positions, landmarks);
  std::vector<double> off;
  for (const WrapLandmark& landmark : landmarks) {
    const Eigen::Vector3d there = apply_similarity(pose, row3(positions, landmark.vertex));
    off.push_back((there - landmark.scan_position).norm() / pose.scale);
  }
  return off;
}

double median_residual(const Positions& positions, const std::vector<WrapLandmark>& landmarks) {
  return nth_smallest(residuals_of(positions, landmarks), landmarks.size() / 2);
}

/// Root mean square of the landmarks' residuals. Unlike the median, the root mean square is large
/// even if only one pair of landmarks is swapped.
double rms_residual(const Positions& positions, const std::vector<WrapLandmark>& landmarks) {
  double sum = 0;
  for (const double off : residuals_of(positions, landmarks)) sum += off * off;
  return std::sqrt(sum / static_cast<double>(landmarks.size()));
}

/// The name of the landmark on the other side: "eye_left" for "eye_right"; the same name for a
/// landmark without a side.
std::string other_side(const std::string& name) {
  static const std::array<std::pair<const char*, const char*>, 6> sides = {{{"left", "right"},
                                                                            {"Left", "Right"},
                                                                            {"LEFT", "RIGHT"},
                                                                            {"_l", "_r"},
                                                                            {"_L", "_R"},
                                                                            {".L", ".R"}}};
  for (const auto& [left, right] : sides) {
    const bool is_suffix = left[0] == '_' || left[0] == '.';
    for (const auto& [from, to] : {std::pair(left, right), std::pair(right, left)}) {
      const std::size_t at = name.rfind(from);
      if (at == name.npos || (is_suffix && !name.ends_with(from))) continue;
      std::string other = name;
      return other.replace(at, std::string(from).size(), to);
    }
  }
  return name;
}

std::vector<WrapLandmark> with_sides_exchanged(const std::vector<WrapLandmark>& landmarks) {
  std::map<std::string, Eigen::Vector3d> places;
  for (const WrapLandmark& landmark : landmarks) places[landmark.name] = landmark.scan_position;
  std::vector<WrapLandmark> exchanged;
  for (WrapLandmark landmark : landmarks) {
    const auto other = places.find(other_side(landmark.name));
    if (other == places.end()) continue;
    landmark.scan_position = other->second;
    exchanged.push_back(std::move(landmark));
  }
  return exchanged;
}

}  // namespace

void refuse_mirrored_landmarks(const Positions& positions,
                               const std::vector<WrapLandmark>& landmarks) {
  if (landmarks.size() < kMinCount) return;
  const double as_they_are = median_residual(positions, landmarks);
  if (!(as_they_are > kMaxNaturalMm)) return;
  std::vector<WrapLandmark> mirrored = landmarks;
  for (WrapLandmark& landmark : mirrored) landmark.scan_position.x() = -landmark.scan_position.x();
  const double reflected = median_residual(positions, mirrored);
  if (!(reflected * kTimesWorse < as_they_are)) return;
  const std::vector<WrapLandmark> exchanged = with_sides_exchanged(landmarks);
  const double swapped =
      exchanged.size() < kMinCount ? as_they_are : median_residual(positions, exchanged);
  const std::string numbers = concat(format_fixed(std::min(reflected, swapped), 1),
                                     " mm instead of ", format_fixed(as_they_are, 1), " mm");
  if (swapped < reflected) {
    throw InvalidInput(
        concat("left and right are swapped in the names of the scan's landmarks, or the scan is "
               "mirrored: with left and right swapped, the landmarks fit to ",
               numbers, " (left is the head's own left)"));
  }
  throw InvalidInput(
      concat("the scan is mirrored: with a reflection the landmarks fit to ", numbers,
             "; mirror it back (scale it by -1 along one axis, and flip its faces) before "
             "wrapping, or check that left and right are not swapped in the landmarks' names"));
}

void refuse_swapped_pair(const Positions& positions, const std::vector<WrapLandmark>& landmarks) {
  if (landmarks.size() < kMinCount) return;
  const double as_they_are = rms_residual(positions, landmarks);
  if (!(as_they_are > kMaxNaturalMm)) return;
  double best = as_they_are / kTimesWorse;
  std::string pair;
  std::vector<WrapLandmark> swapped = landmarks;
  for (std::size_t i = 0; i < landmarks.size(); ++i) {
    for (std::size_t j = i + 1; j < landmarks.size(); ++j) {
      std::swap(swapped[i].scan_position, swapped[j].scan_position);
      const double residual = rms_residual(positions, swapped);
      std::swap(swapped[i].scan_position, swapped[j].scan_position);
      if (!(residual < best)) continue;
      best = residual;
      pair = concat(quoted(landmarks[i].name), " and ", quoted(landmarks[j].name));
    }
  }
  if (pair.empty()) return;
  throw InvalidInput(concat("landmarks ", pair,
                            " are swapped on the template or on the scan: with their places "
                            "exchanged the landmarks fit to ",
                            format_fixed(best, 1), " mm instead of ", format_fixed(as_they_are, 1),
                            " mm; exchange the two"));
}

}  // namespace crowdface
