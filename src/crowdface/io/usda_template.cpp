// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/usda_template.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include <Eigen/Geometry>

#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/require.h"
#include "crowdface/core/text.h"
#include "crowdface/io/single_precision.h"

namespace crowdface {
namespace {

constexpr std::string_view kCreator = "string creator = \"crowdface\"";
constexpr std::string_view kIdentity = "[((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (0, 0, 0, 1))]";

/// The text of a transform that rotates `up` to +Y and `front` to +Z. Empty if `up` can be the up
/// axis of the USD stage.
std::string rotation_text(const GlbOptions& options) {
  const Axis up = options.up;
  if (up.sign > 0 && up.index > 0) return {};
  Eigen::Matrix3d turn = Eigen::Matrix3d::Zero();
  turn(1, up.index) = up.sign;
  turn(2, options.front.index) = options.front.sign;
  turn.row(0) = turn.row(1).cross(turn.row(2));
  std::string rows;
  for (int column = 0; column < 3; ++column) {  // USD uses row vectors
    rows += concat('(', turn(0, column) + 0.0, ", ", turn(1, column) + 0.0, ", ",
                   turn(2, column) + 0.0, ", 0), ");
  }
  return concat("        matrix4d xformOp:transform = (", rows,
                "(0, 0, 0, 1))\n"
                "        uniform token[] xformOpOrder = [\"xformOp:transform\"]\n");
}

/// The primvar with the overlay's texture coordinates. Vertices without overlay share one
/// coordinate.
std::string overlay_lines(const Topology& topology, const GlbOptions& options) {
  std::vector<std::uint32_t> places(static_cast<std::size_t>(topology.vertex_count), 0);
  std::vector<std::uint32_t> vertices = {kNoIndex};  // vertex of each coordinate
  for (Index f = 0; f < topology.face_count(); ++f) {
    const auto at = static_cast<std::size_t>(f);
    const std::size_t material =
        options.polygon_materials.empty() ? 0 : options.polygon_materials[at];
    if (!options.materials[material].uses_overlay) continue;
    for (const std::uint32_t v : topology.face(f)) {
      if (places[v] != 0) continue;
      places[v] = static_cast<std::uint32_t>(vertices.size());
      vertices.push_back(v);
    }
  }
  TextureCoordinates uvs = TextureCoordinates::Zero(static_cast<Index>(vertices.size()), 2);
  for (Index i = 1; i < uvs.rows(); ++i) {
    const auto& place = options.overlay->uvs[vertices[static_cast<std::size_t>(i)]];
    // USD measures texture coordinates from the left and the lower edge
    uvs.row(i) << place[0] / 65535.0, 1 - place[1] / 65535.0;
  }
  return concat("            texCoord2f[] primvars:st1 = ", usda_uvs(uvs),
                " (\n                interpolation = \"vertex\"\n            )\n"
                "            int[] primvars:st1:indices = ",
                usda_list(places), '\n');
}

/// Converts a glTF material to the appearance of a USD material.
/// \param images  paths of the images.
/// \param shared  see `GlbOptions::shared_folder`.
UsdaSurface surface_of(const GlbMaterial& material, std::span<const std::string> images,
                       const std::string& shared) {
  const auto file = [&](const std::optional<std::size_t>& image) {
    return image ? images[*image] : std::string();
  };
  UsdaSurface surface{.colour = material.colour,
                      .colour_map = file(material.image),
                      .normal_map = file(material.normal_image),
                      .roughness_map = file(material.roughness_image),
                      .is_overlay = material.uses_overlay};
  if (!material.image && material.uses_overlay)
    surface.colour_map = concat(shared, '/', GlbOverlay::kFile);
  return surface;
}

UsdaMesh mesh_of(const Topology& topology, const TextureCoordinates& uvs, const GlbOptions& options,
                 Subdivision subdivision) {
  if (topology.face_count() == 0) throw InvalidInput("USD: expected a mesh with faces");
  UsdaMesh::Options mesh_options{.subdivision = subdivision,
                                 .polygon_materials = options.polygon_materials,
                                 .targets = options.targets};
  for (const GlbMaterial& material : options.materials) {
    mesh_options.materials.push_back(material.name);
  }
  if (options.overlay) mesh_options.extra_prim_lines = overlay_lines(topology, options);
  return {topology, uvs, mesh_options};
}

/// The prims that drive blend shapes. UsdSkel allows blend shapes only with a skeleton, so the text
/// has a skeleton with a single joint that never moves.
std::string skeleton_text(const std::string& root, std::span<const std::string> tokens) {
  const std::vector<std::string> weights(tokens.size(), "0");
  return concat(
      "\n        def Skeleton \"skeleton\" (\n"
      "            prepend apiSchemas = [\"SkelBindingAPI\"]\n        )\n        {\n"
      "            uniform matrix4d[] bindTransforms = ",
      kIdentity,
      "\n            uniform token[] joints = [\"root\"]\n"
      "            uniform matrix4d[] restTransforms = ",
      kIdentity, "\n            rel skel:animationSource = <", root,
      "/face/animation>\n        }\n\n        def SkelAnimation \"animation\"\n        {\n"
      "            uniform token[] blendShapes = ",
      usda_list(tokens), "\n            float[] blendShapeWeights = ", usda_list(weights),
      "\n        }\n");
}

}  // namespace

UsdaTemplate::UsdaTemplate(const Topology& topology, const TextureCoordinates& uvs,
                           const GlbOptions& options, Subdivision subdivision)
    : mesh_(mesh_of(topology, uvs, options, subdivision)),
      layer_metadata_(usda_layer_metadata(options.unit, options.up)),
      axis_transform_(rotation_text(options)),
      glb_materials_(options.materials),
      shared_folder_(options.shared_folder) {
  UsdaNames names;
  for (const std::string& point : options.point_names)
    point_prim_names_.push_back(names.add(point));
}

EncodedFile UsdaTemplate::encode(const Positions& positions, const Positions& normals,
                                 const std::string& name, std::span<const Displacements> moves,
                                 std::span<const std::string> images, const Positions& points,
                                 std::span<const PlacedUsdaPart> parts,
                                 const ColourRows& colours) const {
  const std::string prim = usda_name(name), root = "/" + prim, face = root + "/face";
  const bool acts = !mesh_.quoted_shape_names().empty();
  EncodedFile file;
  file.add(concat("#usda 1.0\n(\n    customLayerData = {\n        ", kCreator,
                  "\n    }\n    defaultPrim = \"", prim, "\"\n", layer_metadata_,
                  ")\n\ndef Xform \"", prim, "\" (\n    kind = \"component\"\n)\n{\n    def ",
                  acts ? "SkelRoot" : "Xform", " \"face\"\n    {\n", axis_transform_));
  mesh_.add(file, {face, "mesh", root + "/materials"}, positions, normals, moves, name, colours);
  for (const PlacedUsdaPart& part : parts) {
    part.part->add_mesh(file, root, *part.positions, part.moves, name);
  }
  if (acts) file.add(skeleton_text(root, mesh_.quoted_shape_names()));
  add_points(file, points, name);
  file.add("    }\n");
  std::vector<UsdaSurface> surfaces;
  for (const GlbMaterial& one : glb_materials_)
    surfaces.push_back(surface_of(one, images, shared_folder_));
  file.add(usda_materials(root, "materials", mesh_.materials(), surfaces));
  for (const PlacedUsdaPart& part : parts) part.part->add_materials(file, root, part.look);
  file.add("}\n");
  return file;
}

void UsdaTemplate::add_points(EncodedFile& file, const Positions& points,
                              const std::string& what) const {
  require_finite(points, static_cast<Index>(point_prim_names_.size()), what);
  if (point_prim_names_.empty()) return;
  std::string text = "\n        def Scope \"points\"\n        {\n";
  for (Index p = 0; p < points.rows(); ++p) {
    text += concat(
        "            def Xform \"", point_prim_names_[static_cast<std::size_t>(p)],
        "\"\n            {\n                double3 xformOp:translate = ", usda_rows(points.row(p)),
        "\n                uniform token[] xformOpOrder = [\"xformOp:translate\"]\n"
        "            }\n");
  }
  file.add(text + "        }\n");
}

Positions read_usda_positions(const std::filesystem::path& path, Index vertices) {
  const MappedFile file(path);
  const std::string_view bytes = file.bytes();
  const auto refuse = [&] {
    refuse_file(
        path,
        concat(
            "expected a USD layer as crowdface writes it for ", vertices,
            " vertices, found different contents; run crowdface generate to write the file again"));
  };
  const std::size_t begin = bytes.find(kUsdaPoints);
  if (!bytes.starts_with("#usda ") || bytes.find(kCreator) == bytes.npos || begin == bytes.npos) {
    refuse();
  }
  const char* at = bytes.data() + begin + kUsdaPoints.size();
  const char* const end = bytes.data() + bytes.size();
  Positions positions(vertices, 3);
  for (Index i = 0; i < positions.size(); ++i) {
    while (at != end && (*at == '(' || *at == ',' || *at == ')')) ++at;
    float value = 0;
    const auto [after, error] = std::from_chars(at, end, value);
    if (error != std::errc()) refuse();
    positions.data()[i] = static_cast<double>(value);
    at = after;
  }
  if (end - at < 2 || at[0] != ')' || at[1] != ']') refuse();
  require_finite(positions, vertices, path.string());
  return positions;
}

}  // namespace crowdface
