// SPDX-License-Identifier: Apache-2.0
#include "crowdface/config/config_writer.h"

#include <algorithm>
#include <array>

#include "crowdface/config/yaml.h"
#include "crowdface/core/text.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;

std::string flow_list(const std::vector<std::string>& items) {
  return concat('[', join(items), ']');
}

std::string flow_map(const std::vector<std::string>& entries) {
  return concat('{', join(entries), '}');
}

std::string flow_names(const std::vector<std::string>& names) {
  std::vector<std::string> items;
  for (const std::string& name : names) items.push_back(write_scalar(name));
  return flow_list(items);
}

std::string flow_point(const PlanePoint& point) {
  return flow_list({format_number(point.x()), format_number(point.y())});
}

/// One value, or [low, high]; `write` writes one of them.
template <class Write>
std::string flow_range(const Range& range, const Write& write) {
  if (range.low == range.high) return write(range.low);
  return flow_list({write(range.low), write(range.high)});
}

std::string flow_factor(const Range& range) {
  return flow_range(range, [](double value) { return format_number(value); });
}

std::string mm(double value) {
  return concat(value, " mm");
}

std::string flow_amount(const SmoothnessDistribution& smoothness) {
  using Unit = SmoothnessDistribution::Unit;
  switch (smoothness.unit) {
    case Unit::kSize:
      return flow_range(smoothness.range, mm);
    case Unit::kIterations:  // as integers: 1e+07 is no whole number to the reader
      return flow_range(smoothness.range,
                        [](double value) { return concat(static_cast<std::uint64_t>(value)); });
    case Unit::kFraction:
      break;
  }
  return flow_factor(smoothness.range);
}

/// Writes the sections, one function each.
class Writer {
 public:
  Writer(const Config& config, const fs::path& directory)
      : config_(config), directory_(fs::absolute(directory / "").lexically_normal()) {}

  std::string write() {
    line("schema: 1");
    write_crowd();
    write_faces();
    write_regions();
    write_methods();
    write_sampling();
    write_casting();
    write_recipes();
    write_families();
    write_reviews();
    write_output();
    return std::move(text_);
  }

 private:
  template <class... Parts>
  void line(const Parts&... parts) {
    text_ += concat(parts..., '\n');
  }

  const std::string& head(Eigen::Index index) const {
    return config_.faces.names[static_cast<std::size_t>(index)];
  }
  std::string head_key(Eigen::Index index) const { return write_scalar(head(index)); }

  std::string path(const fs::path& file) const {
    const fs::path absolute = fs::absolute(file).lexically_normal();
    const fs::path relative = absolute.lexically_relative(directory_);
    return write_scalar(relative.empty() ? absolute.string() : relative.string());
  }

  void write_crowd() {
    line("crowd:");
    line("  name: ", write_scalar(config_.crowd.name));
    line("  count: ", config_.crowd.count);
    line("  seed: ", config_.crowd.seed);
  }

  void write_faces() {
    const Config::Faces& faces = config_.faces;
    line("faces:");
    line("  files:");
    for (const fs::path& file : faces.files) line("    - ", path(file));
    line("  units: ", name_of(faces.units));
    line("  up: ", name_of(faces.up));
    line("  front: ", name_of(faces.front));
    line("  align: ", faces.align == Align::kCheck   ? "check"
                      : faces.align == Align::kRigid ? "rigid"
                                                     : "none");
    const bool tagged = std::any_of(faces.tags.begin(), faces.tags.end(),
                                    [](const auto& tags) { return !tags.empty(); });
    line(tagged ? "  tags:" : "  tags: {}");
    for (std::size_t i = 0; i < faces.tags.size(); ++i) {
      if (faces.tags[i].empty()) continue;
      line("    ", write_scalar(faces.names[i]), ": ", flow_names(faces.tags[i]));
    }
  }

  void write_regions() {
    const Config::Regions& regions = config_.regions;
    if (regions.names.empty()) return line("regions: none");
    line("regions:");
    line("  names: ", flow_names(regions.names));
    line("  mask:");
    for (const std::string& mask : regions.mask) line("    - ", path(mask));
  }

