// SPDX-License-Identifier: Apache-2.0
#include "crowdface/crowd/crowd_table.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "crowdface/core/contains.h"
#include "crowdface/core/rounded.h"
#include "crowdface/core/text.h"
#include "crowdface/crowd/face_json.h"
#include "crowdface/io/srgb.h"

namespace crowdface {
namespace {

/// A column of crowd.csv, the table of all faces.
struct TableColumn {
  std::string name;
  std::function<std::string(const FacePlan& face)> value;
  /// Whether the column applies to a face. The table has the column if it applies to at least one
  /// face. An empty function means that the table always has the column.
  std::function<bool(const FacePlan& face)> applies = {};
};
using TableColumns = std::vector<TableColumn>;

/// A CSV field, quoted if it holds a comma, a quote or a line break (RFC 4180).
std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == text.npos) return text;
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"') out += '"';
    out += c;
  }
  return out + '"';
}

/// Formats weights as "ann:0.4;bob:0.6".
std::string weights_text(const std::vector<SourceWeight>& weights, const PlanNames& names) {
  std::vector<std::string> parts;
  for (const SourceWeight& source : weights) {
    parts.push_back(concat(name_at(names.heads, source.head), ':', source.weight));
  }
  return join(parts, ";");
}

/// Adds the columns of crowd.csv for one band of a region. Faces without this band have empty
/// fields in these columns.
void add_band(const std::string& start, std::size_t region, std::size_t band,
              const PlanNames& names, TableColumns& columns) {
  const auto add = [&](const char* name, const auto& value) {
    columns.push_back({concat(start, '_', name), [=](const FacePlan& face) -> std::string {
                         const RegionRecipe& own = face.recipe.regions[region];
                         return band < band_count(own) ? value(band_of(own, band)) : "";
                       }});
  };
  const auto coordinate = [](int axis) {
    return [=](const BandRecipe& own) {
      return own.position ? format_number((*own.position)[axis]) : "";
    };
  };
  add("position_x", coordinate(0));
  add("position_y", coordinate(1));
  add("weights", [&names](const BandRecipe& own) { return weights_text(own.weights, names); });
  add("smoothness", [](const BandRecipe& own) { return format_number(own.smoothness); });
  add("iterations", [](const BandRecipe& own) { return concat(own.iterations); });
  add("extrapolation", [](const BandRecipe& own) { return format_number(own.extrapolation); });
}

/// Adds the columns of crowd.csv that hold the colour of each face's skin at the neck.
/// \param colours  the parameter `neck_colours` of table_text
void add_neck_colours(const std::vector<FacePlan>& crowd,
                      const std::vector<Eigen::Array3d>& colours, TableColumns& columns) {
  if (colours.empty()) return;
  const auto colour = [&crowd, &colours](const FacePlan& face) {
    return colours[static_cast<std::size_t>(&face - crowd.data())];
  };
  for (int c = 0; c < 3; ++c) {
    columns.push_back({concat("neck_linear_", "rgb"[c]), [=](const FacePlan& face) {
                         return format_number(rounded(colour(face)[c]));
                       }});
  }
  columns.push_back({"neck_srgb", [=](const FacePlan& face) { return srgb_hex(colour(face)); }});
}

/// Maps the id of each parent to a map from the parent's families to the parent's role ("mother",
/// "father") in that family.
using Parenthood = std::map<std::string, std::map<std::string, std::string>>;

Parenthood parenthood_in(const std::vector<FacePlan>& crowd) {
  Parenthood parents;
  for (const FacePlan& face : crowd) {
    if (!face.family || face.parents.size() != 2) continue;
    parents[face.parents[0]][*face.family] = "mother";
    parents[face.parents[1]][*face.family] = "father";
  }
  return parents;
}

/// The family of which the face is a member. For a face that is no member: the families of which
/// the face is a parent.
std::string family_of(const FacePlan& face, const Parenthood& parenthood) {
  if (face.family) return *face.family;
  std::vector<std::string> families;
  const auto own = parenthood.find(face.id);
  if (own == parenthood.end()) return {};
  for (const auto& [family, role] : own->second) families.push_back(family);
  return join(families, ";");
}

/// Role of a member, if the family has no parents. (family_role may return several roles, for
/// example "child;mother".)
constexpr const char* kMember = "member";

