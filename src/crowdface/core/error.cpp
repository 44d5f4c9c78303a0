// SPDX-License-Identifier: Apache-2.0
#include "crowdface/core/error.h"

namespace crowdface {

UsageError::UsageError(const std::string& message) : Error(ExitCode::kUsage, message) {}
InvalidInput::InvalidInput(const std::string& message) : Error(ExitCode::kBadData, message) {}
MissingInput::MissingInput(const std::string& message) : Error(ExitCode::kMissingInput, message) {}
Unsatisfiable::Unsatisfiable(const std::string& message)
    : Error(ExitCode::kUnsatisfiable, message) {}
CannotCreate::CannotCreate(const std::string& message) : Error(ExitCode::kCannotCreate, message) {}
IoError::IoError(const std::string& message) : Error(ExitCode::kIoError, message) {}
Interrupted::Interrupted(const std::string& message) : Error(ExitCode::kInterrupted, message) {}

}  // namespace crowdface
