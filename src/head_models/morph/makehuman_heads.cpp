// SPDX-License-Identifier: Apache-2.0
#include "head_models/morph/makehuman_heads.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <string_view>
#include <utility>

#include <nlohmann/json.hpp>

#include "crowdface/core/contains.h"
#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/text.h"
#include "crowdface/mesh/all_columns.h"
#include "head_models/morph/makehuman_controls.h"
#include "head_models/morph/three_mesh.h"

namespace crowdface {
namespace {

constexpr double kCentimetresPerUnit = 10;

// The plane y + kCutSlope · z = kCutHeight (decimetres) that cuts the neck. The cut follows one
// loop of 42 edges.
constexpr double kCutHeight = 5.84, kCutSlope = 0.4;

struct Part {
  std::string_view in_file, name;
};
constexpr std::array<Part, 3> kParts = {
    {{"body", "skin"}, {"helper-r-eye", "eyeball_r"}, {"helper-l-eye", "eyeball_l"}}};

/// Returns the mean height of the corners of the polygons in two helper groups (geometry in the
/// base mesh that is not part of the body).
double mean_height(const ThreeMesh& mesh, const std::array<std::string_view, 2>& helpers,
                   const std::filesystem::path& file) {
  double sum = 0;
  std::size_t count = 0;
  for (const ThreeMesh::Face& face : mesh.faces) {
    if (!contains(helpers, mesh.material_of(face))) continue;
    for (const std::uint32_t v : face.vertices) sum += mesh.positions(v, 1);
    count += 4;
  }
  if (count == 0) refuse_file(file, concat("expected faces of ", helpers[0], ", found none"));
  return sum / static_cast<double>(count);
}

std::vector<std::string> read_target_names(const std::filesystem::path& file) {
  std::vector<std::string> names;
  try {
    const auto root = nlohmann::json::parse(read_file(file));
    for (const auto& [name, groups] : root.at("targets").items()) names.push_back(name);
  } catch (const nlohmann::json::exception& error) {
    refuse_file(file, concat("expected MakeHuman's list of targets: ", error.what()));
  }
  return names;
}

/// Copies from `all` to `mesh` the vertices and texture coordinates that the polygons of `mesh`
/// use. Renumbers the corners of these
/// polygons.
/// \return for each vertex of `mesh`: its row in `all.positions`
std::vector<std::uint32_t> keep_used_rows(const ThreeMesh& all, Mesh& mesh) {
  std::vector<std::uint32_t> rows = renumber(mesh.topology.corner_vertices, all.positions.rows());
  mesh.topology.vertex_count = static_cast<Index>(rows.size());
  mesh.positions = all.positions(rows, kAllColumns);
  mesh.uvs = all.uvs(renumber(mesh.topology.corner_uvs, all.uvs.rows()), kAllColumns);
  return rows;
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
      if (all.material_of(face) != part.in_file) continue;
      const bool in_head = std::ranges::all_of(face.vertices, above_cut);
      if (in_head) topology.add_face(face.vertices, face.uvs);
      if (!in_head && &part == kParts.data()) out.body.topology.add_face(face.vertices, face.uvs);
    }
    if (out.materials.back().first_face == topology.face_count()) {
      refuse_file(file, concat("expected polygons of the material ", part.in_file,
                               " above the cut through the neck, found none"));
    }
  }
  out.head_rows = keep_used_rows(all, out.head);
  keep_used_rows(all, out.body);
  out.heights = {mean_height(all, {"helper-r-eye", "helper-l-eye"}, file),
                 mean_height(all, {"helper-upper-teeth", "helper-lower-teeth"}, file)};
  out.file_positions = std::move(all.positions);
  return out;
}

MakeHumanHeads::MakeHumanHeads(const std::filesystem::path& package)
    : mesh_(read_makehuman_mesh(package / "public/data/models/human_full_size.json")),
      targets_(package / "public/data/targets/targets.bin",
               read_target_names(package / "src/json/targets/target-list.json"),
               mesh_.file_positions.rows()),
      materials_(mesh_.materials) {
  for (const std::string& name : makehuman_target_names()) {
    if (!targets_.has(name)) {
      refuse_file(package / "src/json/targets/target-list.json",
                  concat("expected a target ", quoted(name), ", found none"));
    }
  }
  for (const std::uint32_t row :
       vertices_of_material(mesh_.head.topology, mesh_.materials, {"eyeball"})) {
    eye_rows_.push_back(mesh_.head_rows[row]);
  }
  neutral_ = {mesh_.head.topology, to_head_frame(mesh_.head.positions, mesh_.file_positions),
              mesh_.head.uvs};
  const double origin = mean_of(mesh_.file_positions, eye_rows_).y();
  heights_ = {kCentimetresPerUnit * (mesh_.heights.eye_height - origin),
              kCentimetresPerUnit * (mesh_.heights.mouth_height - origin)};
}

Positions MakeHumanHeads::to_head_frame(const Positions& decimetres, const Positions& base) const {
  const Eigen::RowVector3d origin = mean_of(base, eye_rows_);
  return kCentimetresPerUnit * (decimetres.rowwise() - origin);
}

