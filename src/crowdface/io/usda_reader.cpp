// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

#include <Eigen/Geometry>

#include "crowdface/core/error.h"
#include "crowdface/core/text.h"
#include "crowdface/io/file_mesh.h"
#include "crowdface/io/gltf_file.h"
#include "crowdface/io/mesh_textures.h"
#include "crowdface/io/srgb.h"
#include "crowdface/io/usda_bindings.h"
#include "crowdface/io/usda_tokens.h"

namespace crowdface {
namespace {

constexpr int kDeepest = 200;
constexpr std::size_t kLongestStatement = 16;  // words before '='

struct PrimProperty {
  std::vector<double> numbers;
  std::vector<std::string> texts;  ///< all strings and paths in the property's value
  std::string interpolation;
  /// Whether the property has time samples; the value is then the first time sample.
  bool is_time_sample = false;
};

struct Prim {
  std::string_view type, name;
  std::string path;  ///< path of the prim, such as "/head/skin"
  std::map<std::string, PrimProperty, std::less<>> properties;
  std::string colours;  ///< name of the primvar that holds vertex colours
  /// names of the primvars of texture coordinates by their rank (see rank_of_uvs)
  std::multimap<int, std::string> uvs;
  std::vector<Prim> subsets, shaders;

  const PrimProperty* find(std::string_view property) const {
    const auto found = properties.find(property);
    return found == properties.end() ? nullptr : &found->second;
  }
};

/// A Mesh prim and the transform from its axes to the axes of a prim above it, or of the layer.
struct MeshPrim {
  Eigen::Matrix4d place;
  /// Whether `place` transforms to the axes of the layer, so that no prim above changes `place`.
  bool has_final_place;
  Prim prim;
  bool is_hidden = false;  ///< whether the prim, or a prim above it, is inactive or invisible
  /// Whether the prim, or a prim above it, has a property with only time samples.
  bool is_animated = false;
};

/// Whether a primvar has a value for each corner or vertex.
/// \param width  numbers per value
bool varies(const PrimProperty& primvar, std::size_t width) {
  return primvar.numbers.size() >= width &&
         (primvar.interpolation == "faceVarying" || primvar.interpolation == "vertex" ||
          primvar.interpolation == "varying");
}

/// Ranks a primvar by how likely it holds texture coordinates; lower is likelier. Rank 0 is the
/// name that USD recommends, rank 1 are the usual names of other programs. Used only for meshes
/// whose materials name no primvar.
int rank_of_uvs(std::string_view type, std::string_view primvar) {
  const std::string name = lower_case(primvar.substr(primvar.find(':') + 1));
  if (name == "st") return 0;
  if (name == "map1" || name.starts_with("uv")) return 1;
  return type.starts_with("texCoord") ? 2 : 3;
}

/// The size of a value (2 or 3 numbers) if a primvar of this type and name may be texture
/// coordinates; otherwise 0. Values of three numbers are texture coordinates only if the type or a
/// usual name says so.
std::size_t uv_width(std::string_view type, std::string_view primvar) {
  for (const std::string_view start : {"texCoord", "float", "double", "half"}) {
    if (!type.starts_with(start)) continue;
    const std::string_view rest = type.substr(start.size());
    if (rest.starts_with('2')) return 2;
    return rest.starts_with('3') && (start == "texCoord" || rank_of_uvs(type, primvar) < 2) ? 3 : 0;
  }
  return 0;
}

/// Removes the third number of each value, such as the w of texture coordinates.
void remove_third_numbers(std::vector<double>& numbers) {
  for (std::size_t i = 0; i < numbers.size() / 3; ++i) {
    numbers[2 * i] = numbers[3 * i];
    numbers[2 * i + 1] = numbers[3 * i + 1];
  }
  numbers.resize(numbers.size() / 3 * 2);
}

/// A rotation about axes by angles in degrees.
/// \param order  order of the rotations; "XYZ" rotates about x first
Eigen::Matrix3d euler_rotation(std::string_view order, const std::vector<double>& degrees) {
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  for (std::size_t i = 0; i < order.size(); ++i) {
    const int axis = order[i] - 'X';
    const double angle = degrees[order.size() == 1 ? 0 : static_cast<std::size_t>(axis)];
    turn = Eigen::AngleAxisd(angle * std::numbers::pi / 180, Eigen::Vector3d::Unit(axis)) * turn;
  }
  return turn;
}

/// The matrix of one transform operation, such as "xformOp:rotateXYZ:pivot". An unknown operation
/// gives the identity.
Eigen::Matrix4d matrix_of(std::string_view step, const std::vector<double>& numbers) {
  constexpr std::string_view kPrefix = "xformOp:";
  step.remove_prefix(std::min(kPrefix.size(), step.size()));
  const std::string_view kind = step.substr(0, step.find(':'));
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  const std::size_t count = numbers.size();
  if (kind == "transform" && count == 16) return matrix_from(numbers);  // USD uses row vectors
  if (kind == "translate" && count == 3) {
    matrix.topRightCorner<3, 1>() = Eigen::Vector3d(numbers.data());
  } else if (kind == "scale" && count == 3) {
    matrix.diagonal().head<3>() = Eigen::Vector3d(numbers.data());
  } else if (kind == "orient" && count == 4) {
    matrix.topLeftCorner<3, 3>() =
        Eigen::Quaterniond(numbers[0], numbers[1], numbers[2], numbers[3]).toRotationMatrix();
  } else if (kind.starts_with("rotate")) {
    const std::string_view order = kind.substr(6);
    const bool is_known = order.find_first_not_of("XYZ") == order.npos && count == order.size() &&
                          (count == 1 || count == 3);
    if (is_known) matrix.topLeftCorner<3, 3>() = euler_rotation(order, numbers);
  }
  return matrix;
}

/// A transform of texture coordinates, as UsdTransform2d defines it: scale, then rotation, then
/// translation.
struct UsdUvTransform {
  std::array<double, 2> scale = {1, 1}, translation = {0, 0};
  double degrees = 0;
  auto operator<=>(const UsdUvTransform&) const = default;  // NOLINT(modernize-use-nullptr)
};

/// Texture coordinates: the name of a primvar without "primvars:", and a transform.
struct UvSource {
  std::string primvar;
  UsdUvTransform transform;
  auto operator<=>(const UvSource&) const = default;  // NOLINT(modernize-use-nullptr)
};

/// The transform that a prim's xformOpOrder describes: from the prim's axes to the axes of its
/// parent, or to the axes of the layer.
struct LocalTransform {
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  /// whether `matrix` transforms to the axes of the layer instead of the parent's axes
  bool ignores_parents = false;
};

LocalTransform local_transform(const Prim& prim) {
  constexpr std::string_view kInverse = "!invert!";
  LocalTransform local;
  const PrimProperty* order = prim.find("xformOpOrder");
  if (order == nullptr) return local;
  for (const std::string& step : order->texts) {
    if (step == "!resetXformStack!") {
      local = {Eigen::Matrix4d::Identity(), true};
      continue;
    }
    const bool is_inverse = step.starts_with(kInverse);
    const std::string_view name = std::string_view(step).substr(is_inverse ? kInverse.size() : 0);
    const PrimProperty* value = prim.find(name);
    if (value == nullptr) continue;
    const Eigen::Matrix4d matrix = matrix_of(name, value->numbers);
    local.matrix =
        matrix_product(local.matrix, is_inverse ? Eigen::Matrix4d(matrix.inverse()) : matrix);
  }
  return local;
}

class UsdaReader {
 public:
  UsdaReader(std::string_view text, const std::string& name) : name_(name), tokens_(text, name) {}

