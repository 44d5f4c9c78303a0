// SPDX-License-Identifier: Apache-2.0
#include "crowdface/crowd/plan_file.h"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "crowdface/blend/recipe_bounds.h"
#include "crowdface/core/error.h"
#include "crowdface/core/text.h"
#include "crowdface/crowd/face_json.h"
#include "crowdface/io/shallow_json.h"
#include "crowdface/smooth/level_size.h"

namespace crowdface {
namespace {

using Json = nlohmann::ordered_json;

/// Tolerance for shares or weights that a user wrote by hand: their sum may exceed 1, or differ
/// from a required sum of 1, by at most kRounding.
constexpr double kRounding = 1e-6;

/// Reads the fields of one line of a plan. Errors name the file, the line and the field.
class LineReader {
 public:
  LineReader(const PlanNames& names, const std::string& place) : names_(names), place_(place) {}

  PlanLine read(std::string_view line) const {
    const Json json = parse_shallow_json(line);
    if (!json.is_object()) fail("line", "a JSON object", "something else");
    PlanLine result;
    FacePlan& face = result.face;
    face.id = file_name(json, "id", kMaxIdLength);
    if (const Json& index = member(json, "index"); !index.is_null()) {
      face.index = whole(index, "index");
    }
    if (const Json& family = member(json, "family"); !family.is_null()) {
      face.family = file_name(json, "family", kMaxNameLength);
    }
    if (json.contains("group")) face.group = file_name(json, "group", kMaxNameLength);
    face.recipe.target = head(text(json, "target"), "target");
    if (const Json* mixture = found(json, "mixture")) {
      set_target_heads(face.recipe, shares(*mixture, "mixture"));
    }
    if (const Json* colours = found(json, "colours")) {
      face.recipe.colours = shares(*colours, "colours");
    }
    if (const Json* asymmetry = found(json, "asymmetry")) {
      face.recipe.asymmetry = number(*asymmetry, "asymmetry", 0, kMaxAsymmetry);
    }
    if (const Json* mirrored = found(json, "mirrored")) {
      if (!mirrored->is_boolean()) fail("mirrored", "true or false", mirrored->dump());
      face.recipe.mirrored = mirrored->get<bool>();
    }
    face.notes.attempt = attempt(member(json, "attempt"));
    const Json& regions = member(json, "regions");
    if (!regions.is_object() || regions.size() != names_.regions.size()) {
      fail("regions", concat("an object of ", names_.regions.size(), " regions"), regions.dump());
    }
    for (const std::string& name : names_.regions) {
      face.recipe.regions.push_back(region(member(regions, name), name));
    }
    if (const Json* age = found(json, "age")) face.age = number(*age, "age");
    if (const Json* years = found(json, "age_years")) face.age_years = number(*years, "age_years");
    if (const Json* parents = found(json, "parents")) {
      face.parents = {text(*parents, "mother"), text(*parents, "father")};
    }
    if (const Json* share = found(json, "mother_share")) {
      face.mother_share = number(*share, "mother_share", 0, 1);
    }
    if (const Json* inherits = found(json, "inherits")) {
      for (const std::string& name : names_.regions) {
        if (names_.bands.empty()) face.inherited_from.push_back(text(*inherits, name));
        for (const std::string& band : names_.bands) {
          face.inherited_from.push_back(text(member(*inherits, name), band));
        }
      }
    }
    if (const Json* placed = found(json, "attachments")) face.attachments = attachments(*placed);
    if (const Json* measured = found(json, "traits")) face.traits = traits(*measured);
    if (const Json* hair = found(json, "hair")) {
      face.hair = HairColour{number(member(*hair, "eumelanin"), "hair.eumelanin", 0, 1),
                             number(member(*hair, "pheomelanin"), "hair.pheomelanin", 0, 1),
                             number(member(*hair, "grey"), "hair.grey", 0, 1)};
    }
    if (json.contains("note")) face.notes.review = text(json, "note");
    if (const Json* changes = found(json, "changed"))
      face.notes.changes = texts(*changes, "changed");
    if (const Json* near = found(json, "nearest")) face.notes.nearest = nearest(*near);
    result.settings_hash = text(json, "settings");
    return result;
  }

 private:
  [[noreturn]] void fail(std::string_view field, std::string_view expected,
                         std::string_view found) const {
    throw InvalidInput(
        concat(place_, ": ", field, ": expected ", expected, ", found ", found.substr(0, 80)));
  }

