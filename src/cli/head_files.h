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

inline constexpr std::uint64_t kMaxGeneratedHeads =
    1000;                               ///< largest number of heads that one command makes
inline constexpr int kMaskSize = 1024;  ///< width and height of masks in pixels
inline constexpr std::uint64_t kMinTexturePx = 64,
                               kMaxTexturePx = 8192;  ///< width and height of textures in pixels

/// A file in a folder of heads. Its content depends only on the command line.
struct HeadFile {
  std::filesystem::path path;
  std::function<EncodedFile()> make;
};

HeadFile text_file(const std::filesystem::path& path, std::string text);

/// Writes the missing files and their folders. First compares the existing files with their
/// intended content. An interrupted command can thus continue, and edited files are not lost.
/// \param what     for progress messages, such as "synthetic heads".
/// \param replace  whether to overwrite all files without comparing.
/// \throws UsageError, before writing, with the name of every file that has other content;
/// CannotCreate if an existing path is not a regular file; IoError.
void write_head_files(const std::string& what, const std::vector<HeadFile>& files, bool replace);

/// The tags of a generated head, for the config's `faces.tags`.
struct TaggedHead {
  std::string name;
  bool male = false;
  double years = 0;
  std::string extra_tags = {};  ///< further tags, separated by ", "; may be empty
};

/// Returns "young" below 35 years, "adult" from 35 to below 55 years, and "old" from 55 years on.
std::string_view age_class(double years);

/// Returns YAML with the section `faces`, which contains only tags ([female, old]). The ages are
/// comments in this YAML.
/// \param title  first line of the comment at the top, without "# ": a description of the heads.
std::string format_tags(const std::vector<TaggedHead>& heads, std::string_view title);

/// Returns a name with at least two digits: "synth_01".
std::string head_name(std::string_view kind, std::uint64_t index);

}  // namespace crowdface::cli
