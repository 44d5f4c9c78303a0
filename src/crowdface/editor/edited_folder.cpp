// SPDX-License-Identifier: Apache-2.0
#include "crowdface/editor/edited_folder.h"

#include <utility>
#include <vector>

#include "crowdface/config/config_values.h"
#include "crowdface/config/edited_entries.h"
#include "crowdface/core/file.h"
#include "crowdface/core/text.h"
#include "crowdface/run/write_face.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;

std::string format_mark(const ReviewMark& mark, const std::vector<std::string>& parts) {
  std::vector<std::string> entries = {entry("mark", word_of(mark.verdict))};
  const auto locked = texts_of(mark.locked, [&](std::size_t k) { return parts[k]; });
  if (!locked.empty()) entries.push_back(entry("lock", flow_names(locked)));
  if (mark.note) entries.push_back(entry("note", write_scalar(*mark.note)));
  return concat("  ", entry(write_scalar(mark.id), flow_map(entries)), '\n');
}

/// The lines of a plan but for the one with that id.
std::string other_lines(const fs::path& plan, const std::string& id, const PlanNames& names) {
  if (!is_there(plan)) return {};
  std::string lines;
  for (const PlanLine& line : read_plan(plan, names)) {
    if (line.face.id == id) continue;
    const auto settings = parse_digest(line.settings);
    lines += format_recipe(line.face, names, settings.value_or(Digest{})) + '\n';
  }
  return lines;
}

}  // namespace

fs::path make_edited_folder(const Config& config) {
  fs::path path = config.output.directory / "edited";
  refuse_folder_elsewhere({config.output.directory}, path);
  make_directories(path);
  return path;
}

EditedFolder::EditedFolder(const Job& job, fs::path path, MarkLines marks)
    : job_(job), path_(std::move(path)), marks_(std::move(marks)) {
  remove_leftovers(path_);
}

std::vector<std::string> EditedFolder::formats() {
  std::vector<std::string> endings;
  for (const MeshFormat format : all_mesh_formats()) {
    endings.emplace_back(extension_of(format).substr(1));
  }
  return endings;
}

std::string EditedFolder::state() const {
  const fs::path file = path_ / "state.json";
  return is_there(file) ? read_file(file) : std::string();
}

void EditedFolder::keep_state(std::string_view text) {
  const std::lock_guard lock(mutex_);
  write_file(path_ / "state.json", text);
}

fs::path EditedFolder::save(const CastFace& face, MeshFormat format, const Positions& positions,
                            const FaceTextures& textures) {
  const std::lock_guard lock(mutex_);
  const fs::path plan = path_ / "edited.jsonl";
  const std::string others = other_lines(plan, face.id, job_.names);
  fs::path mesh = path_ / concat(face.id, extension_of(format));
  write_face(job_, textures, face, format, positions, mesh);
  write_file(plan, others + format_recipe(face, job_.names, job_.settings) + '\n');
  return mesh;
}

void EditedFolder::save_picture(const std::string& name, std::string_view png) {
  const std::lock_guard lock(mutex_);
  write_file(path_ / (name + ".png"), png);
}

fs::path EditedFolder::save_mark(const ReviewMark& mark) {
  const std::lock_guard lock(mutex_);
  MarkLines marks = marks_;
  marks[mark.id] = format_mark(mark, job_.config.part_names());
  std::string text = "schema: 1\nfaces:\n";
  for (const auto& [id, line] : marks) text += line;
  fs::path file = path_ / "review.yaml";
  Problems problems;
  check_review(text, file.string(), job_.config, problems);
  problems.throw_if_any();
  write_file(file, text);
  marks_ = std::move(marks);
  return file;
}

MarkLines EditedFolder::marks() {
  const std::lock_guard lock(mutex_);
  return marks_;
}

}  // namespace crowdface
