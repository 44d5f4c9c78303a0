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
#include "crowdface/io/single_text.h"

namespace crowdface {
namespace {

constexpr std::string_view kCreator = "string creator = \"crowdface\"";
constexpr std::string_view kPoints = "point3f[] points = [";
constexpr std::string_view kIdentity = "[((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (0, 0, 0, 1))]";

/// "(0.8, 0.6, 0.5)".
std::string colour_text(const GlbMaterial& material) {
  const auto tidy = [](float value) { return std::round(static_cast<double>(value) * 1e4) / 1e4; };
  return concat('(', tidy(material.colour[0]), ", ", tidy(material.colour[1]), ", ",
                tidy(material.colour[2]), ')');
}

/// A transform that turns `up` to +Y and `front` to +Z, unless the stage can have that up axis.
std::string turn_of(const GlbOptions& options) {
  const Axis up = options.up;
  if (up.sign > 0 && up.index > 0) return {};
  Eigen::Matrix3d turn = Eigen::Matrix3d::Zero();
  turn(1, up.index) = up.sign;
  turn(2, options.front.index) = options.front.sign;
  turn.row(0) = turn.row(1).cross(turn.row(2));
  std::string rows;
  for (int column = 0; column < 3; ++column) {  // USD's vectors are rows
    rows += concat('(', turn(0, column) + 0.0, ", ", turn(1, column) + 0.0, ", ",
                   turn(2, column) + 0.0, ", 0), ");
  }
  return concat("        matrix4d xformOp:transform = (", rows,
                "(0, 0, 0, 1))\n"
                "        uniform token[] xformOpOrder = [\"xformOp:transform\"]\n");
}

std::string uv_text(const TextureCoordinates& uvs) {
  std::string text = "[";
  for (Index i = 0; i < uvs.rows(); ++i) {
    char buffer[2 * kSingleRoom];
    char* at = buffer;
    if (i > 0) *at++ = ',';
    *at++ = '(';
    at = write_single(at, uvs(i, 0));
    *at++ = ',';
    at = write_single(at, uvs(i, 1));
    *at++ = ')';
    text.append(buffer, at);
  }
  return text + ']';
}

/// The values of the primvar, and for each corner which of them: one that has none gets zeros.
std::string uv_lines(const Topology& topology, const TextureCoordinates& uvs) {
  TextureCoordinates all = uvs;
  std::vector<std::uint32_t> corners = topology.corner_uvs;
  if (std::ranges::find(corners, kNoIndex) != corners.end()) {
    all.conservativeResize(uvs.rows() + 1, Eigen::NoChange);
    all.row(uvs.rows()).setZero();
    std::replace(corners.begin(), corners.end(), kNoIndex, static_cast<std::uint32_t>(uvs.rows()));
  }
  return concat("            texCoord2f[] primvars:st = ", uv_text(all),
                " (\n                interpolation = \"faceVarying\"\n            )\n"
                "            int[] primvars:st:indices = ",
                usda_list(corners), '\n');
}

/// Where the vertices of overlaid faces lie on the overlay; all others share one place.
std::string overlay_lines(const Topology& topology, const GlbOptions& options) {
  std::vector<std::uint32_t> places(static_cast<std::size_t>(topology.vertex_count), 0);
  std::vector<std::uint32_t> vertices = {kNoIndex};  // of each place
  for (Index f = 0; f < topology.face_count(); ++f) {
    const auto at = static_cast<std::size_t>(f);
    const std::size_t material = options.face_materials.empty() ? 0 : options.face_materials[at];
    if (!options.materials[material].overlay) continue;
    for (const std::uint32_t v : topology.face(f)) {
      if (places[v] != 0) continue;
      places[v] = static_cast<std::uint32_t>(vertices.size());
      vertices.push_back(v);
    }
  }
  TextureCoordinates uvs = TextureCoordinates::Zero(static_cast<Index>(vertices.size()), 2);
  for (Index i = 1; i < uvs.rows(); ++i) {
    const auto& place = options.overlay->places[vertices[static_cast<std::size_t>(i)]];
    uvs.row(i) << place[0] / 65535.0, 1 - place[1] / 65535.0;  // from the left and lower edge
  }
  return concat("            texCoord2f[] primvars:st1 = ", uv_text(uvs),
                " (\n                interpolation = \"vertex\"\n            )\n"
                "            int[] primvars:st1:indices = ",
                usda_list(places), '\n');
}

std::string corner_counts(const Topology& topology) {
  std::vector<std::uint32_t> counts;
  for (Index f = 0; f < topology.face_count(); ++f) {
    const auto [begin, end] = topology.corners(f);
    counts.push_back(end - begin);
  }
  return usda_list(counts);
}

std::string extent_of_points(const Positions& positions) {
  Positions box(2, 3);
  box.row(0) = positions.colwise().minCoeff();
  box.row(1) = positions.colwise().maxCoeff();
  return usda_rows(box);
}

/// A texture of a material as a shader of its own. \param more  lines of its inputs.
std::string texture_text(const std::string& path, std::string_view name, const std::string& file,
                         std::string_view wrap, bool is_colour, std::string_view more,
                         std::string_view output) {
  const std::string inner = "            ";
  const std::string deep = inner + "    ";
  return concat('\n', inner, "def Shader \"", name, "\"\n", inner, "{\n", deep,
                "uniform token info:id = \"UsdUVTexture\"\n", deep, "asset inputs:file = @", file,
                "@\n", more, deep, "token inputs:sourceColorSpace = \"", is_colour ? "sRGB" : "raw",
                "\"\n", deep, "float2 inputs:st.connect = <", path, "/st.outputs:result>\n", deep,
                "token inputs:wrapS = \"", wrap, "\"\n", deep, "token inputs:wrapT = \"", wrap,
                "\"\n", deep, output, '\n', inner, "}\n");
}

std::string material_text(const std::string& path, const std::string& name,
                          const GlbMaterial& material, std::span<const std::string> images,
                          const std::string& shared) {
  const std::string picture = material.image     ? images[*material.image]
                              : material.overlay ? concat(shared, '/', GlbOverlay::kFile)
                                                 : std::string();
  const std::string inner = "            ";
  const std::string deep = inner + "    ";
  const std::string colour = !picture.empty() ? concat(".connect = <", path, "/colour.outputs:rgb>")
                                              : concat(" = ", colour_text(material));
  const std::string roughness =
      material.roughness_image ? concat(".connect = <", path, "/roughness.outputs:r>") : " = 0.6";
  std::string text =
      concat("        def Material \"", name, "\"\n        {\n", inner,
             "token outputs:surface.connect = <", path, "/surface.outputs:surface>\n\n", inner,
             "def Shader \"surface\"\n", inner, "{\n", deep,
             "uniform token info:id = \"UsdPreviewSurface\"\n", deep, "color3f inputs:diffuseColor",
             colour, '\n', deep, "float inputs:metallic = 0\n");
  if (material.normal_image) {
    text += concat(deep, "normal3f inputs:normal.connect = <", path, "/normal.outputs:rgb>\n");
  }
  text += concat(deep, "float inputs:opacity = ", static_cast<double>(material.colour[3]), '\n',
                 deep, "float inputs:roughness", roughness, '\n', deep, "token outputs:surface\n",
                 inner, "}\n");
  const std::string_view wrap = material.overlay ? "clamp" : "repeat";
  if (!picture.empty()) {
    text += texture_text(path, "colour", picture, wrap, true, "", "float3 outputs:rgb");
  }
  if (material.normal_image) {
    text += texture_text(path, "normal", images[*material.normal_image], wrap, false,
                         concat(deep, "float4 inputs:bias = (-1, -1, -1, 0)\n", deep,
                                "float4 inputs:scale = (2, 2, 2, 1)\n"),
                         "float3 outputs:rgb");
  }
  if (material.roughness_image) {
    text += texture_text(path, "roughness", images[*material.roughness_image], wrap, false, "",
                         "float outputs:r");
  }
  if (!picture.empty() || material.normal_image || material.roughness_image) {
    text += concat('\n', inner, "def Shader \"st\"\n", inner, "{\n", deep,
                   "uniform token info:id = \"UsdPrimvarReader_float2\"\n", deep,
                   "string inputs:varname = \"", material.overlay ? "st1" : "st", "\"\n", deep,
                   "float2 outputs:result\n", inner, "}\n");
  }
  return text + "        }\n";
}

/// What plays blend shapes: UsdSkel wants a skeleton, of one joint that never moves.
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
    : vertices_(topology.vertex_count),
      subdivision_(subdivision),
      frame_(usda_frame(options.unit, options.up)),
      turn_(turn_of(options)),
      surfaces_(options.materials),
      shared_(options.shared) {
  if (topology.face_count() == 0) throw InvalidInput("USD: expected a mesh with faces");
  add_mesh(topology, uvs, options);
  UsdaNames names, point_names;
  for (const std::string& material : materials_) {  // subsets lie beside the shapes
    if (!material.empty()) names.add(concat(material, "_faces"));
  }
  for (const std::string& point : options.points) points_.push_back(point_names.add(point));
  for (const GlbTarget& target : options.targets) {
    shapes_.push_back(names.add(target.name));
    tokens_.push_back(usda_string(target.name));
    indices_.push_back(usda_list(target.vertices));
    target_rows_ += target.vertices.size();
  }
}

void UsdaTemplate::add_mesh(const Topology& topology, const TextureCoordinates& uvs,
                            const GlbOptions& options) {
  faces_ =
      concat("            uniform bool doubleSided = 1\n            int[] faceVertexCounts = ",
             corner_counts(topology),
             "\n            int[] faceVertexIndices = ", usda_list(topology.corner_vertices), '\n');
  if (!topology.corner_uvs.empty()) faces_ += uv_lines(topology, uvs);
  if (options.overlay) faces_ += overlay_lines(topology, options);
  faces_ += concat("            uniform token subdivisionScheme = \"",
                   subdivision_ == Subdivision::kNone ? "none" : "catmullClark", "\"\n");
  std::vector<std::vector<std::uint32_t>> of_material(options.materials.size());
  for (Index f = 0; f < topology.face_count() && !of_material.empty(); ++f) {
    const std::size_t material =
        options.face_materials.empty() ? 0 : options.face_materials[static_cast<std::size_t>(f)];
    of_material[material].push_back(static_cast<std::uint32_t>(f));
  }
  UsdaNames names;
  for (std::size_t m = 0; m < of_material.size(); ++m) {
    const std::string& name = options.materials[m].name;
    materials_.push_back(of_material[m].empty() ? "" : names.add(name.empty() ? "material" : name));
    subsets_.push_back(of_material[m].empty() ? "" : usda_list(of_material[m]));
  }
}

EncodedFile UsdaTemplate::encode(const Positions& positions, const Positions& normals,
                                 const std::string& name, std::span<const Displacements> moves,
                                 std::span<const std::string> images,
                                 const Positions& points) const {
  require(moves.size() == shapes_.size(), "UsdaTemplate: displacements of each target");
  require_finite(positions, vertices_, name);
  const std::string prim = usda_name(name), root = "/" + prim;
  const bool acts = !shapes_.empty();
  EncodedFile file;
  file.add(concat("#usda 1.0\n(\n    customLayerData = {\n        ", kCreator,
                  "\n    }\n    defaultPrim = \"", prim, "\"\n", frame_, ")\n\ndef Xform \"", prim,
                  "\" (\n    kind = \"component\"\n)\n{\n    def ", acts ? "SkelRoot" : "Xform",
                  " \"face\"\n    {\n", turn_,
                  "        def Mesh \"mesh\" (\n            prepend apiSchemas = "
                  "[\"MaterialBindingAPI\"",
                  acts ? ", \"SkelBindingAPI\"" : "", "]\n        )\n        {\n",
                  "            float3[] extent = [", extent_of_points(positions), "]\n            ",
                  kPoints));
  file.add(usda_rows(positions));
  file.add("]\n");
  if (subdivision_ == Subdivision::kNone) {  // a subdivided surface has its own
    require_finite(normals, vertices_, name);
    file.add("            normal3f[] normals = [");
    file.add(usda_rows(normals));
    file.add("] (\n                interpolation = \"vertex\"\n            )\n");
  }
  file.refer_to(faces_);
  add_shapes(file, root, moves, name);
  add_subsets(file, root);
  file.add("        }\n");
  if (acts) file.add(skeleton_text(root, tokens_));
  add_points(file, points, name);
  file.add("    }\n");
  add_materials(file, root, images);
  file.add("}\n");
  return file;
}

void UsdaTemplate::add_shapes(EncodedFile& file, const std::string& root,
                              std::span<const Displacements> moves, const std::string& what) const {
  if (shapes_.empty()) return;
  const std::string mesh = root + "/face/mesh";
  std::vector<std::string> targets;
  for (const std::string& shape : shapes_) targets.push_back(concat('<', mesh, '/', shape, '>'));
  file.add(concat("            uniform token[] skel:blendShapes = ", usda_list(tokens_),
                  "\n            rel skel:blendShapeTargets = ", usda_list(targets),
                  "\n            rel skel:skeleton = <", root, "/face/skeleton>\n"));
  for (std::size_t s = 0; s < shapes_.size(); ++s) {
    require_finite(moves[s].moves, moves[s].moves.rows(), what);
    file.add(concat("\n            def BlendShape \"", shapes_[s],
                    "\"\n            {\n                uniform vector3f[] offsets = ["));
    file.add(usda_rows(moves[s].moves));
    file.add("]\n                uniform int[] pointIndices = ");
    file.refer_to(indices_[s]);
    file.add("\n            }\n");
  }
}

void UsdaTemplate::add_points(EncodedFile& file, const Positions& points,
                              const std::string& what) const {
  require_finite(points, static_cast<Index>(points_.size()), what);
  if (points_.empty()) return;
  std::string text = "\n        def Scope \"points\"\n        {\n";
  for (Index p = 0; p < points.rows(); ++p) {
    text += concat(
        "            def Xform \"", points_[static_cast<std::size_t>(p)],
        "\"\n            {\n                double3 xformOp:translate = ", usda_rows(points.row(p)),
        "\n                uniform token[] xformOpOrder = [\"xformOp:translate\"]\n"
        "            }\n");
  }
  file.add(text + "        }\n");
}

void UsdaTemplate::add_subsets(EncodedFile& file, const std::string& root) const {
  const auto used =
      std::ranges::count_if(materials_, [](const std::string& name) { return !name.empty(); });
  for (std::size_t m = 0; m < materials_.size(); ++m) {
    const std::string& name = materials_[m];
    if (name.empty()) continue;
    const std::string binding =
        concat("rel material:binding = <", root, "/materials/", name, ">\n");
    if (used == 1) {
      file.add("            " + binding);
      return;
    }
    file.add(concat("\n            def GeomSubset \"", name,
                    "_faces\" (\n                prepend apiSchemas = [\"MaterialBindingAPI\"]\n"
                    "            )\n            {\n                uniform token elementType = "
                    "\"face\"\n                uniform token familyName = \"materialBind\"\n"
                    "                int[] indices = "));
    file.refer_to(subsets_[m]);
    file.add(concat("\n                ", binding, "            }\n"));
  }
}

void UsdaTemplate::add_materials(EncodedFile& file, const std::string& root,
                                 std::span<const std::string> images) const {
  if (materials_.empty()) return;
  file.add("\n    def Scope \"materials\"\n    {\n");
  for (std::size_t m = 0; m < materials_.size(); ++m) {
    if (materials_[m].empty()) continue;
    file.add(material_text(concat(root, "/materials/", materials_[m]), materials_[m], surfaces_[m],
                           images, shared_));
  }
  file.add("    }\n");
}

std::size_t UsdaTemplate::memory_bytes() const {
  std::size_t bytes = faces_.size();
  for (const auto* texts : {&subsets_, &indices_}) {
    for (const std::string& text : *texts) bytes += text.size();
  }
  return bytes;
}

std::size_t UsdaTemplate::encode_bytes() const {
  // The text of each array, and its copy in the file.
  return 2 * kLongestUsdaRow * (2 * static_cast<std::size_t>(vertices_) + target_rows_);
}

Positions read_usda_positions(const std::filesystem::path& path, Index vertices) {
  const MappedFile file(path);
  const std::string_view bytes = file.bytes();
  const auto refuse = [&] {
    throw InvalidInput(concat(path.string(), ": expected a USD layer as crowdface writes it for ",
                              vertices, " vertices, found another"));
  };
  const std::size_t begin = bytes.find(kPoints);
  if (bytes.find(kCreator) == bytes.npos || begin == bytes.npos) refuse();
  const char* at = bytes.data() + begin + kPoints.size();
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
