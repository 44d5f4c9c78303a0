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

/// The complete content of a file to be written, as a list of byte ranges. Data that many files
/// share (texture coordinates, polygons) is referenced in place; memory is allocated only for the
/// data of this file.
class EncodedFile {
 public:
  EncodedFile() = default;
  /// Creates a file whose content is `text`.
  EncodedFile(std::string text) { add(std::move(text)); }  // NOLINT(*-explicit-*)
  /// Appends bytes without copying them. The bytes must outlive this object.
  void add_without_copy(std::string_view bytes);
  /// Appends a text, which this object then owns.
  void add(std::string text);
  /// Keeps `owner` alive as long as this object. `owner` is an object that holds bytes appended
  /// with `add_without_copy`.
  void share_ownership(std::shared_ptr<const void> owner);
  /// Allocates `capacity` uninitialised bytes. The caller fills these bytes and appends ranges of
  /// them with `add_without_copy`.
  char* reserve(std::size_t capacity);

  /// Finds the lines that begin with `word` and a blank. Puts `line` in place of the first of these
  /// lines, and removes the others.
  /// \return whether a line was replaced.
  bool replace_line(std::string_view word, std::string_view line);

  std::uint64_t size() const { return size_; }  ///< length of the content in bytes
  /// Number of bytes that this object owns; referenced bytes do not count.
  std::size_t memory_bytes() const { return memory_bytes_; }
  /// The hash of the whole content, as `hash_bytes` computes it.
  Digest digest() const;
  /// All byte ranges in order, for `write_files`.
  const std::vector<std::string_view>& pieces() const { return pieces_; }
  /// The whole content as one string.
  std::string text() const;
  /// Writes the file.
  /// \throws CannotCreate, IoError. After an exception, the file at `path` is unchanged (see
  /// `write_file`).
  void write(const std::filesystem::path& path) const;

 private:
  std::vector<std::shared_ptr<const void>> owners_;  ///< owners of the bytes in `pieces_`
  std::vector<std::string_view> pieces_;             ///< the content: byte ranges in order
  std::uint64_t size_ = 0;                           ///< length of the content in bytes
  std::size_t memory_bytes_ = 0;                     ///< number of bytes that this object owns
};

}  // namespace crowdface
