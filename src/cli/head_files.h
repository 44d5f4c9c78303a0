// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
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

/// What is known of a head that was made, for the config's `faces.tags`.
struct TaggedHead {
  std::string name;
  bool male = false;
  double years = 0;
  std::string more = {};  ///< a further tag, or none
};

/// "young" below 35 years, "old" from 55 on, "adult" between.
std::string_view age_class(double years);

/// The section `faces` with nothing but the heads' tags, [female, old], and the years as comments.
/// \param about  a line on what heads they are, without "# ".
std::string format_tags(const std::vector<TaggedHead>& heads, std::string_view about);

/// "synth_01": at least two digits.
std::string head_name(std::string_view kind, std::uint64_t index);

}  // namespace crowdface::cli