  void write_methods() {
    const Config::Smoothing& smoothing = config_.smoothing;
    line("smoothing:");
    line("  max_size: ", mm(smoothing.max_size_mm));
    if (smoothing.max_iterations) line("  max_iterations: ", *smoothing.max_iterations);
    line("  boundary: ", smoothing.boundary == Boundary::kFixed ? "fixed" : "free");
    line("  operator: ", smoothing.operator_kind == OperatorKind::kUmbrella ? "umbrella" : "lazy");
    line("  levels: ", levels_name(smoothing.levels));
    line("  tolerance: ", mm(smoothing.tolerance_mm));
    line("blending:");
    line("  normalization: ",
         config_.blending.normalization == Normalization::kPartition ? "partition" : "printed");
    write_parts();
    line("plane:");
    line("  layout: ", layout_name(config_.plane.layout));
    line(config_.plane.anchors.empty() ? "  anchors: {}" : "  anchors:");
    for (const auto& [index, anchor] : config_.plane.anchors) {
      line("    ", head_key(index), ": ", flow_point(anchor));
    }
  }

  void write_parts() {
    const Config::Parts& parts = config_.parts;
    if (!parts.follow) return line("parts: none");
    line("parts:");
    line("  shape: ", parts.shape == PartShape::kBlend ? "blend" : "target");
    line("  skin: ", flow_names(parts.skin));
    line("  rigid: ", flow_names(parts.rigid));
    line("  bound: ", flow_names(parts.bound));
    std::vector<std::string> together;
    for (const auto& names : parts.together) together.push_back(flow_names(names));
    line("  together: ", flow_list(together));
  }

  static std::string_view levels_name(Levels levels) {
    switch (levels) {
      case Levels::kExact:
        return "exact";
      case Levels::kCubic:
        return "cubic";
      case Levels::kBasis:
        break;
    }
    return "basis";
  }

  static std::string_view layout_name(Layout layout) {
    switch (layout) {
      case Layout::kGrid:
        return "grid";
      case Layout::kSimilarity:
        return "similarity";
      case Layout::kManual:
        return "manual";
      case Layout::kCircle:
        break;
    }
    return "circle";
  }

  std::string flow_targets() const {
    const auto& targets = config_.sampling.targets;
    const bool weighted = std::any_of(targets.begin(), targets.end(),
                                      [](const WeightedHead& t) { return t.weight != 1; });
    if (!weighted && targets.size() == config_.faces.names.size()) return "all";
    std::vector<std::string> items;
    for (const WeightedHead& target : targets) {
      items.push_back(weighted ? concat(head_key(target.head), ": ", target.weight)
                               : head_key(target.head));
    }
    return weighted ? flow_map(items) : flow_list(items);
  }

  std::string flow_sources() const {
    const auto& sources = config_.sampling.sources;
    if (sources.size() == config_.faces.names.size()) return "all";
    std::vector<std::string> items;
    for (const Eigen::Index source : sources) items.push_back(head_key(source));
    return flow_list(items);
  }

  std::string flow_position(const PositionDistribution& position) const {
    using Kind = PositionDistribution::Kind;
    switch (position.kind) {
      case Kind::kAround:
        return flow_map({"distribution: around",
                         concat("face: ", position.head ? head_key(*position.head) : "target"),
                         concat("radius: ", position.radius)});
      case Kind::kFixed:
        return flow_map({"distribution: fixed", concat("position: ", flow_point(position.at))});
      case Kind::kUniform:
        return flow_map({"distribution: uniform"});
      case Kind::kAnchored:
        break;
    }
    return flow_map({"distribution: anchored", concat("pull: ", position.pull)});
  }

  /// One line a region; without regions the one line is called `default`.
  template <class Write>
  void write_per_region(const std::string& key, const Write& write) {
    line("  ", key, ":");
    for (std::size_t i = 0; i < config_.sampling.regions.size(); ++i) {
      const std::string name =
          config_.regions.names.empty() ? "default" : write_scalar(config_.regions.names[i]);
      line("    ", name, ": ", write(config_.sampling.regions[i]));
    }
  }

