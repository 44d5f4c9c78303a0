// SPDX-License-Identifier: Apache-2.0
// Patterns of `faces.files`, compared with the C library's.
#include <algorithm>
#include <cstdlib>
#include <string>
#include <vector>

#include <fnmatch.h>

#include "crowdface/config/input_files.h"
#include "crowdface/core/error.h"

#include "fuzz/input_file.h"
#include "fuzz/job_folder.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const crowdface::fuzz::JobFolder folder("pattern");
  static const std::vector<std::filesystem::path> files = {
      folder.write("review.yaml", ""), folder.write("heads/ann.obj", ""),
      folder.write("heads/a-b.c.obj", ""), folder.write("heads/.hidden.obj", "")};
  const std::string text(crowdface::fuzz::text_of(data, size));
  // The C library gives more characters a meaning, and a path's parts may be named in several ways.
  if (text.find_first_of(std::string("[\\\0", 3)) != text.npos) return 0;
  if (text.find("//") != text.npos) return 0;
  for (const auto& part : std::filesystem::path(text)) {
    if (part.empty() || part == "/" || part == "." || part == "..") return 0;
  }
  const auto pattern = files[0].parent_path() / text;
  try {
    const auto found = crowdface::files_matching(pattern);
    for (const auto& file : files) {
      const bool expected =
          ::fnmatch(pattern.c_str(), file.c_str(), FNM_PATHNAME | FNM_PERIOD) == 0;
      if ((std::ranges::count(found, file) == 1) != expected) std::abort();
    }
    crowdface::names_of_heads(found);
  } catch (const crowdface::Error&) {
  }
  return 0;
}
