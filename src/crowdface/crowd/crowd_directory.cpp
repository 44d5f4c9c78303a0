// SPDX-License-Identifier: Apache-2.0
#include "crowdface/crowd/crowd_directory.h"

#include <algorithm>
#include <chrono>
#include <set>
#include <system_error>

#include <unistd.h>

#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/file_descriptor.h"
#include "crowdface/core/folder.h"
#include "crowdface/core/log.h"
#include "crowdface/core/text.h"
#include "crowdface/core/text_pieces.h"
#include "crowdface/crowd/ledger.h"
#include "crowdface/io/glb_options.h"
#include "crowdface/io/npy.h"
#include "crowdface/io/shallow_json.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;

void remove_file(const fs::path& path) {
  std::error_code error;
  fs::remove(path, error);  // a missing file is no error; only empty folders are removed
  if (error && error != std::errc::directory_not_empty) {
    throw IoError(concat(path.string(), ": cannot be removed: ", error.message()));
  }
}

/// The subfolders that a crowd's folder may have. A parent folder precedes its subfolders.
std::vector<fs::path> crowd_folders(const CrowdDirectory& directory) {
  const fs::path data = directory.gallery() / "data";
  std::vector<fs::path> folders;
  for (const fs::path& folder : folder_and_numbered_subfolders(directory.meshes())) {
    folders.insert(folders.end(), {folder, folder / kBlendedFolder});
  }
  for (const fs::path& folder : {directory.renders(), directory.sheets()}) {
    for (const fs::path& each : folder_and_numbered_subfolders(folder)) folders.push_back(each);
  }
  folders.insert(folders.end(),
                 {directory.topology(), directory.head_render("").parent_path(),
                  directory.founder_render("").parent_path(), directory.reviews(),
                  directory.gallery(), data, data / "attachments", directory.gallery_pages()});
  for (const fs::path& each : folder_and_numbered_subfolders(directory.gallery_faces())) {
    folders.push_back(each);
  }
  folders.push_back(data / "heads");
  return folders;
}

std::vector<fs::path> record_files(const CrowdDirectory& directory) {
  return {directory.plan(),     directory.founders(),    directory.table(),    directory.casting(),
          directory.report(),   directory.ledger(),      directory.likeness(), directory.timings(),
          directory.rejected(), directory.plan_marker(), directory.stage()};
}

/// Reads all ledgers in the folder and returns the names of the files that they list. Reads only
/// ledger items whose names begin with `items`.
std::set<std::string> recorded_files(const CrowdDirectory& directory, std::string_view items) {
  std::set<std::string> names;
  for (const fs::path& ledger : directory.ledgers()) {
    for (const LedgerEntry& entry : read_ledger(ledger, items).entries) {
      for (const LedgerEntry::File& file : entry.files) names.insert(file.name);
    }
  }
  return names;
}

/// The files of all faces: the files that ledgers record, and the files that a killed run wrote for
/// planned faces but did not record.
std::vector<fs::path> files_of_faces(const CrowdDirectory& directory) {
  const std::set<std::string> recorded = recorded_files(directory, "faces/");
  std::set<std::string> ids;
  if (path_exists(directory.plan())) {
    for (std::string& id : ids_in_plan(directory)) ids.insert(std::move(id));
  }
  std::vector<fs::path> files;
  const auto add = [&](const fs::path& folder, const auto& is_ours) {
    for (fs::path& file : list_files(folder, [&](const fs::path& path) {
           const std::string name = path.filename().string();
           const std::size_t plus = name.find('+');
           return recorded.contains(directory.relative(path)) ||
                  (ids.contains(plus == name.npos ? path.stem().string() : name.substr(0, plus)) &&
                   is_ours(path));
         })) {
      files.push_back(std::move(file));
    }
  };
  for (const fs::path& folder : folder_and_numbered_subfolders(directory.meshes())) {
    add(folder, [](const fs::path& path) {
      return mesh_format_of(path) || path.extension() == ".mtl" ||
             path.filename().string().ends_with(concat('+', kFacePointsFileSuffix));
    });
    for (fs::path& file : list_files(folder / kBlendedFolder, is_file)) {
      files.push_back(std::move(file));  // this folder holds no other files
    }
  }
  for (const fs::path& folder : folder_and_numbered_subfolders(directory.renders())) {
    add(folder, extension_filter(".png"));
  }
  for (const fs::path& folder : folder_and_numbered_subfolders(directory.gallery_faces())) {
    for (fs::path& file : list_files(folder, extension_filter(".js")))
      files.push_back(std::move(file));
  }
  return files;
}