  void write_sampling() {
    line("sampling:");
    line("  targets: ", flow_targets());
    line("  sources: ", flow_sources());
    write_per_region("position",
                     [&](const RegionSampling& r) { return flow_position(r.position); });
    write_per_region("smoothness", [](const RegionSampling& r) {
      const std::string amount = flow_amount(r.smoothness);
      return r.smoothness.unit == SmoothnessDistribution::Unit::kIterations
                 ? flow_map({concat("iterations: ", amount)})
                 : amount;
    });
    write_per_region("extrapolation",
                     [](const RegionSampling& r) { return flow_factor(r.extrapolation); });
    const auto& most = config_.sampling.max_sources;
    line("  max_sources: ", most ? concat(*most) : "all");
    line("  age: ", flow_factor(config_.sampling.age));
  }

  void write_casting() {
    line("distance:");
    line("  area: ", config_.distance.area == FaceArea::kFront ? "front" : "skin");
    if (config_.distance.mask) line("  mask: ", path(*config_.distance.mask));
    const DiversityOptions& diversity = config_.diversity;
    line("diversity:");
    line("  mode: ", diversity.mode == DiversityOptions::Mode::kSpread ? "spread" : "first_fit");
    line("  min_distance: ", mm(diversity.min_distance_mm));
    line("  min_distance_to_faces: ", mm(diversity.min_distance_to_faces_mm));
    line("  max_weight: ", diversity.max_weight);
    std::vector<std::string> quotas;
    for (const Quota& quota : diversity.quotas) {
      quotas.push_back(concat(write_scalar(quota.name), ": ", quota.share));
    }
    line("  quotas: ", flow_map(quotas));
    if (diversity.candidates) line("  candidates: ", *diversity.candidates);
    line("  pool: ", diversity.pool);
    line("  max_attempts: ", diversity.max_attempts);
    const BelievabilityOptions& believability = config_.believability;
    if (!believability.check) return line("believability: none");
    line("believability:");
    line("  max_deviation: ", believability.max_deviation);
    line("  max_stretch: ", believability.max_stretch);
    line("  max_flipped: ", believability.max_flipped);
    line("  max_intersecting: ", believability.max_intersecting);
    using Meshes = BelievabilityOptions::Meshes;
    line("  meshes: ", believability.meshes == Meshes::kAll     ? "all"
                       : believability.meshes == Meshes::kNone  ? "none"
                       : believability.meshes == Meshes::kJudge ? "judge"
                                                                : "auto");
  }

  std::string flow_recipe_region(const HandRecipe::Region& region) const {
    std::vector<std::string> entries;
    if (region.position) entries.push_back(concat("position: ", flow_point(*region.position)));
    std::vector<std::string> weights;
    for (const WeightedHead& weight : region.weights) {
      weights.push_back(concat(head_key(weight.head), ": ", weight.weight));
    }
    if (!weights.empty()) entries.push_back(concat("weights: ", flow_map(weights)));
    if (region.smoothness) {
      const bool iterations = region.smoothness->unit == SmoothnessDistribution::Unit::kIterations;
      entries.push_back(
          concat(iterations ? "iterations: " : "smoothness: ", flow_amount(*region.smoothness)));
    }
    if (region.extrapolation) {
      entries.push_back(concat("extrapolation: ", flow_factor(*region.extrapolation)));
    }
    return flow_map(entries);
  }

  void write_recipes() {
    line(config_.recipes.empty() ? "recipes: []" : "recipes:");
    const std::vector<std::string> names = config_.region_names();
    for (const HandRecipe& recipe : config_.recipes) {
      line("  - id: ", write_scalar(recipe.id));
      if (recipe.target) line("    target: ", head_key(*recipe.target));
      if (recipe.age) line("    age: ", flow_factor(*recipe.age));
      line("    regions:");
      for (std::size_t i = 0; i < names.size(); ++i) {
        line("      ", write_scalar(names[i]), ": ", flow_recipe_region(recipe.regions[i]));
      }
    }
  }

