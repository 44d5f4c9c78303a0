// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "crowdface/pick/pick_scans.h"

namespace crowdface {

struct PickOptions {
  std::optional<std::filesystem::path> pages;  ///< the folder of built pages
  int port = 0;                                ///< 0: any that is free
  std::size_t most_triangles = 100'000;        ///< of each mesh on the page
};

/// Serves the page on which landmarks are picked until a signal asks to end.
/// \param started  is given the address once the page can be opened
/// \throws Error
void pick_landmarks(PickScans& scans, const PickOptions& options,
                    const std::function<void(const std::string&)>& started);

}  // namespace crowdface
