// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "crowdface/core/error.h"

namespace crowdface {

/// Collects all errors of an input, so that the user sees them at once.
class Problems {
 public:
  /// Adds an error. Repeated messages are dropped.
  /// \param message  one or more lines: file, place, what was expected, what was found.
  void add(ExitCode code, std::string message);
  void add(const Error& error) { add(error.code(), error.what()); }
  bool empty() const { return messages_.empty(); }
  std::size_t size() const { return messages_.size(); }
  const std::vector<std::string>& messages() const { return messages_; }

  /// The exit code of the most basic error: 64 before 66 before 65 before any other; 0 if there is
  /// none.
  ExitCode code() const;

  /// \throws RecoverableError with all messages, one per line, if there are any.
  void throw_if_any() const;

 private:
  std::vector<std::string> messages_;
  std::vector<ExitCode> codes_;
};

}  // namespace crowdface
