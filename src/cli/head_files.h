// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "crowdface/io/encoded_file.h"

namespace crowdface::cli {

inline constexpr std::uint64_t kMostMade = 1000;                         ///< heads of a command
inline constexpr int kMaskSize = 1024;                                   ///< pixels of a side
inline constexpr std::uint64_t kLeastTexture = 64, kMostTexture = 8192;  ///< the same

/// A file of a folder of heads; the command line alone determines what it holds.
struct HeadFile {
  std::filesystem::path path;
  std::function<EncodedFile()> make;
};

HeadFile text_file(const std::filesystem::path& path, std::string text);

/// Writes those that are not there yet, one after the other, with their folders. Those that are there
/// are compared first, so that a command goes on where it was interrupted, and what somebody has
/// changed is not lost.
/// \param what     "synthetic heads", for the progress.
/// \param replace  whether to write them all, whatever is there.
/// \throws UsageError, before anything is written, naming every file that holds something else;
/// CannotCreate if one of them is no regular file; IoError.
void write_head_files(const std::string& what, const std::vector<HeadFile>& files, bool replace);

}  // namespace crowdface::cli
