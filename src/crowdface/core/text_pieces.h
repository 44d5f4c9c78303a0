// SPDX-License-Identifier: Apache-2.0
// Makes, writes and reads texts in pieces, because the texts of a large crowd may not fit in
// memory.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "crowdface/core/file.h"

namespace crowdface {

/// Receives the next piece of a text.
using TextSink = std::function<void(std::string_view)>;
/// A text as a function that passes the text's pieces to `take`, in order. Every call passes the
/// same text. Objects that the function captures by reference must outlive it.
using TextPieces = std::function<void(const TextSink& take)>;

/// Makes a text by concatenating `item(0)` … `item(count − 1)`. Several threads call `item`. A
/// TextPieces is a function: the returned text throws Interrupted if it is called after a signal.
TextPieces text_of_items(std::size_t count, std::function<std::string(std::size_t)> item);

/// Returns the whole text as one string.
std::string whole_text(const TextPieces& text);
/// Returns the size and the hash of the text.
FileDigest digest_of(const TextPieces& text);
/// Writes the whole text to a file atomically, like the function `write_file` for a text in memory
/// (core/file.h). \return size and hash of the file.
FileDigest write_file(const std::filesystem::path& path, const TextPieces& text);

/// Reads a file in pieces, from start to end. \throws MissingInput, IoError like read_file.
void read_pieces(const std::filesystem::path& path, const TextSink& take);
/// Calls `use` for each line, without its '\n'.
/// \param use  `has_line_end` is false for a last line that lacks its '\n'.
void read_lines(const std::filesystem::path& path,
                const std::function<void(std::string_view line, bool has_line_end)>& use);

}  // namespace crowdface