std::string family_role(const FacePlan& face, const Parenthood& parenthood) {
  std::vector<std::string> roles;
  if (face.family) roles.emplace_back(face.parents.empty() ? kMember : "child");
  if (const auto own = parenthood.find(face.id); own != parenthood.end()) {
    for (const auto& [family, role] : own->second) {
      if (!contains(roles, role)) roles.push_back(role);
    }
  }
  return join(roles, ";");
}

const std::vector<std::string>& tags_of(const FacePlan& face, const HeadTags& tags) {
  return tags[static_cast<std::size_t>(typical_head(face.recipe, tags))];
}

std::string sex_of(const FacePlan& face, const HeadTags& tags) {
  for (const char* sex : {"female", "male"}) {
    if (contains(tags_of(face, tags), std::string(sex))) return sex;
  }
  return {};
}

bool has_any_tag(const HeadTags& tags) {
  return std::ranges::any_of(tags, [](const auto& own) { return !own.empty(); });
}

/// Adds the columns of crowd.csv that identify a face, such as id, family and role.
void add_identity_columns(const std::vector<FacePlan>& crowd, const PlanNames& names,
                          const HeadTagsAndAttachmentKinds& facts, TableColumns& columns) {
  using Face = const FacePlan&;
  const auto parenthood = std::make_shared<const Parenthood>(parenthood_in(crowd));
  const auto kinds = facts.attachment_kinds;
  const auto tags = std::make_shared<const HeadTags>(facts.head_tags);
  const auto family = std::ranges::find(columns, "family", &TableColumn::name);
  family->value = [=](Face face) { return family_of(face, *parenthood); };
  columns.push_back({"family_role", [=](Face face) { return family_role(face, *parenthood); },
                     [](Face face) { return face.family.has_value(); }});
  columns.push_back({"age", [](Face face) { return format_number(face.age.value_or(0)); },
                     [](Face face) { return face.age.has_value(); }});
  columns.push_back(
      {"age_years",
       [](Face face) { return face.age_years ? format_number(*face.age_years) : std::string(); },
       [](Face face) { return face.age_years.has_value(); }});
  const auto has_tag = [](const HeadTags& all, const std::string& tag) {
    return std::ranges::any_of(all, [&](const auto& own) { return contains(own, tag); });
  };
  if (has_tag(*tags, "female") || has_tag(*tags, "male")) {
    columns.push_back({"sex", [=](Face face) { return sex_of(face, *tags); }});
  }
  if (has_any_tag(*tags)) {
    columns.push_back({"tags", [=](Face face) { return join(tags_of(face, *tags), ";"); }});
  }
  columns.push_back({"changed", [](Face face) { return join(face.notes.changes, ";"); },
                     [](Face face) { return !face.notes.changes.empty(); }});
  if (contains(kinds, std::string("hair"))) {
    columns.push_back({"hair", [=, &names](Face face) {
                         for (std::size_t a = 0; a < kinds.size(); ++a) {
                           const std::string& name = names.attachments[a];
                           if (kinds[a] == "hair" && contains(face.attachments, name)) return name;
                         }
                         return std::string();
                       }});
  }
}

