// SPDX-License-Identifier: Apache-2.0
#include "crowdface/page/page_files.h"

#include <utility>

#include "crowdface/core/file.h"
#include "crowdface/core/text.h"

namespace crowdface {
namespace {

constexpr std::string_view kLicense = "three.LICENSE.txt";
constexpr std::string_view kNotice =
    "<!doctype html><title>crowdface</title><p>This page is not built here: run "
    "scripts/build_gallery.sh, then start crowdface again.";

std::string_view type_of(std::string_view name) {
  if (name.ends_with(".html")) return "text/html; charset=utf-8";
  if (name.ends_with(".js")) return "text/javascript; charset=utf-8";
  if (name.ends_with(".css")) return "text/css; charset=utf-8";
  return "text/plain; charset=utf-8";
}

}  // namespace

PageFiles::PageFiles(std::optional<std::filesystem::path> folder, std::string page)
    : folder_(std::move(folder)), page_(std::move(page)) {}

std::optional<PageFile> PageFiles::file(std::string_view name) const {
  const std::string html = concat(page_, ".html");
  if (name.empty()) name = html;
  if (name != html && name != concat(page_, ".js") && name != concat(page_, ".css") &&
      name != kLicense) {
    return std::nullopt;
  }
  if (!folder_ || !is_there(*folder_ / name)) {
    if (name != html) return std::nullopt;
    return PageFile{std::string(kNotice), std::string(type_of(name))};
  }
  return PageFile{read_file(*folder_ / name), std::string(type_of(name))};
}

}  // namespace crowdface
