// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace crowdface {

/// Bytes of memory that this process may use: the machine's, or its control group's if that is less.
std::uint64_t machine_memory();

/// The most memory this process has held so far, in bytes.
std::uint64_t peak_memory();

/// From now on blocks of a megabyte or more go back to the system when they are freed. Else a long run
/// grows from face to face: what is large and short-lived shares the heap with what is small and
/// stays, and leaves holes that no later block fits in. For programs, at their start.
void give_back_large_blocks();

/// From now on `memory_ran_out` knows of every `new` that failed, whoever called it: libraries catch
/// what it throws and go on with less than they should have made. For programs, at their start.
void watch_for_lack_of_memory();
bool memory_ran_out();

/// "4 GiB", "512 MiB", "3 GB" as bytes; nothing if it is no such size.
std::optional<std::uint64_t> parse_bytes(std::string_view text);

/// "3.2 GiB", "47 MiB".
std::string format_bytes(std::uint64_t bytes);

}  // namespace crowdface
