// SPDX-License-Identifier: Apache-2.0
// Handles the requests of the editor's page that write files, add heads or paint masks.
#include <algorithm>

#include "crowdface/config/edited_entries.h"
#include "crowdface/config/words.h"
#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/text.h"
#include "crowdface/editor/config_edits.h"
#include "crowdface/editor/edit_api.h"
#include "crowdface/editor/recipe_json.h"
#include "crowdface/io/shallow_json.h"
#include "crowdface/page/answer_request.h"
#include "crowdface/page/binary_answer.h"
#include "crowdface/run/write_face.h"

namespace crowdface {
namespace {

using Json = nlohmann::ordered_json;

/// Returns the enumerator of `Value` whose word is the value of `key` in `body`.
/// \throws UsageError if the value is not a word of this enumeration.
template <class Value>
Value word_in(const Json& body, const std::string& key) {
  const std::string text = text_in(body, key);
  std::vector<std::string> known;
  for (const auto& word : words_of<Value>()) {
    if (word.text == text) return word.value;
    known.emplace_back(word.text);
  }
  throw UsageError(concat(key, ": expected ", join(known, " or "), ", found ", quoted(text)));
}

/// The text that is the value of a key; nothing if the value is null.
std::optional<std::string> optional_text_in(const Json& body, const std::string& key) {
  return body[key].is_null() ? std::nullopt : std::optional(text_in(body, key));
}

Json file_json(const std::filesystem::path& file) {
  return {{"file", file.string()}};
}

}  // namespace

HttpAnswer EditApi::saved_state(const HttpRequest&, const std::string&) {
  std::string text = folder_.saved_state();
  return {200, "application/json", text.empty() ? "null" : std::move(text)};
}

HttpAnswer EditApi::take_over_editing(const HttpRequest& request, const std::string& rest) {
  folder_.set_only_saving_page(text_in(parse_json_body(request), "page"));
  return saved_state(request, rest);
}

HttpAnswer EditApi::save_state(const HttpRequest& request, const std::string&) {
  const Json json = parse_shallow_json(request.body);
  if (json.is_discarded()) throw UsageError("the state: expected JSON");
  const bool is_named = json.is_object() && json.contains("page") && json["page"].is_string();
  if (!folder_.save_state(request.body, is_named ? json["page"].get<std::string>() : "")) {
    return error_answer(409, "another page edits this face now");
  }
  return json_answer(Json::object());
}

EditedFolder::WriteMesh EditApi::mesh_writer() {
  return [this](const FacePlan& face, MeshFormat format, const std::filesystem::path& file) {
    write_face(session_.job(), pictures_.textures(), face, format, session_.build(face.recipe),
               file);
  };
}

HttpAnswer EditApi::save_face(const HttpRequest& request, const std::string&) {
  const Json body = parse_json_body(request);
  const FacePlan face = face_in(body);
  const std::string name = text_in(body, "format");
  const auto format = mesh_format_of("face." + name);
  if (!format) {
    throw UsageError(concat("format: expected one of ", join(EditedFolder::formats()), ", found ",
                            quoted(name)));
  }
  const std::lock_guard lock(build_mutex_);
  require_masks_of_config();
  const auto file = folder_.path() / concat(face.id, extension_of(*format));
  if (body.contains("ask") && body["ask"] == true && path_exists(file)) {
    return error_answer(409, concat(file.filename().string(), " already exists"));
  }
  painting_.apply_masks();
  return json_answer(file_json(folder_.save(session_.job(), face, *format, mesh_writer())));
}

void EditApi::require_editable_config() const {
  if (may_edit_config_) return;
  throw UsageError(
      "the config.yaml in a crowd's folder records how its faces were made and cannot be edited; "
      "open the config that the crowd was made from");
}

HttpAnswer EditApi::put_recipe(const HttpRequest& request, const std::string&) {
  require_editable_config();
  const Json body = parse_json_body(request);
  const Config& config = session_.job().config;
  const ManualRecipe recipe =
      manual_recipe_of_json(body.contains("recipe") ? body["recipe"] : Json(), config);
  const std::lock_guard lock(build_mutex_);
  require_masks_of_config();
  return json_answer(file_json(save_recipe_in_edits(recipe, config)));
}

HttpAnswer EditApi::generate(const HttpRequest&, const std::string&) {
  folder_.require_same_folder();
  run_.start();
  return json_answer(Json::object(), 202);
}

HttpAnswer EditApi::stop_generate(const HttpRequest&, const std::string&) {
  run_.stop();
  return json_answer(Json::object());
}

HttpAnswer EditApi::generate_progress(const HttpRequest&, const std::string&) {
  const GenerateRun::State state = run_.state();
  const RunProgress progress = run_.progress();
  const std::string message = printable(progress.message);
  return json_answer({{"state", name_of(state)},
                      {"done", progress.done},
                      {"total", progress.total},
                      {"eta_s", progress.seconds_left},
                      {"message", message}});
}

void EditApi::require_no_run() {
  if (run_.state() != GenerateRun::State::kRunning) return;
  throw UsageError("the crowd is being generated: wait until it is done, or stop it");
}

HttpAnswer EditApi::reload_job(const HttpRequest&, const std::string&) {
  require_no_run();
  reload_job_();
  return json_answer(Json::object());
}

HttpAnswer EditApi::review(const HttpRequest& request, const std::string&) {
  constexpr std::size_t kLongestNote = 2000;
  const Json body = parse_json_body(request);
  ReviewMark mark;
  mark.id = text_in(body, "id");
  const std::vector<FacePlan>* crowd = session_.crowd();
  if (crowd == nullptr || std::ranges::find(*crowd, mark.id, &FacePlan::id) == crowd->end()) {
    throw UsageError(concat("no face of this crowd is called ", crowdface::quoted(mark.id)));
  }
  if (body.contains("change")) {
    Problems problems;
    const auto change =
        parse_change(mark.id, body["change"].dump(), session_.job().config, problems);
    problems.throw_if_any();
    return json_answer(file_json(folder_.save_change(session_.job().config, *change)));
  }
  if (body.contains("verdict")) mark.verdict = word_in<ReviewMark::Verdict>(body, "verdict");
  mark.locked_bands = bands_in(body, "lock");
  if (!mark.locked_bands.empty()) mark.verdict = ReviewMark::Verdict::kReject;
  if (body.contains("note")) {
    mark.note = text_in(body, "note");
    if (mark.note->size() > kLongestNote) {
      throw UsageError(concat("note: expected at most ", kLongestNote, " bytes"));
    }
  }
  return json_answer(file_json(folder_.save_mark(session_.job().config, mark)));
}

HttpAnswer EditApi::painted_masks() const {
  const std::vector<float> masks = painting_.masks();
  BinaryAnswer answer;
  answer.json["painted"] = painting_.differs_from_config();
  answer.add("alpha", std::span(masks));
  return binary_answer(answer.bytes());
}

void EditApi::require_masks_of_config() const {
  if (!painting_.differs_from_config()) return;
  throw UsageError(
      "the config does not use the painted masks yet; press \"Use masks\" first, so that the saved "
      "face matches the config");
}

HttpAnswer EditApi::paint_masks(const HttpRequest& request, const std::string&) {
  const Json body = parse_json_body(request);
  const std::lock_guard lock(build_mutex_);
  folder_.require_same_folder();
  painting_.apply_stroke(body);
  return painted_masks();
}

HttpAnswer EditApi::undo_masks(const HttpRequest&, const std::string&) {
  const std::lock_guard lock(build_mutex_);
  folder_.require_same_folder();
  painting_.undo();
  return painted_masks();
}

HttpAnswer EditApi::save_masks(const HttpRequest&, const std::string&) {
  const std::lock_guard lock(build_mutex_);
  folder_.require_same_folder();
  Json files = Json::array();
  for (const auto& file : painting_.save(painting_.changed_regions({}), unused_mask_path())) {
    files.push_back(file.string());
  }
  return json_answer({{"files", files}});
}

std::filesystem::path EditApi::unused_mask_path() const {
  for (std::size_t number = 1;; ++number) {
    const std::string stem = number == 1 ? "masks" : concat("masks-", number);
    const bool is_used = std::ranges::any_of(
        std::filesystem::directory_iterator(folder_.path()), [&](const auto& entry) {
          const std::string name = entry.path().filename().string();
          return name.starts_with(concat(stem, '.')) || name.starts_with(concat(stem, '_'));
        });
    if (!is_used) return folder_.path() / concat(stem, ".png");
  }
}

nlohmann::ordered_json EditApi::edit_json(const std::filesystem::path& edits,
                                          const std::string& section) {
  const auto value = section_in_edits(edits, section);
  return value ? Json(*value) : Json();
}

HttpAnswer EditApi::use_regions(const HttpRequest& request, const std::string& rest) {
  require_editable_config();
  require_no_run();
  const Json body = parse_json_body(request);
  const std::filesystem::path& config = session_.job().config.file;
  std::filesystem::path edits;
  {
    const std::lock_guard lock(build_mutex_);
    folder_.require_same_folder();
    if (body.contains("back")) {
      edits = restore_section(config, "regions", optional_text_in(body, "back"));
    } else {
      const PaintedRegions regions = painting_.changed_regions(body);
      edits =
          save_regions_in_edits(config, regions.names, painting_.save(regions, unused_mask_path()));
    }
    painting_.delete_stored_strokes();
  }
  reload_job(request, rest);
  return json_answer({{"regions", edit_json(edits, "regions")}});
}

HttpAnswer EditApi::begin_drop(const HttpRequest& request, const std::string&) {
  constexpr double kMaxBytes = 1e15;
  require_editable_config();
  const Json body = parse_json_body(request);
  std::map<std::string, std::uint64_t> sizes;
  for (const auto& [name, ignored] : body.items()) {
    sizes[name] = static_cast<std::uint64_t>(number_in(body, name, 0, kMaxBytes));
  }
  dropped_.begin_upload(sizes);
  return json_answer(Json::object());
}

/// PUT api/dropped/OFFSET/NAME; the body holds the bytes of the file from this offset on.
HttpAnswer EditApi::receive_dropped_file(const HttpRequest& request, const std::string& rest) {
  const std::size_t slash = std::min(rest.find('/'), rest.size());
  const auto offset = parse_unsigned(std::string_view(rest).substr(0, slash));
  if (!offset || slash == rest.size()) return error_answer(404, "there is nothing at this address");
  dropped_.add(rest.substr(slash + 1), *offset, request.body);
  return json_answer(Json::object());
}

/// Adds the head files that the user dropped on the page to the config. If the heads cannot be
/// loaded, undoes this change of the config. A request with {"back": value} adds no heads; it only
/// restores the earlier `value` of the section `faces` in the edits.
HttpAnswer EditApi::add_heads(const HttpRequest& request, const std::string& rest) {
  require_editable_config();
  require_no_run();
  const Json body = parse_json_body(request);
  const Config& config = session_.job().config;
  const auto before = section_in_edits(config.edits, "faces");
  const std::string config_text = read_file(config.file);
  if (body.contains("back")) {
    folder_.require_same_folder();
    restore_section(config.file, "faces", optional_text_in(body, "back"));
    reload_job(request, rest);
    return json_answer(Json::object());
  }
  const std::vector<std::filesystem::path> heads = dropped_.move_to_config_folder();
  try {
    const auto edits = save_heads_in_edits(config.file, heads);
    try {
      reload_job_();
    } catch (...) {
      restore_section(config.file, "faces", before);
      write_file(config.file, config_text);
      throw;
    }
    Json names = Json::array();
    for (const auto& head : heads) names.push_back(head.stem().string());
    return json_answer({{"faces", edit_json(edits, "faces")}, {"heads", names}});
  } catch (...) {
    std::error_code ignored;
    const auto folder = heads.front().parent_path();
    std::filesystem::remove_all(folder, ignored);
    // deletes the folder only if the folder is empty
    std::filesystem::remove(folder.parent_path(), ignored);
    throw;
  }
}

}  // namespace crowdface
