// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/usda_material.h"

#include <string_view>

#include "crowdface/core/rounded.h"
#include "crowdface/core/text.h"

namespace crowdface {
namespace {

const std::string kInner = "            ";
const std::string kDeep = kInner + "    ";

/// Formats a colour: "(0.8, 0.6, 0.5)".
std::string colour_text(const std::array<float, 4>& colour) {
  return concat('(', rounded(colour[0]), ", ", rounded(colour[1]), ", ", rounded(colour[2]), ')');
}

/// Formats a file name as a USD asset path. The name stands between two @. If the name contains @,
/// it stands between two @@@, and each @@@ in the name is escaped.
std::string asset_path(std::string_view file) {
  if (file.find('@') == file.npos) return concat('@', file, '@');
  std::string text = "@@@";
  for (; !file.empty(); file.remove_prefix(1)) {
    if (file.starts_with("@@@")) text += '\\';
    text += file.front();
  }
  return text + "@@@";
}

/// The text of a shader prim for a texture.
/// \param path  path of the Material prim that contains the shader.
/// \param more  additional input lines.
std::string texture_text(const std::string& path, std::string_view name, const std::string& file,
                         std::string_view wrap, bool is_colour, std::string_view more,
                         std::string_view output) {
  return concat('\n', kInner, "def Shader \"", name, "\"\n", kInner, "{\n", kDeep,
                "uniform token info:id = \"UsdUVTexture\"\n", kDeep,
                "asset inputs:file = ", asset_path(file), '\n', more, kDeep,
                "token inputs:sourceColorSpace = \"", is_colour ? "sRGB" : "raw", "\"\n", kDeep,
                "float2 inputs:st.connect = <", path, "/st.outputs:result>\n", kDeep,
                "token inputs:wrapS = \"", wrap, "\"\n", kDeep, "token inputs:wrapT = \"", wrap,
                "\"\n", kDeep, output, '\n', kInner, "}\n");
}

/// The text of a Material prim.
/// \param path  path of the prim.
/// \param name  last component of the path.
std::string material_text(const std::string& path, const std::string& name,
                          const UsdaSurface& surface) {
  const auto input = [&](const std::string& file, std::string_view shader, std::string_view output,
                         const std::string& value) {
    if (file.empty()) return concat(" = ", value, '\n');
    return concat(".connect = <", path, '/', shader, ".outputs:", output, ">\n");
  };
  const std::string_view holes = surface.is_opacity_in_alpha ? "a" : "r";
  std::string text = concat("        def Material \"", name, "\"\n        {\n", kInner,
                            "token outputs:surface.connect = <", path,
                            "/surface.outputs:surface>\n\n", kInner, "def Shader \"surface\"\n",
                            kInner, "{\n", kDeep, "uniform token info:id = \"UsdPreviewSurface\"\n",
                            kDeep, "color3f inputs:diffuseColor",
                            input(surface.colour_map, "colour", "rgb", colour_text(surface.colour)),
                            kDeep, "float inputs:metallic = 0\n");
  if (!surface.normal_map.empty()) {
    text += concat(kDeep, "normal3f inputs:normal", input(surface.normal_map, "normal", "rgb", ""));
  }
  text += concat(
      kDeep, "float inputs:opacity",
      input(surface.opacity_map, "holes", holes, concat(static_cast<double>(surface.colour[3]))));
  if (!surface.opacity_map.empty()) text += concat(kDeep, "float inputs:opacityThreshold = 0.5\n");
  text +=
      concat(kDeep, "float inputs:roughness", input(surface.roughness_map, "roughness", "r", "0.6"),
             kDeep, "token outputs:surface\n", kInner, "}\n");
  const std::string_view wrap = surface.is_overlay ? "clamp" : "repeat";
  const auto add_texture = [&](const std::string& file, std::string_view shader, bool is_colour,
                               std::string_view more, std::string_view output) {
    if (!file.empty()) text += texture_text(path, shader, file, wrap, is_colour, more, output);
  };
  add_texture(surface.colour_map, "colour", true, "", "float3 outputs:rgb");
  add_texture(surface.normal_map, "normal", false,
              concat(kDeep, "float4 inputs:bias = (-1, -1, -1, 0)\n", kDeep,
                     "float4 inputs:scale = (2, 2, 2, 1)\n"),
              "float3 outputs:rgb");
  add_texture(surface.roughness_map, "roughness", false, "", "float outputs:r");
  add_texture(surface.opacity_map, "holes", false, "", concat("float outputs:", holes));
  if (!(surface.colour_map + surface.normal_map + surface.roughness_map + surface.opacity_map)
           .empty()) {
    text += concat('\n', kInner, "def Shader \"st\"\n", kInner, "{\n", kDeep,
                   "uniform token info:id = \"UsdPrimvarReader_float2\"\n", kDeep,
                   "string inputs:varname = \"", surface.is_overlay ? "st1" : "st", "\"\n", kDeep,
                   "float2 outputs:result\n", kInner, "}\n");
  }
  return text + "        }\n";
}

}  // namespace

std::string usda_materials(const std::string& root, const std::string& scope,
                           const std::vector<std::string>& names,
                           const std::vector<UsdaSurface>& surfaces) {
  if (names.empty()) return {};
  std::string text = concat("\n    def Scope \"", scope, "\"\n    {\n");
  for (std::size_t m = 0; m < names.size(); ++m) {
    if (names[m].empty()) continue;
    text += material_text(concat(root, '/', scope, '/', names[m]), names[m], surfaces[m]);
  }
  return text + "    }\n";
}

}  // namespace crowdface
