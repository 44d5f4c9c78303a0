// SPDX-License-Identifier: Apache-2.0
#include <cstdlib>

#include "crowdface/core/error.h"
#include "crowdface/page/answer_request.h"
#include "crowdface/page/http_head.h"

#include "fuzz/input_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(crowdface::fuzz::text_of(data, size));
  try {
    const auto body = crowdface::parse_json_body({"POST", "api/face", text});
    crowdface::text_in(body, "id");
    crowdface::number_in(body, "size", 0, 1);
  } catch (const crowdface::Error&) {
  }
  const auto head = crowdface::parse_http_head(text);
  if (!head) return 0;
  if (head->method.empty() || !text.ends_with("\r\n\r\n")) std::abort();
  for (const char c : head->path) {
    if (static_cast<unsigned char>(c) < ' ') std::abort();
  }
  for (const auto& [name, value] : head->fields) {
    if (head->count(name) == 0 || name.find_first_of(": \r\n") != name.npos ||
        value.find_first_of("\r\n") != value.npos) {
      std::abort();
    }
  }
  return 0;
}
