// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

namespace crowdface {

/// Exit codes of the program. If BSD's sysexits.h has a matching code, its value is used.
enum class ExitCode : int {
  kDone = 0,
  kUnsatisfiable = 3,  ///< the constraints of a plan cannot be met
  kUsage = 64,         ///< the command line or config is wrong
  kBadData = 65,       ///< the content of an input file cannot be used
  kMissingInput = 66,  ///< an input file is missing or cannot be read
  kBug = 70,           ///< a bug in crowdface
  kCannotCreate = 73,  ///< an output file or folder cannot be created
  kIoError = 74,       ///< reading or writing failed after it had begun
  kInterrupted = 75,   ///< stopped by a signal; run again to resume
};

/// Base of all exceptions that crowdface throws. The messages of input errors name the file, the
/// expected content and the content found. `main` returns `code()` as the exit code.
class Error : public std::runtime_error {
 public:
  Error(ExitCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
  ExitCode code() const { return code_; }

 private:
  ExitCode code_;
};

/// Base of the errors that inputs, the machine or the user cause: all errors except
/// BrokenPrecondition (core/require.h). The library's own code catches only RecoverableError, so
/// that a BrokenPrecondition, which means a bug, always reaches the program.
struct RecoverableError : Error {
  using Error::Error;
};

/// An error with the exit code kCode. Each exit code has its own class, so that callers can catch
/// each kind of error separately.
template <ExitCode kCode>
struct ErrorWithCode : RecoverableError {
  explicit ErrorWithCode(const std::string& message) : RecoverableError(kCode, message) {}
};

/// Wrong command line or config.
using UsageError = ErrorWithCode<ExitCode::kUsage>;
/// Unusable input data.
using InvalidInput = ErrorWithCode<ExitCode::kBadData>;
/// \throws InvalidInput with the message "FILE: WHAT".
[[noreturn]] inline void refuse_file(const std::filesystem::path& file, const std::string& what) {
  throw InvalidInput(file.string() + ": " + what);
}
/// An input that does not exist or cannot be opened.
using MissingInput = ErrorWithCode<ExitCode::kMissingInput>;
/// The constraints of a plan cannot be met.
using Unsatisfiable = ErrorWithCode<ExitCode::kUnsatisfiable>;
/// An output file or folder that cannot be created.
using CannotCreate = ErrorWithCode<ExitCode::kCannotCreate>;
/// A read or write that failed after it began.
using IoError = ErrorWithCode<ExitCode::kIoError>;
/// The run was stopped by a signal.
using Interrupted = ErrorWithCode<ExitCode::kInterrupted>;

}  // namespace crowdface
