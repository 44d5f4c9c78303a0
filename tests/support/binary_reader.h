// SPDX-License-Identifier: Apache-2.0
// Reads numbers out of a binary file, for parsers that share nothing with the writers.
#pragma once

#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

namespace crowdface::testing {

class BinaryReader {
 public:
  explicit BinaryReader(std::string bytes) : bytes_(std::move(bytes)) {}

  template <class Number>
  Number next() {
    Number number;
    if (at_ + sizeof number > bytes_.size()) throw std::runtime_error("the file is too short");
    std::memcpy(&number, bytes_.data() + at_, sizeof number);
    at_ += sizeof number;
    return number;
  }
  std::string next_line() { return next_text(bytes_.find('\n', at_) + 1 - at_); }
  std::string next_text(std::size_t size) {
    if (at_ + size > bytes_.size()) throw std::runtime_error("the file is too short");
    at_ += size;
    return bytes_.substr(at_ - size, size);
  }
  template <class Number>
  std::vector<Number> next_array(std::size_t count) {
    std::vector<Number> numbers;
    for (std::size_t i = 0; i < count; ++i) numbers.push_back(next<Number>());
    return numbers;
  }
  std::size_t position() const { return at_; }
  void go_to(std::size_t position) { at_ = position; }
  bool at_end() const { return at_ == bytes_.size(); }

 private:
  std::string bytes_;
  std::size_t at_ = 0;
};

}  // namespace crowdface::testing
