// SPDX-License-Identifier: Apache-2.0
#include "crowdface/pick/pick_session.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/text.h"
#include "crowdface/mesh/vector3.h"
#include "crowdface/paint/face_marks.h"
#include "crowdface/pick/landmark_names.h"
#include "crowdface/pick/proposed_landmarks.h"
#include "crowdface/preview/reduced_mesh.h"

namespace crowdface {
namespace {

/// Tries all axis-aligned orientations. The user or the first landmarks correct the orientation of
/// a tilted scan.
PoseHint guess_orientation(const Scan& scan) {
  constexpr std::size_t kEnough = 30000;
  const std::vector<Triangle> reduced = reduce_triangles(scan.triangles, scan.positions, kEnough);
  HeadShape head;
  head.positions = scan.positions;
  head.is_skin = is_vertex_used({scan.positions, reduced});
  const auto orientation = find_orientation(topology_of(reduced, scan.positions.rows()), head);
  if (!orientation) return {Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitZ()};
  return {unit_vector(orientation->up), unit_vector(orientation->front)};
}

/// The largest power of ten that is at most a millionth of the mesh's bounding box diagonal.
double coordinate_step(const PickableMesh& mesh) {
  const double size = (mesh.box_max() - mesh.box_min()).norm();
  return size > 0 ? std::pow(10.0, std::floor(std::log10(size)) - 6) : 1e-6;
}

std::vector<PickedLandmark> landmarks_of(const LandmarkFile& file, const PickInputs& inputs) {
  std::map<std::string, PickedLandmark> by_name;
  for (const auto& [name, place] : file.template_places) {
    by_name[name].template_vertex = template_vertex(place, inputs.template_file_positions);
  }
  for (const auto& [name, place] : file.scan_places) {
    PickedLandmark& landmark = by_name[name];
    landmark.scan_point = scan_point(place, inputs.scan);
    if (place.is_vertex) landmark.scan_vertex = static_cast<std::uint32_t>(place.vertex);
  }
  std::vector<PickedLandmark> landmarks;
  const auto take = [&](const std::string& name) {
    const auto found = by_name.extract(name);
    if (found.empty()) return;
    landmarks.push_back(found.mapped());
    landmarks.back().name = name;
  };
  for (const LandmarkDefinition& known : suggested_landmarks()) take(std::string(known.name));
  while (!by_name.empty()) take(std::string(by_name.begin()->first));
  return landmarks;
}

}  // namespace

PickSession::PickSession(PickInputs inputs)
    : inputs_(std::move(inputs)),
      template_(make_pickable(inputs_.wrap_template, inputs_.template_positions)),
      scan_(inputs_.scan.positions, inputs_.scan.triangles),
      symmetry_plane_(symmetry_plane(inputs_.wrap_template, inputs_.template_positions)),
      proposed_vertices_(propose_landmarks(inputs_.wrap_template)),
      scan_orientation_(inputs_.hint ? *inputs_.hint : guess_orientation(inputs_.scan)),
      last_file_text_(landmark_file_text()) {
  LandmarkFile file;
  if (!inputs_.template_landmark_file.empty()) {
    file.template_places = read_landmarks(inputs_.template_landmark_file).template_places;
  }
  if (path_exists(inputs_.landmark_file)) {
    const LandmarkFile own = read_landmarks(inputs_.landmark_file);
    for (const auto& [name, place] : own.template_places) file.template_places[name] = place;
    file.scan_places = own.scan_places;
  }
  landmarks_ = landmarks_of(file, inputs_);
}

std::vector<PickedLandmark> PickSession::landmarks() const {
  const std::lock_guard lock(mutex_);
  return landmarks_;
}

bool PickSession::saving_deletes_comments() const {
  const std::lock_guard lock(mutex_);
  return has_comments_after_header(last_file_text_);
}

std::string PickSession::landmark_file_text() const {
  return path_exists(inputs_.landmark_file) ? read_file(inputs_.landmark_file) : std::string();
}

std::optional<PickedPlace> PickSession::pick_on_template(const Eigen::Vector3d& origin,
                                                         const Eigen::Vector3d& direction) const {
  constexpr double kBesideMm = 3;
  const auto place = template_.cast_ray(origin, direction, kBesideMm);
  if (!place) return std::nullopt;
  return template_.place_at_vertex(place->vertex);
}

std::optional<PickedPlace> PickSession::pick_on_scan(const Eigen::Vector3d& origin,
                                                     const Eigen::Vector3d& direction) const {
  auto place = scan_.cast_ray(origin, direction, 0);
  if (!place) return std::nullopt;
  const double step = coordinate_step(scan_);
  for (double& x : place->point) {
    // Rounds to a decimal text and back, so that the saved number equals the displayed number.
    const int decimals = std::clamp(static_cast<int>(std::lround(-std::log10(step))), 0, 15);
    x = parse_double(format_fixed(std::round(x / step) * step, decimals)).value_or(x);
  }
  return place;
}

SuggestedPlaces PickSession::suggest(const std::vector<PickedLandmark>& landmarks) const {
  return suggest_places(landmarks, template_, scan_, symmetry_plane_, proposed_vertices_);
}

void PickSession::save(const std::vector<PickedLandmark>& landmarks) {
  const std::lock_guard lock(mutex_);
  const std::string before = landmark_file_text();
  if (before != last_file_text_) {
    last_file_text_ = before;
    throw UsageError(concat(
        inputs_.landmark_file.string(),
        " has been changed by another program since it was read; save again to overwrite it"));
  }
  std::string text = format_landmarks(landmarks, header_comments(before));
  write_file(inputs_.landmark_file, text);
  last_file_text_ = std::move(text);
  landmarks_ = landmarks;
}

}  // namespace crowdface