  FileMesh read() {
    for (UsdaToken token = tokens_.next(); token.kind != UsdaToken::Kind::kEnd;
         token = tokens_.next()) {
      if (token.is('(')) tokens_.consume_group();
      if (is_prim(token)) read_prim(token, 0, nullptr);
    }
    std::vector<std::string> unused;
    bool is_animated = false;
    for (const MeshPrim& mesh : meshes_) {
      const std::string_view purpose = text_of(mesh.prim, "purpose");
      if (mesh.is_hidden || purpose == "guide" || purpose == "proxy") {
        unused.emplace_back(mesh.prim.name);
      } else {
        add_mesh(mesh.prim, mesh.place);
        is_animated = is_animated || mesh.is_animated;
      }
    }
    if (points_.empty() && !unused.empty()) {
      fail(concat("expected a mesh that is shown, found only: ", join(unused)));
    }
    if (is_animated) {
      mesh_.notes.emplace_back("its meshes are animated: the first time sample is used");
    }
    if (!unused.empty()) {
      mesh_.notes.push_back(
          "its meshes that are inactive, invisible, guides or proxies are not used: " +
          join(unused));
    }
    if (points_.empty()) {
      fail(
          "it defines no mesh itself; if it refers to other files or has variants, run usdcat "
          "--flatten -o flat.usda FILE and read flat.usda");
    }
    finish();
    return std::move(mesh_);
  }

