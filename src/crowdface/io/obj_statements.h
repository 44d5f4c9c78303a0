// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string_view>

namespace crowdface {

inline constexpr std::string_view kObjBlanks = " \t\r";

/// Whether lines of OBJ files may begin with the word: "usemtl".
bool is_obj_statement(std::string_view word);
std::string_view first_obj_word(std::string_view line);
/// The line that begins at a place of the text, which becomes that of the next one.
std::string_view next_obj_line(std::string_view text, std::size_t& at);
/// Whether a line of the text, without its end, goes on in the next one. A name may end in '\' too: then the next line
/// is a statement.
bool is_continued(std::string_view text, std::string_view line);

}  // namespace crowdface
