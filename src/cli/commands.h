// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "cli/command_line.h"

namespace crowdface::cli {

/// Executes a command, after the command line has been parsed.
using Run = std::function<void()>;

/// Each of these functions adds one subcommand to the program, and returns the function that
/// executes this subcommand.
Run add_generate(CLI::App& program);
Run add_prepare(CLI::App& program);
Run add_plan(CLI::App& program);
Run add_blend(CLI::App& program);
Run add_smooth(CLI::App& program);
Run add_gather(CLI::App& program);
Run add_verify(CLI::App& program);
Run add_sheet(CLI::App& program);
Run add_synth(CLI::App& program);
Run add_import(CLI::App& program);
Run add_check(CLI::App& program);
Run add_convert(CLI::App& program);
Run add_init(CLI::App& program);
Run add_mask(CLI::App& program);
Run add_cache(CLI::App& program);
Run add_wrap(CLI::App& program);
Run add_edit(CLI::App& program);
Run add_submit(CLI::App& program);
Run add_status(CLI::App& program);
Run add_completion(CLI::App& program);
Run add_manual(CLI::App& program);

}  // namespace crowdface::cli
