// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "crowdface/page/local_server.h"

namespace crowdface {

/// What a request holds. \throws UsageError if it is no mapping in JSON.
nlohmann::ordered_json body_of(const HttpRequest& request);

/// A value of a request. \throws UsageError, naming the key, if it is of another type or out of bounds.
std::string text_in(const nlohmann::ordered_json& body, const std::string& key);
double number_in(const nlohmann::ordered_json& body, const std::string& key, double low,
                 double high);

HttpAnswer json_answer(const nlohmann::ordered_json& json, int status = 200);
/// {"error": sentence}
HttpAnswer refusal(int status, std::string_view sentence);
/// Of bytes that the page takes apart itself.
HttpAnswer binary_answer(std::string bytes);

/// The files of one page that the program serves, NAME.html, NAME.js and NAME.css, as
/// scripts/build_gallery.sh writes them.
class PageFiles {
 public:
  /// \param folder  where pages lie, or nothing
  /// \param page    "editor"
  PageFiles(std::optional<std::filesystem::path> folder, std::string page);

  /// A file by its name in the address; the empty name is the page itself. Where the page was not built a
  /// notice stands in its place.
  std::optional<HttpAnswer> file(std::string_view name) const;

 private:
  std::optional<std::filesystem::path> folder_;
  std::string page_;
};

/// A file of the page, or a refusal.
HttpAnswer page_answer(const PageFiles& files, const HttpRequest& request);

/// What `answer` gives; an Error becomes a refusal with its message, anything else one that points to the log.
HttpAnswer answer_or_refuse(const HttpRequest& request,
                            const std::function<HttpAnswer(const HttpRequest&)>& answer);

}  // namespace crowdface