 private:
  [[noreturn]] void fail(std::string_view what) const { tokens_.fail(what); }

  static bool is_prim(const UsdaToken& token) {
    return token.is_word("def") || token.is_word("over") || token.is_word("class");
  }

  void read_prim(const UsdaToken& keyword, int depth, Prim* parent) {
    if (depth > kDeepest) fail("its prims are nested too deeply");
    Prim prim;
    UsdaToken token = tokens_.next();
    if (token.kind == UsdaToken::Kind::kWord) {
      prim.type = token.text;
      token = tokens_.next();
    }
    prim.name = token.text;
    prim.path = concat(parent == nullptr ? std::string() : parent->path, '/', prim.name);
    token = tokens_.next();
    bool is_hidden = false;
    if (token.is('(')) {
      const std::string active = tokens_.consume_group("active");
      is_hidden = active == "false" || active == "0";
      token = tokens_.next();
    }
    if (!token.is('{')) fail(concat("expected the body of ", quoted(std::string(prim.name))));
    if (!keyword.is_word("def")) {  // `over` and `class` define no prim
      tokens_.consume_group();
      return;
    }
    const std::size_t first_mesh = meshes_.size();
    std::vector<std::string_view> words;
    for (token = tokens_.next(); !token.is('}'); token = tokens_.next()) {
      if (token.kind == UsdaToken::Kind::kEnd) fail("it ends within a prim");
      if (is_prim(token)) {
        read_prim(token, depth + 1, &prim);
        words.clear();
      } else if (token.is('=')) {
        read_property(words, prim);
        words.clear();
      } else if (token.is('(') || token.is('{') || token.is('[')) {
        const std::string interpolation = tokens_.consume_group();
        // A primvar with time samples has its interpolation in a statement without a value.
        if (!words.empty() && words.back().starts_with("primvars:")) {
          prim.properties[std::string(words.back())].interpolation = interpolation;
        }
        words.clear();
      } else if (token.kind == UsdaToken::Kind::kWord) {
        if (words.size() == kLongestStatement) words.erase(words.begin());
        words.push_back(token.text);
      }
    }
    if (prim.type == "Material") add_textures(prim);
    is_hidden = is_hidden || text_of(prim, "visibility") == "invisible";
    const bool is_animated = std::ranges::any_of(
        prim.properties, [](const auto& property) { return property.second.is_time_sample; });
    const LocalTransform local = local_transform(prim);
    for (std::size_t m = first_mesh; m < meshes_.size(); ++m) {
      if (!meshes_[m].has_final_place) {
        meshes_[m].place = matrix_product(local.matrix, meshes_[m].place);
        meshes_[m].has_final_place = local.ignores_parents;
      }
      meshes_[m].is_hidden = meshes_[m].is_hidden || is_hidden;
      meshes_[m].is_animated = meshes_[m].is_animated || is_animated;
      inherit("purpose", prim, meshes_[m].prim);
    }
    if (prim.type == "Mesh") {
      meshes_.push_back(
          {local.matrix, local.ignores_parents, std::move(prim), is_hidden, is_animated});
      return;
    }
    if (parent != nullptr && prim.type == "NodeGraph") {
      std::ranges::move(prim.shaders, std::back_inserter(parent->shaders));
    }
    if (parent != nullptr && prim.type == "Shader") {
      parent->shaders.push_back(std::move(prim));
      return;
    }
    if (prim.type == "GeomSubset" && parent != nullptr) parent->subsets.push_back(std::move(prim));
  }

