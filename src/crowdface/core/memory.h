// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
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

/// Has the system lay pages behind memory that is about to be written for the first time. All at once that takes a third to
/// two thirds of the time that it takes page by page. Where the system knows no such thing it stays as it is.
void lay_pages(void* memory, std::size_t bytes);

/// From now on `memory_ran_out` knows of every `new` that failed, whoever called it: libraries catch
/// what it throws and go on with less than they should have made. For programs, at their start.
void watch_for_lack_of_memory();
bool memory_ran_out();

/// "4 GiB", "512 MiB", "3 GB" as bytes; nothing if it is no such size.
std::optional<std::uint64_t> parse_bytes(std::string_view text);

/// "3.2 GiB", "47 MiB".
std::string format_bytes(std::uint64_t bytes);

}  // namespace crowdface
