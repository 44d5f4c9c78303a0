// SPDX-License-Identifier: Apache-2.0
#include "crowdface/page/answer_request.h"

#include <utility>

#include "crowdface/core/error.h"
#include "crowdface/core/log.h"
#include "crowdface/core/text.h"
#include "crowdface/page/request_values.h"

namespace crowdface {
namespace {

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

}  // namespace

HttpAnswer refusal(int status, std::string_view sentence) {
  return json_answer({{"error", sentence}}, status);
}

HttpAnswer binary_answer(std::string bytes) {
  return {200, "application/octet-stream", std::move(bytes)};
}

HttpAnswer page_answer(const PageFiles& files, const HttpRequest& request) {
  auto file = request.method == "GET" ? files.file(request.path) : std::nullopt;
  if (!file) return refusal(404, "there is nothing at this address");
  return {200, std::move(file->type), std::move(file->bytes)};
}

HttpAnswer answer_or_refuse(const HttpRequest& request,
                            const std::function<HttpAnswer(const HttpRequest&)>& answer) {
  try {
    return answer(request);
  } catch (const Error& error) {
    return refusal(status_of(error), error.what());
  } catch (const std::exception& error) {
    log_error(concat(request.path, ": internal error, please report it: ", error.what()));
    return refusal(500, "internal error; the program's own window says more");
  }
}

}  // namespace crowdface
