// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "crowdface/core/error.h"

namespace crowdface {

/// Collects everything that is wrong with an input, so that a user sees all of it at once.
class Problems {
 public:
  /// Adds one problem; `message` is one line (or more), naming file, place, expected and found.
  void add(ExitCode kind, std::string message);
  void add(const Error& error) { add(error.code(), error.what()); }
  bool empty() const { return messages_.empty(); }
  std::size_t size() const { return messages_.size(); }
  const std::vector<std::string>& messages() const { return messages_; }

  /// The code of the most basic problem: 64 before 66 before 65 before any other.
  ExitCode code() const;

  /// Throws one Error with every message, a line each, if there is any problem.
  void throw_if_any() const;

 private:
  std::vector<std::string> messages_;
  std::vector<ExitCode> kinds_;
};

}  // namespace crowdface
