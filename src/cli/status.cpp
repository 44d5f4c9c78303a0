// SPDX-License-Identifier: Apache-2.0
#include <chrono>
#include <iostream>
#include <thread>

#include <unistd.h>

#include "crowdface/core/error.h"
#include "crowdface/core/interrupt.h"
#include "crowdface/core/text.h"
#include "crowdface/crowd/crowd_status.h"
#include "crowdface/crowd/status_text.h"

#include "cli/commands.h"
#include "cli/common_options.h"

namespace crowdface::cli {
namespace {

struct StatusOptions : CommonOptions {
  std::string directory;
  bool json = false;
  bool watch = false;
  std::string every = "5";
};

void declare_status(CLI::App& command, StatusOptions& options) {
  add_option(command, "directory", options.directory, "CROWD_DIR", "The crowd's folder").required();
  add_flag(command, "--json", options.json, "Print one JSON object on one line");
  add_flag(command, "--watch", options.watch, "Repeat until the crowd is finished");
  add_option(command, "--every", options.every, "SECONDS", "Seconds between two outputs")
      .needs("--watch");
}

void wait(std::uint64_t seconds) {
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::seconds(seconds);
  while (Clock::now() < end) {
    throw_if_interrupted();
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
}

void show(const StatusOptions& options) {
  constexpr std::uint64_t kMaxSeconds = 86'400;
  const std::uint64_t every = parse_whole_number("--every", options.every, 1, kMaxSeconds);
  const bool renew = options.watch && !options.json && ::isatty(STDOUT_FILENO) == 1;
  for (;;) {
    const CrowdStatus status = crowd_status(options.directory);
    if (renew) std::cout << "\033[H\033[2J";
    print(options.json ? format_status_json(status) : format_status_table(status));
    if (!std::cout.flush()) throw IoError("standard output: writing failed");
    if (!options.watch || status.is_report_written) return;
    wait(every);
  }
}

}  // namespace

CommandAction add_status(CLI::App& program) {
  return add_command(program, "status",
                     "Show the progress of a crowd that this or other machines are making",
                     declare_status, show);
}

}  // namespace crowdface::cli
