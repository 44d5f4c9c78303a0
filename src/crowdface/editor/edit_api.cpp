// SPDX-License-Identifier: Apache-2.0
#include "crowdface/editor/edit_api.h"

#include <algorithm>
#include <chrono>

#include "crowdface/config/config_draft.h"
#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/text.h"
#include "crowdface/editor/config_edits.h"
#include "crowdface/editor/recipe_json.h"
#include "crowdface/editor/sample_faces.h"
#include "crowdface/mesh/all_columns.h"
#include "crowdface/page/answer_request.h"
#include "crowdface/page/binary_answer.h"
#include "crowdface/pictures/gallery_page.h"

namespace crowdface {

EditApi::EditApi(EditSession& session, EditedFolder& folder, GenerateRun& run, bool may_edit_config,
                 std::function<void()> reload_job)
    : session_(session),
      may_edit_config_(may_edit_config),
      folder_(folder),
      run_(run),
      reload_job_(std::move(reload_job)),
      page_(gallery_page_folder(), "editor"),
      pictures_(session.job()),
      attachments_(session.job(), session.crowd()),
      expressions_(session.job()),
      dropped_(session.job().config.file.parent_path()),
      painting_(session, folder.path() / "strokes.jsonl") {
  folder_.finish_interrupted_saves(session_.job(), mesh_writer());
}

HttpAnswer EditApi::answer(const HttpRequest& request) {
  struct Route {
    std::string method, path;
    HttpAnswer (EditApi::*answer)(const HttpRequest& request, const std::string& rest);
  };
  static const std::vector<Route> routes = {{"GET", "api/job", &EditApi::job},
                                            {"GET", "api/mesh", &EditApi::mesh},
                                            {"GET", "api/light", &EditApi::light},
                                            {"GET", "api/heads/", &EditApi::head},
                                            {"GET", "api/attachments/", &EditApi::attachment},
                                            {"POST", "api/face", &EditApi::face},
                                            {"POST", "api/skin", &EditApi::skin},
                                            {"POST", "api/measures", &EditApi::measures},
                                            {"POST", "api/faults", &EditApi::faults},
                                            {"POST", "api/draw", &EditApi::draw},
                                            {"POST", "api/steer", &EditApi::steer},
                                            {"GET", "api/faces/", &EditApi::face_picture},
                                            {"GET", "api/state", &EditApi::saved_state},
                                            {"POST", "api/state", &EditApi::take_over_editing},
                                            {"PUT", "api/state", &EditApi::save_state},
                                            {"POST", "api/save", &EditApi::save_face},
                                            {"POST", "api/recipes", &EditApi::put_recipe},
                                            {"GET", "api/generate", &EditApi::generate_progress},
                                            {"POST", "api/generate", &EditApi::generate},
                                            {"POST", "api/generate/stop", &EditApi::stop_generate},
                                            {"POST", "api/review", &EditApi::review},
                                            {"POST", "api/masks/stroke", &EditApi::paint_masks},
                                            {"POST", "api/masks/undo", &EditApi::undo_masks},
                                            {"POST", "api/masks/save", &EditApi::save_masks},
                                            {"POST", "api/regions", &EditApi::use_regions},
                                            {"POST", "api/dropped", &EditApi::begin_drop},
                                            {"PUT", "api/dropped/", &EditApi::receive_dropped_file},
                                            {"POST", "api/heads", &EditApi::add_heads},
                                            {"POST", "api/open", &EditApi::reload_job}};
  return answer_or_error(request, [this](const HttpRequest& asked) {
    for (const Route& route : routes) {
      const bool is_prefix = route.path.ends_with('/');
      if (is_prefix ? !asked.path.starts_with(route.path) : asked.path != route.path) continue;
      if (route.method != asked.method) continue;
      return (this->*route.answer)(asked, asked.path.substr(route.path.size()));
    }
    return page_answer(page_, asked);
  });
}

HttpAnswer EditApi::job(const HttpRequest&, const std::string&) {
  Json json = session_.description();
  json["can_edit_config"] = may_edit_config_;
  {
    const std::lock_guard lock(build_mutex_);
    json["painted"] = painting_.differs_from_config();
  }
  if (may_edit_config_) {
    json["regions_edit"] = edit_json(session_.job().config.edits, "regions");
    json["faces_edit"] = edit_json(session_.job().config.edits, "faces");
  }
  json["attachments"] = attachments_.kinds();
  json["shapes"] = expressions_.names();
  return json_answer(json);
}

HttpAnswer EditApi::mesh(const HttpRequest&, const std::string&) {
  const std::lock_guard lock(build_mutex_);
  painting_.apply_masks();
  return binary_answer(session_.mesh_answer());
}

HttpAnswer EditApi::light(const HttpRequest&, const std::string&) {
  return binary_answer(session_.ambient_light_answer());
}

HttpAnswer EditApi::head(const HttpRequest&, const std::string& rest) {
  const std::size_t slash = std::min(rest.find('/'), rest.size());
  const std::string what = rest.substr(slash);
  const auto number = parse_unsigned(std::string_view(rest).substr(0, slash));
  if (!number || *number >= session_.job().inputs.head_set.heads.size()) {
    return error_answer(404, "there is no such head");
  }
  const auto head = static_cast<Index>(*number);
  if (what.empty()) return binary_answer(session_.head_answer(head));
  if (what == "/thumbnail") return {200, "image/png", pictures_.thumbnail(head)};
  if (what != "/texture") return error_answer(404, "there is nothing at this address");
  auto texture = session_.textures().head_jpeg(head);
  if (!texture) return error_answer(404, "the head has no texture");
  return {200, "image/jpeg", std::move(*texture)};
}

HttpAnswer EditApi::attachment(const HttpRequest&, const std::string& rest) {
  auto look = attachments_.appearance_json(rest);
  if (!look) return error_answer(404, "there is no such attachment");
  return {200, "application/json", std::move(*look)};
}

FacePlan EditApi::face_in(const Json& body, const std::string& key) const {
  return face_of_json(body.contains(key) ? body[key] : Json(), session_.casting(),
                      session_.job().config);
}

std::vector<std::size_t> EditApi::bands_in(const Json& body, const std::string& key) const {
  std::vector<std::size_t> parts;
  if (!body.contains(key)) return parts;
  for (const Json& name : body[key]) {
    const auto found =
        find_region_bands(name.is_string() ? name.get<std::string>() : "", session_.job().config);
    if (found.empty()) throw UsageError(concat(key, ": expected a list of regions or bands"));
    parts.insert(parts.end(), found.begin(), found.end());
  }
  return parts;
}

HttpAnswer EditApi::draw(const HttpRequest& request, const std::string&) {
  constexpr double kMaxFaces = 64;
  constexpr std::uint32_t kAttempts = 4096;  // upper limit of the attempts for one request
  const Json body = parse_json_body(request);
  SampleRequest sampling{face_in(body), bands_in(body, "locked"), std::nullopt};
  if (body.contains("like") && !body["like"].is_null()) sampling.original = face_in(body, "like");
  if (body.contains("amount")) sampling.variation = number_in(body, "amount", 0, 1);
  if (body.contains("count")) {
    sampling.count = static_cast<std::size_t>(number_in(body, "count", 1, kMaxFaces));
  }
  sampling.first_attempt = sampling_attempts_.fetch_add(kAttempts);
  Json recipes = Json::array();
  Json mm = Json::array();  // distances from `original`
  for (const FacePlan& face : session_.sample_faces(sampling)) {
    recipes.push_back(recipe_to_json(face, session_.casting(), session_.job().config));
    if (sampling.original) mm.push_back(session_.distance_mm(*sampling.original, face));
  }
  return json_answer({{"recipes", recipes}, {"mm", mm}});
}

/// Changes a face so that one measurement comes as near to a requested value as the heads allow.
/// Answers with the new face and the measures of this face.
HttpAnswer EditApi::steer(const HttpRequest& request, const std::string&) {
  constexpr double kFarthest = 1e4;
  const Json body = parse_json_body(request);
  const FacePlan face =
      session_.steer(face_in(body), text_in(body, "trait"),
                     number_in(body, "value", -kFarthest, kFarthest), bands_in(body, "locked"));
  Json answer = measures_json(session_.measure(face, opened_id(body)));
  answer["recipe"] = recipe_to_json(face, session_.casting(), session_.job().config);
  return json_answer(answer);
}

/// The image of a face of the crowd, with all views side by side, as on the contact sheets.
HttpAnswer EditApi::face_picture(const HttpRequest&, const std::string& rest) {
  const std::vector<FacePlan>* crowd = session_.crowd();
  if (crowd == nullptr || std::ranges::find(*crowd, rest, &FacePlan::id) == crowd->end()) {
    return error_answer(404, "there is no such face");
  }
  const auto file = crowd_directory_of(session_.job().config).render(rest);
  if (!path_exists(file)) return error_answer(404, "the face has no picture");
  return {200, "image/png", read_file(file)};
}

void EditApi::note_request_number(const std::string& page, std::uint64_t request_number) {
  constexpr std::size_t kMaxPages = 64;
  const std::lock_guard lock(newest_requests_mutex_);
  if (newest_requests_.size() > kMaxPages) newest_requests_.clear();
  std::uint64_t& newest = newest_requests_[page];
  newest = std::max(newest, request_number);
}

bool EditApi::is_outdated_request(const std::string& page, std::uint64_t request_number) {
  const std::lock_guard lock(newest_requests_mutex_);
  const auto newest = newest_requests_.find(page);
  return newest != newest_requests_.end() && request_number < newest->second;
}

nlohmann::ordered_json EditApi::measures_json(const FaceMeasures& measures) const {
  const auto& names = session_.job().names.heads;
  Json json;
  json["nearest_head"] = {{"name", names[static_cast<std::size_t>(measures.nearest_head)]},
                          {"mm", measures.nearest_head_distance_mm},
                          {"as_built_mm", measures.nearest_head_distance_with_extrapolation_mm}};
  json["nearest_face"] = nullptr;
  if (measures.nearest_face) {
    json["nearest_face"] = {{"id", (*session_.crowd())[*measures.nearest_face].id},
                            {"mm", measures.nearest_face_distance_mm}};
  }
  json["traits"] = Json::array();
  for (const FaceMeasures::Trait& one : measures.traits) {
    const Measurement& of = measurements()[one.trait];
    json["traits"].push_back({{"name", of.name},
                              {"symbol", of.symbol},
                              {"unit", unit_of(of)},
                              {"value", one.value},
                              {"low", one.low},
                              {"high", one.high},
                              {"more", one.difference_from_mean}});
  }
  json["warnings"] = measures.warnings;
  return json;
}

std::string EditApi::opened_id(const Json& body) {
  return body.contains("face") && body["face"].is_string() ? body["face"].get<std::string>() : "";
}

HttpAnswer EditApi::measures(const HttpRequest& request, const std::string&) {
  const Json body = parse_json_body(request);
  return json_answer(measures_json(session_.measure(face_in(body), opened_id(body))));
}

/// The visible faults of the whole mesh of a face: {"faults": sentences}.
HttpAnswer EditApi::faults(const HttpRequest& request, const std::string&) {
  const FacePlan face = face_in(parse_json_body(request));
  Positions positions;
  {
    const std::lock_guard lock(build_mutex_);
    painting_.apply_masks();
    positions = session_.build(face.recipe);
  }
  return json_answer({{"faults", session_.mesh_faults(face.recipe, positions)}});
}

HttpAnswer EditApi::face(const HttpRequest& request, const std::string&) {
  constexpr double kMaxTurns = 1e15;
  const Json body = parse_json_body(request);
  const FacePlan face = face_in(body);
  const std::string page = body.contains("page") ? text_in(body, "page") : "";
  const auto turn =
      static_cast<std::uint64_t>(body.contains("turn") ? number_in(body, "turn", 0, kMaxTurns) : 0);
  if (!page.empty()) note_request_number(page, turn);
  const std::lock_guard lock(build_mutex_);
  if (!page.empty() && is_outdated_request(page, turn))
    return error_answer(409, "overtaken by a newer request");
  painting_.apply_masks();
  const auto begin = std::chrono::steady_clock::now();
  const Positions positions = session_.build(face.recipe);
  const EditExpressions::WeightedDisplacements moves =
      body.contains("expression")
          ? expressions_.weighted_displacements(body["expression"], face.recipe, positions)
          : EditExpressions::WeightedDisplacements();
  Positions shown = positions;
  for (const Displacements& move : moves) move.add_to(shown);
  BinaryAnswer answer;
  const std::vector<float> points = session_.preview_points(shown);
  const std::vector<float> normals = session_.preview_normals(shown);
  answer.add("positions", std::span(points));
  answer.add("normals", std::span(normals));
  const Json chosen = body.contains("wears") ? body["wears"] : Json::object();
  if (!chosen.is_object())
    throw UsageError("wears: expected a mapping from kinds of attachments to names");
  const std::string opened = opened_id(body);
  answer.json["worn"] = Json::array();
  const auto worn = attachments_.attachments_of(face, opened, chosen, positions, moves);
  answer.json["bare"] = !worn;  // attachments are still being bound; the page asks again
  for (const PlacedAttachment& one : worn.value_or(std::vector<PlacedAttachment>())) {
    const std::vector<float> places = attachments_.vertex_positions(one);
    const std::string name = one.look().name();
    answer.json["worn"].push_back(name);
    answer.add(concat("worn ", name), std::span(places));
  }
  answer.json["ms"] =
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
  if (body.contains("measure") && body["measure"] == true) {
    answer.json.update(measures_json(session_.measure(face, positions, opened)));
  }
  return binary_answer(answer.bytes());
}

/// The skin of a face. "picture" and "normals" are JPEG files in the layout of the atlas; "rough"
/// and "colours" have values at the preview's vertices. Omits each of these keys for which the face
/// has no texture (or no vertex colours).
HttpAnswer EditApi::skin(const HttpRequest& request, const std::string&) {
  const FacePlan face = face_in(parse_json_body(request));
  BinaryAnswer answer;
  const auto add = [&](std::string_view name, std::string_view bytes) {
    answer.add(name, std::span(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()));
  };
  const auto texture_set = pictures_.textures_of(face.recipe);
  if (texture_set && !texture_set->textures.empty()) {
    add("picture", session_.textures().colour_jpeg(*texture_set));
  }
  if (texture_set && !texture_set->slopes.textures.empty()) {
    add("normals", session_.textures().normal_map_jpeg(texture_set->slopes));
  }
  const auto rough =
      texture_set ? session_.preview_roughness(*texture_set) : std::vector<std::uint8_t>();
  if (!rough.empty()) answer.add("rough", std::span(rough));
  const ColourRows colours = pictures_.textures().vertex_colours(face.recipe);
  if (colours.rows() > 0) {
    const ColourRows shown = colours(session_.preview().vertices, kAllColumns);
    answer.add("colours", std::span(shown.data(), static_cast<std::size_t>(shown.size())));
  }
  return binary_answer(answer.bytes());
}

}  // namespace crowdface
