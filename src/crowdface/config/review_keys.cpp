// SPDX-License-Identifier: Apache-2.0
// The config key `review`, and the review files that it lists.
#include <algorithm>

#include "crowdface/cast/face_ids.h"
#include "crowdface/cast/family.h"
#include "crowdface/config/config_keys.h"
#include "crowdface/config/edited_entries.h"
#include "crowdface/core/contains.h"
#include "crowdface/core/file.h"
#include "crowdface/core/folder.h"

namespace crowdface {
namespace {

using Verdict = ReviewMark::Verdict;

constexpr std::size_t kLongestNote = 2000;
constexpr std::uint64_t kMaxReviewedFaces = 1'000'000;

/// Returns the ids of all faces of this config's crowd, except sampled faces.
std::vector<std::string> named_ids(const Config& config) {
  std::vector<std::string> ids;
  for (const ManualRecipe& recipe : config.recipes) ids.push_back(recipe.id);
  for (const FamilyOptions& family : config.families) {
    const std::vector<std::string> own = face_ids_of_family(family, config.crowd.name);
    ids.insert(ids.end(), own.begin(), own.end());
  }
  return ids;
}

bool is_new_parent(const std::string& id, const Config& config) {
  return std::ranges::any_of(config.families, [&](const auto& family) {
    return std::ranges::any_of(family.parents, [&](const Parent& parent) {
      return parent.is_new && id == parent_id(config.crowd.name, parent);
    });
  });
}

void read_lock(const YamlNode& node, ReviewMark& mark, ConfigDraft& draft) {
  mark.locked_bands = read_locked_bands(node, draft);
  mark.verdict = Verdict::kReject;
}

void read_verdict(const YamlNode& node, ReviewMark& mark, ConfigDraft& draft) {
  mark.verdict = word<Verdict>().read(node, draft).value_or(mark.verdict);
  if (mark.verdict == Verdict::kKeep && !mark.locked_bands.empty()) {
    draft.complaints.add_at(
        node, "expected mark: reject with lock, found keep; a kept face is not redrawn");
  }
}

void read_note(const YamlNode& node, ReviewMark& mark, ConfigDraft& draft) {
  if (node.kind != YamlNode::Kind::kScalar || node.text.size() > kLongestNote) {
    draft.complaints.add_mismatch(node, concat("a text of at most ", kLongestNote, " bytes"));
  } else {
    mark.note = node.text;
  }
}

void read_mark(const YamlNode& node, ReviewMark& mark, ConfigDraft& draft) {
  if (node.kind != YamlNode::Kind::kMap) return read_verdict(node, mark, draft);
  static const Keys<ReviewMark> keys = {
      {"lock", read_lock, {}}, {"mark", read_verdict, {}}, {"note", read_note, {}}};
  if (node.entries.empty()) draft.complaints.add_at(node, "expected mark, lock or note");
  read_keys(node, keys, mark, draft);
}

Review read_marks(const std::optional<YamlNode>& root, ConfigDraft& draft) {
  Review review;
  if (!root) return review;
  const MapReader map(*root, {"schema", "count", "after", "min_distance", "faces", "changes"},
                      draft.complaints);
  if (const YamlNode* schema = map.require("schema", "write \"schema: 1\"")) {
    read_whole_number(*schema, 1, 1, draft.complaints);
  }
  if (const YamlNode* count = map.find("count")) {
    review.reviewed_face_count = read_whole_number(*count, 0, kMaxReviewedFaces, draft.complaints);
  }
  if (const YamlNode* after = map.find("after")) {
    review.review_count_seen_by_reviewer =
        read_whole_number(*after, 0, kMaxReviewedFaces, draft.complaints);
  }
  if (const YamlNode* distance = map.find("min_distance")) {
    review.min_distance_mm = length(kMaxDistanceMm).read(*distance, draft);
  }
  if (const YamlNode* changes = map.find("changes")) review.changes = read_changes(*changes, draft);
  const YamlNode* faces = map.find("changes") != nullptr
                              ? map.find("faces")
                              : map.require("faces", "such as \"faces: {market_0007: reject}\"");
  if (faces == nullptr) return review;
  if (!draft.complaints.expect_map(*faces, "a mapping from faces to marks, {market_0007: reject}"))
    return review;
  // Each entry of `faces` must name a face of this crowd. The mark `reject` is refused for parents
  // that casting made for a family, and for faces written by hand.
  for (const YamlEntry& entry : faces->entries) {
    ReviewMark mark;
    mark.id = entry.key;
    if (!is_face_id(entry.key, draft.config)) {
      draft.complaints.add(entry.key_place,
                           concat("no face of this crowd is called ", quoted(entry.key)));
    }
    read_mark(entry.value, mark, draft);
    if (mark.verdict == Verdict::kReject && is_new_parent(entry.key, draft.config)) {
      draft.complaints.add(
          entry.key_place,
          concat(quoted(entry.key), " is a parent and cannot be rejected; to redraw ",
                 "the family, give it another name"));
    }
    const auto& recipes = draft.config.recipes;
    if (mark.verdict == Verdict::kReject &&
        std::ranges::find(recipes, entry.key, &ManualRecipe::id) != recipes.end()) {
      draft.complaints.add(entry.key_place,
                           concat(quoted(entry.key), " is written by hand and cannot be rejected; ",
                                  "change its recipe"));
    }
    review.marks.push_back(std::move(mark));
  }
  return review;
}

/// Adds a key to the text of a review: on a new line or, if the review is written in braces, as the
/// first key inside the braces.
std::string insert_key(std::string text, const std::string& key) {
  std::size_t first = 0;
  while (first < text.size() &&
         (text[first] == '#' || is_blank(text[first]) || text[first] == '\n')) {
    first = text[first] == '#' ? std::min(text.find('\n', first), text.size()) : first + 1;
  }
  if (first < text.size() && text[first] == '{') {
    return text.insert(first + 1, concat(key, ", "));
  }
  if (!text.empty() && !text.ends_with('\n')) text += '\n';
  return text + concat(key, '\n');
}

/// Returns the text of a review, completed with missing keys: if `review` has no `count` or no
/// `min_distance`, adds the key with the value that `kept` has.
std::string add_missing_keys(std::string text, const Review& review, const Review& kept) {
  if (!review.reviewed_face_count && kept.reviewed_face_count) {
    text = insert_key(std::move(text), concat("count: ", *kept.reviewed_face_count));
  }
  if (!review.min_distance_mm && kept.min_distance_mm) {
    text = insert_key(std::move(text), concat("min_distance: ", *kept.min_distance_mm, " mm"));
  }
  return text;
}

/// Adds a review file to the config, unless the file is a copy of an earlier review file. The
/// config stores the text of the review file. The stored text always has the following two values;
/// if the file lacks a value, the value is added to the stored text:
///
/// - the number of faces that were reviewed;
/// - for a review in the crowd's folder, the minimum distance that the crowd had before the config
///   changed.
void add_review(const std::filesystem::path& file, const YamlNode& where, Config& config,
                ConfigDraft& draft) {
  if (!expect_file(where, file, draft)) return;
  if (!draft.ignored_reviews_folder.empty() && is_inside_folder(file, draft.ignored_reviews_folder))
    return;
  const Review review = read_marks(read_yaml(file.string(), draft.complaints), draft);
  std::string text = draft.complaints.empty() ? read_file(file) : std::string();
  const std::string original = text;
  Config::Reviews& known = config.review;
  for (std::size_t i = 0; i < known.texts.size() && !text.empty(); ++i) {
    if (known.texts[i] == add_missing_keys(text, review, known.reviews[i])) return;
  }
  const bool is_stored = contains(draft.stored_reviews, file);
  Review whole = review;
  if (!whole.reviewed_face_count) {
    whole.reviewed_face_count =
        is_stored ? draft.former_face_count.value_or(config.crowd.count) : config.crowd.count;
  }
  if (!whole.min_distance_mm && is_stored) whole.min_distance_mm = draft.former_min_distance_mm;
  if (!text.empty()) text = add_missing_keys(std::move(text), review, whole);
  known.files.push_back(file);
  known.texts.push_back(std::move(text));
  known.original_texts.push_back(original);
  known.reviews.push_back(std::move(whole));
}

std::string format_mark(const ReviewMark& mark, const std::vector<std::string>& parts) {
  std::vector<std::string> entries = {yaml_entry("mark", word_of(mark.verdict))};
  const auto locked = texts_of(mark.locked_bands, [&](std::size_t k) { return parts[k]; });
  if (!locked.empty()) entries.push_back(yaml_entry("lock", yaml_flow_list_of_names(locked)));
  if (mark.note) entries.push_back(yaml_entry("note", write_scalar(*mark.note)));
  return yaml_entry(write_scalar(mark.id), yaml_flow_map(entries));
}

}  // namespace

bool is_sampled_face_id(const std::string& id, const Config& config) {
  const std::string start = concat(config.crowd.name, '_');
  if (!id.starts_with(start)) return false;
  const auto index = parse_unsigned(std::string_view(id).substr(start.size()));
  return index && *index >= 1 && *index <= config.crowd.count &&
         id == face_id(config.crowd.name, *index);
}

bool is_face_id(const std::string& id, const Config& config) {
  return is_sampled_face_id(id, config) || contains(named_ids(config), id);
}

std::vector<std::size_t> read_locked_bands(const YamlNode& node, ConfigDraft& draft) {
  std::vector<std::size_t> locked;
  std::vector<std::string> names = draft.config.regions.names;
  for (const std::string& band : draft.config.plan_names().bands) names.push_back(band);
  const bool banded = names.size() > draft.config.regions.names.size();
  if (node.kind != YamlNode::Kind::kList || node.items.empty()) {
    draft.complaints.add_mismatch(node, "a list of regions or bands to keep, [top]");
    return locked;
  }
  for (const YamlNode& item : node.items) {
    const bool of_both =
        item.kind == YamlNode::Kind::kScalar && item.text.find('/') != item.text.npos;
    const auto name = of_both ? std::optional(item.text) : read_name(item, draft.complaints);
    if (!name) continue;
    const std::vector<std::size_t> found =
        names.empty() ? std::vector<std::size_t>() : find_region_bands(*name, draft.config);
    if (found.empty() && draft.are_regions_known) {
      draft.complaints.add_at(
          item, names.empty()
                    ? "the config has no regions, so nothing can be locked"
                    : concat(banded ? "no region or band is called " : "no region is called ",
                             quoted(*name), suggestion_or_choices(*name, names)));
    }
    locked.insert(locked.end(), found.begin(), found.end());
  }
  std::ranges::sort(locked);
  locked.erase(std::unique(locked.begin(), locked.end()), locked.end());
  if (!names.empty() && locked.size() == draft.config.region_band_names().size()) {
    draft.complaints.add_at(
        node, "every region is locked, so nothing is left to redraw; unlock at least one");
  }
  return locked;
}

void read_review(const YamlNode& node, Config& config, ConfigDraft& draft) {
  const auto read_one = [&](const YamlNode& item) {
    if (const auto file = path("a review file").read(item, draft)) {
      add_review(*file, item, config, draft);
    }
  };
  if (node.kind != YamlNode::Kind::kList) return read_one(node);
  for (const YamlNode& item : node.items) read_one(item);
}

std::string write_review(const Config& config, const WriteContext& context) {
  return list(path(""), "").write(config.review.files, context);
}

std::optional<FaceChange> parse_change(const std::string& id, std::string_view text,
                                       const Config& config, Problems& problems) {
  if (text == "{}") {
    FaceChange change;
    change.id = id;
    return change;
  }
  const Review review =
      parse_review(concat("schema: 1\nchanges: {", write_scalar(id), ": ", text, "}\n"), "change",
                   config, problems);
  return review.changes.empty() ? std::nullopt : std::optional(review.changes.front());
}

std::string format_review(const Review& review, const Config& config) {
  const std::vector<std::string> parts = config.region_band_names();
  std::vector<std::string> entries = {"schema: 1"};
  if (review.reviewed_face_count) entries.push_back(concat("count: ", *review.reviewed_face_count));
  if (review.review_count_seen_by_reviewer)
    entries.push_back(concat("after: ", *review.review_count_seen_by_reviewer));
  if (review.min_distance_mm) {
    entries.push_back(concat("min_distance: ", *review.min_distance_mm, " mm"));
  }
  const auto marks =
      texts_of(review.marks, [&](const ReviewMark& mark) { return format_mark(mark, parts); });
  if (!marks.empty()) entries.push_back(yaml_entry("faces", yaml_block_map(marks)));
  if (!review.changes.empty()) {
    entries.push_back(yaml_entry("changes", write_changes(review.changes, {config, {}})));
  }
  if (marks.empty() && review.changes.empty()) entries.emplace_back("faces: {}");
  return yaml_block_map(entries).substr(1) + '\n';
}

Review parse_review(std::string_view text, const std::string& source, const Config& config,
                    Problems& problems) {
  Complaints complaints;
  ConfigDraft draft(complaints);
  draft.config = config;
  draft.are_heads_known = true;
  Review review = read_marks(parse_yaml(text, source, complaints), draft);
  complaints.report_to(problems);
  return review;
}

}  // namespace crowdface
