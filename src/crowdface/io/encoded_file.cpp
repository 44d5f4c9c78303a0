// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/encoded_file.h"

#include <algorithm>
#include <utility>

#include "crowdface/core/file.h"

namespace crowdface {

void EncodedFile::add_without_copy(std::string_view bytes) {
  if (bytes.empty()) return;
  pieces_.push_back(bytes);
  size_ += bytes.size();
}

void EncodedFile::add(std::string text) {
  const auto owner = std::make_shared<const std::string>(std::move(text));
  share_ownership(owner);
  memory_bytes_ += owner->size();
  add_without_copy(*owner);
}

void EncodedFile::share_ownership(std::shared_ptr<const void> owner) {
  owners_.push_back(std::move(owner));
}

char* EncodedFile::reserve(std::size_t capacity) {
  const auto memory = std::make_shared_for_overwrite<char[]>(capacity);
  share_ownership(memory);
  memory_bytes_ += capacity;
  return memory.get();
}

bool EncodedFile::replace_line(std::string_view word, std::string_view line) {
  const std::vector<std::string_view> old = std::move(pieces_);
  pieces_.clear();
  size_ = 0;
  bool found = false;
  for (const std::string_view piece : old) {
    std::size_t kept = 0;
    for (std::size_t at = piece.find(word); at != piece.npos; at = piece.find(word, at + 1)) {
      const std::size_t before = piece.substr(0, at).find_last_not_of(" \t");
      // The first piece begins at the start of a line; other pieces may begin within a line.
      const bool begins =
          before == piece.npos ? piece.data() == old.front().data() : piece[before] == '\n';
      const std::size_t after = at + word.size();
      if (!begins || after >= piece.size() || (piece[after] != ' ' && piece[after] != '\t'))
        continue;
      add_without_copy(piece.substr(kept, at - kept));
      if (!found) add(std::string(line));
      found = true;
      kept = std::min(piece.find_first_of("\r\n", after), piece.size());
    }
    add_without_copy(piece.substr(kept));
  }
  return found;
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
