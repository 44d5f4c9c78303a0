// SPDX-License-Identifier: Apache-2.0
#include "crowdface/crowd/face_json.h"

#include "crowdface/core/rounded.h"

namespace crowdface {
namespace {

using Json = nlohmann::ordered_json;

template <class T>
Json or_null(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json band_to_json(const BandRecipe& band, const PlanNames& names) {
  Json json;
  json["position"] = band.position ? Json({band.position->x(), band.position->y()}) : Json();
  json["weights"] = Json::object();
  for (const SourceWeight& source : band.weights) {
    json["weights"][name_at(names.heads, source.head)] = source.weight;
  }
  json["smoothness"] = band.smoothness;
  json["iterations"] = band.iterations;
  json["extrapolation"] = band.extrapolation;
  return json;
}

/// Converts the recipe of a region to a JSON object. Stores the values of the first band directly
/// in this object. Stores the values of each further band in the member `bands`, an object whose
/// keys are the names of the bands.
Json region_to_json(const RegionRecipe& region, const PlanNames& names) {
  Json json = band_to_json(region, names);
  for (const SourceWeight& part : region.colours) {
    json["colours"][name_at(names.heads, part.head)] = part.weight;
  }
  for (std::size_t b = 1; b < band_count(region); ++b) {
    json["bands"][names.bands[b]] = band_to_json(band_of(region, b), names);
  }
  return json;
}

/// The parent from whom the face inherits a region; if the config defines bands, one parent for
/// each band of the region.
Json inherits_to_json(const std::vector<std::string>& inherits, std::size_t region,
                      const PlanNames& names) {
  if (names.bands.empty()) return inherits[region];
  Json json;
  for (std::size_t b = 0; b < names.bands.size(); ++b) {
    json[names.bands[b]] = inherits[region * names.bands.size() + b];
  }
  return json;
}

}  // namespace

Json face_to_json(const FacePlan& face, const PlanNames& names, const Digest& settings) {
  Json json;
  json["id"] = face.id;
  json["index"] = or_null(face.index);
  json["family"] = or_null(face.family);
  if (face.group) json["group"] = *face.group;
  json["target"] = name_at(names.heads, face.recipe.target);
  for (const SourceWeight& part : face.recipe.mixture) {
    json["mixture"][name_at(names.heads, part.head)] = part.weight;
  }
  for (const SourceWeight& part : face.recipe.colours) {
    json["colours"][name_at(names.heads, part.head)] = part.weight;
  }
  if (face.recipe.asymmetry != 1) json["asymmetry"] = face.recipe.asymmetry;
  if (face.recipe.mirrored) json["mirrored"] = true;
  json["attempt"] = face.notes.attempt;
  if (face.age) json["age"] = *face.age;
  if (face.age_years) json["age_years"] = *face.age_years;
  if (!face.parents.empty()) {
    json["parents"] = {{"mother", face.parents[0]}, {"father", face.parents[1]}};
    if (face.mother_share > 0) json["mother_share"] = rounded(face.mother_share);
  }
  if (!face.inherited_from.empty()) {
    for (std::size_t k = 0; k < names.regions.size(); ++k) {
      json["inherits"][names.regions[k]] = inherits_to_json(face.inherited_from, k, names);
    }
  }
  if (!names.attachments.empty()) json["attachments"] = face.attachments;
  for (std::size_t t = 0; t < face.traits.size(); ++t) {
    json["traits"][names.traits[t]] = rounded(face.traits[t]);
  }
  if (face.hair) {
    json["hair"] = {{"eumelanin", face.hair->eumelanin},
                    {"pheomelanin", face.hair->pheomelanin},
                    {"grey", face.hair->grey_fraction}};
  }
  if (face.notes.review) json["note"] = *face.notes.review;
  if (!face.notes.changes.empty()) json["changed"] = face.notes.changes;
  json["regions"] = Json::object();
  for (std::size_t k = 0; k < face.recipe.regions.size(); ++k) {
    json["regions"][names.regions[k]] = region_to_json(face.recipe.regions[k], names);
  }
  if (face.notes.nearest) {
    const NearestNeighbours& nearest = *face.notes.nearest;
    json["nearest"] = {
        {"face", name_at(names.heads, nearest.head)},
        {"face_mm", rounded(nearest.head_distance_mm)},
        {"crowd", or_null(nearest.earlier_face)},
        {"crowd_mm",
         nearest.earlier_face ? Json(rounded(nearest.earlier_face_distance_mm)) : Json()}};
  }
  json["settings"] = settings.hex();
  return json;
}

}  // namespace crowdface
