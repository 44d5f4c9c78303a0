// SPDX-License-Identifier: Apache-2.0
#include "crowdface/run/report.h"

#include <algorithm>
#include <cmath>
#include <thread>

#include <nlohmann/json.hpp>

#include "crowdface/core/file.h"
#include "crowdface/core/memory.h"
#include "crowdface/core/parallel.h"
#include "crowdface/core/rounded.h"
#include "crowdface/core/text.h"
#include "crowdface/core/units.h"
#include "crowdface/core/version.h"
#include "crowdface/crowd/crowd_table.h"
#include "crowdface/heads/heads_on_body.h"
#include "crowdface/heads/settings_digest.h"
#include "crowdface/io/shallow_json.h"
#include "crowdface/mesh/alignment.h"
#include "crowdface/smooth/level_size.h"

namespace crowdface {
namespace {

using Json = nlohmann::ordered_json;

/// The text in report.json between the summary and the list of faces.
constexpr std::string_view kBeforeFaces = ",\n  \"faces\": [";

/// Returns the minimum, median and maximum of the distances that `of`, a value of casting.json,
/// describes; null if there are no distances.
Json distribution(const Json& of) {
  if (of.is_null()) return nullptr;
  return {{"min", of["min"]}, {"median", of["median"]}, {"max", of["max"]}};
}

Json heads_to_json(const Job& job, const CrowdPlan& crowd_plan) {
  Json heads = Json::array();
  for (std::size_t h = 0; h < job.names.heads.size(); ++h) {
    heads.push_back({{"name", job.names.heads[h]},
                     {"file", job.config.faces.files[h].filename().string()},
                     {"positions", job.inputs.head_digests[h].hex()},
                     {"anchor", {crowd_plan.anchors[h].x(), crowd_plan.anchors[h].y()}}});
  }
  return heads;
}

Json topology_to_json(const Inputs& inputs) {
  const auto& boundary = inputs.adjacency.boundary;
  return {{"vertices", inputs.head_set.topology.vertex_count},
          {"faces", inputs.head_set.topology.face_count()},
          {"components", inputs.components.count()},
          {"boundary_vertices", std::count(boundary.begin(), boundary.end(), true)},
          {"digest", inputs.topology_digest.hex()}};
}

/// Returns the approximation errors of each head's fitted smoothing levels.
Json levels_to_json(const Job& job, const PreparedHeads& prepared) {
  const double mm = mm_per(job.config.faces.units);
  const auto fine = [](double value) { return std::round(value * 1e7) / 1e7; };
  Json heads = Json::array();
  for (std::size_t h = 0; h < prepared.levels.size(); ++h) {
    const StoredLevels& levels = prepared.levels[h];
    heads.push_back({{"name", job.names.heads[h]},
                     {"rank", levels.fields.rank},
                     {"error_max_mm", fine(levels.error.max * mm)},
                     {"error_rms_mm", fine(levels.error.rms * mm)},
                     {"error_max_at_iterations", levels.error.level}});
  }
  return {{"tolerance_mm", job.config.smoothing.tolerance_mm}, {"heads", std::move(heads)}};
}

/// Returns, for each band of detail, the smallest and the largest wavelength at which the band
/// begins, in mm, over all regions and faces.
Json bands_to_json(const Job& job, const std::vector<FacePlan>& crowd) {
  const auto size = [&](std::uint64_t level) {
    return rounded(
        wavelength_of_iterations(job.smoothing.kind(), level, job.inputs.edge_length_mm));
  };
  Json bands = Json::array();
  for (std::size_t b = 0; b < job.names.bands.size(); ++b) {
    std::uint64_t least = job.inputs.max_level, most = 0;
    for (const FacePlan& face : crowd) {
      for (const RegionRecipe& region : face.recipe.regions) {
        least = std::min(least, band_of(region, b).iterations);
        most = std::max(most, band_of(region, b).iterations);
      }
    }
    bands.push_back({{"name", job.names.bands[b]}, {"begins_mm", {size(least), size(most)}}});
  }
  return bands;
}

Json error_to_json(const LevelError& error) {
  return {{"rms", rounded(error.root_mean_square)}, {"max", rounded(error.max)}};
}

Json lods_to_json(const Inputs& inputs) {
  Json lods = Json::array();
  for (const auto& [level, heads, shapes] : inputs.detail_levels) {
    lods.push_back({{"share", level.share},
                    {"triangles", level.topology.face_count()},
                    {"vertices", level.vertices.size()},
                    {"error_mm", error_to_json(heads)}});
    if (!inputs.shapes.shapes.empty()) lods.back()["error_in_shapes_mm"] = error_to_json(shapes);
  }
  return lods;
}

Json smoothing_to_json(const Job& job, const PreparedHeads& prepared, const CrowdPlan& crowd_plan) {
  const Inputs& inputs = job.inputs;
  Json smoothing = {
      {"max_iterations", inputs.max_level},
      {"max_size_mm", rounded(wavelength_of_iterations(job.smoothing.kind(), inputs.max_level,
                                                       inputs.edge_length_mm))},
      {"edge_length_mm", inputs.edge_length_mm}};
  if (job.config.smoothing.levels == LevelRepresentation::kBasis) {
    smoothing["basis"] = levels_to_json(job, prepared);
  }
  if (!job.names.bands.empty() && !crowd_plan.crowd.empty()) {
    smoothing["bands"] = bands_to_json(job, crowd_plan.crowd);
  }
  return smoothing;
}

Json distances_to_json(const Json& distances) {
  Json json;
  for (const char* kind :
       {"between_heads_mm", "to_nearest_head_mm", "to_nearest_earlier_face_mm"}) {
    json[kind] = distribution(distances[kind]);
  }
  return json;
}

Json face_to_json(const std::string& id, const std::vector<FaceFile>& files,
                  const FaceResult& result, const Eigen::Array3d* neck_colour) {
  Json face = {{"id", id}};
  for (std::size_t f = 0; f < files.size(); ++f) {
    const FaceFile& file = files[f];
    if (file.report_key.empty()) continue;
    (file.report_section.empty() ? face : face[file.report_section])[file.report_key] =
        result.file_digests[f].digest.hex();
  }
  if (result.skin_defects) {
    const SkinDefects& skin = *result.skin_defects;
    face["skin"] = {{"triangles", skin.local.compared_triangle_count},
                    {"flipped", skin.local.flipped_triangle_count},
                    {"stretch", rounded(skin.local.stretch_factor)},
                    {"intersecting", skin.intersecting_triangle_count},
                    {"wider_mm", rounded(skin.gap_excess_mm)},
                    {"exposed_mm2", rounded(skin.exposed_back_face_mm2)}};
  }
  if (neck_colour != nullptr) {
    const Eigen::Array3d& light = *neck_colour;
    face["neck"] = {{"linear", {rounded(light[0]), rounded(light[1]), rounded(light[2])}},
                    {"srgb", srgb_hex(light)}};
  }
  return face;
}

/// Returns, for each blend shape, the number of faces in which the shape makes skin triangles
/// intersect, and the largest number of such triangles in one face. Does not count intersections
/// that already exist in the template or in the face at rest.
Json shapes_to_json(const ShapeSet& set, const std::vector<FaceResult>& results) {
  Json shapes = Json::object();
  for (std::size_t s = 0; s < set.shapes.size(); ++s) {
    std::size_t faces = 0;
    Index most = 0;
    for (const FaceResult& face : results) {
      if (s >= face.skin_intersections.size() || face.skin_intersections[s] == 0) continue;
      ++faces;
      most = std::max(most, face.skin_intersections[s]);
    }
    shapes[set.shapes[s].name] = {{"faces_with_crossing_skin", faces},
                                  {"most_crossing_triangles", most}};
  }
  return shapes;
}

/// Indents by two spaces per level, like the rest of the report.
std::string indented(const Json& json, std::size_t levels) {
  std::string text;
  for (const char c : json.dump(2, ' ', false, Json::error_handler_t::replace)) {
    text += c;
    if (c == '\n') text.append(2 * levels, ' ');
  }
  return text;
}

/// For each head: how well the head was fitted to the ring of vertices at the neck.
Json neck_to_json(const Job& job) {
  const HeadsOnBody& neck = *job.inputs.heads_on_body;
  Json heads = Json::array();
  for (std::size_t h = 0; h < neck.heads.size(); ++h) {
    const HeadsOnBody::Head& head = neck.heads[h];
    heads.push_back({{"name", job.names.heads[h]},
                     {"moved_mm", rounded(head.shift_mm)},
                     {"turned_degrees", rounded(head.rotation_degrees)},
                     {"bent_mm", rounded(head.max_bend_mm)}});
  }
  return {{"ring_vertices", neck.seam.rim.size()},
          {"bent_vertices", neck.seam.neck_bend.vertices().size()},
          {"heads", std::move(heads)}};
}

/// The report without the list of faces.
Json summary(const Job& job, const PreparedHeads& prepared, const CrowdPlan& crowd_plan,
             const Json& casting, const std::vector<FaceResult>& faces, std::size_t sheets,
             const std::vector<std::string>& warnings) {
  Json report;
  report["crowdface"] = kVersion;
  report["crowd"] = job.config.crowd.name;
  report["asked"] = {{"count", job.config.crowd.count},
                     {"recipes", job.config.recipes.size()},
                     {"families", job.config.families.size()},
                     {"seed", job.config.crowd.seed}};
  report["reached"] = {{"faces", crowd_plan.crowd.size()}, {"sheets", sheets}};
  report["settings"] = job.settings.hex();
  report["topology"] = topology_to_json(job.inputs);
  if (!job.inputs.detail_levels.empty()) report["lods"] = lods_to_json(job.inputs);
  report["smoothing"] = smoothing_to_json(job, prepared, crowd_plan);
  report["heads"] = heads_to_json(job, crowd_plan);
  if (job.inputs.heads_on_body) report["neck"] = neck_to_json(job);
  report["masks"] = {{"digest", job.inputs.mask_digest.hex()},
                     {"uncovered_vertices", job.inputs.regions.uncovered_vertex_count}};
  for (const auto& [name, digest] : digests_without_heads_and_masks(job.inputs)) {
    report["inputs"][name] = digest.hex();
  }
  report["distances"] = distances_to_json(casting["distances"]);
  report["casting"] = casting;
  if (!job.inputs.shapes.shapes.empty()) {
    report["shapes"] = shapes_to_json(job.inputs.shapes, faces);
  }
  report["warnings"] = warnings;
  return report;
}

}  // namespace

TextPieces report_text(const Job& job, const PreparedHeads& prepared, const CrowdPlan& crowd_plan,
                       const Json& casting, const FaceFileLists& lists,
                       const std::vector<FaceResult>& faces,
                       const std::vector<Eigen::Array3d>& neck_colours, std::size_t sheets,
                       const std::vector<std::string>& warnings) {
  // Replace invalid UTF-8: warnings may contain any file names.
  std::string head = summary(job, prepared, crowd_plan, casting, faces, sheets, warnings)
                         .dump(2, ' ', false, Json::error_handler_t::replace);
  head.resize(head.size() - std::string_view("\n}").size());
  return [&, head = concat(head, kBeforeFaces)](const TextSink& take) {
    take(head);
    text_of_items(faces.size(), [&](std::size_t i) {
      const FacePlan& face = crowd_plan.crowd[i];
      return concat(i > 0 ? ",\n    " : "\n    ",
                    indented(face_to_json(face.id, lists.all_files(face), faces[i],
                                          neck_colours.empty() ? nullptr : &neck_colours[i]),
                             2));
    })(take);
    take(faces.empty() ? "]\n}\n" : "\n  ]\n}\n");
  };
}

Json read_report_summary(const std::filesystem::path& file) {
  const MappedFile report(file);
  const std::string_view whole = report.bytes();
  return parse_shallow_json(concat(whole.substr(0, whole.find(kBeforeFaces)), "\n}"));
}

std::vector<std::pair<std::string, Digest>> digests_without_heads_and_masks(const Inputs& inputs) {
  std::vector<std::pair<std::string, Digest>> digests = {
      {"materials", materials_digest(inputs)},
      {"textures", inputs.textures.digest},
      {"colours at vertices", inputs.colours_digest},
      {"shapes", inputs.shapes_digest},
      {"points", inputs.points_digest},
      {"rig", inputs.rig.digest},
      {"attachments", inputs.attachments.digest},
      {"neck", inputs.heads_on_body ? inputs.heads_on_body->digest : Digest()}};
  for (const HeadTextures& maps : inputs.other_textures) {
    const TextureKind kind = maps.names.front().kind;
    digests.emplace_back(concat(mtl_statement_of(kind).name, " maps"), maps.digest);
  }
  std::erase_if(digests, [](const auto& each) { return each.second == Digest(); });
  return digests;
}

std::string format_timings(const StageSeconds& stages, const StageTimes& busy, std::size_t faces,
                           std::size_t heads_from_cache) {
  Json timings;
  timings["crowdface"] = kVersion;
  timings["threads"] = thread_count();
  timings["hardware_threads"] = std::thread::hardware_concurrency();
  timings["faces"] = faces;
  timings["heads_from_cache"] = heads_from_cache;
  double total = 0;
  for (const auto& [stage, seconds] : stages) {
    timings["seconds"][stage] = rounded(seconds);
    total += seconds;
  }
  timings["seconds"]["total"] = rounded(total);
  const std::pair<const char*, double> parts[] = {{"blend", busy.blend_seconds},
                                                  {"encode", busy.encode_seconds},
                                                  {"write", busy.write_seconds},
                                                  {"render", busy.render_seconds},
                                                  {"check", busy.check_seconds}};
  const auto* slowest = std::max_element(std::begin(parts), std::end(parts),
                                         [](auto& a, auto& b) { return a.second < b.second; });
  for (const auto& [part, seconds] : parts) timings["busy_seconds"][part] = rounded(seconds);
  timings["slowest"] = slowest->first;
  timings["peak_memory_bytes"] = peak_memory_bytes();
  return timings.dump(2) + "\n";
}

}  // namespace crowdface