  /// Gives a prim the property of its parent unless the prim has its own.
  static void inherit(const char* property, const Prim& parent, Prim& prim) {
    const PrimProperty* inherited = parent.find(property);
    if (inherited != nullptr) prim.properties.try_emplace(property, *inherited);
  }

  /// Reads the value of a property and stores it in `prim`.
  /// \param words  the words before '=', such as "uniform", "token" and "orientation"
  void read_property(const std::vector<std::string_view>& words, Prim& prim) {
    constexpr std::string_view kTimeSamples = ".timeSamples";
    std::string name(words.empty() ? std::string_view() : words.back());
    const std::string_view type = words.size() < 2 ? std::string_view() : words[words.size() - 2];
    PrimProperty property;
    property.is_time_sample = name.ends_with(kTimeSamples) && tokens_.consume('{');
    if (property.is_time_sample) {
      name.resize(name.size() - kTimeSamples.size());
      // Skip the time code and the colon, which come before the value.
      UsdaToken token = tokens_.next();
      if (token.is('}')) return;
      if (!token.text.ends_with(':')) token = tokens_.next();
    }
    constexpr std::array<std::string_view, 5> kNumbers = {
        "points", "faceVertexCounts", "faceVertexIndices", "indices", "holeIndices"};
    const bool is_plain = name.find('.') == name.npos;  // "points.connect"
    const bool is_primvar = name.starts_with("primvars:");
    const bool is_uv_transform =
        type.starts_with("float") &&
        (name == "inputs:scale" || name == "inputs:translation" || name == "inputs:rotation");
    const std::size_t uv_numbers = is_primvar ? uv_width(type, name) : 0;
    const bool is_binding = name.starts_with("material:binding") || name.starts_with("collection:");
    const bool is_list = name == "xformOpOrder" || is_binding;
    const bool is_text =
        name == "orientation" || name == "visibility" || name == "purpose" || name == "info:id" ||
        name.ends_with(".connect") ||
        (name.starts_with("inputs:") && (type == "asset" || type == "string" || type == "token"));
    if (is_plain &&
        (std::ranges::find(kNumbers, name) != kNumbers.end() || name.starts_with("xformOp:") ||
         is_uv_transform ||
         (is_primvar && (uv_numbers > 0 || type.starts_with("color3") || type == "int[]")))) {
      property.numbers = tokens_.read_numbers(name);
      if (uv_numbers == 3) remove_third_numbers(property.numbers);
    } else {
      const UsdaToken token = tokens_.next();
      const bool is_value =
          token.kind == UsdaToken::Kind::kQuoted || (is_binding && name.ends_with(":includeRoot"));
      if (is_value && (is_list || is_text)) {
        property.texts.emplace_back(token.text);
      }
      if (token.is('[') && is_list) {
        for (UsdaToken item = tokens_.next(); !item.is(']') && item.kind != UsdaToken::Kind::kEnd;
             item = tokens_.next()) {
          if (item.kind == UsdaToken::Kind::kQuoted) property.texts.emplace_back(item.text);
        }
      } else if (token.is('(') || token.is('[') || token.is('{')) {
        tokens_.consume_group();
      }
    }
    if (tokens_.consume('(')) {
      property.interpolation =
          tokens_.consume_group(is_binding ? "bindMaterialAs" : "interpolation");
    }
    if (is_binding) bindings_.add(prim.path, name, property.texts, property.interpolation);
    if (property.is_time_sample) {
      tokens_.consume_group();
      if (property.numbers.empty() && property.texts.empty()) return;
    }
    PrimProperty& known = prim.properties[name];
    if (property.is_time_sample) {
      if (!known.numbers.empty() || !known.texts.empty()) return;
      property.interpolation = known.interpolation;
    }
    if (uv_numbers > 0) prim.uvs.emplace(rank_of_uvs(type, name), name);
    if (name == "primvars:displayColor") prim.colours = name;
    known = std::move(property);
  }

