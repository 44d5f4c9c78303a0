// SPDX-License-Identifier: Apache-2.0
#include "crowdface/editor/region_painting.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string>
#include <utility>

#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/log.h"
#include "crowdface/core/text.h"
#include "crowdface/core/units.h"
#include "crowdface/heads/named_parts.h"
#include "crowdface/page/answer_request.h"
#include "crowdface/paint/proposed_masks.h"
#include "crowdface/region/mask_painting.h"

namespace crowdface {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kUndo = "undo";

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

/// Hash of the data on which brush strokes depend: the preview's triangles, the regions and the
/// regions' masks.
Digest hash_painting_base(const EditSession& session) {
  const RegionWeights::Alpha& alpha = session.job().inputs.regions.alpha;
  const std::span values(alpha.data(), static_cast<std::size_t>(alpha.size()));
  Hasher hasher;
  for (const std::string& name : session.casting().region_names) hasher.add(name);
  return hasher.add_array(values).add_array(std::span(session.preview().triangles)).digest();
}

}  // namespace

RegionPainting::RegionPainting(EditSession& session, const std::filesystem::path& strokes)
    : session_(session),
      mean_head_(mean_head_shape(session.job().inputs.head_set)),
      strokes_(strokes, hash_painting_base(session)) {
  replay_strokes();
}

void RegionPainting::replay_strokes() {
  painter_.reset();
  try {
    for (const Json& stroke : strokes_.strokes()) {
      if (!stroke.contains(kUndo)) {
        paint(stroke);
      } else if (differs_from_config()) {
        painter().undo();
      }
    }
  } catch (const UsageError& error) {  // a user may have edited the file
    log_warning(concat(strokes_.file().string(), ": ", error.what(),
                       "; the remaining strokes are ignored"));
  }
}

void RegionPainting::store_step(const Json& step) {
  try {
    strokes_.add(step);
  } catch (...) {  // restore the masks from the file
    replay_strokes();
    has_unapplied_paint_ = true;
    throw;
  }
}

MaskPainter& RegionPainting::painter() {
  if (!painter_) {
    const Job& job = session_.job();
    const HeadAxes axes = head_axes(job.config);
    const Topology& topology = job.inputs.head_set.topology;
    painter_.emplace(topology, mean_head_.positions,
                     MirrorPlane{axes.side(), symmetry_offset(topology, mean_head_, axes)},
                     job.inputs.regions.alpha);
  }
  return *painter_;
}

SurfacePoint RegionPainting::surface_point_of(const Json& point) {
  if (!point.is_object()) throw UsageError("points: expected a list of {triangle, u, v}");
  const PreviewMesh& preview = session_.preview();
  const std::size_t triangles = preview.triangles.size() / 3;
  const double number = number_in(point, "triangle", 0, static_cast<double>(triangles) - 1);
  const double u = number_in(point, "u", 0, 1), v = number_in(point, "v", 0, 1);
  const std::uint32_t* corners =
      preview.triangles.data() + 3 * static_cast<std::size_t>(std::floor(number));
  const auto corner = [&](int c) -> Eigen::Vector3d {
    return mean_head_.positions.row(preview.vertices[corners[c]]).transpose();
  };
  return painter().surface().nearest((1 - u - v) * corner(0) + u * corner(1) + v * corner(2));
}

Index RegionPainting::region_in(const Json& body, const std::string& key) const {
  const std::vector<std::string>& names = session_.casting().region_names;
  const auto region = std::ranges::find(names, text_in(body, key));
  if (region == names.end()) throw UsageError(concat(key, ": expected the name of a region"));
  return region - names.begin();
}

void RegionPainting::paint(const Json& body) {
  constexpr std::size_t kMaxPoints = 1000;
  constexpr double kMinRadius = 0.1, kMaxRadius = 200;
  const Index region = region_in(body, "region");
  Brush brush;
  brush.mode = mode_in(body);
  brush.radius = number_in(body, "radius_mm", kMinRadius, kMaxRadius) /
                 mm_per(session_.job().config.faces.units);
  brush.strength = number_in(body, "strength", 0, 1);
  brush.falloff = number_in(body, "falloff", 0, 1);
  brush.paints_mirror_image = is_true(body, "mirror");
  if (!body.contains("points") || !body["points"].is_array() || body["points"].empty() ||
      body["points"].size() > kMaxPoints) {
    throw UsageError(concat("points: expected a list of 1 to ", kMaxPoints));
  }
  std::vector<SurfacePoint> places;
  for (const Json& point : body["points"]) places.push_back(surface_point_of(point));
  painter().paint(region, places, brush, !is_true(body, "begin") && differs_from_config());
  has_unapplied_paint_ = true;
}

void RegionPainting::apply_stroke(const Json& body) {
  paint(body);
  store_step(body);
}

void RegionPainting::undo() {
  if (!differs_from_config()) throw UsageError("there is no stroke to undo");
  painter().undo();
  has_unapplied_paint_ = true;
  store_step({{kUndo, true}});
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

void RegionPainting::apply_masks() {
  if (has_unapplied_paint_) session_.use_masks({painter().alpha(), 0});
  has_unapplied_paint_ = false;
}

PaintedRegions RegionPainting::changed_regions(const Json& change) {
  PaintedRegions regions{session_.casting().region_names, painter().alpha()};
  if (change.contains("add")) {
    regions.names.push_back(text_in(change, "add"));
    regions.alpha.conservativeResize(Eigen::NoChange, regions.alpha.cols() + 1);
    regions.alpha.rightCols(1).setZero();
  } else if (change.contains("remove")) {
    const Index region = region_in(change, "remove");
    if (regions.names.size() == 1) throw UsageError("remove: the only region cannot be removed");
    regions.names.erase(regions.names.begin() + region);
    regions.alpha = painter().alpha_without(region);
  } else if (change.contains("propose")) {
    if (!change["propose"].is_array()) throw UsageError("propose: expected a list of names");
    std::vector<std::string> wanted;
    for (const Json& name : change["propose"]) {
      if (!name.is_string()) throw UsageError("propose: expected a list of names");
      wanted.push_back(name);
    }
    const std::vector<MaskBand> bands = parse_bands(join(wanted, ","));
    const Config& config = session_.job().config;
    regions = {names_of(bands), propose_regions(session_.job().inputs.head_set.topology, mean_head_,
                                                {config.faces.up, config.faces.front}, bands)};
  }
  return regions;
}

std::vector<std::filesystem::path> RegionPainting::save(const PaintedRegions& regions,
                                                        const std::filesystem::path& path) const {
  const HeadSet& head_set = session_.job().inputs.head_set;
  const int size = mask_side_texels(head_set.topology.vertex_count);
  const MaskFiles images = encode_masks(
      paint_masks(head_set.topology, head_set.uvs, regions.alpha, mean_head_.is_skin, size), path);
  for (const auto& [file, bytes] : images.png_files) write_file(file, bytes);
  return images.mask_paths;
}

}  // namespace crowdface
