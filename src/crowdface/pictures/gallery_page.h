// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>

#include "crowdface/config/config.h"
#include "crowdface/core/hash.h"

namespace crowdface {

/// Where pages lie once they are built or installed: share/crowdface/gallery beside the program's bin;
/// the environment's CROWDFACE_GALLERY, if set, instead. Nothing if that cannot be told.
std::optional<std::filesystem::path> gallery_page_folder();

/// The same folder if it holds the gallery's page, or nothing.
std::optional<std::filesystem::path> find_gallery_page();

/// Whether a crowd of this config gets a gallery here.
bool has_gallery(const Config& config);

/// The hash of the page that a crowd of this config gets; of nothing, if it gets none.
Digest gallery_page_digest(const Config& config);

}  // namespace crowdface
