// SPDX-License-Identifier: Apache-2.0
#include "crowdface/pick/landmark_file.h"

#include <algorithm>

#include "crowdface/config/config_values.h"
#include "crowdface/config/yaml.h"
#include "crowdface/core/file.h"
#include "crowdface/core/problems.h"
#include "crowdface/core/text.h"
#include "crowdface/io/decomposed_text.h"
#include "crowdface/io/legacy_text.h"
#include "crowdface/pick/landmark_lists.h"

namespace crowdface {
namespace {

constexpr std::size_t kMaxFileLandmarks = 100;
constexpr std::uint64_t kMaxVertices = 0xfffffffe;

std::map<std::string, LandmarkFile::Place> read_places(const YamlNode* node, Complaints& out) {
  std::map<std::string, LandmarkFile::Place> places;
  if (node == nullptr || node->kind == YamlNode::Kind::kNothing) return places;
  if (node->kind != YamlNode::Kind::kMap) {
    out.add_mismatch(*node, "a mapping of names to vertices, such as {chin: 966}");
    return places;
  }
  if (node->entries.size() > kMaxFileLandmarks) {
    out.add_at(*node, concat("expected at most ", kMaxFileLandmarks, " landmarks, found ",
                             node->entries.size()));
    return places;
  }
  for (const YamlEntry& entry : node->entries) {
    LandmarkFile::Place place;
    place.file_location = entry.value.place.text();
    if (entry.value.kind == YamlNode::Kind::kList) {
      if (entry.value.items.size() != 3) {
        out.add_mismatch(entry.value, "a vertex number or [x, y, z]");
        continue;
      }
      bool whole = true;
      for (std::size_t c = 0; c < 3; ++c) {
        const auto number = read_number(entry.value.items[c], -kMaxCoordinate, kMaxCoordinate, out);
        whole = whole && number;
        place.point(static_cast<Index>(c)) = number.value_or(0);
      }
      if (!whole) continue;
    } else {
      const auto number = read_whole_number(entry.value, 0, kMaxVertices, out);
      if (!number) continue;
      place.is_vertex = true;
      place.vertex = *number;
    }
    places[entry.key] = place;
  }
  return places;
}

/// Returns the key of a name. Two names have the same key if they differ only in case, blanks,
/// hyphens, underscores or Unicode's normal form.
std::string key_of(std::string_view name) {
  std::string key = lower_case(decomposed(name));
  std::ranges::replace_if(
      key, [](char c) { return c == ' ' || c == '-' || c == '.'; }, '_');
  return key;
}

std::uint32_t vertex_of(const LandmarkFile::Place& place, Index count, const char* what) {
  if (place.vertex >= static_cast<std::uint64_t>(count)) {
    throw UsageError(concat(place.file_location, ": expected a vertex of the ", what, " from 0 to ",
                            count - 1, ", found ", place.vertex));
  }
  return static_cast<std::uint32_t>(place.vertex);
}

std::uint32_t nearest_vertex(const Positions& positions, const Eigen::Vector3d& point) {
  Index nearest = 0;
  (positions.rowwise() - point.transpose()).rowwise().squaredNorm().minCoeff(&nearest);
  return static_cast<std::uint32_t>(nearest);
}

}  // namespace

LandmarkFile read_landmarks(const std::filesystem::path& path, LandmarkMesh mesh) {
  Complaints complaints;
  LandmarkFile file;
  std::optional<YamlNode> root;
  if (is_file(path)) {
    const MappedFile content(path);
    if (auto list = parse_landmark_list(content.bytes(), path)) {
      (mesh == LandmarkMesh::kScan ? file.scan_places : file.template_places) = std::move(*list);
      return file;
    }
    root = parse_yaml(decoded_text(content.bytes()), path.string(), complaints);
  } else {
    root = read_yaml(path.string(), complaints);
  }
  if (root && root->kind != YamlNode::Kind::kMap) {
    complaints.add_mismatch(*root, "a mapping with the keys template and scan");
  } else if (root) {
    const MapReader map(*root, {"template", "scan"}, complaints);
    file.template_places = read_places(map.find("template"), complaints);
    file.scan_places = read_places(map.find("scan"), complaints);
  }
  Problems problems;
  complaints.report_to(problems);
  problems.throw_if_any();
  return file;
}

std::uint32_t template_vertex(const LandmarkFile::Place& place,
                              const Positions& template_positions) {
  return place.is_vertex ? vertex_of(place, template_positions.rows(), "template")
                         : nearest_vertex(template_positions, place.point);
}

Eigen::Vector3d scan_point(const LandmarkFile::Place& place, const Scan& scan) {
  if (!place.is_vertex) return place.point;
  return scan.positions.row(vertex_of(place, scan.positions.rows(), "scan")).transpose();
}

std::vector<WrapLandmark> match_landmarks(const LandmarkFile& file,
                                          const Positions& template_positions, const Scan& scan) {
  std::map<std::string, const LandmarkFile::Place*> scan_places_by_key;
  for (const auto& [name, place] : file.scan_places) {
    if (!file.template_places.contains(name)) scan_places_by_key.emplace(key_of(name), &place);
  }
  std::vector<WrapLandmark> landmarks;
  for (const auto& [name, place] : file.template_places) {
    const auto same_name = file.scan_places.find(name);
    const LandmarkFile::Place* on_scan = nullptr;
    if (same_name != file.scan_places.end()) {
      on_scan = &same_name->second;
    } else if (const auto similar = scan_places_by_key.extract(key_of(name))) {
      on_scan = similar.mapped();
    }
    if (on_scan == nullptr) continue;
    landmarks.push_back(
        {name, template_vertex(place, template_positions), scan_point(*on_scan, scan)});
  }
  return landmarks;
}

std::string format_landmarks(const std::vector<PickedLandmark>& landmarks,
                             std::string_view comments) {
  std::string template_lines, scan_lines;
  for (const PickedLandmark& landmark : landmarks) {
    const std::string key = concat("  ", write_scalar(landmark.name), ": ");
    if (landmark.template_vertex) template_lines += concat(key, *landmark.template_vertex, '\n');
    if (landmark.scan_vertex) {
      scan_lines += concat(key, *landmark.scan_vertex, '\n');
    } else if (landmark.scan_point) {
      const Eigen::Vector3d& p = *landmark.scan_point;
      scan_lines += concat(key, '[', p.x(), ", ", p.y(), ", ", p.z(), "]\n");
    }
  }
  const auto section = [](std::string_view name, const std::string& lines) {
    return lines.empty() ? concat(name, ": {}\n") : concat(name, ":\n", lines);
  };
  return concat(comments, section("template", template_lines), section("scan", scan_lines));
}

std::string_view header_comments(std::string_view text) {
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

bool has_comments_after_header(std::string_view text) {
  // A " #" inside a quoted name counts as a comment, too. This only causes a needless warning.
  text.remove_prefix(header_comments(text).size());
  return text.find(" #") != std::string_view::npos || text.find("\n#") != std::string_view::npos ||
         text.starts_with('#');
}

}  // namespace crowdface
