// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/gltf_file.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/text.h"
#include "crowdface/io/glb_container.h"
#include "crowdface/io/gltf_compression.h"
#include "crowdface/io/texture_search.h"
#include "crowdface/mesh/topology.h"

namespace crowdface {
namespace {

using namespace gltf;
using GltfJson = GltfFile::Json;

/// Largest absolute value that the matrix of a node may contain; for a translation, 1000 km.
constexpr double kMaxMatrixEntry = 1e6;
/// The reader reads at most kNumbersOfAnyFile + kMaxNumbersPerByte · (bytes in the file's buffers)
/// numbers.
constexpr std::size_t kNumbersOfAnyFile = 1U << 21U, kMaxNumbersPerByte = 4;

constexpr const char* kIsVersion1 =
    "expected glTF 2.0, found version 1: export it again, or convert it (gltf-pipeline -i in.glb "
    "-o out.glb)";

std::size_t size_of_type(int type) {
  if (type == kUnsignedByte || type == kByte) return 1;
  if (type == kUnsignedShort || type == kShort) return 2;
  return 4;
}

/// The number by which a normalized integer of this component type is divided; 1 for other types.
double max_of_type(int type) {
  if (type == kUnsignedByte) return 255;
  if (type == kByte) return 127;
  if (type == kUnsignedShort) return 65535;
  if (type == kShort) return 32767;
  return 1;
}

std::string decoded_base64(std::string_view text) {
  std::string out;
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    constexpr std::string_view kDigits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const std::size_t digit = kDigits.find(c);
    if (digit == kDigits.npos) break;
    bits = bits << 6U | static_cast<std::uint32_t>(digit);
    count += 6;
    if (count < 8) continue;
    count -= 8;
    out += static_cast<char>(bits >> static_cast<unsigned>(count) & 0xffU);
  }
  return out;
}

/// Reads a list of numbers of a node; returns `if_missing` if the node does not have the list.
/// \throws InvalidInput (exit 65) if the list has another length than `if_missing`.
std::vector<double> numbers_of_node(const GltfFile& file, std::size_t node, const char* key,
                                    const std::vector<double>& if_missing) {
  std::vector<double> numbers = file.scene().at("nodes")[node].value(key, if_missing);
  if (numbers.size() != if_missing.size()) {
    file.fail(concat("expected ", if_missing.size(), " numbers in the ", key, " of node ", node,
                     ", found ", numbers.size()));
  }
  return numbers;
}

Eigen::Matrix4d local_matrix(const GltfFile& file, std::size_t node) {
  if (file.scene().at("nodes")[node].contains("matrix")) {
    return matrix_from(numbers_of_node(file, node, "matrix", std::vector<double>(16)));
  }
  const std::vector<double> t = numbers_of_node(file, node, "translation", {0, 0, 0}),
                            q = numbers_of_node(file, node, "rotation", {0, 0, 0, 1}),
                            s = numbers_of_node(file, node, "scale", {1, 1, 1});
  const double x = q[0], y = q[1], z = q[2], w = q[3];
  Eigen::Matrix4d matrix;
  matrix << s[0] * (1 - 2 * (y * y + z * z)), s[1] * 2 * (x * y - z * w),
      s[2] * 2 * (x * z + y * w), t[0],  //
      s[0] * 2 * (x * y + z * w), s[1] * (1 - 2 * (x * x + z * z)), s[2] * 2 * (y * z - x * w),
      t[1],  //
      s[0] * 2 * (x * z - y * w), s[1] * 2 * (y * z + x * w), s[2] * (1 - 2 * (x * x + y * y)),
      t[2],  //
      0, 0, 0, 1;
  return matrix;
}

}  // namespace

Eigen::Matrix4d matrix_from(const std::vector<double>& columns) {
  Eigen::Matrix4d matrix;
  for (Index c = 0; c < 4; ++c) {
    for (Index r = 0; r < 4; ++r) matrix(r, c) = columns.at(static_cast<std::size_t>(4 * c + r));
  }
  return matrix;
}

Eigen::Matrix4d matrix_product(const Eigen::Matrix4d& a, const Eigen::Matrix4d& b) {
  Eigen::Matrix4d product;
  for (Index r = 0; r < 4; ++r) {
    for (Index c = 0; c < 4; ++c) {
      product(r, c) = a(r, 0) * b(0, c) + a(r, 1) * b(1, c) + a(r, 2) * b(2, c) + a(r, 3) * b(3, c);
    }
  }
  return product;
}