/// Removes the crowd's files with fixed names, and the unaltered files that the crowd's ledgers
/// list. Keeps all other files, because other files belong to the user.
void remove_crowd(const CrowdDirectory& directory) {
  std::vector<fs::path> files = {directory.meshes() / GlbOverlay::kFile};
  for (const char* array : kTopologyArrays) files.push_back(directory.topology() / array);
  for (const std::vector<fs::path>& more : {files_of_faces(directory), crowd_sheets(directory),
                                            files_made_together_with_sheets(directory)}) {
    files.insert(files.end(), more.begin(), more.end());
  }
  for (const fs::path& path : files) remove_file(path);
  for (const fs::path& ledger : directory.ledgers()) {
    for (const LedgerEntry& entry : read_ledger(ledger).entries) {
      for (const LedgerEntry::File& file : entry.files) remove_recorded_file(directory.root, file);
    }
  }
  std::vector<fs::path> folders = crowd_folders(directory);
  std::ranges::reverse(folders);
  for (const std::vector<fs::path>& some :
       {folders, directory.shard_ledgers(), directory.shard_logs(), directory.progress_files(),
        record_files(directory)}) {
    for (const fs::path& path : some) remove_file(path);
  }
  remove_file(directory.log());
  remove_file(directory.config());
}

/// Checks that the crowd's paths can be written. Checks each path with a single system call,
/// because another run may remove its lock file between two calls.
/// \throws CannotCreate if one of the crowd's folders is a file or not writable, or if one of the
///         crowd's files is a folder.
void refuse_obstacles(const CrowdDirectory& directory) {
  const auto stands_at = [](const fs::path& path) {
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    throw_if_system_error(path, error);
    return status;
  };
  for (const fs::path& folder : crowd_folders(directory)) {
    const fs::file_status found = stands_at(folder);
    if (!fs::exists(found)) continue;
    if (!fs::is_directory(found)) {
      throw CannotCreate(concat(folder.string(), ": expected a folder, or nothing"));
    }
    if (::access(folder.c_str(), W_OK | X_OK) != 0 && errno != ENOENT) {
      throw CannotCreate(concat(folder.string(), ": is not writable"));
    }
  }
  std::vector<fs::path> files = record_files(directory);
  files.insert(files.end(),
               {directory.config(), directory.log(), directory.lock(), directory.sheet(1),
                directory.sheets() / "index.png", directory.gallery() / kGalleryPageFiles.front()});
  for (const fs::path& file : files) {
    const fs::file_status found = stands_at(file);
    if (!fs::exists(found) || fs::is_regular_file(found)) continue;
    throw CannotCreate(concat(file.string(), ": expected a file, or nothing"));
  }
}

/// Whether a folder without a config.yaml has other files that a crowd would overwrite. False if a
/// ledger records this crowd's config.yaml, because then the files belong to this crowd and only
/// the config.yaml was lost.
bool holds_other_files(const CrowdDirectory& directory, const std::string& effective_config) {
  if (path_exists(directory.config())) return false;
  const std::string name = directory.relative(directory.config());
  for (const fs::path& ledger : directory.ledgers()) {
    for (const LedgerEntry& entry : read_ledger(ledger, name).entries) {
      if (entry.key == hash_bytes(effective_config)) return false;
    }
  }
  const bool holds_any = std::ranges::any_of(record_files(directory), path_exists) ||
                         std::ranges::any_of(crowd_folders(directory), [](const fs::path& folder) {
                           return !list_folder(folder).empty();
                         });
  // Check again whether config.yaml exists: another shard of the same crowd may have begun in the
  // meantime. A shard writes config.yaml before its other files.
  return holds_any && !path_exists(directory.config());
}

/// Renames the folder of reviews to a new name with the date, such as "reviews-2026-11-27".
void set_reviews_aside(const CrowdDirectory& directory) {
  if (directory.stored_reviews().empty()) return;
  const std::chrono::year_month_day today{
      std::chrono::floor<std::chrono::days>(std::chrono::system_clock::now())};
  const std::string name = concat("reviews-", static_cast<int>(today.year()), '-',
                                  zero_padded(static_cast<unsigned>(today.month()), 2), '-',
                                  zero_padded(static_cast<unsigned>(today.day()), 2));
  fs::path aside = directory.root / name;
  for (int i = 2; path_exists(aside); ++i) aside = directory.root / concat(name, '-', i);
  std::error_code error;
  fs::rename(directory.reviews(), aside, error);
  if (error) {
    throw IoError(concat(directory.reviews().string(), ": cannot be moved to ", aside.string(),
                         ": ", error.message()));
  }
  log_info(concat("moved the reviews to ", aside.string()));
}

