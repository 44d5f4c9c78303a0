// SPDX-License-Identifier: Apache-2.0
#include "crowdface/page/request_values.h"

#include "crowdface/core/error.h"
#include "crowdface/core/text.h"
#include "crowdface/io/shallow_json.h"

namespace crowdface {

using Json = nlohmann::ordered_json;

HttpAnswer json_answer(const Json& json, int status) {
  // Names of files need not be UTF-8; an answer has to be.
  return {status, "application/json", json.dump(-1, ' ', false, Json::error_handler_t::replace)};
}

Json body_of(const HttpRequest& request) {
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

}  // namespace crowdface
