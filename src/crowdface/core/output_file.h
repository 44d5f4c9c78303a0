// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

namespace crowdface {

/// The file that a user's path names, to be called before the work whose result goes there: links
/// are followed, so that the file they lead to is replaced, not the link.
/// \throws CannotCreate unless its folder is there and may be written to, and nothing but a regular
/// file bears its name: no folder, no device, no pipe, no link that leads nowhere.
std::filesystem::path output_file(const std::filesystem::path& path);

/// \throws UsageError if an output is one of the inputs, under whatever name.
void refuse_to_write_over(const std::vector<std::filesystem::path>& inputs,
                          const std::vector<std::filesystem::path>& outputs);

}  // namespace crowdface
