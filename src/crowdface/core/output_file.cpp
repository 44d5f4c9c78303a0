// SPDX-License-Identifier: Apache-2.0
#include "crowdface/core/output_file.h"

#include <map>
#include <optional>
#include <system_error>
#include <utility>

#include <sys/stat.h>
#include <unistd.h>

#include "crowdface/core/error.h"
#include "crowdface/core/file_descriptor.h"
#include "crowdface/core/text.h"

namespace crowdface {

namespace fs = std::filesystem;

namespace {

/// Device and inode number identify a file independently of its path.
using FileId = std::pair<dev_t, ino_t>;

std::optional<FileId> id_of(const fs::path& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) {
    throw_if_system_error(path, {errno, std::generic_category()});
    return std::nullopt;
  }
  return FileId(status.st_dev, status.st_ino);
}

}  // namespace

fs::path checked_output_path(const fs::path& path) {
  const auto refuse = [&](std::string_view what) {
    throw CannotCreate(concat(path.empty() ? "\"\"" : path.string(), ": ", what));
  };
  if (!path.has_filename()) refuse("expected the name of a file to write");
  std::error_code error;
  fs::path file = path;
  if (fs::is_symlink(fs::symlink_status(path, error))) {
    file = fs::weakly_canonical(path, error);
    if (error) refuse(concat("cannot be reached: ", error.message()));
  }
  const fs::file_status status = fs::symlink_status(file, error);
  if (!fs::status_known(status)) refuse(concat("cannot be created: ", error.message()));
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    refuse("exists and is not a regular file; choose another name");
  }
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  if (!fs::is_directory(folder, error)) {
    refuse(concat("cannot be created: there is no folder ", folder.string()));
  }
  if (::access(folder.c_str(), W_OK | X_OK) != 0) {
    refuse(concat("cannot be created: the folder ", folder.string(), " is not writable"));
  }
  return file;
}

void refuse_to_write_over(const std::vector<fs::path>& inputs,
                          const std::vector<fs::path>& outputs) {
  std::map<FileId, fs::path> known;
  for (const fs::path& input : inputs) {
    if (const auto id = id_of(input)) known.emplace(*id, input);
  }
  for (const fs::path& output : outputs) {
    const auto id = id_of(output);
    const auto input = id ? known.find(*id) : known.end();
    if (input == known.end()) continue;
    throw UsageError(concat(output.string(), ": is an input (", input->second.string(),
                            ") and must not be overwritten; choose another name"));
  }
}

}  // namespace crowdface
