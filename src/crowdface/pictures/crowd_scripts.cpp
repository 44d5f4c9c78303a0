// SPDX-License-Identifier: Apache-2.0
// Writes the gallery's scripts, which contain the recipes of a crowd.
#include <algorithm>
#include <optional>
#include <set>
#include <string>

#include <nlohmann/json.hpp>

#include "crowdface/core/file.h"
#include "crowdface/core/folder.h"
#include "crowdface/core/interrupt.h"
#include "crowdface/core/parallel.h"
#include "crowdface/core/rounded.h"
#include "crowdface/core/text.h"
#include "crowdface/core/version.h"
#include "crowdface/crowd/face_json.h"
#include "crowdface/pictures/change_choices.h"
#include "crowdface/pictures/pictures.h"
#include "crowdface/traits/measurements.h"

namespace crowdface {
namespace {

using Json = nlohmann::ordered_json;

/// Largest number of faces that the gallery's view "Plane" shows if the recipes are split into
/// several scripts. This view shows the positions of faces on the weight plane.
constexpr std::size_t kMaxOnPlane = 2000;

/// Returns the data of the crowd's script that do not belong to a single face.
Json crowd_wide_json(const Config& config, const ShapeSet& shapes, const CrowdLikeness& likeness,
                     const std::vector<std::vector<double>>& head_traits, bool has_textures) {
  const PlanNames names = config.plan_names();
  Json json;
  json["name"] = config.crowd.name;
  json["seed"] = config.crowd.seed;
  json["version"] = kVersion;
  json["regions"] = config.regions.names;
  if (!names.bands.empty()) json["bands"] = names.bands;
  json["pictures"] = config.output.contact_sheet.has_value();
  for (const Shape& shape : shapes.shapes) json["shapes"].push_back(shape.name);
  add_possible_changes(config, has_textures, json);
  json["heads"] = Json::array();
  for (std::size_t h = 0; h < names.heads.size(); ++h) {
    json["heads"].push_back({{"name", names.heads[h]},
                             {"tags", config.faces.tags[h]},
                             {"anchor", {likeness.anchors[h].x(), likeness.anchors[h].y()}}});
    for (std::size_t t = 0; !head_traits.empty() && t < names.traits.size(); ++t) {
      json["heads"].back()["traits"][names.traits[t]] = rounded(head_traits[h][t]);
    }
  }
  for (std::size_t t = 0; !head_traits.empty() && t < names.traits.size(); ++t) {
    const Measurement& of = measurements()[*find_measurement(names.traits[t])];
    json["traits"].push_back({{"name", of.name}, {"symbol", of.symbol}, {"unit", unit_of(of)}});
  }
  return json;
}

std::vector<std::size_t> ranks(const Likeness& likeness, std::size_t faces) {
  std::vector<std::size_t> rank(faces);
  for (std::size_t i = 0; i < likeness.face_order.size(); ++i) rank[likeness.face_order[i]] = i;
  return rank;
}

Json near_to_json(const std::vector<Neighbour>& near) {
  Json others = Json::array();
  for (const Neighbour& other : near) others.push_back({other.face, other.distance_mm});
  return others;
}

Json whole_crowd(Json json, const std::vector<FacePlan>& crowd, const PlanNames& names,
                 const Digest& settings, const Likeness& likeness) {
  json["faces"] = Json::array();
  for (const FacePlan& face : crowd) json["faces"].push_back(face_to_json(face, names, settings));
  json["likeness"] = ranks(likeness, crowd.size());
  json["near"] = Json::array();
  for (const std::vector<Neighbour>& near : likeness.neighbours) {
    json["near"].push_back(near_to_json(near));
  }
  return json;
}

/// Returns the JSON array [of(0), of(1), …] over all faces.
template <class Of>
std::string list_of(std::size_t faces, const Of& of) {
  std::string text = "[";
  for (std::size_t i = 0; i < faces; ++i) text += concat(i > 0 ? "," : "", of(i));
  return text + ']';
}

/// Returns the JSON object {"0": of(face 0), "1": of(face 1), …}, keyed by the index of the face,
/// without faces whose value is null.
template <class Of>
Json sparse_column(const std::vector<FacePlan>& crowd, const Of& of) {
  Json json = Json::object();
  for (std::size_t i = 0; i < crowd.size(); ++i) {
    Json value = of(crowd[i]);
    if (!value.is_null()) json[std::to_string(i)] = std::move(value);
  }
  return json;
}

/// Returns JSON with the data by which the gallery filters, sorts and lists faces. Each key holds a
/// column: one value per face.
std::string columns(const std::vector<FacePlan>& crowd, const PlanNames& names,
                    const Likeness& likeness) {
  std::string text;
  const auto add = [&](const char* name, const auto& of) {
    text += concat(text.empty() ? "{\"" : ",\n\"", name, "\":", list_of(crowd.size(), of));
  };
  add("id", [&](std::size_t i) { return Json(crowd[i].id).dump(); });
  add("target", [&](std::size_t i) { return crowd[i].recipe.target; });
  add("attempt", [&](std::size_t i) { return crowd[i].notes.attempt; });
  add("near_mm", [&](std::size_t i) {
    const auto& near = likeness.neighbours[i];
    return near.empty() ? std::string("null") : concat(near.front().distance_mm);
  });
  add("head_mm", [&](std::size_t i) {
    const auto& nearest = crowd[i].notes.nearest;
    return nearest ? concat(rounded(nearest->head_distance_mm)) : std::string("null");
  });
  const auto add_if_any = [&](const char* name, std::optional<std::string> FacePlan::*kin) {
    if (std::ranges::none_of(crowd,
                             [&](const FacePlan& face) { return (face.*kin).has_value(); })) {
      return;
    }
    add(name, [&](std::size_t i) {
      const auto& own = crowd[i].*kin;
      return own ? Json(*own).dump() : "null";
    });
  };
  add_if_any("family", &FacePlan::family);
  add_if_any("group", &FacePlan::group);
  if (std::ranges::any_of(crowd, [](const FacePlan& face) { return !face.attachments.empty(); })) {
    add("attachments", [&](std::size_t i) { return Json(crowd[i].attachments).dump(); });
  }
  std::vector<std::string> traits;
  for (std::size_t t = 0; t < names.traits.size(); ++t) {
    const auto value = [&](std::size_t i) {
      return t < crowd[i].traits.size() ? concat(rounded(crowd[i].traits[t])) : std::string("null");
    };
    traits.push_back(concat(Json(names.traits[t]).dump(), ':', list_of(crowd.size(), value)));
  }
  if (!traits.empty()) text += concat(",\n\"traits\":{", join(traits, ",\n"), '}');
  const Json parents = sparse_column(crowd, [](const FacePlan& face) {
    return face.parents.empty() ? Json()
                                : Json{{"mother", face.parents[0]}, {"father", face.parents[1]}};
  });
  const Json by_hand = sparse_column(
      crowd, [](const FacePlan& face) { return face.index || face.family ? Json() : Json(true); });
  const Json changes = sparse_column(crowd, [](const FacePlan& face) {
    return face.notes.changes.empty() ? Json() : Json(face.notes.changes.size());
  });
  if (!changes.empty()) text += concat(",\n\"changes\":", changes.dump());
  const Json notes = sparse_column(crowd, [](const FacePlan& face) {
    return face.notes.review ? Json(*face.notes.review) : Json();
  });
  return text + concat(",\n\"parents\":", parents.dump(), ",\n\"by_hand\":", by_hand.dump(),
                       ",\n\"note\":", notes.dump(), '}');
}

/// Returns a script with the recipes of the faces [begin, end) and with the most similar faces of
/// each of these faces.
std::string page_script(const std::vector<FacePlan>& crowd, std::size_t begin, std::size_t end,
                        std::size_t page, const PlanNames& names, const Digest& settings,
                        const Likeness& likeness) {
  Json faces = Json::array(), near = Json::array();
  for (std::size_t i = begin; i < end; ++i) {
    faces.push_back(face_to_json(crowd[i], names, settings));
    near.push_back(near_to_json(likeness.neighbours[i]));
  }
  return concat("crowdface.setPage(", page, ',', Json{{"faces", faces}, {"near", near}}.dump(),
                ");\n");
}

/// Returns the data for the gallery's view "Plane": the key `regions` of the recipe of every k-th
/// face of the crowd, with the smallest k that gives at most kMaxOnPlane faces.
Json on_plane(const std::vector<FacePlan>& crowd, const PlanNames& names, const Digest& settings) {
  Json json = Json::object();
  const std::size_t step = (crowd.size() + kMaxOnPlane - 1) / kMaxOnPlane;
  for (std::size_t i = 0; i < crowd.size(); i += step) {
    json[std::to_string(i)] = face_to_json(crowd[i], names, settings)["regions"];
  }
  return json;
}

}  // namespace

void CrowdPictures::write_scripts(const std::vector<FacePlan>& crowd,
                                  const CrowdLikeness& likeness) const {
  const PlanNames names = config_.plan_names();
  Json head = crowd_wide_json(config_, inputs_.shapes, likeness, head_traits_,
                              inputs_.textures.digest != Digest());
  std::set<std::filesystem::path> pages;
  std::string script;
  if (const auto faces_per_page = static_cast<std::size_t>(directory_.faces_per_folder);
      faces_per_page == 0) {
    script = whole_crowd(std::move(head), crowd, names, settings_digest_, likeness.likeness).dump();
  } else {
    make_directories(directory_.gallery_pages());
    const auto file = [&](std::size_t page) {
      return directory_.gallery_pages() / concat(zero_padded(page, 3), ".js");
    };
    const std::size_t count = (crowd.size() + faces_per_page - 1) / faces_per_page;
    for (std::size_t page = 0; page < count; ++page) pages.insert(file(page));
    parallel_for_each(count, [&](std::size_t page) {
      throw_if_interrupted();
      const std::size_t begin = page * faces_per_page,
                        end = std::min(begin + faces_per_page, crowd.size());
      write_file(file(page),
                 page_script(crowd, begin, end, page, names, settings_digest_, likeness.likeness));
    });
    head["faces_per_page"] = faces_per_page;
    head["on_plane"] = on_plane(crowd, names, settings_digest_);
    const std::vector<std::size_t> rank = ranks(likeness.likeness, crowd.size());
    script = head.dump();
    script.pop_back();
    script += concat(
        ",\n\"columns\":", columns(crowd, names, likeness.likeness),
        ",\n\"likeness\":", list_of(crowd.size(), [&](std::size_t i) { return rank[i]; }), '}');
  }
  for (const auto& path : list_files(directory_.gallery_pages(), extension_filter(".js"))) {
    if (!pages.contains(path)) remove_if_exists(path);
  }
  write_file(directory_.gallery() / "data/crowd.js", concat("crowdface.setCrowd(", script, ");\n"));
}

}  // namespace crowdface
