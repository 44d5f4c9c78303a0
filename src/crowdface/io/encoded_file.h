// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "crowdface/core/hash.h"

namespace crowdface {

/// All the bytes of a file that is not written yet, in pieces. What a face shares with every other
/// (texture coordinates, faces) is referred to where it lies; only the rest is memory of its own.
class EncodedFile {
 public:
  EncodedFile() = default;
  /// A file that holds just this.
  EncodedFile(std::string text) { add(std::move(text)); }  // NOLINT(*-explicit-*)
  /// Adds bytes that lie elsewhere and must stay there until this object is done with.
  void refer_to(std::string_view bytes);
  /// Adds these bytes.
  void add(std::string text);
  /// Keeps what it refers to for as long as it lives.
  void keep(std::shared_ptr<const void> owner);
  /// Takes `capacity` bytes of memory, not initialised, for pieces that refer_to is told of.
  char* reserve(std::size_t capacity);

  /// Puts a line in the place of the first that begins with this word and a blank, and leaves out further
  /// ones. \return whether there was any.
  bool replace_line(std::string_view word, std::string_view line);

  std::uint64_t size() const { return size_; }
  /// Of its own, beside what is referred to.
  std::size_t memory_bytes() const { return memory_bytes_; }
  /// hash_bytes of the whole.
  Digest digest() const;
  /// All of it in order, for `write_files`.
  const std::vector<std::string_view>& pieces() const { return pieces_; }
  /// The whole as one text.
  std::string text() const;
  /// \throws CannotCreate, IoError; then there is no such file (see write_file).
  void write(const std::filesystem::path& path) const;

 private:
  std::vector<std::shared_ptr<const void>> owners_;
  std::vector<std::string_view> pieces_;
  std::uint64_t size_ = 0;
  std::size_t memory_bytes_ = 0;
};

}  // namespace crowdface
