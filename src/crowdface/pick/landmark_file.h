// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "crowdface/mesh/topology.h"
#include "crowdface/pick/landmark_place.h"
#include "crowdface/wrap/scan.h"
#include "crowdface/wrap/shape_fit.h"

namespace crowdface {

/// Named places as a file of landmarks has them: numbers of vertices, from 0, or x y z.
struct LandmarkFile {
  using Place = LandmarkPlace;
  std::map<std::string, Place> of_template, of_scan;
};

/// Whose landmarks a file has that does not tell.
enum class LandmarksOf { kTemplate, kScan };

/// Reads a YAML file of `template: {chin: 966}` and `scan: {chin: [x, y, z]}`; either may lack, at most
/// 100 names each; or a list as other programs write it (parse_landmark_list).
/// \throws UsageError, MissingInput naming every place that is wrong.
LandmarkFile read_landmarks(const std::filesystem::path& path, LandmarksOf of = LandmarksOf::kScan);

/// The row of the template that a place stands for: of a point the vertex nearest to it.
/// \throws UsageError if a vertex has no such number.
std::uint32_t template_vertex(const LandmarkFile::Place& place, const Positions& of_template);
/// The same of a scan.
Eigen::Vector3d scan_point(const LandmarkFile::Place& place, const Scan& scan);

/// The names that both have: rows of the template, places on the scan. A point given for the template
/// stands for the vertex nearest to it.
/// \throws UsageError if a vertex has no such number.
std::vector<WrapLandmark> match_landmarks(const LandmarkFile& file, const Positions& of_template,
                                          const Scan& scan);

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
