// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

namespace crowdface {

/// Checks, before the work starts, that the user's output path can be written. Resolves symbolic
/// links, so that writing replaces a link's target and not the link.
/// \return the file to write.
/// \throws CannotCreate if the folder does not exist or is not writable, or if the path exists and
///         is not a regular file (a folder, device or pipe).
std::filesystem::path checked_output_path(const std::filesystem::path& path);

/// Checks that no output would overwrite an input.
/// \throws UsageError if an output is the same file as an input, even under another name.
void refuse_to_write_over(const std::vector<std::filesystem::path>& inputs,
                          const std::vector<std::filesystem::path>& outputs);

}  // namespace crowdface
