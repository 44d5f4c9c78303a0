// SPDX-License-Identifier: Apache-2.0
#include "head_models/morph/three_mesh.h"

#include <nlohmann/json.hpp>

#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/text.h"

namespace crowdface {
namespace {

using nlohmann::json;

// Type bits of a polygon: quad, material, texture coordinates per corner. The package contains no
// other types of polygons.
constexpr int kQuadMaterialUvs = 1 | 2 | 8;
constexpr std::size_t kFaceNumbers = 1 + 4 + 1 + 4;

/// Converts a flat list of numbers to a row-major matrix.
template <class Rows>
Rows rows_of(const json& list) {
  const auto numbers = list.get<std::vector<double>>();
  return Eigen::Map<const Rows>(numbers.data(),
                                static_cast<Index>(numbers.size()) / Rows::ColsAtCompileTime,
                                Rows::ColsAtCompileTime);
}

std::uint32_t index_below(const json& number, Index end, const std::filesystem::path& file) {
  const auto value = number.get<std::int64_t>();
  if (value < 0 || value >= end) {
    refuse_file(file, concat("expected an index below ", end, ", found ", value));
  }
  return static_cast<std::uint32_t>(value);
}

void read_faces(const json& numbers, const std::filesystem::path& file, ThreeMesh& mesh) {
  if (numbers.size() % kFaceNumbers != 0) {
    refuse_file(file, concat("expected quads with material and texture coordinates, ", kFaceNumbers,
                             " numbers each, found ", numbers.size(), " numbers"));
  }
  for (std::size_t i = 0; i < numbers.size(); i += kFaceNumbers) {
    if (numbers[i].get<int>() != kQuadMaterialUvs) {
      refuse_file(file, concat("expected faces of type ", kQuadMaterialUvs, ", found ",
                               numbers[i].get<int>()));
    }
    ThreeMesh::Face face;
    for (std::size_t k = 0; k < 4; ++k) {
      face.vertices[k] = index_below(numbers[i + 1 + k], mesh.positions.rows(), file);
      face.uvs[k] = index_below(numbers[i + 6 + k], mesh.uvs.rows(), file);
    }
    face.material =
        index_below(numbers[i + 5], static_cast<Index>(mesh.material_names.size()), file);
    mesh.faces.push_back(face);
  }
}

}  // namespace

ThreeMesh read_three_mesh(const std::filesystem::path& file, std::string_view what) {
  ThreeMesh mesh;
  try {
    const json root = json::parse(read_file(file));
    mesh.positions = rows_of<Positions>(root.at("vertices"));
    mesh.uvs = rows_of<TextureCoordinates>(root.at("uvs").at(0));
    for (const json& material : root.at("materials")) {
      mesh.material_names.push_back(material.at("DbgName").get<std::string>());
    }
    read_faces(root.at("faces"), file, mesh);
  } catch (const json::exception& error) {
    refuse_file(file, concat("expected ", what, " as three.js JSON: ", error.what()));
  }
  if (!mesh.positions.allFinite()) refuse_file(file, "expected finite positions");
  return mesh;
}

}  // namespace crowdface
