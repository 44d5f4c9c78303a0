// SPDX-License-Identifier: Apache-2.0
#include "cli/head_files.h"

#include <utility>

#include "crowdface/core/file.h"
#include "crowdface/core/interrupt.h"
#include "crowdface/core/output_file.h"
#include "crowdface/core/problems.h"
#include "crowdface/core/progress.h"
#include "crowdface/core/text.h"

namespace crowdface::cli {

HeadFile text_file(const std::filesystem::path& path, std::string text) {
  return {path, [text = std::move(text)] { return text; }};
}

void write_head_files(const std::string& what, const std::vector<HeadFile>& files, bool replace) {
  Progress progress(what, files.size());
  Problems problems;
  std::vector<const HeadFile*> missing;
  for (const HeadFile& file : files) {
    const bool there = path_exists(file.path);
    if (there) checked_output_path(file.path);
    if (replace || !there) {
      missing.push_back(&file);
      continue;
    }
    throw_if_interrupted();
    const EncodedFile made = file.make();
    if (!has_content(file.path, {made.size(), made.digest()})) {
      problems.add(ExitCode::kUsage,
                   concat(file.path.string(),
                          ": already exists with other contents; use --force to replace it"));
    }
    progress.step();
  }
  problems.throw_if_any();
  for (const HeadFile* file : missing) {
    throw_if_interrupted();
    make_directories(file->path.parent_path());
    file->make().write(file->path);
    progress.step();
  }
}

std::string format_tags(const std::vector<TaggedHead>& heads, std::string_view title) {
  std::string out = concat("# ", title, ". crowdface reads this file beside the heads.\n",
                           "faces:\n  tags:", heads.empty() ? " {}\n" : "\n");
  for (const TaggedHead& head : heads) {
    out += concat("    ", head.name, ": [", head.is_male ? "male" : "female", ", ",
                  age_class(head.age_years), head.extra_tags.empty() ? "" : ", ", head.extra_tags,
                  "]\n");
  }
  if (!heads.empty()) out += "  ages:  # years\n";
  for (const TaggedHead& head : heads) {
    out += concat("    ", head.name, ": ", format_fixed(head.age_years, 0), '\n');
  }
  return out;
}

std::string head_name(std::string_view kind, std::uint64_t index) {
  return concat(kind, "_", zero_padded(index, 2));
}

}  // namespace crowdface::cli
