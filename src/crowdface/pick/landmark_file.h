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

/// The content of a landmark file: for each landmark name, a vertex number (from 0) or a point.
struct LandmarkFile {
  using Place = LandmarkPlace;
  /// Map the name of a landmark to its place on the template, and to its place on the scan.
  std::map<std::string, Place> template_places, scan_places;
};

/// The mesh to which the landmarks of a file without the keys `template` and `scan` belong.
enum class LandmarkMesh { kTemplate, kScan };

/// Reads a landmark file. The file is YAML with the optional keys `template: {chin: 966}` and
/// `scan: {chin: [x, y, z]}`, with at most 100 names each, or a list from another program (see
/// parse_landmark_list).
/// \param mesh  the mesh to which the landmarks of such a list belong
/// \throws UsageError, MissingInput with a message that names every invalid landmark position.
LandmarkFile read_landmarks(const std::filesystem::path& path,
                            LandmarkMesh mesh = LandmarkMesh::kScan);

/// The template vertex of a landmark: the vertex whose number is in the file, or the vertex nearest
/// to the point in the file.
/// \throws UsageError if the template has no such vertex.
std::uint32_t template_vertex(const LandmarkFile::Place& place,
                              const Positions& template_positions);
/// The position of a landmark on the scan. \throws UsageError if the scan has no such vertex.
Eigen::Vector3d scan_point(const LandmarkFile::Place& place, const Scan& scan);

/// Pairs the landmarks that the file lists for both the template and the scan. Replaces a point on
/// the template by the nearest template vertex.
/// \throws UsageError if the template or the scan has no vertex with a number in the file.
std::vector<WrapLandmark> match_landmarks(const LandmarkFile& file,
                                          const Positions& template_positions, const Scan& scan);

/// A named landmark on the template, on the scan, or on both.
struct PickedLandmark {
  std::string name;
  /// vertex number from 0, if the landmark is on the template
  std::optional<std::uint32_t> template_vertex;
  /// position on the scan, in the unit of the scan's file
  std::optional<Eigen::Vector3d> scan_point;
  /// Scan vertex of the landmark, if the landmark file gives a vertex number instead of a point.
  std::optional<std::uint32_t> scan_vertex;
};

/// The text of a landmark file, from which read_landmarks reads the same landmarks. The text omits
/// landmarks that are neither on the template nor on the scan.
/// \param comments  comment lines at the start of the text, see header_comments.
std::string format_landmarks(const std::vector<PickedLandmark>& landmarks,
                             std::string_view comments = {});

/// The comment lines at the start of a text, with their line ends.
std::string_view header_comments(std::string_view text);
/// Whether the text has comments below its header_comments. May also return true if a quoted name
/// contains " #".
bool has_comments_after_header(std::string_view text);

}  // namespace crowdface
