// SPDX-License-Identifier: Apache-2.0
#include "crowdface/editor/region_painting.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/text.h"
#include "crowdface/core/units.h"
#include "crowdface/editor/request_values.h"
#include "crowdface/heads/named_parts.h"
#include "crowdface/paint/proposed_masks.h"
#include "crowdface/region/mask_painting.h"

namespace crowdface {
namespace {

using Json = nlohmann::ordered_json;

BrushMode mode_in(const Json& body) {
  constexpr std::array<std::pair<std::string_view, BrushMode>, 4> kModes = {
      {{"paint", BrushMode::kAdd},
       {"erase", BrushMode::kErase},
       {"smooth", BrushMode::kSmooth},
       {"grow", BrushMode::kGrow}}};
  const std::string text = text_in(body, "mode");
  for (const auto& [word, mode] : kModes) {
    if (word == text) return mode;
  }
  throw UsageError(concat("mode: expected paint, erase, smooth or grow, found ", quoted(text)));
}

bool is_true(const Json& body, const std::string& key) {
  return body.contains(key) && body[key] == true;
}

}  // namespace

RegionPainting::RegionPainting(EditSession& session)
    : session_(session), mean_(shape_of_mean(session.job().inputs.faces)) {}

MaskPainter& RegionPainting::painter() {
  if (!painter_) {
    const Job& job = session_.job();
    const HeadAxes axes = head_axes(job.config);
    const Topology& topology = job.inputs.faces.topology;
    painter_.emplace(topology, mean_.positions,
                     MirrorPlane{axes.side(), middle_of(topology, mean_, axes)},
                     job.inputs.regions.alpha);
  }
  return *painter_;
}

SurfacePoint RegionPainting::place_of(const Json& point) {
  if (!point.is_object()) throw UsageError("points: expected a list of {triangle, u, v}");
  const PreviewMesh& preview = session_.preview();
  const std::size_t triangles = preview.triangles.size() / 3;
  const double number = number_in(point, "triangle", 0, static_cast<double>(triangles) - 1);
  const double u = number_in(point, "u", 0, 1), v = number_in(point, "v", 0, 1);
  const std::uint32_t* corners =
      preview.triangles.data() + 3 * static_cast<std::size_t>(std::floor(number));
  const auto corner = [&](int c) -> Eigen::Vector3d {
    return mean_.positions.row(preview.vertices[corners[c]]).transpose();
  };
  return painter().surface().nearest((1 - u - v) * corner(0) + u * corner(1) + v * corner(2));
}

void RegionPainting::stroke(const Json& body) {
  constexpr std::size_t kMostPoints = 1000;
  constexpr double kLeastRadius = 0.1, kMostRadius = 200;
  const std::vector<std::string>& names = session_.casting().region_names;
  const auto region = std::find(names.begin(), names.end(), text_in(body, "region"));
  if (region == names.end()) throw UsageError("region: expected the name of one");
  Brush brush;
  brush.mode = mode_in(body);
  brush.radius = number_in(body, "radius_mm", kLeastRadius, kMostRadius) /
                 mm_per(session_.job().config.faces.units);
  brush.strength = number_in(body, "strength", 0, 1);
  brush.falloff = number_in(body, "falloff", 0, 1);
  brush.mirror = is_true(body, "mirror");
  if (!body.contains("points") || !body["points"].is_array() || body["points"].empty() ||
      body["points"].size() > kMostPoints) {
    throw UsageError(concat("points: expected a list of 1 to ", kMostPoints));
  }
  std::vector<SurfacePoint> places;
  for (const Json& point : body["points"]) places.push_back(place_of(point));
  painter().paint(region - names.begin(), places, brush, !is_true(body, "begin") && painted());
  painted_ = true;
}

void RegionPainting::undo() {
  if (!painted()) throw UsageError("nothing is painted that could be taken back");
  painter().undo();
  painted_ = true;
}

std::vector<float> RegionPainting::masks() const {
  const RegionWeights::Alpha& built = session_.masks().alpha;
  const RegionWeights::Alpha& alpha = painter_ ? painter_->alpha() : built;
  std::vector<float> masks;
  for (const std::uint32_t v : session_.preview().vertices) {
    const bool blended = !built.row(v).isZero(0);
    for (Index k = 0; k < alpha.cols(); ++k) {
      masks.push_back(blended ? static_cast<float>(alpha(v, k)) : 0.0F);
    }
  }
  return masks;
}

void RegionPainting::apply() {
  if (painted_) session_.use_masks({painter().alpha(), 0});
  painted_ = false;
}

std::vector<std::filesystem::path> RegionPainting::save(const std::filesystem::path& folder) {
  const FaceSet& faces = session_.job().inputs.faces;
  const int size = mask_size(faces.topology.vertex_count);
  const MaskFiles images =
      encode_masks(paint_masks(faces.topology, faces.uvs, painter().alpha(), mean_.skin, size),
                   folder / "masks.png");
  for (const auto& [path, bytes] : images.files) write_file(path, bytes);
  return images.masks;
}

}  // namespace crowdface
