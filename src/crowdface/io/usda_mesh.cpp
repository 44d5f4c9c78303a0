// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/usda_mesh.h"

#include <algorithm>

#include "crowdface/core/require.h"
#include "crowdface/core/text.h"
#include "crowdface/io/single_precision.h"
#include "crowdface/io/srgb.h"

namespace crowdface {
namespace {

/// The lines of the primvar `st`: its values, and for each corner the index of a value. Corners
/// without texture coordinates get the value (0, 0).
std::string uv_lines(const Topology& topology, const TextureCoordinates& uvs) {
  TextureCoordinates all = uvs;
  std::vector<std::uint32_t> corners = topology.corner_uvs;
  if (std::ranges::find(corners, kNoIndex) != corners.end()) {
    all.conservativeResize(uvs.rows() + 1, Eigen::NoChange);
    all.row(uvs.rows()).setZero();
    std::replace(corners.begin(), corners.end(), kNoIndex, static_cast<std::uint32_t>(uvs.rows()));
  }
  return concat("            texCoord2f[] primvars:st = ", usda_uvs(all),
                " (\n                interpolation = \"faceVarying\"\n            )\n"
                "            int[] primvars:st:indices = ",
                usda_list(corners), '\n');
}

std::string corner_counts(const Topology& topology) {
  std::vector<std::uint32_t> counts;
  for (Index f = 0; f < topology.face_count(); ++f) {
    const auto [begin, end] = topology.corners(f);
    counts.push_back(end - begin);
  }
  return usda_list(counts);
}

}  // namespace

UsdaMesh::UsdaMesh(const Topology& topology, const TextureCoordinates& uvs, const Options& options)
    : vertex_count_(topology.vertex_count), subdivision_(options.subdivision) {
  shared_text_ =
      concat("            uniform bool doubleSided = 1\n            int[] faceVertexCounts = ",
             corner_counts(topology),
             "\n            int[] faceVertexIndices = ", usda_list(topology.corner_vertices), '\n');
  if (!topology.corner_uvs.empty()) shared_text_ += uv_lines(topology, uvs);
  shared_text_ +=
      concat(options.extra_prim_lines, "            uniform token subdivisionScheme = \"",
             subdivision_ == Subdivision::kNone ? "none" : "catmullClark", "\"\n");
  std::vector<std::vector<std::uint32_t>> of_material(options.materials.size());
  for (Index f = 0; f < topology.face_count() && !of_material.empty(); ++f) {
    const std::size_t material = options.polygon_materials.empty()
                                     ? 0
                                     : options.polygon_materials[static_cast<std::size_t>(f)];
    of_material[material].push_back(static_cast<std::uint32_t>(f));
  }
  UsdaNames names, beside;  // `beside` holds subsets and shapes, which are siblings
  for (std::size_t m = 0; m < of_material.size(); ++m) {
    const std::string& name = options.materials[m];
    const bool is_used = !of_material[m].empty();
    materials_.push_back(is_used ? names.add(name.empty() ? "material" : name) : "");
    subsets_.push_back(is_used ? usda_list(of_material[m]) : "");
    if (is_used) beside.add(concat(materials_.back(), "_faces"));
  }
  for (const GlbMorphTarget& target : options.targets) {
    shapes_.push_back(beside.add(target.name));
    quoted_shape_names_.push_back(usda_string(target.name));
    indices_.push_back(target.vertices.empty() ? "" : usda_list(target.vertices));
    max_displacement_count_ +=
        target.vertices.empty() ? static_cast<std::size_t>(vertex_count_) : target.vertices.size();
  }
}

void UsdaMesh::add(EncodedFile& file, const PrimPaths& prim_paths, const Positions& positions,
                   const Positions& normals, std::span<const Displacements> moves,
                   const std::string& what, const ColourRows& colours) const {
  require(moves.size() == shapes_.size(), "UsdaMesh: displacements of each target");
  require_finite(positions, vertex_count_, what);
  Positions extent(2, 3);
  extent << positions.colwise().minCoeff(), positions.colwise().maxCoeff();
  file.add(concat("        def Mesh \"", prim_paths.name,
                  "\" (\n            prepend apiSchemas = [\"MaterialBindingAPI\"",
                  shapes_.empty() ? "" : ", \"SkelBindingAPI\"", "]\n        )\n        {\n",
                  "            float3[] extent = [", usda_rows(extent), "]\n            ",
                  kUsdaPoints));
  file.add(usda_rows(positions));
  file.add("]\n");
  // Write normals only if the surface is not subdivided, because viewers compute the normals of a
  // subdivided surface.
  if (subdivision_ == Subdivision::kNone) {
    require_finite(normals, vertex_count_, what);
    file.add("            normal3f[] normals = [");
    file.add(usda_rows(normals));
    file.add("] (\n                interpolation = \"vertex\"\n            )\n");
  }
  if (colours.rows() > 0) {
    file.add("            color3f[] primvars:displayColor = [");
    file.add(usda_rows(linear_light(colours)));
    file.add("] (\n                interpolation = \"vertex\"\n            )\n");
  }
  file.add_without_copy(shared_text_);
  add_shapes(file, prim_paths, moves, what);
  add_subsets(file, prim_paths);
  file.add("        }\n");
}

void UsdaMesh::add_shapes(EncodedFile& file, const PrimPaths& prim_paths,
                          std::span<const Displacements> moves, const std::string& what) const {
  if (shapes_.empty()) return;
  std::vector<std::string> targets;
  for (const std::string& shape : shapes_) {
    targets.push_back(concat('<', prim_paths.face_prim, '/', prim_paths.name, '/', shape, '>'));
  }
  file.add(concat("            uniform token[] skel:blendShapes = ", usda_list(quoted_shape_names_),
                  "\n            rel skel:blendShapeTargets = ", usda_list(targets),
                  "\n            rel skel:skeleton = <", prim_paths.face_prim, "/skeleton>\n"));
  for (std::size_t s = 0; s < shapes_.size(); ++s) {
    require_finite(moves[s].moves, moves[s].moves.rows(), what);
    file.add(concat("\n            def BlendShape \"", shapes_[s],
                    "\"\n            {\n                uniform vector3f[] offsets = ["));
    file.add(usda_rows(moves[s].moves));
    file.add("]\n                uniform int[] pointIndices = ");
    if (indices_[s].empty()) {
      file.add(usda_list(moves[s].vertices));
    } else {
      file.add_without_copy(indices_[s]);
    }
    file.add("\n            }\n");
  }
}

void UsdaMesh::add_subsets(EncodedFile& file, const PrimPaths& prim_paths) const {
  const auto used =
      std::ranges::count_if(materials_, [](const std::string& name) { return !name.empty(); });
  for (std::size_t m = 0; m < materials_.size(); ++m) {
    const std::string& name = materials_[m];
    if (name.empty()) continue;
    const std::string binding =
        concat("rel material:binding = <", prim_paths.materials, '/', name, ">\n");
    if (used == 1) {
      file.add("            " + binding);
      return;
    }
    file.add(concat("\n            def GeomSubset \"", name,
                    "_faces\" (\n                prepend apiSchemas = [\"MaterialBindingAPI\"]\n"
                    "            )\n            {\n                uniform token elementType = "
                    "\"face\"\n                uniform token familyName = \"materialBind\"\n"
                    "                int[] indices = "));
    file.add_without_copy(subsets_[m]);
    file.add(concat("\n                ", binding, "            }\n"));
  }
}

std::size_t UsdaMesh::memory_bytes() const {
  std::size_t bytes = shared_text_.size();
  for (const auto* texts : {&subsets_, &indices_}) {
    for (const std::string& text : *texts) bytes += text.size();
  }
  return bytes;
}

std::size_t UsdaMesh::encoding_memory_bytes() const {
  // Each array is in memory twice: as formatted text and as its copy in the file.
  return 2 * kMaxUsdaRowLength *
         (3 * static_cast<std::size_t>(vertex_count_) + max_displacement_count_);
}

}  // namespace crowdface
