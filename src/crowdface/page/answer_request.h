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

/// Parses the body of a request. \throws UsageError if the body is not a JSON object.
nlohmann::ordered_json parse_json_body(const HttpRequest& request);

/// Returns the text value of `key` in the body of a request. \throws UsageError if the value is
/// missing or not a text.
std::string text_in(const nlohmann::ordered_json& body, const std::string& key);
/// Returns the number that is the value of `key` in the body of a request. \throws UsageError if
/// the value is missing, not a number or not in [low, high].
double number_in(const nlohmann::ordered_json& body, const std::string& key, double low,
                 double high);

/// Returns an answer with a JSON body.
HttpAnswer json_answer(const nlohmann::ordered_json& json, int status = 200);
/// An error answer with the body {"error": sentence}.
HttpAnswer error_answer(int status, std::string_view sentence);
/// An answer with a body of bytes in a binary format. The page decodes this format.
HttpAnswer binary_answer(std::string bytes);

/// The files of one web page: NAME.html, NAME.js and NAME.css, written by
/// scripts/build_gallery.sh.
class PageFiles {
 public:
  /// \param folder     folder with the built pages; nothing if the pages were not built
  /// \param page_name  name of the page's files without extension (NAME above), such as "editor"
  PageFiles(std::optional<std::filesystem::path> folder, std::string page_name);

  /// The file with this name. The empty name stands for the page itself, such as editor.html; if
  /// the page was not built, this file is a notice that says how to build the page. \return nothing
  /// if the page has no such file.
  std::optional<HttpAnswer> file(std::string_view name) const;

 private:
  std::optional<std::filesystem::path> folder_;
  std::string page_name_;
};

/// Returns the file that the request asks for. If the page has no such file, returns status 404.
HttpAnswer page_answer(const PageFiles& files, const HttpRequest& request);

/// Returns `answer(request)`, and turns exceptions into error answers. For a RecoverableError, the
/// answer contains the message of the exception. Any other exception is logged, and the answer only
/// refers to the log.
HttpAnswer answer_or_error(const HttpRequest& request,
                           const std::function<HttpAnswer(const HttpRequest&)>& answer);

}  // namespace crowdface