  /// Returns null if the key does not exist.
  static const Json* found(const Json& json, const std::string& key) {
    const auto at = json.find(key);
    return at == json.end() ? nullptr : &*at;
  }

  const Json& member(const Json& json, const std::string& key) const {
    const Json* value = found(json, key);
    if (value == nullptr) fail(key, "a value", "none");
    return *value;
  }

  std::string text(const Json& json, const std::string& key) const {
    const Json& value = member(json, key);
    if (!value.is_string()) fail(key, "text", value.dump());
    return value.get<std::string>();
  }

  std::vector<std::string> texts(const Json& json, std::string_view field) const {
    std::vector<std::string> values;
    if (!json.is_array()) fail(field, "a list of texts", json.dump());
    for (const Json& value : json) {
      if (!value.is_string()) fail(field, "a list of texts", json.dump());
      values.push_back(value.get<std::string>());
    }
    return values;
  }

  /// Reads a name (such as a face's id) that becomes part of file names of images and meshes, and
  /// checks that the name is valid there.
  std::string file_name(const Json& json, const std::string& key, std::size_t longest) const {
    std::string name = text(json, key);
    if (!is_valid_name(name, longest)) {
      fail(key, "a name of letters (a-z), digits, '_', '-' or '.', not starting with '.'",
           quoted(std::string_view(name)));
    }
    return name;
  }

  double number(const Json& value, std::string_view key) const {
    if (!value.is_number() || !std::isfinite(value.get<double>())) {
      fail(key, "a number", value.dump());
    }
    return value.get<double>();
  }
  double number(const Json& value, std::string_view key, double low, double high) const {
    const double result = number(value, key);
    if (result < low || result > high) {
      fail(key, concat("a number from ", low, " to ", high), value.dump());
    }
    return result;
  }

  std::uint64_t whole(const Json& value, std::string_view key) const {
    if (!value.is_number_unsigned()) fail(key, "a whole number of zero or more", value.dump());
    return value.get<std::uint64_t>();
  }

  std::uint32_t attempt(const Json& value) const {
    const std::uint64_t number = whole(value, "attempt");
    if (number > UINT32_MAX) fail("attempt", "less than 2^32", value.dump());
    return static_cast<std::uint32_t>(number);
  }

  Index head(const std::string& name, std::string_view key) const {
    const auto found = std::find(names_.heads.begin(), names_.heads.end(), name);
    if (found == names_.heads.end()) fail(key, "the name of a head", quoted(name));
    return found - names_.heads.begin();
  }

  std::vector<std::string> attachments(const Json& json) const {
    if (!json.is_array()) fail("attachments", "a list of names", json.dump());
    std::vector<std::string> placed;
    for (const Json& value : json) {
      const std::string name = value.is_string() ? value.get<std::string>() : "";
      const auto& known = names_.attachments;
      if (std::find(known.begin(), known.end(), name) == known.end() ||
          std::find(placed.begin(), placed.end(), name) != placed.end()) {
        fail("attachments", "distinct names of attachments", value.dump());
      }
      placed.push_back(name);
    }
    return placed;
  }

  /// Reads the measurements of a face. Lines that a user wrote by hand may omit them, because no
  /// mesh depends on measurements.
  std::vector<double> traits(const Json& json) const {
    std::vector<double> values;
    for (const std::string& name : names_.traits) {
      const Json* value = json.is_object() ? found(json, name) : nullptr;
      if (value == nullptr || !value->is_number()) return {};
      values.push_back(value->get<double>());
    }
    return values;
  }

  double coordinate(const Json& value) const {
    return number(value, "position", -kMaxPlaneCoordinate, kMaxPlaneCoordinate);
  }

  /// Reads the heads and shares of a mixture of heads, which serves as a target or as a source of
  /// colours.
  std::vector<SourceWeight> shares(const Json& json, const std::string& field) const {
    if (!json.is_object() || json.empty()) fail(field, "heads and their shares", json.dump());
    std::vector<SourceWeight> parts;
    double sum = 0;
    for (const auto& [key, value] : json.items()) {
      parts.push_back({head(key, field), number(value, field, 0, 1)});
      sum += parts.back().weight;
    }
    if (std::abs(sum - 1) > kRounding) fail(field, "shares that sum to 1", concat(sum));
    std::erase_if(parts, [](const SourceWeight& part) { return part.weight == 0; });
    std::sort(parts.begin(), parts.end(),
              [](const auto& a, const auto& b) { return a.head < b.head; });
    return parts;
  }

