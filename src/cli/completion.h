// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "cli/command_tables.h"

namespace crowdface::cli {

/// Returns the script with which a shell completes commands, options and the values of options.
/// \param shell  "bash", "zsh" or "fish".
std::string completion_script(const ProgramDescription& program, const std::string& shell);

/// The manual page of the program and all its commands, for `man` (groff's man macros).
std::string manual_page(const ProgramDescription& program);

}  // namespace crowdface::cli
