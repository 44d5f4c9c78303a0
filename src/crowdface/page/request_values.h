// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "crowdface/page/local_server.h"

namespace crowdface {

HttpAnswer json_answer(const nlohmann::ordered_json& json, int status = 200);

/// What a request holds. \throws UsageError if it is no mapping in JSON.
nlohmann::ordered_json body_of(const HttpRequest& request);

/// A value of a request. \throws UsageError, naming the key, if it is of another type or out of bounds.
std::string text_in(const nlohmann::ordered_json& body, const std::string& key);
double number_in(const nlohmann::ordered_json& body, const std::string& key, double low,
                 double high);

}  // namespace crowdface