/// \throws UsageError if the folder has reviews that this run would overwrite or not apply, because
///         another run added these reviews after this run read its config.
void refuse_unread_reviews(const CrowdDirectory& directory, const CrowdConfig& config) {
  const std::vector<fs::path> kept = directory.stored_reviews();
  for (std::size_t i = 0; i < kept.size(); ++i) {
    if (i < config.reviews.size()) {
      const std::string text = read_file(kept[i]);
      if (text == config.reviews[i]) continue;
      if (i < config.original_reviews.size() && text == config.original_reviews[i]) continue;
    }
    throw UsageError(concat(kept[i].string(),
                            ": this run has not applied this review, which another run has added; "
                            "run the same command again"));
  }
}

/// Refuses symbolic links through which a run would write, append or remove files outside the
/// crowd's folder.
/// \throws CannotCreate if there is such a link.
void refuse_links(const CrowdDirectory& directory) {
  for (const fs::path& folder : crowd_folders(directory))
    refuse_link_out_of_crowd(directory, folder);
  std::vector<fs::path> files = {directory.log(), directory.ledger()};
  for (const fs::path& path : directory.shard_ledgers()) files.push_back(path);
  for (const fs::path& path : directory.shard_logs()) files.push_back(path);
  for (const fs::path& file : files) {
    std::error_code error;
    const bool is_link = fs::is_symlink(fs::symlink_status(file, error));
    throw_if_system_error(file, error);
    if (!is_link) continue;
    throw CannotCreate(concat(file.string(), ": is a link; expected a file of this crowd"));
  }
}

/// Whether a file in the folder of sheets has the name of a numbered contact sheet.
bool is_numbered_sheet(const fs::path& path) {
  const std::string stem = path.stem().string();
  const std::string ending = path.extension().string();
  if (ending != ".png" && ending != ".exr" && ending != ".pdf") return false;
  if (stem == "index" || stem == "sheets") return true;
  for (const std::string_view start : {"sheet_", "heads_", "shapes_", "index_", "sheets_"}) {
    if (stem.starts_with(start) && parse_unsigned(stem.substr(start.size()))) return true;
  }
  return false;
}

}  // namespace

std::vector<fs::path> CrowdDirectory::ledgers() const {
  std::vector<fs::path> all = shard_ledgers();
  all.push_back(ledger());
  return all;
}

void refuse_link_out_of_crowd(const CrowdDirectory& directory, const fs::path& folder) {
  std::error_code error;
  const fs::path root = fs::weakly_canonical(directory.root, error);
  if (error) return;  // the folder neither exists nor can be created; other code reports this
  const fs::path real = fs::weakly_canonical(folder, error);
  if (error) {
    throw CannotCreate(concat(folder.string(), ": cannot be reached: ", error.message()));
  }
  if (is_inside_folder(real, root)) return;
  throw CannotCreate(concat(folder.string(), ": is a link that leads out of ", root.string(),
                            "; crowdface writes only inside this folder"));
}

std::vector<std::string> ids_in_plan(const CrowdDirectory& directory) {
  std::vector<std::string> ids;
  read_lines(directory.plan(), [&](std::string_view text, bool) {
    const auto line = parse_shallow_json(text);
    if (!line.is_object() || !line.contains("id") || !line["id"].is_string()) return;
    const auto id = line["id"].get<std::string>();
    if (is_valid_name(id, kMaxIdLength)) ids.push_back(id);
  });
  return ids;
}

std::vector<fs::path> crowd_sheets(const CrowdDirectory& directory) {
  const std::set<std::string> recorded = recorded_files(directory, kSheetsItem);
  std::vector<fs::path> sheets;
  for (const fs::path& folder : folder_and_numbered_subfolders(directory.sheets())) {
    for (fs::path& file : list_folder(folder)) sheets.push_back(std::move(file));
  }
  std::erase_if(sheets, [&](const fs::path& path) {
    return !is_numbered_sheet(path) && !recorded.contains(directory.relative(path));
  });
  return sheets;
}

std::vector<fs::path> files_made_together_with_sheets(const CrowdDirectory& directory) {
  std::vector<fs::path> files;
  const auto add = [&](const fs::path& folder, const auto& is_ours) {
    for (fs::path& file : list_files(folder, is_ours)) {
      if (is_file(file)) files.push_back(std::move(file));
    }
  };
  for (const fs::path& picture : {directory.head_render(""), directory.founder_render("")}) {
    add(picture.parent_path(), extension_filter(".png"));
  }
  add(directory.gallery(), is_gallery_page_file);
  for (const fs::path& folder :
       {directory.gallery() / "data", directory.gallery_pages(),
        directory.gallery_head("").parent_path(), directory.gallery_attachment("").parent_path()}) {
    add(folder, extension_filter(".js"));
  }
  return files;
}