  RegionRecipe region(const Json& json, const std::string& name) const {
    RegionRecipe result;
    static_cast<BandRecipe&>(result) = band(json, name);
    if (const Json* colours = found(json, "colours")) result.colours = shares(*colours, "colours");
    const Json* bands = found(json, "bands");
    const std::size_t finer = std::max<std::size_t>(1, names_.bands.size()) - 1;
    if (finer == 0 && bands == nullptr) return result;
    if (bands == nullptr || !bands->is_object() || bands->size() != finer) {
      fail("bands", concat("an object of ", finer, " bands, all but the first"),
           bands == nullptr ? "none" : bands->dump());
    }
    for (std::size_t b = 1; b <= finer; ++b) {
      const std::string& own = names_.bands[b];
      result.finer_bands.push_back(band(member(*bands, own), own));
      const std::uint64_t before = band_of(result, b - 1).iterations;
      const std::uint64_t begins = result.finer_bands.back().iterations;
      if (begins > before) {
        fail(concat(own, ".iterations"),
             concat("at most the iterations of the previous band, ", before), concat(begins));
      }
    }
    return result;
  }

  BandRecipe band(const Json& json, const std::string& name) const {
    if (!json.is_object()) fail(name, "an object", json.dump());
    BandRecipe result;
    if (const Json& position = member(json, "position"); !position.is_null()) {
      if (!position.is_array() || position.size() != 2) fail("position", "[x, y]", position.dump());
      result.position = PlanePoint(coordinate(position[0]), coordinate(position[1]));
    }
    const Json& weights = member(json, "weights");
    if (!weights.is_object()) fail("weights", "an object", weights.dump());
    double sum = 0;
    for (const auto& [key, value] : weights.items()) {
      result.weights.push_back({head(key, "weights"), number(value, "weights", 0, 1)});
      sum += result.weights.back().weight;
    }
    if (sum > 1 + kRounding) fail("weights", "a sum of at most 1", concat(sum));
    result.smoothness = number(member(json, "smoothness"), "smoothness", 0, 1);
    result.iterations = whole(member(json, "iterations"), "iterations");
    if (result.iterations > kMaxLevel) {
      fail("iterations", concat("at most ", kMaxLevel), concat(result.iterations));
    }
    result.extrapolation = number(member(json, "extrapolation"), "extrapolation",
                                  -kMaxExtrapolation, kMaxExtrapolation);
    return result;
  }

  /// Reads the field `nearest`, which names a face's nearest neighbours. Lines that a user wrote by
  /// hand may omit the field or have a wrong value, because no mesh depends on this field.
  std::optional<NearestNeighbours> nearest(const Json& json) const {
    if (!json.is_object()) return std::nullopt;
    const std::string face = json.value("face", Json()).is_string() ? text(json, "face") : "";
    const auto head = std::find(names_.heads.begin(), names_.heads.end(), face);
    const Json head_mm = json.value("face_mm", Json());
    if (head == names_.heads.end() || !head_mm.is_number()) return std::nullopt;
    NearestNeighbours result{head - names_.heads.begin(), head_mm.get<double>(), std::nullopt, 0};
    const Json crowd_mm = json.value("crowd_mm", Json());
    if (json.value("crowd", Json()).is_string() && crowd_mm.is_number()) {
      result.earlier_face = text(json, "crowd");
      result.earlier_face_distance_mm = crowd_mm.get<double>();
    }
    return result;
  }

  const PlanNames& names_;
  const std::string& place_;
};

}  // namespace

std::string format_plan_line(const FacePlan& face, const PlanNames& names, const Digest& settings) {
  return face_to_json(face, names, settings).dump();
}

PlanLine parse_plan_line(std::string_view line, const PlanNames& names, const std::string& place) {
  return LineReader(names, place).read(line);
}

std::vector<PlanLine> read_plan(const std::filesystem::path& path, const PlanNames& names) {
  std::vector<PlanLine> plan;
  std::size_t number = 0;
  read_lines(path, [&](std::string_view line, bool) {
    ++number;
    if (line.empty()) return;
    plan.push_back(parse_plan_line(line, names, concat(path.string(), ":", number)));
  });
  return plan;
}

TextPieces plan_text(const std::vector<FacePlan>& crowd, const PlanNames& names,
                     const Digest& settings) {
  return text_of_items(crowd.size(), [&crowd, &names, settings](std::size_t i) {
    return format_plan_line(crowd[i], names, settings) + '\n';
  });
}

}  // namespace crowdface
