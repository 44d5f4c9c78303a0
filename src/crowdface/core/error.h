// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>
#include <string>

namespace crowdface {

/// Exit codes of the program, after BSD sysexits where those fit.
enum class ExitCode : int {
  kDone = 0,
  kUnsatisfiable = 3,  ///< the constraints cannot be met
  kUsage = 64,         ///< command line or config is wrong
  kBadData = 65,       ///< an input file holds something unusable
  kMissingInput = 66,  ///< an input file is missing or cannot be read
  kBug = 70,           ///< our own mistake
  kCannotCreate = 73,  ///< an output file or folder cannot be created
  kIoError = 74,       ///< a read or write failed half-way
  kInterrupted = 75,   ///< stopped by a signal; run again to resume
};

/// Base of every exception crowdface throws. The message names the file, what was expected and what
/// was found; `main` turns it into the exit code.
class Error : public std::runtime_error {
 public:
  Error(ExitCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
  ExitCode code() const { return code_; }

 private:
  ExitCode code_;
};

/// Wrong command line or config (64).
struct UsageError : Error {
  explicit UsageError(const std::string& message);
};
/// Unusable input data (65). A broken precondition of our own is no Error: core/require.h.
struct InvalidInput : Error {
  explicit InvalidInput(const std::string& message);
};
/// An input that does not exist or cannot be opened (66).
struct MissingInput : Error {
  explicit MissingInput(const std::string& message);
};
/// The constraints of a plan cannot be met (3).
struct Unsatisfiable : Error {
  explicit Unsatisfiable(const std::string& message);
};
/// An output file or folder that cannot be created (73).
struct CannotCreate : Error {
  explicit CannotCreate(const std::string& message);
};
/// A read or write that failed after it began (74).
struct IoError : Error {
  explicit IoError(const std::string& message);
};
/// The run was stopped by a signal (75).
struct Interrupted : Error {
  explicit Interrupted(const std::string& message);
};

}  // namespace crowdface