  std::uint32_t index_of(double number, std::size_t count) const {
    if (number >= 0 && number < static_cast<double>(count)) {
      return static_cast<std::uint32_t>(number);
    }
    fail(concat("expected an index below ", count, ", found ", number));
  }

  /// Returns, for each corner, the row of its value in a primvar. Empty if the prim has no such
  /// primvar.
  std::vector<std::uint32_t> rows_of_corners(const Prim& prim, const std::string& primvar,
                                             std::size_t width,
                                             const std::vector<std::uint32_t>& vertices) const {
    const PrimProperty* values = primvar.empty() ? nullptr : prim.find(primvar);
    if (values == nullptr || !varies(*values, width)) return {};
    const bool of_corners = values->interpolation == "faceVarying";
    const PrimProperty* indices = prim.find(primvar + ":indices");
    const std::size_t rows = values->numbers.size() / width;
    std::vector<std::uint32_t> result;
    for (std::size_t c = 0; c < vertices.size(); ++c) {
      std::size_t row = of_corners ? c : vertices[c];
      if (indices != nullptr && !indices->numbers.empty()) {
        const std::size_t count = indices->numbers.size();
        row = index_of(indices->numbers[index_of(static_cast<double>(row), count)], rows);
      }
      result.push_back(index_of(static_cast<double>(row), rows));
    }
    return result;
  }

  /// The first text of a property; empty if there is none.
  static std::string_view text_of(const Prim& prim, std::string_view property) {
    const PrimProperty* found = prim.find(property);
    return found == nullptr || found->texts.empty() ? std::string_view() : found->texts[0];
  }

  /// The input `input` of `shader` may be connected to an output of another shader of the same
  /// material, by a path such as "/head/skin/colour.outputs:rgb". Returns this other shader; null
  /// if there is none.
  static const Prim* connected(const Prim& material, const Prim& shader, std::string_view input) {
    std::string_view path = text_of(shader, concat(input, ".connect"));
    path = path.substr(0, path.find('.'));
    path = path.substr(path.rfind('/') + 1);
    const auto found = std::ranges::find(material.shaders, path, &Prim::name);
    return path.empty() || found == material.shaders.end() ? nullptr : &*found;
  }

  /// Returns the value of a shader's input. If this input has no value of its own but is connected
  /// to an input of the material, returns the value of the material's input.
  static std::string_view input_text(const Prim& material, const Prim& shader,
                                     std::string_view input) {
    const std::string_view own = text_of(shader, input);
    const std::string_view from = text_of(shader, concat(input, ".connect"));
    return own.empty() ? text_of(material, from.substr(from.rfind('.') + 1)) : own;
  }

  /// The texture coordinates of a texture. The primvar is empty if no UsdPrimvarReader names one.
  static UvSource uv_source(const Prim& material, const Prim& texture) {
    UvSource source;
    const Prim* reader = connected(material, texture, "inputs:st");
    if (reader != nullptr && text_of(*reader, "info:id") == "UsdTransform2d") {
      source.transform = uv_transform(*reader);
      reader = connected(material, *reader, "inputs:in");
    }
    if (reader != nullptr) source.primvar = input_text(material, *reader, "inputs:varname");
    return source;
  }

  static UsdUvTransform uv_transform(const Prim& shader) {
    UsdUvTransform transform;
    const auto numbers = [&](std::string_view input, std::size_t count) {
      const PrimProperty* found = shader.find(input);
      return found != nullptr && found->numbers.size() == count ? found->numbers.data() : nullptr;
    };
    if (const double* scale = numbers("inputs:scale", 2))
      std::copy_n(scale, 2, transform.scale.data());
    if (const double* by = numbers("inputs:translation", 2))
      std::copy_n(by, 2, transform.translation.data());
    if (const double* degrees = numbers("inputs:rotation", 1)) transform.degrees = *degrees;
    return transform;
  }

