// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "crowdface/core/hash.h"

namespace crowdface {

/// All the bytes of a file that is not written yet, in pieces. What a face shares with every other
/// (texture coordinates, faces) is referred to where it lies; only the rest is memory of its own.
class EncodedFile {
 public:
  EncodedFile() = default;
  /// A file that holds just this.
  EncodedFile(std::string_view text) { add(text); }  // NOLINT(*-explicit-*)
  EncodedFile(const std::string& text)
      : EncodedFile(std::string_view(text)) {}  // NOLINT(*-explicit-*)
  /// Adds bytes that lie elsewhere and must stay there until this object is done with.
  void refer_to(std::string_view bytes);
  /// Adds a copy of these bytes.
  void add(std::string_view text);
  /// Takes `capacity` bytes of memory, not initialised, for pieces that refer_to is told of.
  char* reserve(std::size_t capacity);

  /// Puts a line in the place of the first that begins with this word and a blank, and leaves out further
  /// ones. \return whether there was any.
  bool replace_line(std::string_view word, std::string_view line);

  std::uint64_t size() const { return size_; }
  /// hash_bytes of the whole.
  Digest digest() const;
  /// The whole as one text.
  std::string text() const;
  /// \throws CannotCreate, IoError; then there is no such file (see write_file).
  void write(const std::filesystem::path& path) const;

 private:
  std::vector<std::unique_ptr<char[]>> memory_;
  std::vector<std::string_view> pieces_;
  std::uint64_t size_ = 0;
};

}  // namespace crowdface
