// SPDX-License-Identifier: Apache-2.0
#include "crowdface/morph/makehuman_mesh.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/text.h"

namespace crowdface {
namespace {

using nlohmann::json;

// The plane of the cut, in decimetres: it keeps to one loop of 42 edges round the lower neck.
constexpr double kCutHeight = 5.84, kCutSlope = 0.4;

// A face's type bits: a quad, with a material, with texture coordinates of its corners. The base
// mesh has no other faces.
constexpr int kQuadMaterialUvs = 1 | 2 | 8;
constexpr std::size_t kFaceNumbers = 1 + 4 + 1 + 4;

struct FileMesh {
  Positions positions;
  TextureCoordinates uvs;
  struct Face {
    std::array<std::uint32_t, 4> vertices, uvs;
    std::uint32_t material;
  };
  std::vector<Face> faces;
  std::vector<std::string> material_names;

  const std::string& material_of(const Face& face) const { return material_names[face.material]; }
};

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& what) {
  throw InvalidInput(concat(file.string(), ": ", what));
}

std::uint32_t index_below(const json& number, Index end, const std::filesystem::path& file) {
  const auto value = number.get<std::int64_t>();
  if (value < 0 || value >= end) {
    refuse(file, concat("expected an index below ", end, ", found ", value));
  }
  return static_cast<std::uint32_t>(value);
}

void read_faces(const json& numbers, const std::filesystem::path& file, FileMesh& mesh) {
  if (numbers.size() % kFaceNumbers != 0) {
    refuse(file, concat("expected quads with material and texture coordinates, ", kFaceNumbers,
                        " numbers each, found ", numbers.size(), " numbers"));
  }
  for (std::size_t i = 0; i < numbers.size(); i += kFaceNumbers) {
    if (numbers[i].get<int>() != kQuadMaterialUvs) {
      refuse(file, concat("expected faces of type ", kQuadMaterialUvs, ", found ",
                          numbers[i].get<int>()));
    }
    FileMesh::Face face;
    for (std::size_t k = 0; k < 4; ++k) {
      face.vertices[k] = index_below(numbers[i + 1 + k], mesh.positions.rows(), file);
      face.uvs[k] = index_below(numbers[i + 6 + k], mesh.uvs.rows(), file);
    }
    face.material =
        index_below(numbers[i + 5], static_cast<Index>(mesh.material_names.size()), file);
    mesh.faces.push_back(face);
  }
}

FileMesh read_file_mesh(const std::filesystem::path& file) {
  FileMesh mesh;
  try {
    const json root = json::parse(read_file(file));
    const json& vertices = root.at("vertices");
    mesh.positions.resize(static_cast<Index>(vertices.size() / 3), 3);
    for (Index i = 0; i < mesh.positions.size(); ++i) {
      mesh.positions(i / 3, i % 3) = vertices[static_cast<std::size_t>(i)].get<double>();
    }
    const json& uvs = root.at("uvs").at(0);
    mesh.uvs.resize(static_cast<Index>(uvs.size() / 2), 2);
    for (Index i = 0; i < mesh.uvs.size(); ++i) {
      mesh.uvs(i / 2, i % 2) = uvs[static_cast<std::size_t>(i)].get<double>();
    }
    for (const json& material : root.at("materials")) {
      mesh.material_names.push_back(material.at("DbgName").get<std::string>());
    }
    read_faces(root.at("faces"), file, mesh);
  } catch (const json::exception& error) {
    refuse(file, concat("expected MakeHuman's base mesh as three.js JSON: ", error.what()));
  }
  if (!mesh.positions.allFinite()) refuse(file, "expected finite positions");
  return mesh;
}

struct Part {
  std::string_view in_file, name;
};
constexpr std::array<Part, 3> kParts = {
    {{"body", "skin"}, {"helper-r-eye", "eyeball_r"}, {"helper-l-eye", "eyeball_l"}}};

/// Mean height of the corners of these helpers' faces.
double mean_height(const FileMesh& mesh, const std::array<std::string_view, 2>& helpers,
                   const std::filesystem::path& file) {
  double sum = 0;
  std::size_t count = 0;
  for (const FileMesh::Face& face : mesh.faces) {
    if (std::ranges::find(helpers, mesh.material_of(face)) == helpers.end()) continue;
    for (const std::uint32_t v : face.vertices) sum += mesh.positions(v, 1);
    count += 4;
  }
  if (count == 0) refuse(file, concat("expected faces of ", helpers[0], ", found none"));
  return sum / static_cast<double>(count);
}

}  // namespace

MakeHumanMesh read_makehuman_mesh(const std::filesystem::path& file) {
  const FileMesh all = read_file_mesh(file);
  const auto above_cut = [&](std::uint32_t v) {
    return all.positions(v, 1) + kCutSlope * all.positions(v, 2) > kCutHeight;
  };
  MakeHumanMesh out;
  Topology& topology = out.head.topology;
  for (const Part& part : kParts) {
    out.materials.push_back({std::string(part.name), topology.face_count()});
    for (const FileMesh::Face& face : all.faces) {
      if (all.material_of(face) != part.in_file || !std::ranges::all_of(face.vertices, above_cut))
        continue;
      topology.add_face(face.vertices, face.uvs);
    }
    if (out.materials.back().first_face == topology.face_count()) {
      refuse(file, concat("expected a head of material ", part.in_file, " above the neck's cut, ",
                          "found none"));
    }
  }
  out.file_vertices = all.positions.rows();
  out.rows = renumber(topology.corner_vertices, all.positions.rows());
  topology.vertex_count = static_cast<Index>(out.rows.size());
  const auto uv_rows = renumber(topology.corner_uvs, all.uvs.rows());
  out.head.positions = all.positions(out.rows, Eigen::all);
  out.head.uvs = all.uvs(uv_rows, Eigen::all);
  out.heights = {mean_height(all, {"helper-r-eye", "helper-l-eye"}, file),
                 mean_height(all, {"helper-upper-teeth", "helper-lower-teeth"}, file)};
  return out;
}

}  // namespace crowdface
