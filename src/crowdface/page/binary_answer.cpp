// SPDX-License-Identifier: Apache-2.0
#include "crowdface/page/binary_answer.h"

namespace crowdface {
namespace {

void pad(std::string& bytes, char with) {
  bytes.resize((bytes.size() + 3) / 4 * 4, with);
}

}  // namespace

void BinaryAnswer::add(std::string_view name, std::string_view type, std::size_t count,
                       std::string_view bytes) {
  arrays_.push_back({{"name", name}, {"type", type}, {"count", count}});
  data_ += bytes;
  pad(data_, '\0');
}

std::string BinaryAnswer::bytes() const {
  nlohmann::ordered_json whole = json;
  whole["arrays"] = arrays_;
  std::string text = whole.dump();
  pad(text, ' ');
  const auto length = static_cast<std::uint32_t>(text.size());
  std::string bytes(reinterpret_cast<const char*>(&length), sizeof(length));
  bytes.reserve(bytes.size() + text.size() + data_.size());
  return bytes += text, bytes += data_;
}

}  // namespace crowdface
