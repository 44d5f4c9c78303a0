// SPDX-License-Identifier: Apache-2.0
#include "crowdface/page/answer_request.h"

#include <utility>

#include "crowdface/core/contains.h"
#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/log.h"
#include "crowdface/core/text.h"
#include "crowdface/io/shallow_json.h"

namespace crowdface {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view kLicense = "three.LICENSE.txt";
constexpr std::string_view kNotice =
    "<!doctype html><title>crowdface</title><p>This page has not been built: run "
    "scripts/build_gallery.sh, then start crowdface again.";

std::string_view media_type(std::string_view name) {
  if (name.ends_with(".html")) return "text/html; charset=utf-8";
  if (name.ends_with(".js")) return "text/javascript; charset=utf-8";
  if (name.ends_with(".css")) return "text/css; charset=utf-8";
  return "text/plain; charset=utf-8";
}

int status_of(const Error& error) {
  if (error.code() == ExitCode::kMissingInput) return 404;
  const auto of_request = {ExitCode::kUsage, ExitCode::kBadData, ExitCode::kUnsatisfiable};
  return contains(of_request, error.code()) ? 400 : 500;
}

}  // namespace

Json parse_json_body(const HttpRequest& request) {
  Json json = parse_shallow_json(request.body);
  if (!json.is_object()) throw UsageError("the request: expected a mapping in JSON");
  return json;
}

std::string text_in(const Json& body, const std::string& key) {
  if (!body.contains(key) || !body[key].is_string()) {
    throw UsageError(concat(key, ": expected a text"));
  }
  return body[key].get<std::string>();
}

double number_in(const Json& body, const std::string& key, double low, double high) {
  const double value =
      body.contains(key) && body[key].is_number() ? body[key].get<double>() : low - 1;
  if (!(value >= low && value <= high)) {
    throw UsageError(concat(key, ": expected a number from ", low, " to ", high));
  }
  return value;
}

HttpAnswer json_answer(const Json& json, int status) {
  // Replace invalid UTF-8, because JSON must be valid UTF-8. Texts may contain file names, which
  // may be invalid UTF-8.
  return {status, "application/json", json.dump(-1, ' ', false, Json::error_handler_t::replace)};
}

HttpAnswer error_answer(int status, std::string_view sentence) {
  return json_answer({{"error", sentence}}, status);
}

HttpAnswer binary_answer(std::string bytes) {
  return {200, "application/octet-stream", std::move(bytes)};
}

PageFiles::PageFiles(std::optional<std::filesystem::path> folder, std::string page_name)
    : folder_(std::move(folder)), page_name_(std::move(page_name)) {}

std::optional<HttpAnswer> PageFiles::file(std::string_view name) const {
  const std::string html = concat(page_name_, ".html");
  if (name.empty()) name = html;
  if (name != html && name != concat(page_name_, ".js") && name != concat(page_name_, ".css") &&
      name != kLicense) {
    return std::nullopt;
  }
  if (!folder_ || !path_exists(*folder_ / name)) {
    if (name != html) return std::nullopt;
    return HttpAnswer{.type = std::string(media_type(name)), .bytes = std::string(kNotice)};
  }
  return HttpAnswer{.type = std::string(media_type(name)), .bytes = read_file(*folder_ / name)};
}

HttpAnswer page_answer(const PageFiles& files, const HttpRequest& request) {
  auto file = request.method == "GET" ? files.file(request.path) : std::nullopt;
  if (!file) return error_answer(404, "there is nothing at this address");
  return std::move(*file);
}

HttpAnswer answer_or_error(const HttpRequest& request,
                           const std::function<HttpAnswer(const HttpRequest&)>& answer) {
  try {
    return answer(request);
  } catch (const RecoverableError& error) {
    return error_answer(status_of(error), error.what());
  } catch (const std::exception& error) {
    log_error(concat(request.path, ": internal error, please report it: ", error.what()));
    return error_answer(500, "internal error; the terminal that runs crowdface shows the details");
  }
}

}  // namespace crowdface
