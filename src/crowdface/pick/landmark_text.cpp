// SPDX-License-Identifier: Apache-2.0
#include "crowdface/pick/landmark_text.h"

#include <algorithm>

#include "crowdface/config/yaml.h"
#include "crowdface/core/text.h"

namespace crowdface {

std::string format_landmarks(const std::vector<PickedLandmark>& landmarks,
                             std::string_view comments) {
  std::string of_template, of_scan;
  for (const PickedLandmark& landmark : landmarks) {
    const std::string key = concat("  ", write_scalar(landmark.name), ": ");
    if (landmark.vertex) of_template += concat(key, *landmark.vertex, '\n');
    if (landmark.scan_vertex) {
      of_scan += concat(key, *landmark.scan_vertex, '\n');
    } else if (landmark.point) {
      const Eigen::Vector3d& p = *landmark.point;
      of_scan += concat(key, '[', p.x(), ", ", p.y(), ", ", p.z(), "]\n");
    }
  }
  const auto section = [](std::string_view name, const std::string& lines) {
    return lines.empty() ? concat(name, ": {}\n") : concat(name, ":\n", lines);
  };
  return concat(comments, section("template", of_template), section("scan", of_scan));
}

std::string_view opening_comments(std::string_view text) {
  std::size_t end = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t next = std::min(text.find('\n', begin), text.size() - 1) + 1;
    const std::string_view line = text.substr(begin, next - begin);
    const std::size_t first = line.find_first_not_of(" \t\r\n");
    if (first != std::string_view::npos && line[first] != '#') break;
    if (first != std::string_view::npos && line.ends_with('\n')) end = next;
    begin = next;
  }
  return text.substr(0, end);
}

bool has_more_comments(std::string_view text) {
  // A name may hold a '#', but none after a blank unless it is in quotes: then one says it for nothing.
  text.remove_prefix(opening_comments(text).size());
  return text.find(" #") != std::string_view::npos || text.find("\n#") != std::string_view::npos ||
         text.starts_with('#');
}

}  // namespace crowdface
