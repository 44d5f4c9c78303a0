// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

namespace crowdface {

/// A name and where it is on template and scan, as far as that has been picked.
struct PickedLandmark {
  std::string name;
  std::optional<std::uint32_t> vertex;       ///< of the template
  std::optional<Eigen::Vector3d> point;      ///< on the scan, in its file's unit
  std::optional<std::uint32_t> scan_vertex;  ///< if the file has a number in place of the point
};

/// The text of a file of landmarks, which read_landmarks reads back as the same. Names without any place are
/// left out. \param comments  what stands above, as opening_comments gives it.
std::string format_landmarks(const std::vector<PickedLandmark>& landmarks,
                             std::string_view comments = {});

/// The lines of comments with which a text begins, with their ends.
std::string_view opening_comments(std::string_view text);
/// Whether there are comments after those.
bool has_more_comments(std::string_view text);

}  // namespace crowdface
