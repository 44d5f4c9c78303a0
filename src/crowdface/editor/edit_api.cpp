// SPDX-License-Identifier: Apache-2.0
#include "crowdface/editor/edit_api.h"

#include <algorithm>
#include <chrono>

#include "crowdface/core/error.h"
#include "crowdface/core/log.h"
#include "crowdface/core/text.h"
#include "crowdface/editor/binary_answer.h"
#include "crowdface/editor/page_files.h"
#include "crowdface/editor/recipe_json.h"
#include "crowdface/io/shallow_json.h"

namespace crowdface {
namespace {

using Json = nlohmann::ordered_json;

HttpAnswer json_answer(const Json& json, int status = 200) {
  return {status, "application/json", json.dump()};
}
HttpAnswer binary_answer(std::string bytes) {
  return {200, "application/octet-stream", std::move(bytes)};
}
HttpAnswer refusal(int status, std::string_view sentence) {
  return json_answer({{"error", sentence}}, status);
}

int status_of(const Error& error) {
  switch (error.code()) {
    case ExitCode::kUsage:
    case ExitCode::kBadData:
    case ExitCode::kUnsatisfiable:
      return 400;
    case ExitCode::kMissingInput:
      return 404;
    default:
      return 500;
  }
}

/// \throws UsageError if the body is no mapping.
Json body_of(const HttpRequest& request) {
  Json json = parse_shallow_json(request.body);
  if (!json.is_object()) throw UsageError("the request: expected a mapping in JSON");
  return json;
}

}  // namespace

EditApi::EditApi(EditSession& session) : session_(session) {}

const std::vector<EditApi::Route>& EditApi::routes() {
  static const std::vector<Route> routes = {{"GET", "api/job", &EditApi::job},
                                            {"GET", "api/mesh", &EditApi::mesh},
                                            {"GET", "api/heads/", &EditApi::head},
                                            {"POST", "api/face", &EditApi::face}};
  return routes;
}

HttpAnswer EditApi::answer(const HttpRequest& request) {
  try {
    for (const Route& route : routes()) {
      const bool is_prefix = route.path.ends_with('/');
      if (is_prefix ? !request.path.starts_with(route.path) : request.path != route.path) continue;
      if (route.method != request.method) continue;
      return (this->*route.answer)(request, request.path.substr(route.path.size()));
    }
    return page(request, request.path);
  } catch (const Error& error) {
    return refusal(status_of(error), error.what());
  } catch (const std::exception& error) {
    log_error(concat(request.path, ": internal error, please report it: ", error.what()));
    return refusal(500, "internal error; the program's own window says more");
  }
}

HttpAnswer EditApi::page(const HttpRequest& request, const std::string& rest) {
  auto file = request.method == "GET" ? page_file(rest) : std::nullopt;
  if (!file) return refusal(404, "there is nothing at this address");
  return {200, std::move(file->type), std::move(file->bytes)};
}

HttpAnswer EditApi::job(const HttpRequest&, const std::string&) {
  return json_answer(session_.description());
}

HttpAnswer EditApi::mesh(const HttpRequest&, const std::string&) {
  return binary_answer(session_.mesh());
}

HttpAnswer EditApi::head(const HttpRequest&, const std::string& rest) {
  const auto number = parse_unsigned(rest);
  if (!number || *number >= session_.job().inputs.faces.heads.size()) {
    return refusal(404, "there is no such head");
  }
  return binary_answer(session_.head(static_cast<Index>(*number)));
}

CastFace EditApi::face_of(const Json& request) const {
  return face_of_json(request.contains("recipe") ? request["recipe"] : Json(), session_.casting(),
                      session_.job().config);
}

void EditApi::note_turn(const std::string& page, std::uint64_t turn) {
  constexpr std::size_t kMostPages = 64;
  const std::lock_guard lock(turns_mutex_);
  if (turns_.size() > kMostPages) turns_.clear();
  std::uint64_t& newest = turns_[page];
  newest = std::max(newest, turn);
}

bool EditApi::overtaken(const std::string& page, std::uint64_t turn) {
  const std::lock_guard lock(turns_mutex_);
  const auto newest = turns_.find(page);
  return newest != turns_.end() && turn < newest->second;
}

HttpAnswer EditApi::face(const HttpRequest& request, const std::string&) {
  const Json body = body_of(request);
  const CastFace face = face_of(body);
  const std::string page = body.value("page", "");
  const std::uint64_t turn = body.value("turn", std::uint64_t{0});
  if (!page.empty()) note_turn(page, turn);
  const std::lock_guard lock(building_);
  if (!page.empty() && overtaken(page, turn)) return refusal(409, "overtaken by a newer request");
  const auto begin = std::chrono::steady_clock::now();
  const Positions positions = session_.build(face.recipe);
  BinaryAnswer answer;
  const std::vector<float> points = session_.points(positions);
  const std::vector<float> normals = session_.normals(positions);
  answer.add("positions", std::span(points));
  answer.add("normals", std::span(normals));
  answer.head["ms"] =
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
  if (body.value("measure", false)) {
    const FaceMeasures measures = session_.measure(face, positions);
    const auto& names = session_.job().names.heads;
    answer.head["nearest_head"] = {{"name", names[static_cast<std::size_t>(measures.head)]},
                                   {"mm", measures.head_mm}};
    answer.head["nearest_face"] = nullptr;
    if (measures.face) {
      answer.head["nearest_face"] = {{"id", (*session_.crowd())[*measures.face].id},
                                     {"mm", measures.face_mm}};
    }
    answer.head["warnings"] = measures.warnings;
  }
  return binary_answer(answer.bytes());
}

}  // namespace crowdface
