// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>

#include "crowdface/config/config.h"
#include "crowdface/core/hash.h"
#include "crowdface/heads/prepared.h"

namespace crowdface {

/// What an entry must hold to be of use.
struct HeadCacheShape {
  Index vertices = 0;
  Index samples = 0;
  Index trajectory_levels = 0;  ///< rows of the trajectory
  Index nodes = 0;              ///< of `levels: basis`
  std::uint64_t max_level = 0;
  Levels levels = Levels::kBasis;
};

/// Reads an entry, whose fields stay in the file, mapped. \return nothing if there is none.
/// \throws InvalidInput if it is damaged, of another version or of another shape.
std::optional<PreparedHead> read_cached_head(const std::filesystem::path& cache, const Digest& key,
                                             const HeadCacheShape& shape);

/// Writes an entry. \throws CannotCreate, IoError.
void write_cached_head(const std::filesystem::path& cache, const Digest& key,
                       const HeadCacheShape& shape, const PreparedHead& head);

}  // namespace crowdface
