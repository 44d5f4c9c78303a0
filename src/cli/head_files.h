// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "crowdface/config/head_tags.h"
#include "crowdface/io/encoded_file.h"

namespace crowdface::cli {

/// largest number of heads that one command makes
inline constexpr std::uint64_t kMaxGeneratedHeads = 1000;
/// Width and height, in pixels, of the region masks that commands make.
inline constexpr int kMaskSize = 1024;
/// smallest and largest accepted size of a texture: its width and height in pixels
inline constexpr std::uint64_t kMinTexturePx = 64, kMaxTexturePx = 8192;

/// A file to write into a folder of heads. The content depends only on the command line.
struct HeadFile {
  std::filesystem::path path;
  std::function<EncodedFile()> make;  ///< function that returns the content of the file
};

/// A file with the content `text`.
HeadFile text_file(const std::filesystem::path& path, std::string text);

/// Writes the missing files and creates their folders. Before writing, compares each existing file
/// with the content that this function would write. An interrupted command can therefore continue,
/// and files that the user edited are not lost.
/// \param what     what the files are, for progress messages, such as "synthetic heads".
/// \param replace  whether to overwrite existing files without comparing them.
/// \throws UsageError, before writing, with the name of every file that has other content;
/// CannotCreate if an existing path is not a regular file; IoError.
void write_head_files(const std::string& what, const std::vector<HeadFile>& files, bool replace);

/// The tags and age of a generated head, for the config's `faces.tags` and `faces.ages`.
struct TaggedHead {
  std::string name;
  bool is_male = false;
  double age_years = 0;
  /// Tags in addition to sex and age, separated by ", "; may be empty.
  std::string extra_tags = {};
};

/// Returns YAML text with the section `faces`, which contains only tags, such as [female, old], and
/// ages.
/// \param title  first line of the comment at the top, without "# ": a description of the heads.
std::string format_tags(const std::vector<TaggedHead>& heads, std::string_view title);

/// Returns the name of a head, such as "synth_01"; the number has at least two digits.
std::string head_name(std::string_view kind, std::uint64_t index);

}  // namespace crowdface::cli
