// SPDX-License-Identifier: Apache-2.0
// What reads of file.h and text_pieces.h.
#include <algorithm>

#include "crowdface/core/descriptor.h"
#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/opened_file.h"
#include "crowdface/core/text.h"
#include "crowdface/core/text_pieces.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;

/// \return 0 at the end of the file.
std::size_t read_some(const Descriptor& descriptor, char* to, std::size_t size,
                      const fs::path& path) {
  for (;;) {
    const ssize_t got = ::read(descriptor.get(), to, size);
    if (got >= 0) return static_cast<std::size_t>(got);
    if (errno != EINTR) throw IoError(concat(path.string(), ": reading failed: ", reason()));
  }
}

}  // namespace

std::string read_file(const fs::path& path) {
  const OpenedFile file = open_for_reading(path);
  std::string bytes(file.size, '\0');
  std::size_t done = 0;
  while (done < bytes.size()) {
    const std::size_t got =
        read_some(file.descriptor, bytes.data() + done, bytes.size() - done, path);
    if (got == 0) break;
    done += got;
  }
  bytes.resize(done);
  return bytes;
}

void read_pieces(const fs::path& path, const TakePiece& take) {
  constexpr std::size_t kPiece = 1U << 20U;
  const OpenedFile file = open_for_reading(path);
  std::string piece(std::min(kPiece, file.size + 1), '\0');
  while (const std::size_t got = read_some(file.descriptor, piece.data(), piece.size(), path)) {
    take({piece.data(), got});
  }
}

FileDigest hash_file(const fs::path& path) {
  return digest_of([&](const TakePiece& take) { read_pieces(path, take); });
}

bool holds(const std::filesystem::path& path, const FileDigest& content) {
  std::error_code error;
  if (std::filesystem::file_size(path, error) != content.bytes || error) return false;
  try {
    return hash_file(path) == content;
  } catch (const Error&) {
    return false;
  }
}

}  // namespace crowdface
