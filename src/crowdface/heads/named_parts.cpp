// SPDX-License-Identifier: Apache-2.0
#include "crowdface/heads/named_parts.h"

#include <algorithm>
#include <map>

#include "crowdface/core/text.h"
#include "crowdface/core/units.h"

namespace crowdface {
namespace {

/// For each component, the name that most of its polygons have; empty if no polygon has a name.
std::vector<std::string> names_of(const std::vector<MaterialRange>& ranges, const Inputs& inputs) {
  const Topology& topology = inputs.head_set.topology;
  std::vector<std::map<std::size_t, Index>> faces(
      static_cast<std::size_t>(inputs.components.count()));
  for (std::size_t range = 0; range < ranges.size(); ++range) {
    const Index end =
        range + 1 < ranges.size() ? ranges[range + 1].first_face : topology.face_count();
    std::uint32_t component = kNoIndex;
    Index* count = nullptr;  // cached, because the polygons of a component mostly follow each other
    for (Index f = ranges[range].first_face; f < end; ++f) {
      const std::uint32_t of_face = inputs.components.component_of_vertex[topology.face(f)[0]];
      if (of_face != component) count = &faces[of_face][range];
      component = of_face;
      ++*count;
    }
  }
  std::vector<std::string> names;
  for (const auto& of_component : faces) {
    std::map<std::string, Index> by_name;  // a name may occur several times in the file
    for (const auto& [r, count] : of_component) by_name[ranges[r].name] += count;
    const auto most = std::ranges::max_element(
        by_name, [](const auto& a, const auto& b) { return a.second < b.second; });
    names.push_back(most == by_name.end() ? "" : most->first);
  }
  return names;
}

/// Finds the components to which a name in the config refers.
class ComponentNames {
 public:
  ComponentNames(const Config& config, const Inputs& inputs, Problems& problems)
      : config_(config),
        problems_(problems),
        materials_(names_of(inputs.head_files[0].materials, inputs)),
        groups_(names_of(inputs.head_files[0].groups, inputs)) {}

  std::vector<std::uint32_t> find(const std::string& name, std::string_view key) {
    constexpr std::string_view kComponent = "component ";
    std::vector<std::uint32_t> found;
    if (name.starts_with(kComponent)) {
      const auto number = parse_unsigned(std::string_view(name).substr(kComponent.size()));
      if (number && *number >= 1 && *number <= materials_.size()) {
        found.push_back(static_cast<std::uint32_t>(*number - 1));
      }
    }
    for (std::uint32_t c = 0; c < materials_.size(); ++c) {
      if (materials_[c] == name || groups_[c] == name) found.push_back(c);
    }
    if (found.empty()) {
      std::vector<std::string> known = materials_;
      known.insert(known.end(), groups_.begin(), groups_.end());
      const auto nearest = nearest_word(name, known);
      problems_.add(ExitCode::kUsage,
                    concat(config_.file.string(), ": parts.", key,
                           ": expected the material or group of a component, or \"component 1\" "
                           "to \"component ",
                           materials_.size(), "\", found ", quoted(name),
                           nearest ? concat("; did you mean ", quoted(*nearest), "?") : ""));
    }
    return found;
  }

