// SPDX-License-Identifier: Apache-2.0
#include "crowdface/config/config_writer.h"

#include <algorithm>

#include "crowdface/config/config_keys.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;

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

std::string flow_amount(const SmoothnessDistribution& smoothness) {
  using Unit = SmoothnessDistribution::Unit;
  switch (smoothness.unit) {
    case Unit::kSize:
      return flow_range(smoothness.range, write_mm);
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
    write_section("crowd", crowd_keys(), config_.crowd);
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

  std::string path(const fs::path& file) const { return write_path(file, directory_); }

  template <class Section>
  void write_keys(std::string_view indent, const Keys<Section>& keys, const Section& section) {
    for (const Key<Section>& key : keys) {
      const std::string value = key.write(section, directory_);
      if (!value.empty()) line(indent, key.name, ": ", value);
    }
  }
  template <class Section>
  void write_section(std::string_view name, const Keys<Section>& keys, const Section& section) {
    line(name, ":");
    write_keys("  ", keys, section);
  }

  void write_faces() {
    const Config::Faces& faces = config_.faces;
    line("faces:");
    line("  files:");
    for (const fs::path& file : faces.files) line("    - ", path(file));
    line("  units: ", name_of(faces.units));
    line("  up: ", name_of(faces.up));
    line("  front: ", name_of(faces.front));
    line("  align: ", word_of(faces.align));
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
    write_section("smoothing", smoothing_keys(), config_.smoothing);
    write_section("blending", blending_keys(), config_.blending);
    if (!config_.parts.follow) {
      line("parts: none");
    } else {
      write_section("parts", parts_keys(), config_.parts);
    }
    line("plane:");
    line("  layout: ", word_of(config_.plane.layout));
    line(config_.plane.anchors.empty() ? "  anchors: {}" : "  anchors:");
    for (const auto& [index, anchor] : config_.plane.anchors) {
      line("    ", head_key(index), ": ", flow_point(anchor));
    }
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
    const std::string kind = concat("distribution: ", word_of(position.kind));
    switch (position.kind) {
      case Kind::kAround:
        return flow_map({kind,
                         concat("face: ", position.head ? head_key(*position.head) : "target"),
                         concat("radius: ", position.radius)});
      case Kind::kFixed:
        return flow_map({kind, concat("position: ", flow_point(position.at))});
      case Kind::kUniform:
        return flow_map({kind});
      case Kind::kAnchored:
        break;
    }
    return flow_map({kind, concat("pull: ", position.pull)});
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
    write_section("distance", distance_keys(), config_.distance);
    write_section("diversity", diversity_keys(), config_.diversity);
    if (!config_.believability.check) return line("believability: none");
    write_section("believability", believability_keys(), config_.believability);
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
          inherit.push_back(concat(write_scalar(names[k]), ": ", word_of(family.inherit[k])));
        }
        line("    inherit: ", flow_map(inherit));
      }
      line("    max_distance: ", write_mm(family.max_distance_mm));
      line("    min_distance: ", write_mm(family.min_distance_mm));
      line("    age: ", flow_factor(family.age));
    }
  }

  void write_reviews() {
    std::vector<std::string> files;
    for (const fs::path& file : config_.review.files) files.push_back(path(file));
    line("review: ", flow_list(files));
  }

  static std::string surface_word(const SurfaceChoice& surface) {
    if (!surface.colour) return std::string(word_of(surface.kind));
    constexpr std::string_view kDigits = "0123456789abcdef";
    std::string text = "\"#";
    for (const std::uint8_t value : *surface.colour) {
      text += kDigits[value >> 4U];
      text += kDigits[value & 15U];
    }
    return text + '"';
  }

  void write_output() {
    line("output:");
    line("  directory: ", path(config_.output.directory));
    std::vector<std::string> meshes;
    for (const MeshFormat format : config_.output.meshes) meshes.emplace_back(name_of(format));
    line("  meshes: ", flow_list(meshes));
    line("  gallery: ", word_of(config_.output.gallery));
    std::vector<std::string> surfaces;
    for (const auto& [name, surface] : config_.output.surfaces) {
      surfaces.push_back(concat(write_scalar(name), ": ", surface_word(surface)));
    }
    line("  surfaces: ", flow_map(surfaces));
    const auto& sheet = config_.output.contact_sheet;
    if (!sheet) return line("  contact_sheet: none");
    line("  contact_sheet:");
    write_keys("    ", contact_sheet_keys(), *sheet);
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
