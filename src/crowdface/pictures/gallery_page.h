// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>

#include "crowdface/config/config.h"
#include "crowdface/core/hash.h"

namespace crowdface {

/// The folder of the built or installed web pages: the environment variable CROWDFACE_GALLERY if
/// set, otherwise share/crowdface/gallery beside the program's bin folder. Nothing if the path of
/// the program is unknown.
std::optional<std::filesystem::path> gallery_page_folder();

/// Returns gallery_page_folder(); nothing if there is no such folder or if the folder does not
/// contain the gallery's page.
std::optional<std::filesystem::path> find_gallery_page();

/// Whether a crowd with this config gets a gallery: the config has contact sheets and does not turn
/// the gallery off, and `find_gallery_page` finds the page.
bool has_gallery(const Config& config);

/// The hash of the gallery page that a crowd with this config gets; the hash of no data if the
/// crowd gets no page.
Digest gallery_page_digest(const Config& config);

}  // namespace crowdface
