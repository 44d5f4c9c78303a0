// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace crowdface {

/// Bytes of memory that this process may use: the machine's, or the least limit of its control groups (version 2,
/// or the controller `memory` of version 1) and of all groups that these lie in, if that is less.
std::uint64_t machine_memory();
/// The least of those limits; nothing if there is none.
/// \param groups  the file that names the groups of the process. \param root  where the groups are mounted.
std::optional<std::uint64_t> memory_limit_of_groups(
    const std::filesystem::path& groups = "/proc/self/cgroup",
    const std::filesystem::path& root = "/sys/fs/cgroup");

/// The most memory this process has held so far, in bytes.
std::uint64_t peak_memory();

/// From now on `memory_ran_out` knows of every `new` that failed, whoever called it: libraries catch
/// what it throws and go on with less than they should have made. For programs, at their start.
void watch_for_lack_of_memory();
bool memory_ran_out();

/// "4 GiB", "512 MiB", "3 GB" as bytes; nothing if it is no such size.
std::optional<std::uint64_t> parse_bytes(std::string_view text);

/// "3.2 GiB", "47 MiB", "98 KiB", "512 bytes".
std::string format_bytes(std::uint64_t bytes);

}  // namespace crowdface
