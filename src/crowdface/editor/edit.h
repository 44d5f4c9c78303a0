// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "crowdface/config/config_reader.h"
#include "crowdface/heads/cache_folder.h"

namespace crowdface {

struct EditOptions {
  CacheFolder cache;  ///< of prepared heads
  int port = 0;       ///< 0: any that is free
  std::size_t preview_vertices = 50'000;
  std::vector<std::string> generate_arguments =
      {};  ///< further ones of the run that makes the crowd
};

/// Serves the editor of a crowd until a signal asks to end.
/// \param given    a config, or the folder of a crowd
/// \param started  is given the address once the page can be opened
/// \throws Error
void edit(const std::filesystem::path& given, const ConfigOverrides& overrides,
          const EditOptions& options, const std::function<void(const std::string&)>& started);

/// Serves nothing and writes nothing: how long an editor of that job takes for what a page asks when the
/// mouse is let go, the full face after a controller, the smoothness or the target has changed, as a table
/// beside the paper's frame.
std::string benchmark_edit(const std::filesystem::path& given, const ConfigOverrides& overrides,
                           const EditOptions& options);

}  // namespace crowdface
