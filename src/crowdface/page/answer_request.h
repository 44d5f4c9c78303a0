// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "crowdface/page/local_server.h"
#include "crowdface/page/page_files.h"

namespace crowdface {

/// {"error": sentence}
HttpAnswer refusal(int status, std::string_view sentence);
/// Of bytes that the page takes apart itself.
HttpAnswer binary_answer(std::string bytes);

/// A file of the page, or a refusal.
HttpAnswer page_answer(const PageFiles& files, const HttpRequest& request);

/// What `answer` gives; an Error becomes a refusal with its message, anything else one that points to the log.
HttpAnswer answer_or_refuse(const HttpRequest& request,
                            const std::function<HttpAnswer(const HttpRequest&)>& answer);

}  // namespace crowdface
