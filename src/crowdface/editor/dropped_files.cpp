// SPDX-License-Identifier: Apache-2.0
#include "crowdface/editor/dropped_files.h"

#include <algorithm>
#include <fstream>
#include <set>
#include <system_error>

#include "crowdface/config/config_values.h"
#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/text.h"
#include "crowdface/io/mesh_as_obj.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;

/// Refuses file names that lead out of the folder, names of hidden files, and names with characters
/// that a config or a terminal cannot show.
void require_safe_name(const std::string& name) {
  constexpr std::size_t kLongest = 128;
  static const std::set<std::string> beside = {".mtl",  ".bin", ".png",  ".jpg",
                                               ".jpeg", ".tif", ".tiff", ".exr"};
  const bool is_safe = !name.empty() && name.size() <= kLongest && name.front() != '.' &&
                       name.find_first_of("/\\:") == std::string::npos && is_utf8(name) &&
                       !has_control_character(name);
  if (!is_safe) throw UsageError(concat(quoted(name), ": a file with this name cannot be added"));
  if (is_head_file(name) || beside.contains(lower_case(fs::path(name).extension().string())))
    return;
  throw UsageError(concat(quoted(name),
                          ": expected heads (OBJ, PLY, GLB, glTF, FBX, USD or NumPy), material "
                          "files (.mtl) and textures (PNG, JPEG, TIFF or EXR)"));
}

}  // namespace

DroppedFiles::DroppedFiles(const fs::path& folder)
    : added_folder_(folder / "added"), upload_folder_(added_folder_ / ".arriving") {}

DroppedFiles::~DroppedFiles() {
  discard();
}

void DroppedFiles::discard() {
  if (expected_bytes_.empty()) return;
  std::error_code ignored;
  fs::remove_all(upload_folder_, ignored);
  fs::remove(added_folder_, ignored);  // deletes the folder only if the folder is empty
  expected_bytes_.clear();
  received_bytes_.clear();
}

void DroppedFiles::begin_upload(const std::map<std::string, std::uint64_t>& sizes) {
  constexpr std::size_t kMaxFiles = 256;
  constexpr std::uint64_t kMaxBytes = std::uint64_t{2} << 30U;
  if (sizes.size() > kMaxFiles) {
    throw UsageError(concat("expected at most ", kMaxFiles, " files at once"));
  }
  std::uint64_t all = 0;
  for (const auto& [name, bytes] : sizes) {
    require_safe_name(name);
    if (bytes > kMaxBytes - all) throw UsageError("expected at most 2 GiB at once");
    all += bytes;
  }
  if (std::ranges::none_of(sizes, [](const auto& file) { return is_head_file(file.first); })) {
    throw UsageError("none of these files is a head: drop textures together with their heads");
  }
  const std::lock_guard lock(mutex_);
  discard();
  expected_bytes_ = sizes;
  make_directories(upload_folder_);
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(upload_folder_)) fs::remove_all(entry, ignored);
}

void DroppedFiles::add(const std::string& name, std::uint64_t offset, std::string_view bytes) {
  const std::lock_guard lock(mutex_);
  const auto size = expected_bytes_.find(name);
  if (size == expected_bytes_.end())
    throw UsageError(
        concat(quoted(name), ": this file was not among the dropped files; drop all files again"));
  std::uint64_t& arrived = received_bytes_[name];
  if (offset != arrived || bytes.size() > size->second - arrived) {
    throw UsageError(concat(quoted(name), ": the file changed while it was read; drop it again"));
  }
  const fs::path path = upload_folder_ / name;
  std::ofstream file(path, std::ios::binary | std::ios::app);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (!file) throw CannotCreate(concat(path.string(), ": cannot be written"));
  arrived += bytes.size();
}

std::vector<fs::path> DroppedFiles::move_to_config_folder() {
  const std::lock_guard lock(mutex_);
  if (expected_bytes_.empty()) throw UsageError("no files were dropped");
  std::vector<fs::path> heads;
  for (const auto& [name, bytes] : expected_bytes_) {
    const auto arrived = received_bytes_.find(name);
    if ((arrived == received_bytes_.end() ? 0 : arrived->second) != bytes) {
      throw UsageError(concat(quoted(name), " is incomplete; drop the files again"));
    }
    if (is_head_file(name)) heads.emplace_back(name);
  }
  const std::string stem = heads.front().stem().string();
  fs::path folder;
  for (std::size_t number = 1; folder.empty() || path_exists(folder); ++number) {
    folder = added_folder_ / (number == 1 ? stem : concat(stem, '-', number));
  }
  fs::rename(upload_folder_, folder);
  expected_bytes_.clear();
  received_bytes_.clear();
  for (fs::path& head : heads) head = folder / head;
  return heads;
}

}  // namespace crowdface
