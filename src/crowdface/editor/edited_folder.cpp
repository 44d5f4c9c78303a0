// SPDX-License-Identifier: Apache-2.0
#include "crowdface/editor/edited_folder.h"

#include <algorithm>
#include <utility>

#include "crowdface/config/config_values.h"
#include "crowdface/config/edited_entries.h"
#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/folder.h"
#include "crowdface/core/log.h"
#include "crowdface/core/text.h"
#include "crowdface/crowd/crowd_directory.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;

/// Adds a review entry (a mark or a change) for a face. Replaces an earlier entry of the same kind
/// for this face.
template <class Entry>
void put_entry(const Entry& entry, std::vector<Entry>& entries) {
  const auto known = std::ranges::find(entries, entry.id, &Entry::id);
  if (known == entries.end()) {
    entries.push_back(entry);
  } else {
    *known = entry;
  }
}

/// Returns whether the crowd's folder has a copy of the review with this text. A run may have
/// appended the keys `count` and `min_distance` to the copy.
bool crowd_has_review(const Config& config, const std::string& text) {
  const std::vector<fs::path> kept = CrowdDirectory{config.output.directory}.stored_reviews();
  return std::ranges::any_of(
      kept, [&](const fs::path& file) { return read_file(file).starts_with(text); });
}

/// Prefix of the name of a marker file that exists while a face is being saved. The marker file
/// contains the extension of the mesh file.
constexpr std::string_view kSavingPrefix = ".saving-";
constexpr const char* kPlan = "edited.jsonl";

/// The text of all lines of a plan except the line of the face with the given id.
std::string other_lines(const fs::path& plan, const std::string& id, const PlanNames& names) {
  if (!path_exists(plan)) return {};
  std::string lines;
  for (const PlanLine& line : read_plan(plan, names)) {
    if (line.face.id == id) continue;
    const auto settings = parse_digest(line.settings_hash);
    lines += format_plan_line(line.face, names, settings.value_or(Digest{})) + '\n';
  }
  return lines;
}

/// Writes the earlier lines of a plan back to the file. Logs a write error instead of throwing.
void restore_plan(const fs::path& plan, const std::string& lines) {
  try {
    write_file(plan, lines);
  } catch (const RecoverableError& error) {
    log_warning(error.what());
  }
}

}  // namespace

fs::path make_edited_folder(const Config& config) {
  fs::path path = config.output.directory / "edited";
  refuse_link_out_of_crowd({config.output.directory}, path);
  make_directories(path);
  return path;
}

EditedFolder::EditedFolder(fs::path path) : path_(std::move(path)), handle_(path_) {
  remove_temporary_files(path_);
}

std::vector<std::string> EditedFolder::formats() {
  std::vector<std::string> endings;
  for (const MeshFormat format : all_mesh_formats()) {
    endings.emplace_back(extension_of(format).substr(1));
  }
  return endings;
}

std::string EditedFolder::saved_state() const {
  const fs::path file = path_ / "state.json";
  return path_exists(file) ? read_file(file) : std::string();
}

void EditedFolder::set_only_saving_page(std::string page) {
  const std::lock_guard lock(mutex_);
  editing_page_id_ = std::move(page);
}

bool EditedFolder::save_state(std::string_view text, const std::string& page) {
  const std::lock_guard lock(mutex_);
  if (page != editing_page_id_) return false;
  require_same_folder();
  write_file(path_ / "state.json", text);
  return true;
}

void EditedFolder::write_meshes(const FacePlan& face, const std::string& ending,
                                const WriteMesh& write) const {
  for (const MeshFormat format : all_mesh_formats()) {
    const fs::path mesh = path_ / concat(face.id, extension_of(format));
    if (extension_of(format) == ending || path_exists(mesh)) write(face, format, mesh);
  }
}

fs::path EditedFolder::save(const Job& job, const FacePlan& face, MeshFormat format,
                            const WriteMesh& write) {
  const std::lock_guard lock(mutex_);
  require_same_folder();
  const fs::path plan = path_ / kPlan, saving = path_ / concat(kSavingPrefix, face.id);
  const std::string ending(extension_of(format));
  const std::string before = path_exists(plan) ? read_file(plan) : std::string();
  const std::string others = other_lines(plan, face.id, job.names);
  write_file(saving, ending);
  write_file(plan, others + format_plan_line(face, job.names, job.settings) + '\n');
  try {
    write_meshes(face, ending, write);
  } catch (...) {
    restore_plan(plan, before);
    throw;
  }
  remove_if_exists(saving);
  return path_ / concat(face.id, ending);
}

void EditedFolder::finish_interrupted_saves(const Job& job, const WriteMesh& write) {
  const std::lock_guard lock(mutex_);
  for (const fs::path& saving : list_folder(path_)) {
    const std::string name = saving.filename().string();
    if (!name.starts_with(kSavingPrefix)) continue;
    try {
      const fs::path plan = path_ / kPlan;
      const std::vector<PlanLine> lines =
          path_exists(plan) ? read_plan(plan, job.names) : std::vector<PlanLine>();
      for (const PlanLine& line : lines) {
        if (line.face.id != name.substr(kSavingPrefix.size())) continue;
        write_meshes(line.face, read_file(saving), write);
      }
      remove_if_exists(saving);
    } catch (const RecoverableError& error) {
      log_warning(concat(saving.string(), ": a face was not saved completely: ", error.what()));
    }
  }
}

fs::path EditedFolder::save_mark(const Config& config, const ReviewMark& mark) {
  return save_review(config, [&](Review& review) { put_entry(mark, review.marks); });
}

fs::path EditedFolder::save_change(const Config& config, const FaceChange& change) {
  return save_review(config, [&](Review& review) {
    if (!change.is_empty()) return put_entry(change, review.changes);
    std::erase_if(review.changes, [&](const FaceChange& known) { return known.id == change.id; });
  });
}

fs::path EditedFolder::save_review(const Config& config, const std::function<void(Review&)>& edit) {
  const std::lock_guard lock(mutex_);
  require_same_folder();
  fs::path file = path_ / "review.yaml";
  Problems problems;
  Review review;
  const std::string before = path_exists(file) ? read_file(file) : std::string();
  if (before.empty() || crowd_has_review(config, before)) {
    review.review_count_seen_by_reviewer = config.review.reviews.size();
  } else {
    review = parse_review(before, file.string(), config, problems);
  }
  problems.throw_if_any();
  edit(review);
  const std::string text = format_review(review, config);
  parse_review(text, file.string(), config, problems);
  problems.throw_if_any();
  write_file(file, text);
  return file;
}

}  // namespace crowdface