/// Returns all columns of the table. To add a column, add an entry here.
/// \param names  must outlive the columns.
TableColumns table_columns(const PlanNames& names) {
  using Face = const FacePlan&;
  const auto is_mirrored = [](Face face) { return !is_unmirrored(face.recipe); };
  TableColumns columns = {
      {"id", [](Face face) { return face.id; }},
      {"index", [](Face face) { return face.index ? concat(*face.index) : ""; }},
      {"family", [](Face face) { return face.family.value_or(""); }},
      {"target", [&names](Face face) { return name_at(names.heads, face.recipe.target); }}};
  for (std::size_t r = 0; r < names.regions.size(); ++r) {
    add_band(names.regions[r], r, 0, names, columns);
  }
  const auto nearest = [](const auto& text) {
    return
        [=](Face face) { return face.notes.nearest ? text(*face.notes.nearest) : std::string(); };
  };
  const TableColumns more = {
      {"nearest_face", nearest([&names](const NearestNeighbours& near) {
         return name_at(names.heads, near.head);
       })},
      {"nearest_face_mm", nearest([](const NearestNeighbours& near) {
         return format_number(rounded(near.head_distance_mm));
       })},
      {"nearest_crowd",
       nearest([](const NearestNeighbours& near) { return near.earlier_face.value_or(""); })},
      {"nearest_crowd_mm", nearest([](const NearestNeighbours& near) {
         return near.earlier_face ? format_number(rounded(near.earlier_face_distance_mm)) : "";
       })},
      {"group", [](Face face) { return face.group.value_or(""); }},
      {"mixture", [&names](Face face) { return weights_text(face.recipe.mixture, names); }}};
  columns.insert(columns.end(), more.begin(), more.end());
  for (std::size_t r = 0; r < names.regions.size(); ++r) {
    for (std::size_t b = 1; b < names.bands.size(); ++b) {
      add_band(concat(names.regions[r], '_', names.bands[b]), r, b, names, columns);
    }
  }
  const TableColumns last = {
      {"asymmetry", [](Face face) { return format_number(face.recipe.asymmetry); }, is_mirrored},
      {"mirrored", [](Face face) { return face.recipe.mirrored ? "true" : "false"; }, is_mirrored},
      {"attachments", [](Face face) { return join(face.attachments, ";"); },
       [&names](Face) { return !names.attachments.empty(); }},
      {"colours", [&names](Face face) { return weights_text(face.recipe.colours, names); },
       [](Face face) { return !face.recipe.colours.empty(); }}};
  columns.insert(columns.end(), last.begin(), last.end());
  for (std::size_t t = 0; t < names.traits.size(); ++t) {
    columns.push_back({names.traits[t], [t](Face face) {
                         return t < face.traits.size() ? format_number(rounded(face.traits[t]))
                                                       : "";
                       }});
  }
  return columns;
}

template <class Text>
std::string table_line(const TableColumns& columns, const Text& text) {
  std::string line;
  for (const TableColumn& column : columns) {
    line += concat(&column == columns.data() ? "" : ",", csv_field(text(column)));
  }
  return line + "\r\n";
}

}  // namespace

std::string srgb_hex(const Eigen::Array3d& linear_colour) {
  constexpr std::string_view kDigits = "0123456789ABCDEF";
  constexpr unsigned kBase = 16;
  std::string text = "#";
  for (const double channel : linear_colour) {
    const auto byte = static_cast<unsigned>(std::lround(255 * srgb_of_linear(channel)));
    text += kDigits[byte / kBase];
    text += kDigits[byte % kBase];
  }
  return text;
}

TextPieces annotated_plan_text(const std::vector<FacePlan>& crowd, const PlanNames& names,
                               const Digest& settings, const HeadTagsAndAttachmentKinds& facts) {
  const auto parenthood = std::make_shared<const Parenthood>(parenthood_in(crowd));
  return text_of_items(crowd.size(), [&crowd, &names, settings, parenthood, tags = facts.head_tags,
                                      is_tagged = has_any_tag(facts.head_tags)](std::size_t i) {
    const FacePlan& face = crowd[i];
    nlohmann::ordered_json line = face_to_json(face, names, settings);
    if (is_tagged) {
      if (const std::string sex = sex_of(face, tags); !sex.empty()) line["sex"] = sex;
      line["tags"] = tags_of(face, tags);
    }
    const std::string role = family_role(face, *parenthood);
    if (!role.empty() && role != kMember) line["family_role"] = role;
    return line.dump() + '\n';
  });
}

TextPieces table_text(const std::vector<FacePlan>& crowd, const PlanNames& names,
                      const std::vector<Eigen::Array3d>& neck_colours,
                      const HeadTagsAndAttachmentKinds& facts) {
  TableColumns columns = table_columns(names);
  add_identity_columns(crowd, names, facts, columns);
  add_neck_colours(crowd, neck_colours, columns);
  std::erase_if(columns, [&](const TableColumn& column) {
    return column.applies && std::ranges::none_of(crowd, column.applies);
  });
  return [&crowd, columns = std::move(columns)](const TextSink& take) {
    take(table_line(columns, [](const TableColumn& column) { return column.name; }));
    text_of_items(crowd.size(), [&](std::size_t i) {
      return table_line(columns, [&](const TableColumn& column) { return column.value(crowd[i]); });
    })(take);
  };
}

}  // namespace crowdface