Eigen::Vector3d transform_point(const Eigen::Matrix4d& matrix, const double* point) {
  Eigen::Vector3d to;
  for (Index r = 0; r < 3; ++r) {
    to[r] =
        matrix(r, 0) * point[0] + matrix(r, 1) * point[1] + matrix(r, 2) * point[2] + matrix(r, 3);
  }
  return to;
}

GltfFile::GltfFile(std::string_view bytes, std::filesystem::path path) : path_(std::move(path)) {
  if (bytes.starts_with("glTF")) {
    if (bytes.size() >= glb::kFileHeaderSize && number_at<std::uint32_t>(bytes.data() + 4) == 1)
      fail(kIsVersion1);
    const auto chunks = glb_chunks(bytes);
    if (!chunks)
      fail(
          "expected a binary glTF 2.0 file (GLB), found one that is cut off or damaged: copy or "
          "export it again");
    scene_ = parse_shallow_json(chunks->json);
    binary_ = chunks->binary;
  } else {
    scene_ = parse_shallow_json(bytes);
  }
  if (!scene_.is_object())
    fail("expected a glTF 2.0 file, found JSON that cannot be read: export it again");
  const auto asset = scene_.find("asset");
  if (asset != scene_.end() && asset->is_object() && asset->contains("version") &&
      asset->at("version").is_string() &&
      asset->at("version").get<std::string>().starts_with("1.")) {
    fail(kIsVersion1);
  }
  remaining_numbers_ = kNumbersOfAnyFile + kMaxNumbersPerByte * binary_.size();
}

void GltfFile::fail(const std::string& what) const {
  refuse_file(path_, what);
}

std::string GltfFile::read_uri(const std::string& uri, const std::string& what) const {
  if (uri.starts_with("data:")) {
    const std::size_t comma = uri.find(',');
    if (comma == uri.npos) fail(concat(what, " has no data"));
    return decoded_base64(std::string_view(uri).substr(comma + 1));
  }
  std::string named = percent_decoded(uri).value_or(std::string(uri));
  std::ranges::replace(named, '\\', '/');
  const std::filesystem::path file = named, folder = path_.parent_path();
  const bool inside = file.is_relative() && !file.lexically_normal().string().starts_with("..");
  if (inside && is_file(folder / file)) return read_file(folder / file);
  if (const auto found = search_texture(folder, file, path_.stem())) {
    return read_file(folder / *found);
  }
  if (!inside) fail(concat("its data lie outside its folder, at ", quoted(uri)));
  throw MissingInput(concat((folder / file).string(), ": is missing; ", path_.string(),
                            " keeps its data there (export GLB, which is one file)"));
}

std::string_view GltfFile::buffer(std::size_t number) {
  const Json& json = scene_.at("buffers").at(number);
  const std::string what = concat("its buffer ", number);
  if (!json.contains("uri")) {
    if (number != 0) fail(what + " has no data");
    return binary_;
  }
  const auto [known, is_new] = decoded_buffers_.try_emplace(number);
  if (!is_new) return known->second;
  known->second = read_uri(json.at("uri").get<std::string>(), what);
  remaining_numbers_ += kMaxNumbersPerByte * known->second.size();
  return known->second;
}

std::string_view GltfFile::view(std::size_t number) {
  const Json& json = scene_.at("bufferViews").at(number);
  const auto part = [&](const Json& of) {
    const std::string_view all = buffer(of.value("buffer", std::size_t{0}));
    const auto begin = of.value("byteOffset", std::size_t{0});
    const auto length = of.at("byteLength").get<std::size_t>();
    if (begin > all.size() || length > all.size() - begin) {
      fail(concat("its buffer view ", number, " reaches beyond the end of its buffer"));
    }
    return all.substr(begin, length);
  };
  for (const char* name : {"EXT_meshopt_compression", "KHR_meshopt_compression"}) {
    if (!json.contains("extensions") || !json["extensions"].contains(name)) continue;
    const auto [known, is_new] = decoded_views_.try_emplace(number);
    if (!is_new) return known->second;
    const Json& packed = json["extensions"][name];
    auto bytes = decode_meshopt(
        part(packed),
        {packed.at("count").get<std::size_t>(), packed.at("byteStride").get<std::size_t>(),
         packed.value("mode", std::string()), packed.value("filter", std::string())});
    if (!bytes) {
      fail(concat(
          "it is compressed with ", name, ", and its buffer view ", number,
          " cannot be unpacked; gltf-transform copy in.glb out.glb writes it without compression"));
    }
    known->second = std::move(*bytes);
    remaining_numbers_ += kMaxNumbersPerByte * known->second.size();
    return known->second;
  }
  return part(json);
}