fs::path CrowdDirectory::sheet(std::size_t page) const {
  return sheets() / numbered_subfolder(std::to_string(page)) /
         concat("sheet_", zero_padded(page, 3), ".png");
}

fs::path CrowdDirectory::numbered_subfolder(std::string_view id) const {
  if (faces_per_folder == 0) return {};
  constexpr std::size_t kMaxDigits = 15;
  const std::size_t last = id.find_last_not_of("0123456789");
  std::string_view digits = id.substr(last == id.npos ? 0 : last + 1);
  digits = digits.substr(digits.size() - std::min(digits.size(), kMaxDigits));
  return zero_padded(parse_unsigned(digits).value_or(0) / faces_per_folder, 3);
}

std::vector<fs::path> folder_and_numbered_subfolders(const fs::path& folder) {
  std::vector<fs::path> folders = list_files(folder, [](const fs::path& path) {
    return path.filename().string().find_first_not_of("0123456789") == std::string::npos &&
           is_folder(path);
  });
  folders.insert(folders.begin(), folder);
  return folders;
}

fs::path CrowdDirectory::review(std::size_t number) const {
  return reviews() / concat("review_", zero_padded(number, 3), ".yaml");
}

std::vector<fs::path> CrowdDirectory::stored_reviews() const {
  std::vector<fs::path> kept;
  while (path_exists(review(kept.size() + 1))) kept.push_back(review(kept.size() + 1));
  return kept;
}

fs::path CrowdDirectory::mesh(const std::string& id, MeshFormat format,
                              const std::string& part) const {
  return meshes_of(id) / concat(id, part.empty() ? "" : "+", part, extension_of(format));
}

void require_crowd(const CrowdDirectory& directory) {
  if (path_exists(directory.config())) return;
  throw MissingInput(
      concat(directory.config().string(), ": does not exist; expected the folder of a crowd"));
}

void check_crowd_directory(const CrowdDirectory& directory, const CrowdConfig& config,
                           Replace replace) {
  if (path_exists(directory.config()) && replace == Replace::kRefuse) {
    const std::vector<std::string> keys = config.differences(read_file(directory.config()));
    if (!keys.empty()) {
      throw UsageError(concat(directory.root.string(),
                              ": holds another config's crowd (its config.yaml differs from this "
                              "run's in ",
                              join(keys),
                              "); choose another folder with --out, or replace the crowd with "
                              "--force, which keeps its reviews"));
    }
  }
  fs::path existing = fs::absolute(directory.root);
  std::error_code error;
  if (!fs::status_known(fs::status(existing, error))) {  // name too long, or a cycle of links
    throw CannotCreate(concat(directory.root.string(), ": cannot be created: ", error.message()));
  }
  while (!path_exists(existing) && existing.has_relative_path()) {
    existing = existing.parent_path();
  }
  refuse_links(directory);
  refuse_obstacles(directory);
  if (replace == Replace::kRefuse && holds_other_files(directory, config.text)) {
    throw UsageError(concat(
        directory.root.string(),
        ": contains files that this crowd would overwrite, but no config.yaml that identifies them "
        "as files of this crowd; choose another folder with --out, or replace them with --force"));
  }
  if (!is_folder(existing) || ::access(existing.c_str(), W_OK | X_OK) != 0) {
    throw CannotCreate(concat(directory.root.string(),
                              ": cannot be written: expected a writable folder, found ",
                              existing.string()));
  }
}

void open_crowd_directory(const CrowdDirectory& directory, const CrowdConfig& config,
                          Replace replace) {
  check_crowd_directory(directory, config, replace);
  make_directories(directory.root);
  if (config.renames_review_folder) set_reviews_aside(directory);
  refuse_unread_reviews(directory, config);
  const bool is_others = path_exists(directory.config())
                             ? !config.differences(read_file(directory.config())).empty()
                             : holds_other_files(directory, config.text);
  if (is_others && replace == Replace::kForce) remove_crowd(directory);
  if (!config.reviews.empty()) make_directories(directory.reviews());
  for (std::size_t i = 0; i < config.reviews.size(); ++i) {
    write_file(directory.review(i + 1), config.reviews[i]);
  }
  write_file(directory.config(), config.text);
}

}  // namespace crowdface
