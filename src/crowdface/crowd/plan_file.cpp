// SPDX-License-Identifier: Apache-2.0
#include "crowdface/crowd/plan_file.h"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "crowdface/blend/recipe_bounds.h"
#include "crowdface/core/error.h"
#include "crowdface/core/rounded.h"
#include "crowdface/core/text.h"
#include "crowdface/crowd/face_json.h"
#include "crowdface/io/shallow_json.h"
#include "crowdface/smooth/level_size.h"

namespace crowdface {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kRounding = 1e-6;  ///< of shares written by hand

/// Reads the fields of one line and says where they are wrong.
class LineReader {
 public:
  LineReader(const PlanNames& names, const std::string& place) : names_(names), place_(place) {}

  PlanLine read(std::string_view line) const {
    const Json json = parse_shallow_json(line);
    if (!json.is_object()) fail("line", "a JSON object", "something else");
    PlanLine result;
    CastFace& face = result.face;
    face.id = file_name(json, "id", kLongestId);
    if (const Json& index = member(json, "index"); !index.is_null()) {
      face.index = whole(index, "index");
    }
    if (const Json& family = member(json, "family"); !family.is_null()) {
      face.family = file_name(json, "family", kLongestName);
    }
    if (json.contains("group")) face.group = file_name(json, "group", kLongestName);
    face.recipe.target = head(text(json, "target"), "target");
    if (const Json* mixture = found(json, "mixture")) {
      set_target(face.recipe, shares(*mixture, "mixture"));
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
    if (const Json* parents = found(json, "parents")) {
      face.parents = {text(*parents, "mother"), text(*parents, "father")};
    }
    if (const Json* share = found(json, "mother_share")) {
      face.mother_share = number(*share, "mother_share", 0, 1);
    }
    if (const Json* inherits = found(json, "inherits")) {
      for (const std::string& name : names_.regions) {
        if (names_.bands.empty()) face.inherits.push_back(text(*inherits, name));
        for (const std::string& band : names_.bands) {
          face.inherits.push_back(text(member(*inherits, name), band));
        }
      }
    }
    if (const Json* worn = found(json, "attachments")) face.attachments = attachments(*worn);
    if (json.contains("note")) face.notes.review = text(json, "note");
    if (const Json* near = found(json, "nearest")) face.notes.nearest = nearest(*near);
    result.settings = text(json, "settings");
    return result;
  }

 private:
  [[noreturn]] void fail(std::string_view field, std::string_view expected,
                         std::string_view found) const {
    throw InvalidInput(
        concat(place_, ": ", field, ": expected ", expected, ", found ", found.substr(0, 80)));
  }

  /// Null if there is none.
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

  /// Pictures and meshes are called by it.
  std::string file_name(const Json& json, const std::string& key, std::size_t longest) const {
    std::string name = text(json, key);
    if (!is_name(name, longest)) {
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
    std::vector<std::string> worn;
    for (const Json& value : json) {
      const std::string name = value.is_string() ? value.get<std::string>() : "";
      const auto& known = names_.attachments;
      if (std::find(known.begin(), known.end(), name) == known.end() ||
          std::find(worn.begin(), worn.end(), name) != worn.end()) {
        fail("attachments", "names of attachments, each once", value.dump());
      }
      worn.push_back(name);
    }
    return worn;
  }

  double coordinate(const Json& value) const {
    return number(value, "position", -kMaxPlaneCoordinate, kMaxPlaneCoordinate);
  }

  /// What a target or colours are mixed of.
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
    const Json* bands = found(json, "bands");
    const std::size_t finer = std::max<std::size_t>(1, names_.bands.size()) - 1;
    if (finer == 0 && bands == nullptr) return result;
    if (bands == nullptr || !bands->is_object() || bands->size() != finer) {
      fail("bands", concat("an object of ", finer, " bands, all but the first"),
           bands == nullptr ? "none" : bands->dump());
    }
    for (std::size_t b = 1; b <= finer; ++b) {
      const std::string& own = names_.bands[b];
      result.finer.push_back(band(member(*bands, own), own));
      const std::uint64_t before = band_of(result, b - 1).iterations;
      const std::uint64_t begins = result.finer.back().iterations;
      if (begins > before) {
        fail(concat(own, ".iterations"), concat("at most those of the band before it, ", before),
             concat(begins));
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

  /// No mesh depends on it, so lines that were written by hand may leave it out or get it wrong.
  std::optional<Nearest> nearest(const Json& json) const {
    if (!json.is_object()) return std::nullopt;
    const std::string face = json.value("face", Json()).is_string() ? text(json, "face") : "";
    const auto head = std::find(names_.heads.begin(), names_.heads.end(), face);
    const Json head_mm = json.value("face_mm", Json());
    if (head == names_.heads.end() || !head_mm.is_number()) return std::nullopt;
    Nearest result{head - names_.heads.begin(), head_mm.get<double>(), std::nullopt, 0};
    const Json crowd_mm = json.value("crowd_mm", Json());
    if (json.value("crowd", Json()).is_string() && crowd_mm.is_number()) {
      result.crowd = text(json, "crowd");
      result.crowd_mm = crowd_mm.get<double>();
    }
    return result;
  }

  const PlanNames& names_;
  const std::string& place_;
};

/// A field of a table: between quotes if it needs them.
std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == text.npos) return text;
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"') out += '"';
    out += c;
  }
  return out + '"';
}

constexpr const char* kBandColumns[] = {"position_x", "position_y", "weights",
                                        "smoothness", "iterations", "extrapolation"};

std::string csv_weights(const std::vector<SourceWeight>& weights, const PlanNames& names) {
  std::vector<std::string> parts;
  for (const SourceWeight& source : weights) {
    parts.push_back(concat(name_at(names.heads, source.head), ':', source.weight));
  }
  return join(parts, ";");
}

void add_band(const BandRecipe& band, const PlanNames& names, std::vector<std::string>& row) {
  row.push_back(band.position ? format_number(band.position->x()) : "");
  row.push_back(band.position ? format_number(band.position->y()) : "");
  row.push_back(csv_field(csv_weights(band.weights, names)));
  row.push_back(format_number(band.smoothness));
  row.push_back(concat(band.iterations));
  row.push_back(format_number(band.extrapolation));
}

/// Columns that only some crowds have.
struct SomeColumns {
  bool mirrored = false, colours = false;
};

SomeColumns columns_of(const std::vector<CastFace>& crowd) {
  SomeColumns some;
  for (const CastFace& face : crowd) {
    some.mirrored = some.mirrored || !is_unmirrored(face.recipe);
    some.colours = some.colours || !face.recipe.colours.empty();
  }
  return some;
}

std::string table_header(const PlanNames& names, const SomeColumns& some) {
  std::vector<std::string> header = {"id", "index", "family", "target"};
  for (const std::string& region : names.regions) {
    for (const char* column : kBandColumns) {
      header.push_back(csv_field(concat(region, '_', column)));
    }
  }
  for (const char* column : {"nearest_face", "nearest_face_mm", "nearest_crowd", "nearest_crowd_mm",
                             "group", "mixture"}) {
    header.emplace_back(column);
  }
  for (const std::string& region : names.regions) {
    for (std::size_t b = 1; b < names.bands.size(); ++b) {
      for (const char* column : kBandColumns) {
        header.push_back(csv_field(concat(region, '_', names.bands[b], '_', column)));
      }
    }
  }
  if (some.mirrored) header.insert(header.end(), {"asymmetry", "mirrored"});
  if (!names.attachments.empty()) header.emplace_back("attachments");
  if (some.colours) header.emplace_back("colours");
  return join(header, ",") + "\r\n";
}

std::string table_row(const CastFace& face, const PlanNames& names, const SomeColumns& some) {
  std::vector<std::string> row = {csv_field(face.id), face.index ? concat(*face.index) : "",
                                  csv_field(face.family.value_or("")),
                                  csv_field(name_at(names.heads, face.recipe.target))};
  for (const RegionRecipe& region : face.recipe.regions) add_band(region, names, row);
  const bool near = face.notes.nearest.has_value();
  const bool near_crowd = near && face.notes.nearest->crowd;
  row.push_back(near ? csv_field(name_at(names.heads, face.notes.nearest->head)) : "");
  row.push_back(near ? format_number(rounded(face.notes.nearest->head_mm)) : "");
  row.push_back(near_crowd ? csv_field(*face.notes.nearest->crowd) : "");
  row.push_back(near_crowd ? format_number(rounded(face.notes.nearest->crowd_mm)) : "");
  row.push_back(csv_field(face.group.value_or("")));
  row.push_back(csv_weights(face.recipe.mixture, names));
  for (const RegionRecipe& region : face.recipe.regions) {
    for (std::size_t b = 1; b < names.bands.size(); ++b) {
      if (b < band_count(region)) {
        add_band(band_of(region, b), names, row);
      } else {
        row.resize(row.size() + std::size(kBandColumns));
      }
    }
  }
  if (some.mirrored) {
    row.push_back(format_number(face.recipe.asymmetry));
    row.emplace_back(face.recipe.mirrored ? "true" : "false");
  }
  if (!names.attachments.empty()) row.push_back(csv_field(join(face.attachments, ";")));
  if (some.colours) row.push_back(csv_weights(face.recipe.colours, names));
  return join(row, ",") + "\r\n";
}

}  // namespace

std::string format_recipe(const CastFace& face, const PlanNames& names, const Digest& settings) {
  return face_to_json(face, names, settings).dump();
}

PlanLine parse_recipe(std::string_view line, const PlanNames& names, const std::string& place) {
  return LineReader(names, place).read(line);
}

std::vector<PlanLine> read_plan(const std::filesystem::path& path, const PlanNames& names) {
  std::vector<PlanLine> plan;
  std::size_t number = 0;
  read_lines(path, [&](std::string_view line, bool) {
    ++number;
    if (line.empty()) return;
    plan.push_back(parse_recipe(line, names, concat(path.string(), ":", number)));
  });
  return plan;
}

TextPieces plan_text(const std::vector<CastFace>& crowd, const PlanNames& names,
                     const Digest& settings) {
  return text_of_items(crowd.size(), [&crowd, &names, settings](std::size_t i) {
    return format_recipe(crowd[i], names, settings) + '\n';
  });
}

TextPieces table_text(const std::vector<CastFace>& crowd, const PlanNames& names) {
  return [&crowd, &names, some = columns_of(crowd)](const TakePiece& take) {
    take(table_header(names, some));
    text_of_items(crowd.size(),
                  [&](std::size_t i) { return table_row(crowd[i], names, some); })(take);
  };
}

}  // namespace crowdface