/// Subtracts `more` from `remaining_numbers_`; fails if fewer numbers remain. The limit is
/// necessary because many nodes may use one mesh, and several accessors may share data, so that a
/// small file may describe a huge mesh.
void GltfFile::reserve_numbers(std::size_t more) {
  if (more > remaining_numbers_) {
    fail("its meshes and skins use far more numbers than its buffers have bytes");
  }
  remaining_numbers_ -= more;
}

std::vector<double> GltfFile::read_rows(std::size_t view_index, std::size_t byte_offset, int type,
                                        std::size_t count, std::size_t width,
                                        std::size_t accessor) {
  const std::string_view bytes = view(view_index);
  const std::size_t size = size_of_type(type);
  const std::size_t stride =
      scene_.at("bufferViews").at(view_index).value("byteStride", size * width);
  if (byte_offset > bytes.size() || stride < size * width ||
      count > (bytes.size() - byte_offset) / stride + 1 ||
      (count > 0 && (count - 1) * stride + size * width > bytes.size() - byte_offset)) {
    fail(concat("its accessor ", accessor, " reaches beyond the end of its buffer view"));
  }
  reserve_numbers(count * width);
  std::vector<double> numbers;
  numbers.reserve(count * width);
  const auto take = [&]<class T>(T) {
    for (std::size_t row = 0; row < count; ++row) {
      const char* at = bytes.data() + byte_offset + row * stride;
      for (std::size_t c = 0; c < width; ++c) {
        numbers.push_back(static_cast<double>(number_at<T>(at + c * sizeof(T))));
      }
    }
  };
  if (type == kUnsignedByte) {
    take(std::uint8_t{});
  } else if (type == kByte) {
    take(std::int8_t{});
  } else if (type == kUnsignedShort) {
    take(std::uint16_t{});
  } else if (type == kShort) {
    take(std::int16_t{});
  } else if (type == kUnsignedInt) {
    take(std::uint32_t{});
  } else if (type == kFloat) {
    take(float{});
  } else {
    fail(concat("accessor ", accessor, " has numbers of the unexpected type ", type));
  }
  return numbers;
}

std::vector<double> GltfFile::read_values(std::size_t accessor, std::size_t width) {
  const Json& json = scene_.at("accessors").at(accessor);
  const auto type = json.at("componentType").get<int>();
  const std::size_t count = json.at("count").get<std::size_t>();
  std::vector<double> numbers;
  if (json.contains("bufferView")) {
    numbers = read_rows(json.at("bufferView").get<std::size_t>(),
                        json.value("byteOffset", std::size_t{0}), type, count, width, accessor);
  } else {
    if (json.contains("sparse")) {
      // Call `view` first, because each call with a new buffer view raises `remaining_numbers_`,
      // which the code below checks.
      view(json["sparse"].at("indices").at("bufferView").get<std::size_t>());
    }
    if (count > remaining_numbers_ / width) reserve_numbers(remaining_numbers_ + 1);
    reserve_numbers(count * width);
    numbers.resize(count * width, 0);
  }
  if (json.contains("sparse")) {
    const Json& sparse = json["sparse"];
    const Json &rows = sparse.at("indices"), &values = sparse.at("values");
    const auto some = sparse.at("count").get<std::size_t>();
    const std::vector<double> at = read_rows(
        rows.at("bufferView").get<std::size_t>(), rows.value("byteOffset", std::size_t{0}),
        rows.at("componentType").get<int>(), some, 1, accessor);
    const std::vector<double> moved =
        read_rows(values.at("bufferView").get<std::size_t>(),
                  values.value("byteOffset", std::size_t{0}), type, some, width, accessor);
    for (std::size_t i = 0; i < some; ++i) {
      if (!(at[i] >= 0 && at[i] < static_cast<double>(count))) {
        fail(concat("sparse accessor ", accessor, ": expected rows below ", count, ", found ",
                    at[i]));
      }
      std::copy_n(moved.begin() + static_cast<std::ptrdiff_t>(i * width), width,
                  numbers.begin() +
                      static_cast<std::ptrdiff_t>(at[i]) * static_cast<std::ptrdiff_t>(width));
    }
  }
  if (json.value("normalized", false)) {
    for (double& number : numbers) number = std::max(number / max_of_type(type), -1.0);
  }
  if (!std::all_of(numbers.begin(), numbers.end(), [](double x) { return std::isfinite(x); })) {
    fail(concat("accessor ", accessor, " has numbers that are not finite"));
  }
  return numbers;
}

