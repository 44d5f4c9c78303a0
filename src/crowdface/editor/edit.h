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

/// Options of `crowdface edit`.
struct EditOptions {
  CacheFolder cache;  ///< folder that caches prepared heads
  int port = 0;       ///< port of the server; 0: any free port
  /// approximate maximum number of vertices of the mesh that the page shows
  std::size_t preview_vertices = 50'000;
  /// additional arguments for `crowdface generate`
  std::vector<std::string> generate_arguments = {};
};

/// Runs the editor's server for a crowd until a signal stops the process.
/// \param config_or_crowd  a config, or the folder of a crowd
/// \param started          called with the editor's address as soon as the page can be opened
/// \throws Error
void edit(const std::filesystem::path& config_or_crowd, const ConfigOverrides& overrides,
          const EditOptions& options, const std::function<void(const std::string&)>& started);

/// Measures how long the editor takes to rebuild a face after each of four changes: a new position
/// of one region on the plane, new positions of all regions, a new smoothness of one region, and a
/// new target. Starts no server and writes no files. Returns a table of the times. For comparison,
/// the table includes the frame time that the paper on Laplacian face blending reports.
std::string benchmark_edit(const std::filesystem::path& config_or_crowd,
                           const ConfigOverrides& overrides, const EditOptions& options);

}  // namespace crowdface