void MakeHumanHeads::add_parts(std::vector<FittedPart> parts) {
  // Keep the polygons of the skin, which is the first material.
  const Topology& naked = mesh_.head.topology;
  Topology topology;
  for (Index f = 0; f < mesh_.materials[1].first_face; ++f) {
    topology.add_face(naked.face(f), naked.face_uvs(f));
  }
  skin_rows_ = renumber(topology.corner_vertices, naked.vertex_count);
  for (std::uint32_t& row : skin_rows_) row = mesh_.head_rows[row];
  const auto uv_rows = renumber(topology.corner_uvs, mesh_.head.uvs.rows());
  TextureCoordinates uvs = mesh_.head.uvs(uv_rows, kAllColumns);
  // Append the parts, with shifted vertex indices.
  materials_ = {mesh_.materials[0]};
  auto vertices = static_cast<std::uint32_t>(skin_rows_.size());
  for (const auto& [material, mesh] : parts) {
    materials_.push_back({material, topology.face_count()});
    const auto first_uv = static_cast<std::uint32_t>(uvs.rows());
    for (Index f = 0; f < mesh.topology.face_count(); ++f) {
      std::vector<std::uint32_t> corners(mesh.topology.face(f).begin(),
                                         mesh.topology.face(f).end());
      std::vector<std::uint32_t> of_uvs(mesh.topology.face_uvs(f).begin(),
                                        mesh.topology.face_uvs(f).end());
      for (std::uint32_t& corner : corners) corner += vertices;
      for (std::uint32_t& uv : of_uvs) uv += first_uv;
      topology.add_face(corners, of_uvs);
    }
    vertices += static_cast<std::uint32_t>(mesh.topology.vertex_count);
    uvs.conservativeResize(uvs.rows() + mesh.uvs.rows(), Eigen::NoChange);
    uvs.bottomRows(mesh.uvs.rows()) = mesh.uvs;
  }
  topology.vertex_count = vertices;
  parts_ = std::move(parts);
  neutral_ = {std::move(topology), append_parts(mesh_.file_positions), std::move(uvs)};
}

Positions MakeHumanHeads::append_parts(const Positions& base) const {
  Positions head = base(skin_rows_, kAllColumns);
  for (const FittedPart& part : parts_) {
    const Positions more = part.mesh.fitted_to(base);
    head.conservativeResize(head.rows() + more.rows(), Eigen::NoChange);
    head.bottomRows(more.rows()) = more;
  }
  return to_head_frame(head, base);
}

Positions MakeHumanHeads::fitted_to_neutral(const FittedMesh& mesh) const {
  return to_head_frame(mesh.fitted_to(mesh_.file_positions), mesh_.file_positions);
}

std::vector<bool> MakeHumanHeads::is_skin() const {
  std::vector<bool> skin(static_cast<std::size_t>(neutral_.topology.vertex_count), false);
  for (const std::uint32_t v : vertices_of_material(neutral_.topology, materials_, {"skin"})) {
    skin[v] = true;
  }
  return skin;
}

std::vector<double> MakeHumanHeads::lip_weights() const {
  // The lips consist of the vertices that the morph targets for fuller lips move most.
  constexpr double kOutside = 0.25, kInside = 0.6;  // as fractions of the largest displacement
  const std::vector<std::uint32_t>& rows = parts_.empty() ? mesh_.head_rows : skin_rows_;
  Positions moved = Positions::Zero(static_cast<Index>(rows.size()), 3);
  for (const char* target :
       {"mouth/mouth-upperlip-volume-inflate", "mouth/mouth-lowerlip-volume-inflate"}) {
    targets_.add_displacements({target, 1}, rows, moved);
  }
  const double largest = moved.rowwise().norm().maxCoeff();
  std::vector<double> weights(static_cast<std::size_t>(neutral_.positions.rows()), 0);
  for (Index v = 0; largest > 0 && v < moved.rows(); ++v) {
    const double share = moved.row(v).norm() / largest;
    weights[static_cast<std::size_t>(v)] =
        std::clamp((share - kOutside) / (kInside - kOutside), 0.0, 1.0);
  }
  return weights;
}

Mesh MakeHumanHeads::body() const {
  Mesh body = mesh_.body;
  body.positions = to_head_frame(body.positions, mesh_.file_positions);
  return body;
}

Positions MakeHumanHeads::positions(std::uint64_t seed, std::uint64_t index) const {
  std::vector<std::uint32_t> rows(static_cast<std::size_t>(mesh_.file_positions.rows()));
  std::iota(rows.begin(), rows.end(), 0U);
  Positions base = mesh_.file_positions;
  const MakeHumanPerson person = random_makehuman_person(seed, index);
  for (const TargetWeight& target : makehuman_targets(person, seed, index)) {
    targets_.add_displacements(target, rows, base);
  }
  if (!parts_.empty()) return append_parts(base);
  return to_head_frame(base(mesh_.head_rows, kAllColumns), base);
}

std::optional<HeadPerson> MakeHumanHeads::person(std::uint64_t seed, std::uint64_t index) const {
  const MakeHumanPerson person = random_makehuman_person(seed, index);
  return HeadPerson{person.is_male, person.age_years};
}

}  // namespace crowdface
