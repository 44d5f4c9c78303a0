// SPDX-License-Identifier: Apache-2.0
// Starts the program itself, as a user would.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <sys/types.h>

namespace crowdface::testing {

struct Outcome {
  int code = -1;    ///< exit code; −signal if a signal ended it
  std::string out;  ///< standard output
  std::string err;  ///< standard error
};

/// Runs `program` with these arguments to its end, working directory /.
/// \param meanwhile  called once it has been started, with its process id.
Outcome run_program(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                    const std::function<void(pid_t)>& meanwhile = {});

}  // namespace crowdface::testing
