// SPDX-License-Identifier: Apache-2.0
// The sections with plain values: crowd, smoothing, blending, plane, output; and looking up names.
#include <algorithm>

#include "crowdface/blend/recipe_bounds.h"
#include "crowdface/config/config_keys.h"

namespace crowdface {
namespace {

constexpr std::uint64_t kMaxCount = 1'000'000;
constexpr double kMaxSizeMm = 10'000;
constexpr double kLeastToleranceMm = 0.005;

void read_anchors(const YamlNode* node, ConfigDraft& draft) {
  if (node == nullptr) return;
  if (!draft.complaints.expect_map(*node, "a mapping from heads to points, {head: [x, y]}")) return;
  for (const YamlEntry& entry : node->entries) {
    const auto head = find_head(entry.key, entry.key_place, node->path, draft);
    const auto point = read_point(entry.value, draft.complaints);
    if (head && point) draft.config.plane.anchors[*head] = *point;
  }
}

/// A layout by hand leaves no head without its place.
void check_manual_anchors(const YamlNode& node, const YamlNode* anchors, ConfigDraft& draft) {
  if (!draft.heads_known) return;
  std::vector<std::string> missing;
  for (const std::string& name : draft.config.faces.names) {
    if (anchors == nullptr || anchors->find(name) == nullptr) missing.push_back(name);
  }
  if (!missing.empty()) {
    draft.complaints.about(
        node,
        concat("manual needs an anchor for every head; missing in plane.anchors: ", join(missing)));
  }
}

void read_meshes(const YamlNode* node, ConfigDraft& draft) {
  if (node == nullptr) return;
  if (!draft.complaints.expect_list(*node, "a list, such as [obj], or [] for no meshes")) return;
  draft.config.output.meshes =
      read_choices(*node, words_by_name(all_mesh_formats()), draft.complaints);
}

std::optional<double> read_tolerance(const YamlNode& node, ConfigDraft& draft) {
  const auto length = read_length_mm(node, kMaxSizeMm, draft.complaints);
  if (length && *length < kLeastToleranceMm) {
    draft.complaints.expected(node, concat("a length of at least ", kLeastToleranceMm,
                                           " mm, what single precision can hold"));
  }
  return length;
}

}  // namespace

std::filesystem::path resolve(const std::filesystem::path& folder, const std::string& path) {
  std::filesystem::path resolved = (folder / path).lexically_normal();
  return resolved.has_filename() ? resolved : resolved.parent_path();  // no '/' at the end
}

bool file_exists(const std::filesystem::path& path) {
  std::error_code ignored;
  return std::filesystem::exists(path, ignored);
}

std::optional<Eigen::Index> find_head(const std::string& name, const YamlPlace& place,
                                      const std::string& path, ConfigDraft& draft) {
  const auto& names = draft.config.faces.names;
  const auto found = std::find(names.begin(), names.end(), name);
  if (found != names.end()) return found - names.begin();
  if (draft.heads_known) {
    draft.complaints.add(
        place, concat(path, ": no head is called ", quoted(name), suggestion(name, names)));
  }
  return std::nullopt;
}

std::vector<Eigen::Index> find_heads(const std::string& name, const YamlPlace& place,
                                     const std::string& path, ConfigDraft& draft) {
  std::vector<Eigen::Index> heads;
  std::vector<std::string> known = draft.config.faces.names;
  const auto& tags = draft.config.faces.tags;
  for (std::size_t i = 0; i < known.size(); ++i) {
    const bool tagged =
        i < tags.size() && std::find(tags[i].begin(), tags[i].end(), name) != tags[i].end();
    if (known[i] == name || tagged) heads.push_back(static_cast<Eigen::Index>(i));
  }
  if (heads.empty() && draft.heads_known && draft.tags_known) {
    for (const auto& of_head : tags) known.insert(known.end(), of_head.begin(), of_head.end());
    draft.complaints.add(place, concat(path, ": no head and no tag is called ", quoted(name),
                                       suggestion(name, known)));
  }
  return heads;
}

const Keys<Config::Crowd>& crowd_keys() {
  using Crowd = Config::Crowd;
  static const Keys<Crowd> keys = {
      key(
          "name", &Crowd::name,
          [](const YamlNode& node, ConfigDraft& draft) {
            return read_name(node, draft.complaints);
          },
          write_scalar, "what the faces' ids start with"),
      whole_key("count", &Crowd::count, 0, kMaxCount, "how many faces are sampled"),
      whole_key("seed", &Crowd::seed, 0, UINT64_MAX)};
  return keys;
}

const Keys<Config::Smoothing>& smoothing_keys() {
  using Smoothing = Config::Smoothing;
  static const Keys<Smoothing> keys = {
      {"max_size",
       [](const YamlNode& node, Smoothing& smoothing, ConfigDraft& draft) {
         const std::size_t complaints_before = draft.complaints.size();
         read_positive_mm(node, kMaxSizeMm, smoothing.max_size_mm, draft.complaints);
         draft.largest_size_mm = smoothing.max_size_mm;
         if (draft.complaints.size() != complaints_before) draft.largest_size_mm.reset();
       },
       [](const Smoothing& smoothing, const auto&) { return write_mm(smoothing.max_size_mm); }},
      {"max_iterations",
       [](const YamlNode& node, Smoothing& smoothing, ConfigDraft& draft) {
         smoothing.max_iterations = read_whole(node, 1, kMaxIterations, draft.complaints);
         draft.most_iterations = smoothing.max_iterations;
         draft.largest_size_mm.reset();  // how long a size it makes depends on the mesh
       },
       [](const Smoothing& smoothing, const auto&) {
         return smoothing.max_iterations ? concat(*smoothing.max_iterations) : "";
       }},
      word_key("boundary", &Smoothing::boundary),
      word_key("operator", &Smoothing::operator_kind),
      word_key("levels", &Smoothing::levels),
      key("tolerance", &Smoothing::tolerance_mm, read_tolerance, write_mm)};
  return keys;
}

const Keys<Config::Blending>& blending_keys() {
  static const Keys<Config::Blending> keys = {
      word_key("normalization", &Config::Blending::normalization)};
  return keys;
}

void read_plane(const YamlNode* node, ConfigDraft& draft) {
  const MapReader map(node, {"layout", "anchors"}, draft.complaints);
  const YamlNode* anchors = map.find("anchors");
  read_anchors(anchors, draft);
  const YamlNode* layout = map.find("layout");
  if (layout == nullptr) return;
  read_choice_into(layout, draft.config.plane.layout, draft.complaints);
  if (draft.config.plane.layout == Layout::kManual) check_manual_anchors(*layout, anchors, draft);
}

void read_output(const YamlNode* node, ConfigDraft& draft) {
  const MapReader map(node, {"directory", "meshes", "contact_sheet", "gallery", "surfaces"},
                      draft.complaints);
  draft.config.output.directory = resolve(draft.folder, concat("out/", draft.config.crowd.name));
  if (const YamlNode* directory = map.find("directory")) {
    const auto text = read_text(*directory, "a folder", draft.complaints);
    if (text) draft.config.output.directory = resolve(draft.folder, *text);
  }
  read_meshes(map.find("meshes"), draft);
  read_contact_sheet(map.find("contact_sheet"), draft);
  read_surfaces(map.find("surfaces"), draft);
  read_choice_into(map.find("gallery"), draft.config.output.gallery, draft.complaints);
}

}  // namespace crowdface
