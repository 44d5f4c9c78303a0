// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string_view>

namespace crowdface {

/// The characters that separate the words of a line.
inline constexpr std::string_view kObjBlanks = " \t\r";

/// Whether the word is a statement with which a line of an OBJ file may begin, such as "usemtl".
bool is_obj_statement(std::string_view word);
/// Returns the first word of a line; empty if the line is blank.
std::string_view first_obj_word(std::string_view line);
/// Returns the line that begins at `at`, and advances `at` to the start of the next line.
std::string_view next_obj_line(std::string_view text, std::size_t& at);
/// Whether the '\' at the end of a line means that the statement continues in the next line. In
/// lines that end with a name, such as `usemtl`, the '\' may be the last character of the name. The
/// '\' counts as part of the name if the next line begins with a statement, is a comment or is
/// blank.
/// \param line  a line of `text`, without its line end
bool is_continued(std::string_view text, std::string_view line);

}  // namespace crowdface
