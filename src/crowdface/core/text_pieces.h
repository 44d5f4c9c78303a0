// SPDX-License-Identifier: Apache-2.0
// Texts that are made, written and read piece by piece: those of a large crowd need not be in memory.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "crowdface/core/file.h"

namespace crowdface {

using TakePiece = std::function<void(std::string_view)>;
/// A text: gives its pieces one after the other, the same text each time. What it is made of must
/// outlive it.
using TextPieces = std::function<void(const TakePiece& take)>;

/// The texts of items 0 … count − 1 one after the other, made by several threads. \throws Interrupted
/// where they are taken.
TextPieces text_of_items(std::size_t count, std::function<std::string(std::size_t)> item);

std::string joined(const TextPieces& text);
/// What a file of it holds.
FileDigest digest_of(const TextPieces& text);
/// Like `write_file` of the whole. \return what the file holds.
FileDigest write_file(const std::filesystem::path& path, const TextPieces& text);

/// Reads a file from its beginning to its end. \throws MissingInput, IoError like read_file.
void read_pieces(const std::filesystem::path& path, const TakePiece& take);
/// Calls `use` with each line, without its end, and whether it had one: a last one may not.
void read_lines(const std::filesystem::path& path,
                const std::function<void(std::string_view line, bool ended)>& use);

}  // namespace crowdface