  /// Adds the image files that the preview surface of a material uses.
  void add_textures(const Prim& material) {
    for (const Prim& surface : material.shaders) {
      if (text_of(surface, "info:id") != "UsdPreviewSurface") continue;
      for (const auto& [input, kind] : {std::pair("inputs:diffuseColor", TextureKind::kColour),
                                        std::pair("inputs:normal", TextureKind::kNormal),
                                        std::pair("inputs:roughness", TextureKind::kRoughness)}) {
        const Prim* texture = connected(material, surface, input);
        if (texture == nullptr || text_of(*texture, "info:id") != "UsdUVTexture") continue;
        UvSource& uvs = uvs_of_material_[std::string(material.name)];
        if (uvs.primvar.empty()) uvs = uv_source(material, *texture);
        const std::string_view file = input_text(material, *texture, "inputs:file");
        if (file.empty()) continue;
        mesh_.textures.push_back({std::string(material.name), kind, {}});
        files_.emplace_back(file);
      }
      return;
    }
  }

  /// The texture coordinates of a mesh's polygons that have this material. The primvar is empty if
  /// there is none.
  UvSource uvs_of(const Prim& prim, const std::string& material) const {
    const auto wanted = uvs_of_material_.find(material);
    UvSource best;
    if (wanted != uvs_of_material_.end()) best.transform = wanted->second.transform;
    for (const auto& [rank, name] : prim.uvs) {
      if (!varies(*prim.find(name), 2)) continue;
      const bool is_wanted =
          wanted != uvs_of_material_.end() && name == "primvars:" + wanted->second.primvar;
      if (is_wanted || best.primvar.empty()) best.primvar = name;
      if (is_wanted) break;
    }
    return best;
  }

  void add_mesh(const Prim& prim, const Eigen::Matrix4d& place) {
    const PrimProperty *points = prim.find("points"), *counts = prim.find("faceVertexCounts"),
                       *corners = prim.find("faceVertexIndices");
    if (points == nullptr || counts == nullptr || corners == nullptr) return;
    const std::size_t vertices = points->numbers.size() / 3, first = points_.size() / 3,
                      faces = counts->numbers.size();
    for (std::size_t v = 0; v < vertices; ++v) {
      const Eigen::Vector3d point = transform_point(place, &points->numbers[3 * v]);
      points_.insert(points_.end(), point.data(), point.data() + 3);
    }
    std::vector<std::uint32_t> all;
    for (const double corner : corners->numbers) all.push_back(index_of(corner, vertices));
    const auto colour_rows = rows_of_corners(prim, prim.colours, 3, all);
    any_colours_ = any_colours_ || !colour_rows.empty();
    colours_.resize(points_.size(), 1);
    for (std::size_t c = 0; c < colour_rows.size(); ++c) {
      const double* light = &prim.find(prim.colours)->numbers[3 * std::size_t{colour_rows[c]}];
      for (std::size_t k = 0; k < 3; ++k) {
        colours_[3 * (first + all[c]) + k] = srgb_of_linear(light[k]);
      }
    }
    std::vector<std::string> materials(faces, material_of(prim));
    const std::string of_mesh = bindings_.material_of(prim.path);
    for (const Prim& subset : prim.subsets) {
      const PrimProperty* of = subset.find("indices");
      // A subset without a binding of its own inherits the material of its mesh.
      if (of == nullptr || bindings_.material_of(subset.path) == of_mesh) continue;
      for (const double face : of->numbers) materials[index_of(face, faces)] = material_of(subset);
    }
    std::vector<bool> is_hole(faces, false);
    if (const PrimProperty* holes = prim.find("holeIndices")) {
      for (const double face : holes->numbers) is_hole[index_of(face, faces)] = true;
    }
    const PrimProperty* orientation = prim.find("orientation");
    const bool is_left = orientation != nullptr && !orientation->texts.empty() &&
                         orientation->texts[0] == "leftHanded";
    const bool is_turned = is_left != (place.topLeftCorner<3, 3>().determinant() < 0);
    std::map<UvSource, std::vector<std::uint32_t>> uv_rows;
    const std::vector<std::uint32_t>* rows = nullptr;
    std::size_t begin = 0;
    for (std::size_t f = 0; f < faces; ++f) {
      const std::size_t count = index_of(counts->numbers[f], all.size() - begin + 1);
      if (f == 0 || materials[f] != materials[f - 1]) {
        const UvSource source = uvs_of(prim, materials[f]);
        const auto [known, is_new] = uv_rows.try_emplace(source);
        if (is_new) known->second = add_uvs(prim, source, all);
        rows = &known->second;
      }
      if (!is_hole[f]) add_face(begin, count, is_turned, all, *rows, first, materials[f]);
      begin += count;
    }
  }

