// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/encoded_file.h"

#include <cstring>

#include "crowdface/core/file.h"

namespace crowdface {

void EncodedFile::refer_to(std::string_view bytes) {
  if (bytes.empty()) return;
  pieces_.push_back(bytes);
  size_ += bytes.size();
}

void EncodedFile::add(std::string_view text) {
  char* bytes = reserve(text.size());
  std::memcpy(bytes, text.data(), text.size());
  refer_to({bytes, text.size()});
}

char* EncodedFile::reserve(std::size_t capacity) {
  memory_.push_back(std::make_unique_for_overwrite<char[]>(capacity));
  return memory_.back().get();
}

Digest EncodedFile::digest() const {
  Hasher hasher;
  for (const std::string_view piece : pieces_) hasher.add_raw(piece);
  return hasher.digest();
}

std::string EncodedFile::text() const {
  std::string text;
  text.reserve(size_);
  for (const std::string_view piece : pieces_) text += piece;
  return text;
}

void EncodedFile::write(const std::filesystem::path& path) const {
  write_file(path, pieces_);
}

}  // namespace crowdface
