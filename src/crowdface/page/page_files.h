// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace crowdface {

struct PageFile {
  std::string bytes;
  std::string type;
};

/// The files of one page that the program serves, NAME.html, NAME.js and NAME.css, as
/// scripts/build_gallery.sh writes them.
class PageFiles {
 public:
  /// \param folder  where pages lie, or nothing
  /// \param page    "editor"
  PageFiles(std::optional<std::filesystem::path> folder, std::string page);

  /// A file by its name in the address; the empty name is the page itself. Where the page was not built a
  /// notice stands in its place.
  std::optional<PageFile> file(std::string_view name) const;

 private:
  std::optional<std::filesystem::path> folder_;
  std::string page_;
};

}  // namespace crowdface
