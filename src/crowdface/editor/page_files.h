// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace crowdface {

/// A file of the page and its type.
struct PageFile {
  std::string bytes;
  std::string type;
};

/// A file of the editor's page by its name in the address; the empty name is the page itself. Where the
/// page was not built a notice stands in its place.
std::optional<PageFile> page_file(std::string_view name);

}  // namespace crowdface
