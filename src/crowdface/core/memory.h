// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace crowdface {

/// Bytes of memory that this process may use: the machine's physical memory or the limit of the
/// process's control groups, whichever is less.
std::uint64_t usable_memory_bytes();
/// The smallest memory limit, in bytes, among the control groups of this process and all parents of
/// these groups (version 2, or the controller `memory` of version 1); nothing if there is no limit.
/// \param groups_file  the file that names the control groups of the process.
/// \param mount_folder  where the control groups are mounted.
std::optional<std::uint64_t> control_group_memory_limit_bytes(
    const std::filesystem::path& groups_file = "/proc/self/cgroup",
    const std::filesystem::path& mount_folder = "/sys/fs/cgroup");

/// Peak resident memory of this process so far, in bytes.
std::uint64_t peak_memory_bytes();

/// After this call, `is_out_of_memory` tells whether any `new` has failed. Libraries may catch
/// std::bad_alloc and continue with incomplete results, so the program has to ask. Call this
/// function at program start.
void watch_for_out_of_memory();
/// Whether a `new` has failed since the call of watch_for_out_of_memory.
bool is_out_of_memory();

/// Parses "4 GiB", "512 MiB" or "3 GB" as bytes; nothing if the text is not a size with a unit.
std::optional<std::uint64_t> parse_bytes(std::string_view text);

/// Formats a number of bytes as "3.2 GiB", "47 MiB", "98 KiB" or "512 bytes".
std::string format_bytes(std::uint64_t bytes);

}  // namespace crowdface
