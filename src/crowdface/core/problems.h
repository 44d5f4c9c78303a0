// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "crowdface/core/error.h"

namespace crowdface {

/// Collects all errors of an input, so that the user sees all errors in one run.
class Problems {
 public:
  /// Adds an error, unless the same message was added before.
  /// \param message  one or more lines: file, location in the file, what was expected, what was
  ///                 found.
  void add(ExitCode code, std::string message);
  void add(const Error& error) { add(error.code(), error.what()); }
  bool empty() const { return messages_.empty(); }
  std::size_t size() const { return messages_.size(); }
  const std::vector<std::string>& messages() const { return messages_; }

  /// Returns one exit code for all collected errors. If any error has the code 64, returns 64;
  /// otherwise 66 if any error has this code; otherwise 65 if any error has this code; otherwise
  /// the code of the error that was added first. Returns 0 if there is no error.
  ExitCode code() const;

  /// \throws RecoverableError with all messages, one per line, if there are any.
  void throw_if_any() const;

 private:
  std::vector<std::string> messages_;
  std::vector<ExitCode> codes_;  ///< exit code of each message
};

}  // namespace crowdface
