// SPDX-License-Identifier: Apache-2.0
#include "crowdface/pictures/gallery_page.h"

#include <cstdlib>
#include <system_error>

#include "crowdface/core/file.h"
#include "crowdface/core/file_descriptor.h"
#include "crowdface/crowd/crowd_directory.h"

namespace crowdface {

namespace fs = std::filesystem;

std::optional<fs::path> gallery_page_folder() {
  // NOLINTNEXTLINE(concurrency-mt-unsafe): no thread sets environment variables
  if (const char* chosen = std::getenv("CROWDFACE_GALLERY"); chosen != nullptr && *chosen != 0) {
    return chosen;
  }
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  throw_if_system_error("/proc/self/exe", error);
  if (error) return std::nullopt;
  return program.parent_path().parent_path() / "share/crowdface/gallery";
}

std::optional<fs::path> find_gallery_page() {
  auto folder = gallery_page_folder();
  if (!folder) return std::nullopt;
  for (const std::string_view file : kGalleryPageFiles) {
    if (!path_exists(*folder / file)) return std::nullopt;
  }
  return folder;
}

bool has_gallery(const Config& config) {
  return config.output.contact_sheet && config.output.gallery == Gallery::kAuto &&
         find_gallery_page();
}

Digest gallery_page_digest(const Config& config) {
  Hasher hasher;
  const auto page = has_gallery(config) ? find_gallery_page() : std::nullopt;
  for (const std::string_view file : kGalleryPageFiles) {
    if (page) hasher.add(hash_file(*page / file).digest);
  }
  return hasher.digest();
}

}  // namespace crowdface
