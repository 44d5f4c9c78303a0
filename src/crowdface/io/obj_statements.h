// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string_view>

namespace crowdface {

inline constexpr std::string_view kObjBlanks = " \t\r";

/// Whether the word is a statement with which a line of an OBJ file may begin, such as "usemtl".
bool is_obj_statement(std::string_view word);
std::string_view first_obj_word(std::string_view line);
/// Returns the line that begins at `at`, and advances `at` to the start of the next line.
std::string_view next_obj_line(std::string_view text, std::size_t& at);
/// Whether a line (without its line end) continues in the next line. A line whose last name ends in
/// '\' does not continue; in this case the next line begins with a statement.
bool is_continued(std::string_view text, std::string_view line);

}  // namespace crowdface
