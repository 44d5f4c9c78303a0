// SPDX-License-Identifier: Apache-2.0
#include "crowdface/core/folder.h"

#include <algorithm>
#include <memory>
#include <string_view>
#include <system_error>

#include <dirent.h>
#include <fcntl.h>

#include "crowdface/core/error.h"
#include "crowdface/core/text.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;

struct CloseFolder {
  void operator()(DIR* folder) const { ::closedir(folder); }
};

}  // namespace

std::vector<fs::path> list_folder(const fs::path& folder, std::error_code* error) {
  const std::string name = folder.empty() ? "." : folder.string();
  const std::unique_ptr<DIR, CloseFolder> opened(::opendir(name.c_str()));
  if (!opened) {
    const int why = errno;
    const bool missing = why == ENOENT || why == ENOTDIR || why == ENAMETOOLONG || why == ELOOP;
    const bool told = error != nullptr && (missing || why == EACCES);
    if (told) *error = std::error_code(why, std::generic_category());
    if (told || missing) return {};
  }
  std::vector<fs::path> found;
  if (opened) {
    errno = 0;
    // NOLINTNEXTLINE(concurrency-mt-unsafe): no other thread reads this directory stream
    while (const dirent* entry = ::readdir(opened.get())) {
      const std::string_view each = entry->d_name;
      if (each != "." && each != "..") found.push_back(folder / each);
      errno = 0;
    }
  }
  if (!opened || errno != 0) throw_with_errno<IoError>(name, "cannot be read as a folder");
  std::ranges::sort(found);
  return found;
}

std::vector<fs::path> list_files(const fs::path& folder,
                                 const std::function<bool(const fs::path&)>& is_wanted,
                                 std::error_code* error) {
  std::vector<fs::path> files = list_folder(folder, error);
  std::erase_if(files, [&](const fs::path& path) { return !is_wanted(path); });
  return files;
}

std::vector<fs::path> folder_tree(const fs::path& root) {
  std::vector<fs::path> folders = {root};
  for (std::size_t i = 0; i < folders.size(); ++i) {
    for (fs::path& entry : list_folder(folders[i])) {
      std::error_code error;
      const fs::file_status status = fs::symlink_status(entry, error);
      throw_if_system_error(entry, error);
      if (fs::is_directory(status)) folders.push_back(std::move(entry));
    }
  }
  return folders;
}

bool is_inside_folder(const fs::path& path, const fs::path& folder) {
  std::error_code of_path, of_folder;
  const auto canonical = [](const fs::path& of, std::error_code& error) {
    return fs::weakly_canonical(fs::absolute(of.empty() ? "." : of), error);
  };
  const fs::path way = canonical(path, of_path).lexically_relative(canonical(folder, of_folder));
  throw_if_system_error(path, of_path);
  throw_if_system_error(folder, of_folder);
  return !of_path && !of_folder && !way.empty() && *way.begin() != "..";
}

DirectoryHandle::DirectoryHandle(const fs::path& folder)
    : path_(folder),
      opened_(::open(folder.empty() ? "." : folder.c_str(),
                     O_RDONLY | O_DIRECTORY | O_CLOEXEC | O_PATH)) {
  if (!opened_.valid()) throw_with_errno<CannotCreate>(path_, "cannot be opened as a folder");
}

void DirectoryHandle::require_still_at_path() const {
  if (path_leads_to(path_.empty() ? "." : path_, opened_)) return;
  throw IoError(
      concat(path_.string(),
             ": was removed, moved or replaced during the run; run the same command again"));
}

}  // namespace crowdface
