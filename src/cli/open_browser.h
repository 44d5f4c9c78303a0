// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace crowdface::cli {

enum class Browser { kOpen, kNone };

/// Prints the address of a page that is served now, and opens the browser where there is a screen to show it
/// on; whether that worked the user sees.
void show_page(const std::string& address, Browser browser);

}  // namespace crowdface::cli
