// SPDX-License-Identifier: Apache-2.0
#include "head_models/morph/fitted_mesh.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include <nlohmann/json.hpp>

#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/require.h"
#include "crowdface/core/text.h"
#include "crowdface/mesh/all_columns.h"
#include "head_models/morph/three_mesh.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// Returns the JSON array with the key `name`; checks that the array has three numbers per vertex.
const json& triples(const json& root, const char* name, Index vertices, const fs::path& file) {
  const json& rows = root.at(name);
  if (!rows.is_array() || static_cast<Index>(rows.size()) != vertices) {
    refuse_file(file,
                concat("expected ", name, " of ", vertices, " vertices, found ", rows.size()));
  }
  for (const json& row : rows) {
    if (row.size() != 3)
      refuse_file(file, concat(name, ": expected three numbers, found ", row.dump()));
  }
  return rows;
}

Positions read_triples(const json& root, const char* name, Index vertices, const fs::path& file) {
  const json& rows = triples(root, name, vertices, file);
  Positions values(vertices, 3);
  for (Index i = 0; i < values.size(); ++i) {
    values(i / 3, i % 3) =
        rows[static_cast<std::size_t>(i / 3)][static_cast<std::size_t>(i % 3)].get<double>();
  }
  if (!values.allFinite()) refuse_file(file, concat(name, ": expected finite numbers"));
  return values;
}

void read_anchors(const json& root, Index base_vertices, const fs::path& file, FittedMesh& mesh) {
  for (const json& row : triples(root, "ref_vIdxs", mesh.topology.vertex_count, file)) {
    std::array<std::uint32_t, 3>& anchor = mesh.anchors.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      const auto value = row[k].get<std::int64_t>();
      if (value < 0 || value >= base_vertices) {
        refuse_file(file, concat("ref_vIdxs: expected a vertex of the base mesh, below ",
                                 base_vertices, ", found ", value));
      }
      anchor[k] = static_cast<std::uint32_t>(value);
    }
  }
}

}  // namespace

bool is_free(const AssetLicence& licence) {
  constexpr auto kFree = std::to_array<std::string_view>({"AGPL", "GPL", "CC0", "CC BY", "MIT"});
  const auto begins = [&](std::string_view word) { return licence.licence.starts_with(word); };
  const bool restricted = licence.licence.starts_with("CC BY-N") ||
                          licence.licence.find("-NC") != std::string::npos ||
                          licence.licence.find("-ND") != std::string::npos;
  const bool nobody = licence.author.empty() || licence.author.starts_with("Unknown");
  return std::ranges::any_of(kFree, begins) && !restricted && !nobody;
}

fs::path picture_path(const fs::path& file, const std::string& name) {
  const fs::path relative = fs::path(name).lexically_normal();
  if (relative.empty() || relative.is_absolute() || *relative.begin() == "..") {
    refuse_file(
        file, concat("expected a picture beside the file, found ", quoted(std::string_view(name))));
  }
  return file.parent_path() / relative;
}

Positions FittedMesh::fitted_to(const Positions& base) const {
  Positions out = offsets;
  for (Index v = 0; v < out.rows(); ++v) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t anchor = anchors[static_cast<std::size_t>(v)][k];
      require(anchor < base.rows(), "fitted mesh: anchor ", anchor, " of ", base.rows());
      out.row(v) += weights(v, static_cast<Index>(k)) * base.row(anchor);
    }
  }
  return out;
}

void FittedMesh::keep_faces(const std::vector<bool>& faces) {
  Topology kept;
  for (Index f = 0; f < topology.face_count(); ++f) {
    if (faces[static_cast<std::size_t>(f)]) kept.add_face(topology.face(f), topology.face_uvs(f));
  }
  const auto rows = renumber(kept.corner_vertices, topology.vertex_count);
  const auto uv_rows = renumber(kept.corner_uvs, uvs.rows());
  kept.vertex_count = static_cast<Index>(rows.size());
  std::vector<std::array<std::uint32_t, 3>> kept_anchors;
  for (const std::uint32_t row : rows) kept_anchors.push_back(anchors[row]);
  anchors = std::move(kept_anchors);
  weights = Positions(weights(rows, kAllColumns));
  offsets = Positions(offsets(rows, kAllColumns));
  uvs = TextureCoordinates(uvs(uv_rows, kAllColumns));
  topology = std::move(kept);
}

FittedMesh read_fitted_mesh(const fs::path& file, Index base_vertices) {
  constexpr std::string_view kWhat = "a mesh that MakeHuman's base mesh wears";
  const ThreeMesh three = read_three_mesh(file, kWhat);
  FittedMesh mesh;
  for (const ThreeMesh::Face& face : three.faces) mesh.topology.add_face(face.vertices, face.uvs);
  if (three.faces.empty()) refuse_file(file, "expected faces, found none");
  mesh.topology.vertex_count = three.positions.rows();
  mesh.uvs = three.uvs;
  try {
    const json root = json::parse(read_file(file));
    read_anchors(root, base_vertices, file, mesh);
    mesh.weights = read_triples(root, "weights", mesh.topology.vertex_count, file);
    mesh.offsets = read_triples(root, "offsets", mesh.topology.vertex_count, file);
    for (const json& material : root.at("materials")) {
      mesh.pictures.push_back({material.at("DbgName").get<std::string>(), {}});
      const auto name = material.find("mapDiffuse");
      if (name != material.end()) mesh.pictures.back().path = picture_path(file, *name);
    }
    const json& licence = root.at("metadata").at("license");
    mesh.licence = {licence.at("license").get<std::string>(),
                    licence.at("author").get<std::string>(), licence.value("homepage", "")};
  } catch (const json::exception& error) {
    refuse_file(file, concat("expected ", kWhat, ": ", error.what()));
  }
  return mesh;
}

}  // namespace crowdface