  void write_families() {
    line(config_.families.empty() ? "families: []" : "families:");
    const std::vector<std::string> names = config_.region_names();
    for (const FamilyOptions& family : config_.families) {
      line("  - name: ", write_scalar(family.name));
      line("    members: ", family.members);
      if (family.target) line("    target: ", head_key(*family.target));
      if (!family.parents.empty()) {
        const auto parent = [&](std::size_t p) { return write_scalar(family.parents[p].id); };
        line("    parents: ",
             flow_map({concat("mother: ", parent(0)), concat("father: ", parent(1))}));
        std::vector<std::string> inherit;
        for (std::size_t k = 0; k < names.size(); ++k) {
          const int from = family.inherit[k];
          inherit.push_back(concat(write_scalar(names[k]), ": ",
                                   from < 0    ? "drawn"
                                   : from == 0 ? "mother"
                                               : "father"));
        }
        line("    inherit: ", flow_map(inherit));
      }
      line("    max_distance: ", mm(family.max_distance_mm));
      line("    min_distance: ", mm(family.min_distance_mm));
      line("    age: ", flow_factor(family.age));
    }
  }

  void write_reviews() {
    std::vector<std::string> files;
    for (const fs::path& file : config_.review.files) files.push_back(path(file));
    line("review: ", flow_list(files));
  }

  static std::string view_name(View view) {
    switch (view) {
      case View::kThreeQuarter:
        return "three_quarter";
      case View::kProfile:
        return "profile";
      case View::kFront:
        break;
    }
    return "front";
  }

  static std::string surface_word(const SurfaceChoice& surface) {
    constexpr std::array kKinds = {"skin", "eye", "iris", "teeth", "gums", "hidden"};
    if (!surface.colour) return kKinds[static_cast<std::size_t>(surface.kind)];
    constexpr std::string_view kDigits = "0123456789abcdef";
    std::string text = "\"#";
    for (const std::uint8_t value : *surface.colour) {
      text += kDigits[value >> 4U];
      text += kDigits[value & 15U];
    }
    return text + '"';
  }

  void write_sheet_details(const Config::ContactSheet& sheet) {
    using With = Config::Comparison::With;
    constexpr std::array kLabels = {"id", "family", "target", "nearest", "nearest_head"};
    constexpr std::array kOrders = {"plan", "family", "likeness"};
    constexpr std::array kFormats = {"png", "exr", "pdf"};
    constexpr std::array kWith = {"none", "target", "nearest"};
    std::vector<std::string> labels, formats;
    for (const SheetLabel label : sheet.labels) {
      labels.emplace_back(kLabels[static_cast<std::size_t>(label)]);
    }
    for (const SheetFormat format : sheet.formats) {
      formats.emplace_back(kFormats[static_cast<std::size_t>(format)]);
    }
    line("    labels: ", flow_list(labels));
    line("    order: ", kOrders[static_cast<std::size_t>(sheet.order)]);
    line("    compare: ", sheet.compare.with == With::kFile
                              ? path(sheet.compare.file)
                              : kWith[static_cast<std::size_t>(sheet.compare.with)]);
    line("    compare_scale: ", sheet.compare.scale_mm, " mm");
    line("    formats: ", flow_list(formats));
    line("    texture: ", sheet.texture ? "true" : "false");
  }

  void write_output() {
    line("output:");
    line("  directory: ", path(config_.output.directory));
    std::vector<std::string> meshes;
    for (const MeshFormat format : config_.output.meshes) meshes.emplace_back(name_of(format));
    line("  meshes: ", flow_list(meshes));
    line("  gallery: ", config_.output.gallery == Gallery::kAuto ? "auto" : "none");
    std::vector<std::string> surfaces;
    for (const auto& [name, surface] : config_.output.surfaces) {
      surfaces.push_back(concat(write_scalar(name), ": ", surface_word(surface)));
    }
    line("  surfaces: ", flow_map(surfaces));
    const auto& sheet = config_.output.contact_sheet;
    if (!sheet) return line("  contact_sheet: none");
    line("  contact_sheet:");
    line("    columns: ", sheet->columns);
    line("    rows: ", sheet->rows);
    line("    cell: ", sheet->cell);
    std::vector<std::string> views;
    for (const View view : sheet->views) views.push_back(view_name(view));
    line("    views: ", flow_list(views));
    write_sheet_details(*sheet);
  }

  const Config& config_;
  fs::path directory_;
  std::string text_;
};

}  // namespace

std::string effective_config(const Config& config, const fs::path& directory) {
  return Writer(config, directory).write();
}

}  // namespace crowdface
