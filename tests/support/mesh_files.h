// SPDX-License-Identifier: Apache-2.0
// The binary formats read back, as plainly as their specifications allow; nothing is taken from the
// program. Each of them throws what the standard library throws if a file is not as it should be.
#pragma once

#include <array>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "support/binary_reader.h"
#include "support/temporary_folder.h"

namespace crowdface::testing {

using Singles = std::vector<std::array<float, 3>>;

inline std::array<float, 3> next_triple(BinaryReader& file) {
  const float x = file.next<float>(), y = file.next<float>();
  return {x, y, file.next<float>()};
}

struct PlyFile {
  Singles points, normals;
  std::vector<std::vector<std::size_t>> faces;
};

inline PlyFile read_ply(const std::filesystem::path& path) {
  BinaryReader file(read_text(path));
  std::size_t vertices = 0, faces = 0;
  std::vector<std::string> properties;
  for (std::string line = file.next_line(); line != "end_header\n"; line = file.next_line()) {
    std::istringstream words(line);
    std::string first, second, third;
    words >> first >> second >> third;
    if (first == "element" && second == "vertex") vertices = std::stoul(third);
    if (first == "element" && second == "face") faces = std::stoul(third);
    if (first == "property" && second == "float") properties.push_back(third);
  }
  PlyFile mesh;
  for (std::size_t i = 0; i < vertices; ++i) {
    mesh.points.push_back(next_triple(file));
    if (properties.size() == 6) mesh.normals.push_back(next_triple(file));
  }
  for (std::size_t f = 0; f < faces; ++f) {
    mesh.faces.emplace_back();
    for (auto corners = file.next<std::uint8_t>(); corners > 0; --corners) {
      mesh.faces.back().push_back(file.next<std::uint32_t>());
    }
  }
  if (!file.at_end()) throw std::runtime_error(path.string() + " is too long");
  return mesh;
}

/// The numbers of an array file; `dictionary` is what its header says.
template <class Number>
std::vector<Number> read_npy_numbers(const std::filesystem::path& path, std::string& dictionary) {
  BinaryReader file(read_text(path));
  file.next_text(8);
  const auto size = file.next<std::uint16_t>();
  dictionary = file.next_text(size);
  std::vector<Number> numbers;
  while (!file.at_end()) numbers.push_back(file.next<Number>());
  return numbers;
}

struct GlbFile {
  nlohmann::json scene;
  Singles points, normals;
  std::vector<std::array<float, 2>> uvs;
  std::vector<float> ids;
  std::vector<std::uint32_t> corners;  ///< of all primitives
};

/// \param number  index of the mesh; the first one is the face
inline GlbFile read_glb(const std::filesystem::path& path, std::size_t number = 0) {
  BinaryReader file(read_text(path));
  file.next_text(12);
  const auto json_size = file.next<std::uint32_t>();
  file.next_text(4);
  GlbFile mesh;
  mesh.scene = nlohmann::json::parse(file.next_text(json_size));
  file.next_text(8);
  const std::size_t buffer = file.position();
  const auto go_to = [&](const nlohmann::json& index) {
    const auto& accessor = mesh.scene.at("accessors").at(index.get<std::size_t>());
    const auto& view =
        mesh.scene.at("bufferViews").at(accessor.at("bufferView").get<std::size_t>());
    file.go_to(buffer + view.value("byteOffset", 0U) + accessor.value("byteOffset", 0U));
    return accessor.at("count").get<std::size_t>();
  };
  const auto& primitives = mesh.scene.at("meshes").at(number).at("primitives");
  const auto& attributes = primitives.at(0).at("attributes");
  for (std::size_t i = go_to(attributes.at("POSITION")); i > 0; --i) {
    mesh.points.push_back(next_triple(file));
  }
  for (std::size_t i = go_to(attributes.at("NORMAL")); i > 0; --i) {
    mesh.normals.push_back(next_triple(file));
  }
  if (attributes.contains("TEXCOORD_0")) {
    for (std::size_t i = go_to(attributes.at("TEXCOORD_0")); i > 0; --i) {
      const auto u = file.next<float>();
      mesh.uvs.push_back({u, file.next<float>()});
    }
  }
  if (attributes.contains("_VERTEX_ID")) {
    mesh.ids = file.next_array<float>(go_to(attributes.at("_VERTEX_ID")));
  }
  for (const auto& primitive : primitives) {
    for (std::size_t i = go_to(primitive.at("indices")); i > 0; --i) {
      mesh.corners.push_back(file.next<std::uint32_t>());
    }
  }
  return mesh;
}

}  // namespace crowdface::testing
