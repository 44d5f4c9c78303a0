// SPDX-License-Identifier: Apache-2.0
#include "cli/open_browser.h"

#include <cstdlib>
#include <iostream>

#include <spawn.h>
#include <unistd.h>

#include "crowdface/core/text.h"

#include "cli/common_options.h"

namespace crowdface::cli {

void show_page(const std::string& address, Browser browser) {
  print(concat(address, '\n'));
  std::cout.flush();
  if (browser == Browser::kNone) return;
  // NOLINTNEXTLINE(concurrency-mt-unsafe): nothing here sets a variable
  if (std::getenv("DISPLAY") == nullptr && std::getenv("WAYLAND_DISPLAY") == nullptr) return;
  std::string program = "xdg-open", argument = address;
  char* const arguments[] = {program.data(), argument.data(), nullptr};
  pid_t process = 0;
  ::posix_spawnp(&process, program.c_str(), nullptr, nullptr, arguments, environ);
}

}  // namespace crowdface::cli
