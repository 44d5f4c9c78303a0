// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "cli/command_line.h"

namespace crowdface::cli {

/// Function that executes a subcommand, after the command line has been parsed.
using CommandAction = std::function<void()>;

/// Each of these functions adds one subcommand to the program, and returns the function that
/// executes this subcommand.
CommandAction add_generate(CLI::App& program);
CommandAction add_prepare(CLI::App& program);
CommandAction add_plan(CLI::App& program);
CommandAction add_blend(CLI::App& program);
CommandAction add_smooth(CLI::App& program);
CommandAction add_gather(CLI::App& program);
CommandAction add_verify(CLI::App& program);
CommandAction add_sheet(CLI::App& program);
CommandAction add_synth(CLI::App& program);
CommandAction add_import(CLI::App& program);
CommandAction add_check(CLI::App& program);
CommandAction add_convert(CLI::App& program);
CommandAction add_init(CLI::App& program);
CommandAction add_mask(CLI::App& program);
CommandAction add_cache(CLI::App& program);
CommandAction add_wrap(CLI::App& program);
CommandAction add_edit(CLI::App& program);
CommandAction add_submit(CLI::App& program);
CommandAction add_status(CLI::App& program);
CommandAction add_completion(CLI::App& program);
/// Adds `crowdface manual`, which prints the manual page (for `man`).
CommandAction add_manual(CLI::App& program);

}  // namespace crowdface::cli
