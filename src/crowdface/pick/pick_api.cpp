// SPDX-License-Identifier: Apache-2.0
#include "crowdface/pick/pick_api.h"

#include <cmath>
#include <set>
#include <utility>

#include "crowdface/core/error.h"
#include "crowdface/core/interrupt.h"
#include "crowdface/core/text.h"
#include "crowdface/page/answer_request.h"
#include "crowdface/pick/landmark_file.h"
#include "crowdface/pick/landmark_names.h"

namespace crowdface {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMaxLandmarks = 100, kMaxNameLength = 64;

Json list_of(const Eigen::Vector3d& v) {
  return Json::array({v.x(), v.y(), v.z()});
}

Json place_json(const PickedPlace& place, bool with_vertex) {
  Json json = {{"point", list_of(place.point)}, {"normal", list_of(place.normal)}};
  if (with_vertex) json["vertex"] = place.vertex;
  return json;
}

Json stands_json(const Eigen::Vector3d& up, const Eigen::Vector3d& front) {
  return {{"up", list_of(up)}, {"front", list_of(front)}};
}

/// The similarity transform from the template (mm) to the scan (in its own unit).
Json pose_json(const Similarity& pose) {
  Json rows = Json::array();
  for (int r = 0; r < 3; ++r) rows.push_back(list_of(pose.rotation.row(r).transpose()));
  return {{"scale", pose.scale}, {"rotation", rows}, {"translation", list_of(pose.translation)}};
}

Eigen::Vector3d vector_of(const Json& json, const std::string& key) {
  Eigen::Vector3d v;
  bool good = json.is_array() && json.size() == 3;
  for (std::size_t c = 0; good && c < 3; ++c) {
    good = json[c].is_number();
    if (good) v[static_cast<Index>(c)] = json[c].get<double>();
  }
  if (!good || !(v.cwiseAbs().maxCoeff() <= kMaxCoordinate)) {
    throw UsageError(concat(key, ": expected three numbers"));
  }
  return v;
}

std::uint32_t number_of(const Json& json, Index count, const std::string& key) {
  if (!json.is_number_unsigned() ||
      json.get<std::uint64_t>() >= static_cast<std::uint64_t>(count)) {
    throw UsageError(concat(key, ": expected a vertex from 0 to ", count - 1));
  }
  return json.get<std::uint32_t>();
}

/// The name of a landmark. \throws UsageError if a landmark file cannot hold the name.
std::string name_in(const Json& body) {
  std::string name = text_in(body, "name");
  if (name.empty() || name.size() > kMaxNameLength || printable(name) != name ||
      name.find('\n') != std::string::npos) {
    throw UsageError(concat("name: expected 1 to ", kMaxNameLength,
                            " letters without control characters, found ",
                            quoted(std::string_view(name))));
  }
  return name;
}

Json landmark_json(const PickedLandmark& landmark, const PickSession& session) {
  Json json = {{"name", landmark.name}, {"template", nullptr}, {"scan", nullptr}};
  if (landmark.template_vertex) {
    json["template"] =
        place_json(session.template_mesh().place_at_vertex(*landmark.template_vertex), true);
  }
  if (landmark.scan_point) {
    json["scan"] = place_json(session.scan_mesh().place_at_point(*landmark.scan_point), false);
    if (landmark.scan_vertex) json["scan"]["vertex"] = *landmark.scan_vertex;
  }
  return json;
}

HttpAnswer pick(const PickSession& session, const Json& body) {
  const std::string mesh = text_in(body, "mesh");
  const bool on_template = mesh == "template";
  if (!on_template && mesh != "scan") throw UsageError("mesh: expected template or scan");
  const Eigen::Vector3d origin = vector_of(body.value("origin", Json()), "origin");
  const Eigen::Vector3d direction = vector_of(body.value("direction", Json()), "direction");
  if (direction.isZero()) throw UsageError("direction: expected a vector that is not zero");
  const auto place = on_template ? session.pick_on_template(origin, direction)
                                 : session.pick_on_scan(origin, direction);
  return json_answer({{"place", place ? place_json(*place, on_template) : Json()}});
}

std::vector<PickedLandmark> landmarks_in(const PickSession& session, const Json& body) {
  const Json list = body.value("landmarks", Json());
  if (!list.is_array() || list.size() > kMaxLandmarks) {
    throw UsageError(concat("landmarks: expected a list of at most ", kMaxLandmarks));
  }
  std::vector<PickedLandmark> landmarks;
  std::set<std::string> names;
  for (const Json& item : list) {
    if (!item.is_object()) throw UsageError("landmarks: expected a list of mappings");
    PickedLandmark landmark;
    landmark.name = name_in(item);
    if (!names.insert(landmark.name).second) {
      throw UsageError(concat("landmarks: expected different names, found ",
                              quoted(std::string_view(landmark.name)), " twice"));
    }
    const Json vertex = item.value("template", Json()), place = item.value("scan", Json());
    if (!vertex.is_null()) {
      landmark.template_vertex =
          number_of(vertex, session.template_mesh().positions().rows(), landmark.name);
    }
    const Positions& scan = session.scan_mesh().positions();
    if (place.is_number()) {
      landmark.scan_vertex = number_of(place, scan.rows(), landmark.name);
      landmark.scan_point = scan.row(*landmark.scan_vertex).transpose();
    } else if (!place.is_null()) {
      landmark.scan_point = vector_of(place, landmark.name);
    }
    landmarks.push_back(landmark);
  }
  return landmarks;
}

HttpAnswer suggest(const PickSession& session, const Json& body) {
  const SuggestedPlaces places = session.suggest(landmarks_in(session, body));
  Json of_template = Json::object(), of_scan = Json::object(), residuals = Json::object();
  for (const auto& [name, place] : places.template_places)
    of_template[name] = place_json(place, true);
  for (const auto& [name, place] : places.scan_places) of_scan[name] = place_json(place, false);
  Json pose;
  if (places.pose) {
    for (const auto& [name, residual] : places.pose->residuals) {
      residuals[name] = {{"mm", residual.distance_mm}, {"outlier", residual.is_outlier}};
    }
    pose = pose_json(places.pose->pose);
  }
  return json_answer(
      {{"template", of_template}, {"scan", of_scan}, {"residuals", residuals}, {"pose", pose}});
}

HttpAnswer save(PickSession& session, const Json& body) {
  const std::vector<PickedLandmark> landmarks = landmarks_in(session, body);
  session.save(landmarks);
  std::size_t pairs = 0;
  for (const PickedLandmark& landmark : landmarks) {
    if (landmark.template_vertex && landmark.scan_point) ++pairs;
  }
  return json_answer({{"file", session.inputs().landmark_file.string()}, {"pairs", pairs}});
}

}  // namespace