std::vector<std::uint32_t> GltfFile::read_unsigned_values(std::size_t accessor, std::size_t width) {
  std::vector<std::uint32_t> whole;
  for (const double number : read_values(accessor, width)) {
    if (number < 0 || number >= kNoIndex) {
      fail(concat("accessor ", accessor, ": expected whole numbers, found ", number));
    }
    whole.push_back(static_cast<std::uint32_t>(number));
  }
  return whole;
}

std::vector<std::uint32_t> GltfFile::parents() const {
  const Json& nodes = scene_.at("nodes");
  std::vector<std::uint32_t> parents(nodes.size(), kNoIndex);
  for (std::uint32_t n = 0; n < nodes.size(); ++n) {
    for (const Json& child : nodes[n].value("children", Json::array())) {
      parents.at(child.get<std::size_t>()) = n;
    }
  }
  return parents;
}

/// Computes the transform of each node once, after the transform of its parent.
std::vector<Eigen::Matrix4d> GltfFile::world_transforms(
    const std::vector<std::uint32_t>& parents) const {
  std::vector<Eigen::Matrix4d> worlds(parents.size());
  std::vector<bool> known(parents.size(), false);
  std::vector<std::uint32_t> above;
  for (std::uint32_t node = 0; node < parents.size(); ++node) {
    for (std::uint32_t n = node; n != kNoIndex && !known[n]; n = parents[n]) {
      if (above.size() == parents.size()) fail("its nodes form a cycle");
      above.push_back(n);
    }
    for (; !above.empty(); above.pop_back()) {
      const std::uint32_t n = above.back(), parent = parents[n];
      const Eigen::Matrix4d local = local_matrix(*this, n);
      worlds[n] = parent == kNoIndex ? local : matrix_product(worlds[parent], local);
      if (!(worlds[n].array().abs() < kMaxMatrixEntry).all()) {
        fail(concat("the position of its node ", n, " is out of range"));
      }
      known[n] = true;
    }
  }
  return worlds;
}

std::vector<Eigen::Matrix4d> GltfFile::joint_transforms(
    std::size_t skin, const std::vector<Eigen::Matrix4d>& worlds) {
  const Json& json = scene_.at("skins").at(skin);
  std::vector<Eigen::Matrix4d> transforms;
  for (const Json& joint : json.at("joints")) {
    transforms.push_back(worlds.at(joint.get<std::size_t>()));
  }
  if (!json.contains("inverseBindMatrices")) return transforms;
  const auto inverses = read_values(json.at("inverseBindMatrices").get<std::size_t>(), 16);
  if (inverses.size() < 16 * transforms.size()) fail("a skin lacks inverse bind matrices");
  for (std::size_t j = 0; j < transforms.size(); ++j) {
    const auto first = inverses.begin() + static_cast<std::ptrdiff_t>(16 * j);
    transforms[j] = matrix_product(transforms[j], matrix_from({first, first + 16}));
  }
  return transforms;
}

GltfSkinWeights GltfFile::read_skin_weights(const Json& attributes, std::size_t count) {
  GltfSkinWeights skin;
  for (std::size_t set = 0; attributes.contains(concat("JOINTS_", set)); ++set) {
    const std::string of_weights = concat("WEIGHTS_", set);
    if (!attributes.contains(of_weights)) fail(concat("a mesh lacks ", of_weights));
    skin.joints.push_back(
        read_unsigned_values(attributes.at(concat("JOINTS_", set)).get<std::size_t>(), 4));
    skin.weights.push_back(read_values(attributes.at(of_weights).get<std::size_t>(), 4));
    if (skin.joints.back().size() != 4 * count || skin.weights.back().size() != 4 * count) {
      fail("JOINTS_n, WEIGHTS_n and POSITION differ in length");
    }
  }
  return skin;
}

}  // namespace crowdface