  /// Appends the transformed values of a primvar to the texture coordinates, and returns the row of
  /// each corner.
  std::vector<std::uint32_t> add_uvs(const Prim& prim, const UvSource& source,
                                     const std::vector<std::uint32_t>& vertices) {
    std::vector<std::uint32_t> rows = rows_of_corners(prim, source.primvar, 2, vertices);
    if (rows.empty()) return rows;
    for (std::uint32_t& row : rows) row += static_cast<std::uint32_t>(uvs_.size() / 2);
    const auto& numbers = prim.find(source.primvar)->numbers;
    const UsdUvTransform& by = source.transform;
    const double angle = by.degrees * std::numbers::pi / 180;
    const double cos = std::cos(angle), sin = std::sin(angle);
    for (std::size_t i = 0; i + 1 < numbers.size(); i += 2) {
      const double u = numbers[i] * by.scale[0], v = numbers[i + 1] * by.scale[1];
      uvs_.push_back(cos * u - sin * v + by.translation[0]);
      uvs_.push_back(sin * u + cos * v + by.translation[1]);
    }
    return rows;
  }

  void add_face(std::size_t begin, std::size_t count, bool is_turned,
                const std::vector<std::uint32_t>& vertices,
                const std::vector<std::uint32_t>& uv_rows, std::size_t first,
                const std::string& material) {
    if (count < 3) return;
    Topology& topology = mesh_.topology;
    if (mesh_.materials.empty() || mesh_.materials.back().name != material) {
      mesh_.materials.push_back({material, topology.face_count()});
    }
    for (std::size_t c = 0; c < count; ++c) {
      const std::size_t corner = begin + (is_turned ? (count - c) % count : c);
      topology.corner_vertices.push_back(static_cast<std::uint32_t>(first) + vertices[corner]);
      topology.corner_uvs.push_back(uv_rows.empty() ? kNoIndex : uv_rows[corner]);
    }
    topology.face_offsets.push_back(static_cast<std::uint32_t>(topology.corner_vertices.size()));
  }

  /// The name of the material bound to the prim; without a bound material, the name of the prim.
  std::string material_of(const Prim& prim) const {
    const std::string path = bindings_.material_of(prim.path);
    return path.empty() ? std::string(prim.name) : path.substr(path.rfind('/') + 1);
  }

  void finish() {
    set_vertex_data(mesh_, points_, uvs_, any_colours_ ? colours_ : std::vector<double>());
    read_texture_files(std::move(files_), name_, mesh_);
  }

  const std::string& name_;
  UsdaTokens tokens_;
  FileMesh mesh_;
  UsdaBindings bindings_;
  /// The Mesh prims of the layer; added to `mesh_` when all materials are known.
  std::vector<MeshPrim> meshes_;
  std::map<std::string, UvSource> uvs_of_material_;
  std::vector<double> points_, uvs_, colours_;
  std::vector<std::string> files_;  ///< the file name of each texture in `mesh_`
  bool any_colours_ = false;
};

}  // namespace

FileMesh parse_usda(std::string_view text, const std::string& name) {
  return UsdaReader(text, name).read();
}

}  // namespace crowdface