PickApi::PickApi(PickableScans& scans, std::optional<std::filesystem::path> pages,
                 std::size_t max_triangles)
    : scans_(scans), page_(std::move(pages), "pick"), max_triangles_(max_triangles) {}

HttpAnswer PickApi::answer(const HttpRequest& request) {
  return answer_or_error(request, [this](const HttpRequest& asked) {
    const auto is = [&](const char* method, const char* path) {
      return asked.method == method && asked.path == path;
    };
    const std::shared_ptr<OpenScan> now = scans_.current();
    if (is("GET", "api/job")) return page_data_answer(now->session);
    if (is("GET", "api/mesh/template")) {
      return mesh_answer(now->session.template_mesh(), {}, now->shown_template);
    }
    if (is("GET", "api/mesh/scan")) {
      return mesh_answer(now->session.scan_mesh(), now->session.inputs().scan_colours,
                         now->shown_scan);
    }
    if (is("POST", "api/pick")) return pick(now->session, parse_json_body(asked));
    if (is("POST", "api/suggest")) return suggest(now->session, parse_json_body(asked));
    if (is("PUT", "api/landmarks")) return save(now->session, parse_json_body(asked));
    if (is("POST", "api/open")) return open_scan(parse_json_body(asked));
    return page_answer(page_, asked);
  });
}

HttpAnswer PickApi::mesh_answer(const PickableMesh& whole, const ColourRows& colours,
                                ShownMesh& shown) const {
  std::call_once(shown.once, [&] { shown.bytes = whole.encode_reduced(max_triangles_, colours); });
  return binary_answer(shown.bytes);
}

HttpAnswer PickApi::open_scan(const Json& body) {
  scans_.open(
      number_of(body.value("scan", Json()), static_cast<Index>(scans_.entries().size()), "scan"));
  return json_answer({{"scan", scans_.current_index()}});
}

HttpAnswer PickApi::page_data_answer(const PickSession& session) const {
  const PickInputs& inputs = session.inputs();
  const HeadAxes& axes = inputs.wrap_template.axes;
  Json names = Json::array(), landmarks = Json::array();
  for (const LandmarkDefinition& known : suggested_landmarks()) {
    names.push_back({{"name", known.name}, {"where", known.location}});
  }
  for (const PickedLandmark& landmark : session.landmarks()) {
    landmarks.push_back(landmark_json(landmark, session));
  }
  Json scans = Json::array();
  for (std::size_t i = 0; i < scans_.entries().size(); ++i) {
    scans.push_back({{"name", scans_.entries()[i].scan_file.filename().string()},
                     {"picked", scans_.is_picked(i)}});
  }
  const auto file_name = [](const std::filesystem::path& path) { return path.filename().string(); };
  return json_answer(
      {{"template",
        {{"name", file_name(inputs.template_file)}, {"stands", stands_json(axes.up, axes.front)}}},
       {"scan",
        {{"name", file_name(inputs.scan_file)},
         {"stands", stands_json(session.scan_orientation().up, session.scan_orientation().front)}}},
       {"scans", scans},
       {"number", scans_.current_index()},
       {"file", inputs.landmark_file.string()},
       {"loses_comments", session.saving_deletes_comments()},
       {"names", names},
       {"landmarks", landmarks}});
}

void pick_landmarks(PickableScans& scans, std::optional<std::filesystem::path> pages, int port,
                    const std::function<void(const std::string&)>& started) {
  constexpr std::size_t kMaxTriangles = 100'000;
  PickApi api(scans, std::move(pages), kMaxTriangles);
  LocalServer server([&](const HttpRequest& request) { return api.answer(request); }, port);
  started(server.address());
  server.run(is_interrupted);
}

}  // namespace crowdface
