// SPDX-License-Identifier: Apache-2.0
#include "crowdface/editor/page_files.h"

#include <algorithm>
#include <array>

#include "crowdface/core/file.h"
#include "crowdface/pictures/gallery.h"

namespace crowdface {
namespace {

struct Known {
  std::string_view name, type;
};
constexpr std::array<Known, 4> kFiles = {{{"editor.html", "text/html; charset=utf-8"},
                                          {"editor.js", "text/javascript; charset=utf-8"},
                                          {"editor.css", "text/css; charset=utf-8"},
                                          {"three.LICENSE.txt", "text/plain; charset=utf-8"}}};

constexpr std::string_view kNotice =
    "<!doctype html><title>crowdface</title><p>The editor's page is not built here: run "
    "scripts/build_gallery.sh, then start crowdface edit again.";

}  // namespace

std::optional<PageFile> page_file(std::string_view name) {
  if (name.empty()) name = kFiles.front().name;
  const auto known = std::find_if(kFiles.begin(), kFiles.end(),
                                  [&](const Known& file) { return file.name == name; });
  if (known == kFiles.end()) return std::nullopt;
  std::error_code ignored;
  const auto folder = gallery_page_folder();
  if (!folder || !std::filesystem::exists(*folder / name, ignored)) {
    if (known != kFiles.begin()) return std::nullopt;
    return PageFile{std::string(kNotice), std::string(known->type)};
  }
  return PageFile{read_file(*folder / name), std::string(known->type)};
}

}  // namespace crowdface