 private:
  const Config& config_;
  Problems& problems_;
  std::vector<std::string> materials_, groups_;
};

PartOverrides overrides_of(const Config& config, const Inputs& inputs, Problems& problems) {
  const Config::Parts& parts = config.parts;
  ComponentNames names(config, inputs, problems);
  PartOverrides overrides;
  overrides.classes.resize(static_cast<std::size_t>(inputs.components.count()));
  const auto set = [&](const std::vector<std::string>& list, std::string_view key,
                       PartClass part_class) {
    for (const std::string& name : list) {
      for (const std::uint32_t c : names.find(name, key)) {
        auto& said = overrides.classes[c];
        if (c == inputs.components.largest() && part_class != PartClass::kSkin) {
          problems.add(ExitCode::kUsage,
                       concat(config.file.string(), ": parts.", key, ": ", quoted(name),
                              " is the largest component, which is always skin"));
        }
        if (said && *said != part_class) {
          problems.add(
              ExitCode::kUsage,
              concat(config.file.string(), ": parts.", key, ": ", quoted(name), " is component ",
                     c + 1,
                     ", which another list also names; expected each component in one list only"));
        }
        said = part_class;
      }
    }
  };
  set(parts.skin, "skin", PartClass::kSkin);
  set(parts.rigid, "rigid", PartClass::kRigid);
  set(parts.bound, "bound", PartClass::kBound);
  for (const auto& list : parts.together) {
    std::vector<std::uint32_t> together;
    for (const std::string& name : list) {
      for (const std::uint32_t c : names.find(name, "together")) {
        together.push_back(c);
        if (!overrides.classes[c]) overrides.classes[c] = PartClass::kRigid;
      }
    }
    if (!together.empty()) overrides.joined_components.push_back(std::move(together));
  }
  return overrides;
}

std::string part_name(const Part& part) {
  if (part.part_class == PartClass::kBound) return "bound";
  return part.is_eyeball ? "eyeball" : "rigid";
}

}  // namespace

std::vector<bool> skin_of(const Inputs& inputs) {
  const std::uint32_t largest = inputs.skin_components.largest();
  std::vector<bool> skin;
  for (const std::uint32_t c : inputs.skin_components.component_of_vertex)
    skin.push_back(c == largest);
  return skin;
}

std::vector<std::uint32_t> skin_vertices(const Inputs& inputs) {
  const std::vector<bool> is_skin = skin_of(inputs);
  std::vector<std::uint32_t> skin;
  for (std::uint32_t v = 0; v < is_skin.size(); ++v) {
    if (is_skin[v]) skin.push_back(v);
  }
  return skin;
}

HeadAxes head_axes(const Config& config) {
  HeadAxes axes{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  axes.front(config.faces.front.index) = config.faces.front.sign;
  axes.up(config.faces.up.index) = config.faces.up.sign;
  return axes;
}

void find_named_parts(const Config& config, Inputs& inputs, Problems& problems) {
  inputs.skin_components = inputs.components;
  if (!config.parts.follow_skin) return;
  const PartOverrides overrides = overrides_of(config, inputs, problems);
  inputs.parts = find_parts(inputs.head_set.topology, inputs.adjacency, inputs.components,
                            inputs.mean_head, overrides, head_axes(config));
  inputs.skin_components = join_skin(inputs.components, inputs.parts);
}

std::string describe_parts(const Config& config, const Inputs& inputs) {
  if (!config.parts.follow_skin) return "none: all components are blended as skin";
  const std::vector<std::string> materials = names_of(inputs.head_files[0].materials, inputs);
  const std::vector<std::string> groups = names_of(inputs.head_files[0].groups, inputs);
  const auto label = [&](std::uint32_t c) {
    const std::string& name = materials[c].empty() ? groups[c] : materials[c];
    return name.empty() ? concat("component ", c + 1) : name;
  };
  struct Line {
    std::string what;
    std::vector<std::uint32_t> components;
    Index vertices = 0;
  };
  std::vector<Line> lines = {{"skin", {}, 0}};
  const auto add = [&](Line& line, std::uint32_t c) {
    line.components.push_back(c);
    line.vertices += inputs.parts.shapes[c].vertex_count;
  };
  for (std::uint32_t c = 0; c < static_cast<std::uint32_t>(inputs.parts.classes.size()); ++c) {
    if (inputs.parts.classes[c] == PartClass::kSkin) add(lines[0], c);
  }
  for (const Part& part : inputs.parts.parts) {
    // Write one line of text for successive components of the same material, because there may be
    // dozens of eyelash components.
    const bool joins_last_line = part.part_class == PartClass::kBound &&
                                 lines.back().what == "bound" &&
                                 label(lines.back().components[0]) == label(part.components[0]);
    if (!joins_last_line) lines.push_back({part_name(part), {}, 0});
    for (const std::uint32_t c : part.components) add(lines.back(), c);
  }
  std::string text;
  for (const Line& line : lines) {
    std::vector<std::string> names;
    for (const std::uint32_t c : line.components) {
      if (std::ranges::find(names, label(c)) == names.end()) names.push_back(label(c));
    }
    const std::size_t count = line.components.size();
    const std::string first = concat(line.components[0] + 1);
    text += concat(text.empty() ? "" : "\n            ", line.what, ": component",
                   count == 1
                       ? concat(' ', first)
                       : concat("s ", first, " … ", line.components.back() + 1, " (", count, ")"),
                   ", ", line.vertices, " vertices, ", join(names));
  }
  return text;
}

}  // namespace crowdface
