// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

namespace crowdface {

/// Checks a path that a user has named for output, before the work starts. Symbolic links are
/// followed, so that their target is replaced and not the link.
/// \return the file to write.
/// \throws CannotCreate if the folder does not exist or is not writable, or if the path exists and
///         is not a regular file (a folder, device or pipe).
std::filesystem::path output_file(const std::filesystem::path& path);

/// Rejects outputs that would overwrite an input.
/// \throws UsageError if an output is the same file as an input, even under another name.
void refuse_to_write_over(const std::vector<std::filesystem::path>& inputs,
                          const std::vector<std::filesystem::path>& outputs);

}  // namespace crowdface
