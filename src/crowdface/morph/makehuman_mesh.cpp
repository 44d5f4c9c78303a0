// SPDX-License-Identifier: Apache-2.0
#include "crowdface/morph/makehuman_mesh.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <utility>

#include "crowdface/core/error.h"
#include "crowdface/core/text.h"
#include "crowdface/morph/three_mesh.h"

namespace crowdface {
namespace {

// The plane of the cut, in decimetres: it keeps to one loop of 42 edges round the lower neck.
constexpr double kCutHeight = 5.84, kCutSlope = 0.4;

struct Part {
  std::string_view in_file, name;
};
constexpr std::array<Part, 3> kParts = {
    {{"body", "skin"}, {"helper-r-eye", "eyeball_r"}, {"helper-l-eye", "eyeball_l"}}};

/// Mean height of the corners of these helpers' faces.
double mean_height(const ThreeMesh& mesh, const std::array<std::string_view, 2>& helpers,
                   const std::filesystem::path& file) {
  double sum = 0;
  std::size_t count = 0;
  for (const ThreeMesh::Face& face : mesh.faces) {
    if (std::ranges::find(helpers, mesh.material_of(face)) == helpers.end()) continue;
    for (const std::uint32_t v : face.vertices) sum += mesh.positions(v, 1);
    count += 4;
  }
  if (count == 0) refuse_file(file, concat("expected faces of ", helpers[0], ", found none"));
  return sum / static_cast<double>(count);
}

}  // namespace

MakeHumanMesh read_makehuman_mesh(const std::filesystem::path& file) {
  ThreeMesh all = read_three_mesh(file, "MakeHuman's base mesh");
  const auto above_cut = [&](std::uint32_t v) {
    return all.positions(v, 1) + kCutSlope * all.positions(v, 2) > kCutHeight;
  };
  MakeHumanMesh out;
  Topology& topology = out.head.topology;
  for (const Part& part : kParts) {
    out.materials.push_back({std::string(part.name), topology.face_count()});
    for (const ThreeMesh::Face& face : all.faces) {
      if (all.material_of(face) != part.in_file || !std::ranges::all_of(face.vertices, above_cut))
        continue;
      topology.add_face(face.vertices, face.uvs);
    }
    if (out.materials.back().first_face == topology.face_count()) {
      refuse_file(file, concat("expected a head of material ", part.in_file,
                               " above the neck's cut, ", "found none"));
    }
  }
  out.rows = renumber(topology.corner_vertices, all.positions.rows());
  topology.vertex_count = static_cast<Index>(out.rows.size());
  const auto uv_rows = renumber(topology.corner_uvs, all.uvs.rows());
  out.head.positions = all.positions(out.rows, Eigen::all);
  out.head.uvs = all.uvs(uv_rows, Eigen::all);
  out.heights = {mean_height(all, {"helper-r-eye", "helper-l-eye"}, file),
                 mean_height(all, {"helper-upper-teeth", "helper-lower-teeth"}, file)};
  out.file_positions = std::move(all.positions);
  return out;
}

}  // namespace crowdface
