// SPDX-License-Identifier: Apache-2.0
// The sections with plain values: crowd, smoothing, blending, plane, output; and looking up names.
#include <algorithm>
#include <set>

#include "crowdface/blend/recipe_bounds.h"
#include "crowdface/config/config_sections.h"
#include "crowdface/core/text.h"

namespace crowdface {
namespace {

constexpr std::uint64_t kMaxCount = 1'000'000;
constexpr double kMaxSizeMm = 10'000;
constexpr double kLeastToleranceMm = 0.005;

void read_anchors(const YamlNode* node, ConfigDraft& draft) {
  if (node == nullptr) return;
  if (node->kind != YamlNode::Kind::kMap) {
    draft.complaints.expected(*node, "a mapping from heads to points, {head: [x, y]}");
    return;
  }
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
  if (node->kind != YamlNode::Kind::kList) {
    draft.complaints.expected(*node, "a list, such as [obj], or [] for no meshes");
    return;
  }
  Choices<MeshFormat> choices;
  for (const MeshFormat format : all_mesh_formats()) choices.emplace_back(name_of(format), format);
  std::vector<MeshFormat>& meshes = draft.config.output.meshes;
  meshes.clear();
  for (const YamlNode& item : node->items) {
    const auto format = read_choice(item, choices, draft.complaints);
    if (!format) continue;
    if (std::find(meshes.begin(), meshes.end(), *format) != meshes.end()) {
      draft.complaints.about(item, concat(quoted(item.text), " is named twice"));
    }
    meshes.push_back(*format);
  }
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

void read_crowd(const YamlNode* node, ConfigDraft& draft) {
  Config::Crowd& crowd = draft.config.crowd;
  const MapReader map(node, {"name", "count", "seed"}, draft.complaints);
  if (const YamlNode* name = map.require("name", "what the faces' ids start with")) {
    crowd.name = read_name(*name, draft.complaints).value_or("");
  }
  if (const YamlNode* count = map.require("count", "how many faces are sampled")) {
    crowd.count = read_whole(*count, 0, kMaxCount, draft.complaints).value_or(0);
  }
  if (const YamlNode* seed = map.find("seed")) {
    crowd.seed = read_whole(*seed, 0, UINT64_MAX, draft.complaints).value_or(1);
  }
}

void read_smoothing(const YamlNode* node, ConfigDraft& draft) {
  Config::Smoothing& smoothing = draft.config.smoothing;
  const MapReader map(node,
                      {"max_size", "max_iterations", "boundary", "operator", "levels", "tolerance"},
                      draft.complaints);
  draft.largest_size_mm = smoothing.max_size_mm;
  if (const YamlNode* size = map.find("max_size")) {
    const auto length = read_length_mm(*size, kMaxSizeMm, draft.complaints);
    if (length == 0.0) draft.complaints.expected(*size, "a length above 0 mm");
    if (length) smoothing.max_size_mm = *length;
    draft.largest_size_mm = length;
  }
  if (const YamlNode* iterations = map.find("max_iterations")) {
    smoothing.max_iterations = read_whole(*iterations, 1, kMaxIterations, draft.complaints);
    draft.most_iterations = smoothing.max_iterations;
    draft.largest_size_mm.reset();  // how long a size it makes depends on the mesh
  }
  if (const YamlNode* boundary = map.find("boundary")) {
    const Choices<Boundary> choices = {{"fixed", Boundary::kFixed}, {"free", Boundary::kFree}};
    smoothing.boundary =
        read_choice(*boundary, choices, draft.complaints).value_or(Boundary::kFixed);
  }
  if (const YamlNode* kind = map.find("operator")) {
    const Choices<OperatorKind> choices = {{"umbrella", OperatorKind::kUmbrella},
                                           {"lazy", OperatorKind::kLazy}};
    smoothing.operator_kind =
        read_choice(*kind, choices, draft.complaints).value_or(OperatorKind::kUmbrella);
  }
  if (const YamlNode* levels = map.find("levels")) {
    const Choices<Levels> choices = {
        {"basis", Levels::kBasis}, {"exact", Levels::kExact}, {"cubic", Levels::kCubic}};
    smoothing.levels = read_choice(*levels, choices, draft.complaints).value_or(Levels::kBasis);
  }
  if (const YamlNode* tolerance = map.find("tolerance")) {
    const auto length = read_length_mm(*tolerance, kMaxSizeMm, draft.complaints);
    if (length && *length < kLeastToleranceMm) {
      draft.complaints.expected(*tolerance, concat("a length of at least ", kLeastToleranceMm,
                                                   " mm, what single precision can hold"));
    }
    if (length) smoothing.tolerance_mm = *length;
  }
}

void read_blending(const YamlNode* node, ConfigDraft& draft) {
  const MapReader map(node, {"normalization"}, draft.complaints);
  const YamlNode* normalization = map.find("normalization");
  if (normalization == nullptr) return;
  const Choices<Normalization> choices = {{"partition", Normalization::kPartition},
                                          {"printed", Normalization::kPrinted}};
  draft.config.blending.normalization =
      read_choice(*normalization, choices, draft.complaints).value_or(Normalization::kPartition);
}

void read_plane(const YamlNode* node, ConfigDraft& draft) {
  const MapReader map(node, {"layout", "anchors"}, draft.complaints);
  const YamlNode* anchors = map.find("anchors");
  read_anchors(anchors, draft);
  const YamlNode* layout = map.find("layout");
  if (layout == nullptr) return;
  const Choices<Layout> choices = {{"circle", Layout::kCircle},
                                   {"grid", Layout::kGrid},
                                   {"similarity", Layout::kSimilarity},
                                   {"manual", Layout::kManual}};
  draft.config.plane.layout =
      read_choice(*layout, choices, draft.complaints).value_or(Layout::kCircle);
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
  if (const YamlNode* gallery = map.find("gallery")) {
    const Choices<Gallery> choices = {{"auto", Gallery::kAuto}, {"none", Gallery::kNone}};
    draft.config.output.gallery =
        read_choice(*gallery, choices, draft.complaints).value_or(Gallery::kAuto);
  }
}

}  // namespace crowdface
