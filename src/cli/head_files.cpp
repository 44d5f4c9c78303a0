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
    const bool there = is_there(file.path);
    if (there) output_file(file.path);
    if (replace || !there) {
      missing.push_back(&file);
      continue;
    }
    throw_if_interrupted();
    const EncodedFile made = file.make();
    if (!holds(file.path, {made.size(), made.digest()})) {
      problems.add(ExitCode::kUsage,
                   concat(file.path.string(),
                          ": exists already and holds something else; --force replaces it"));
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

}  // namespace crowdface::cli
