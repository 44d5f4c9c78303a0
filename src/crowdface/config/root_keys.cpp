// SPDX-License-Identifier: Apache-2.0
// The top-level keys of a config, and the keys of its simple sections: crowd, smoothing, blending,
// parts, textures, plane.
#include <algorithm>

#include "crowdface/blend/recipe_bounds.h"
#include "crowdface/cast/diversity.h"
#include "crowdface/config/config_keys.h"
#include "crowdface/config/starter_config.h"
#include "crowdface/config/traits_keys.h"
#include "crowdface/core/contains.h"

namespace crowdface {
namespace {

const Keys<Config::Crowd>& crowd_keys() {
  using Crowd = Config::Crowd;
  constexpr std::uint64_t kMaxCount = 1'000'000;
  static const Keys<Crowd> keys = {
      key("name", &Crowd::name, name(), "write the prefix of the faces' ids")
          .with_starter_lines([](const StarterFacts& facts) {
            return StarterLines{write_scalar(facts.crowd_name),
                                concat("ids start with it: ", facts.crowd_name, "_0001, …")};
          }),
      key("count", &Crowd::count, whole_number(0, kMaxCount), "write the number of faces to sample")
          .with_starter_lines({"24", "how many faces; a larger crowd starts with the same ones"}),
      key("seed", &Crowd::seed, whole_number(0, UINT64_MAX))
          .with_starter_lines({"1", "another number, another crowd"})};
  return keys;
}

const Keys<Config::Smoothing>& smoothing_keys() {
  using Smoothing = Config::Smoothing;
  constexpr double kMaxSizeMm = 10'000;
  static constexpr double kMinToleranceMm = 0.005;
  const auto is_held = [](double tolerance_mm, const YamlNode& node, ConfigDraft& draft) {
    if (tolerance_mm >= kMinToleranceMm) return true;
    draft.complaints.add_mismatch(node, concat("a length of at least ", kMinToleranceMm,
                                               " mm, the resolution of single precision"));
    return false;
  };
  static const Keys<Smoothing> keys = {
      key("max_size", &Smoothing::max_size_mm, positive_length(kMaxSizeMm)),
      key("max_iterations", &Smoothing::max_iterations, whole_number(1, kMaxIterations)),
      word_key("boundary", &Smoothing::boundary),
      word_key("operator", &Smoothing::operator_kind),
      word_key("levels", &Smoothing::levels),
      key("tolerance", &Smoothing::tolerance_mm, restricted(length(kMaxSizeMm), is_held))};
  return keys;
}

void check_smoothing(const YamlNode&, bool is_valid, ConfigDraft& draft) {
  draft.is_smoothing_known = is_valid;
}

const Keys<Config::Blending>& blending_keys() {
  static const Keys<Config::Blending> keys = {
      word_key("normalization", &Config::Blending::normalization),
      word_key("contacts", &Config::Blending::contacts)};
  return keys;
}

const Keys<Config::Textures>& textures_keys() {
  using Textures = Config::Textures;
  const auto are_sampled = [](const Textures& textures, const auto&) {
    return textures.colours == ColourWeights::kSampled;
  };
  static const Keys<Textures> keys = {
      word_key("blend", &Textures::blend).not_affecting_recipes(),
      key("size", &Textures::size, whole_number(16, 16384)).not_affecting_recipes(),
      key("formats", &Textures::formats,
          words<TextureFormat>("a list of formats, [png, jpeg, exr]"))
          .not_affecting_recipes(),
      word_key("colours", &Textures::colours).written_if(are_sampled),
      key("alike", &Textures::matching_tags, list(name(), "a list of tags, [female, male]"))
          .written_if(are_sampled)};
  return keys;
}

void check_textures(const YamlNode& node, bool, ConfigDraft& draft) {
  const Config::Textures& textures = draft.config.textures;
  const auto complain = [&](const char* key, const std::string& text) {
    const YamlEntry* entry = node.find(key);
    draft.complaints.add_at(entry != nullptr ? entry->value : node, text);
  };
  if (textures.colours == ColourWeights::kSampled && textures.blend != TextureBlend::kAuto) {
    complain("colours", "drawn requires textures.blend: auto");
  }
  if (textures.matching_tags && textures.colours != ColourWeights::kSampled) {
    complain("alike", "requires colours: drawn");
  }
  if (!textures.matching_tags || !draft.are_heads_known) return;
  for (const std::string& tag : *textures.matching_tags) {
    const bool known = std::ranges::any_of(draft.config.faces.tags,
                                           [&](const auto& tags) { return contains(tags, tag); });
    if (!known)
      complain("alike",
               concat("no head has the tag ", quoted(tag), known_tags(draft.config.faces)));
  }
}

using Plane = Config::Plane;

void read_anchors(const YamlNode& node, Plane& plane, ConfigDraft& draft) {
  draft.complaints.expect_map(node, "a mapping from heads to points, {head: [x, y]}");
  for (const YamlEntry& entry : node.entries) {
    const auto head = find_head(entry.key, entry.key_place, node.path, draft);
    const auto at = plane_point().read(entry.value, draft);
    if (head && at) plane.anchors[*head] = *at;
  }
}

std::string write_anchors(const Plane& plane, const WriteContext& context) {
  return yaml_block_map(texts_of(plane.anchors, [&](const auto& anchor) {
    return yaml_entry(context.head(anchor.first), plane_point().write(anchor.second, context));
  }));
}

const Keys<Plane>& plane_keys() {
  static const Keys<Plane> keys = {
      word_key("layout", &Plane::layout),
      Key<Plane>{"anchors", read_anchors, write_anchors}.with_accepted_values("`{head: [x, y]}`")};
  return keys;
}

/// Checks the section `plane`. If the section has `layout: manual`, it must give every head an
/// anchor; adds a complaint if any head has none.
void check_plane(const YamlNode& node, bool is_valid, ConfigDraft& draft) {
  const Config& config = draft.config;
  if (config.plane.layout != Layout::kManual || !draft.are_heads_known || !is_valid) return;
  std::vector<std::string> missing;
  for (std::size_t h = 0; h < config.faces.names.size(); ++h) {
    if (!config.plane.anchors.contains(static_cast<Eigen::Index>(h))) {
      missing.push_back(config.faces.names[h]);
    }
  }
  if (!missing.empty()) {
    draft.complaints.add_at(
        node.find("layout")->value,
        concat("manual needs an anchor for every head; missing in plane.anchors: ", join(missing)));
  }
}

using Parts = Config::Parts;

const Keys<Parts>& parts_keys() {
  const auto names = list(text("a material, a group or \"component N\""),
                          "a list of materials, groups or \"component N\"");
  static const Keys<Parts> keys = {
      word_key("shape", &Parts::shape), key("skin", &Parts::skin, names),
      key("rigid", &Parts::rigid, names), key("bound", &Parts::bound, names),
      key("together", &Parts::together,
          list(names, "a list of lists of materials, groups or \"component N\""))};
  return keys;
}

void read_parts(const YamlNode& node, Config& config, ConfigDraft& draft) {
  if (node.kind == YamlNode::Kind::kScalar) {
    const Words<bool> words = {{"auto", true}, {"none", false}};
    config.parts.follow_skin = read_choice(node, words, draft.complaints).value_or(true);
  } else {
    read_keys(node, parts_keys(), config.parts, draft);
  }
}

std::string write_parts(const Config& config, const WriteContext& context) {
  if (!config.parts.follow_skin) return "none";
  return yaml_block_map(write_keys(parts_keys(), config.parts, context));
}

/// Makes a key whose value is the path of an existing file, or `none`.
Key<Config> file_key(std::string_view name, std::filesystem::path Config::*member,
                     const std::string& expected) {
  return {name,
          [=](const YamlNode& node, Config& config, ConfigDraft& draft) {
            if (is_word(node, "none")) return;
            const auto file = path(expected).read(node, draft);
            if (file && expect_file(node, *file, draft)) config.*member = *file;
          },
          [=](const Config& config, const WriteContext& context) {
            const std::string file = path("").write(config.*member, context);
            return file.empty() ? "none" : file;
          }};
}

/// Adds a complaint about GLB meshes if textures are written only as EXR: GLB files contain their
/// textures, but cannot contain EXR.
void check_output(const YamlNode& node, bool is_valid, ConfigDraft& draft) {
  const Config& config = draft.config;
  const bool only_exr = std::ranges::all_of(
      config.textures.formats, [](TextureFormat format) { return format == TextureFormat::kExr; });
  if (!is_valid || !contains(config.output.meshes, MeshFormat::kGlb) || !only_exr) return;
  const YamlEntry* entry = node.find("meshes");
  draft.complaints.add_at(
      entry != nullptr ? entry->value : node,
      "GLB files cannot hold EXR textures; add png or jpeg to textures.formats");
}

/// Makes the key for the crowd's limits on measurements. Groups and families start from these
/// limits.
Key<Config> traits_key() {
  const Codec<TraitLimits> codec = trait_limits();
  return Key<Config>{"traits",
                     [=](const YamlNode& node, Config& config, ConfigDraft& draft) {
                       if (auto limits = codec.read(node, draft)) config.sampling->traits = *limits;
                     },
                     [=](const Config& config, const WriteContext& context) {
                       return codec.write(config.sampling->traits, context);
                     }};
}

Key<Config> trait_table_key(const char* name, Config::TraitTable Config::*table) {
  return Key<Config>{name,
                     [=](const YamlNode& node, Config& config, ConfigDraft& draft) {
                       const auto file =
                           path("a table of measurements, means and deviations").read(node, draft);
                       if (!file || !expect_file(node, *file, draft)) return;
                       if (table == &Config::population &&
                           config.diversity->mode != DiversityOptions::Mode::kFirstFit) {
                         draft.complaints.add_at(node, "requires diversity.mode: first_fit");
                       }
                       config.*table = {*file, read_trait_table(node, *file, draft)};
                     },
                     [=](const Config& config, const WriteContext& context) {
                       return path("").write((config.*table).file, context);
                     }};
}

/// Makes the key `landmarks`. The key is written only if it is set, so that the configs of older
/// crowds keep their bytes.
Key<Config> landmarks_key() {
  return file_key("landmarks", &Config::landmarks, "none, or a file of landmarks")
      .written_if([](const Config& config, const auto&) { return !config.landmarks.empty(); });
}

void read_schema(const YamlNode& node, Config&, ConfigDraft& draft) {
  if (node.kind == YamlNode::Kind::kScalar && !node.is_quoted && parse_unsigned(node.text) == 1U)
    return;
  draft.complaints.add_at(node, concat("this crowdface reads schema 1, found ", describe(node)));
}

/// Returns the default sampling options, with one region.
SamplingOptions one_region_sampling() {
  SamplingOptions sampling;
  sampling.regions.resize(1);
  return sampling;
}

}  // namespace

const Keys<Config>& root_keys() {
  static const Keys<Config> keys = {
      Key<Config>{"schema", read_schema, [](const auto&...) { return "1"; }, "write \"schema: 1\""}
          .with_starter_lines({"1"}),
      section_key("crowd", &Config::crowd, crowd_keys(),
                  "such as \"crowd: {name: market, count: 24}\"")
          .not_affecting_face_files(),
      faces_key().not_affecting_face_files(),
      regions_key().not_affecting_face_files(),
      section_key("smoothing", &Config::smoothing, smoothing_keys(), {}, check_smoothing),
      section_key("blending", &Config::blending, blending_keys()),
      Key<Config>{"parts", read_parts, write_parts}.with_nested_keys(parts_keys()),
      shapes_key().not_affecting_face_files().not_affecting_recipes(),
      file_key("points", &Config::points, "none, or a YAML file of points")
          .not_affecting_face_files()
          .not_affecting_recipes(),
      file_key("rig", &Config::rig, "none, or a GLB file with joints")
          .not_affecting_face_files()
          .not_affecting_recipes(),
      landmarks_key().not_affecting_face_files(),
      neck_key().not_affecting_face_files().not_affecting_recipes(),
      attachments_key().not_affecting_face_files(),
      section_key("textures", &Config::textures, textures_keys(), {}, check_textures),
      section_key("plane", &Config::plane, plane_keys(), {}, check_plane)
          .not_affecting_face_files(),
      section_key("sampling", &Config::sampling, sampling_keys())
          .with_nested_keys(sampling_keys(), one_region_sampling())
          .not_affecting_face_files(),
      section_key("distance", &Config::distance, distance_keys()).not_affecting_face_files(),
      section_key("diversity", &Config::diversity, diversity_keys()).not_affecting_face_files(),
      believability_key().not_affecting_face_files(),
      traits_key().not_affecting_face_files(),
      trait_table_key("population", &Config::population).not_affecting_face_files(),
      trait_table_key("quantiles_of", &Config::quantile_table)
          .not_affecting_face_files()
          .written_if([](const Config& config, const auto&) {
            return !config.quantile_table.file.empty();
          }),
      groups_key().not_affecting_face_files(),
      recipes_key().not_affecting_face_files(),
      families_key().not_affecting_face_files(),
      changes_key().not_affecting_face_files().not_affecting_recipes(),
      Key<Config>{"review", read_review, write_review}
          .not_affecting_face_files()
          .not_affecting_recipes(),
      // read_edits merges the file of edits into the config before any key is read.
      {"edits", [](const auto&...) {}, [](const auto&...) { return ""; }},
      section_key("output", &Config::output, output_keys(), {}, check_output)
          .not_affecting_recipes()};
  return keys;
}

std::string one_line_text(std::string_view value) {
  // A value that applies to all regions is written as a mapping with the key `default`.
  constexpr std::string_view kEverywhere = "\ndefault: ";
  if (value.starts_with(kEverywhere)) value.remove_prefix(kEverywhere.size());
  return std::string(value);
}

std::vector<KeyRow> config_key_rows() {
  std::vector<KeyRow> rows = key_rows("", root_keys(), Config{});
  std::erase_if(rows, [](const KeyRow& row) { return row.accepted_values.empty(); });
  return rows;
}

std::set<std::string> keys_not_affecting_recipes() {
  std::set<std::string> paths;
  for (const KeyRow& row : key_rows("", root_keys(), Config{})) {
    if (row.affects_recipes) continue;
    paths.insert(row.section.empty() ? row.key : concat(row.section, '.', row.key));
  }
  return paths;
}

std::string effective_config(const Config& config, const std::filesystem::path& directory) {
  const WriteContext context = {config,
                                std::filesystem::absolute(directory / "").lexically_normal()};
  return yaml_block_map(write_keys(root_keys(), config, context)).substr(1) + '\n';
}

std::string face_settings_yaml(const Config& config) {
  return yaml_block_map(write_keys(
      root_keys(), config,
      {.config = config, .folder = {}, .written_keys = WriteContext::WrittenKeys::kFaces}));
}

std::string plan_settings_yaml(const Config& config, const std::filesystem::path& directory) {
  WriteContext context = {config, std::filesystem::absolute(directory / "").lexically_normal()};
  const std::string changes = changes_key().write(config, context);
  context.written_keys = WriteContext::WrittenKeys::kPlan;
  return yaml_block_map(write_keys(root_keys(), config, context)) + changes;
}

}  // namespace crowdface
