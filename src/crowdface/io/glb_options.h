// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "crowdface/core/units.h"
#include "crowdface/io/glb_skin.h"

namespace crowdface {

/// A glTF material: its base colour, and the indices of the images that it uses. Each index refers
/// to `GlbOptions::images` or, for a material of a `GlbPart`, to the images of that part.
struct GlbMaterial {
  std::string name;                            ///< name of the material; may be empty
  std::array<float, 4> colour = {1, 1, 1, 1};  ///< linear RGB and opacity, each in [0, 1]
  /// Index of the base colour image. Viewers multiply the image's colours by `colour`.
  std::optional<std::size_t> image = {};
  /// How the alpha channel of the base colour image acts (glTF's alphaMode).
  enum class Alpha {
    kOpaque,
    kMask,   ///< alpha makes each texel either visible or invisible
    kBlend,  ///< alpha is the opacity of each texel
  };
  /// How alpha acts. Nothing: kBlend if the opacity in `colour` is below 1, otherwise kOpaque.
  std::optional<Alpha> alpha = {};
  /// Whether the base colour comes from `GlbOptions::overlay`. The material is then opaque.
  bool uses_overlay = false;
  std::optional<std::size_t> normal_image = {};  ///< index of the tangent-space normal map
  /// Index of the roughness map, which holds roughness in its green channel.
  std::optional<std::size_t> roughness_image = {};
};

/// An image, such as an iris, that materials with `uses_overlay` show instead of their own colour.
/// The image is the same in all files and has its own texture coordinates.
struct GlbOverlay {
  /// Path of the image below `GlbOptions::shared_folder`, for files that do not embed images.
  static constexpr const char* kFile = "topology/iris.png";

  std::string png;  ///< content of the PNG file
  /// one pair of texture coordinates per vertex, from 0 (left, upper edge) to 65535 (right, lower
  /// edge)
  std::vector<std::array<std::uint16_t, 2>> uvs;
};

/// A morph target (blend shape) that every file has.
struct GlbMorphTarget {
  std::string name;
  std::vector<std::uint32_t> vertices;  ///< the vertices that the target moves, ascending
};

/// An image with different content in the file of each face.
struct GlbFaceImage {
  std::string type;    ///< "image/png" or "image/jpeg"
  std::string suffix;  ///< end of the image's name, after the mesh's name, such as ".normal"
};

/// Settings and content that are equal in the GLB files of all faces of a crowd. USD layers use the
/// same settings.
struct GlbOptions {
  /// Length unit of the positions; the file's root node scales the positions to metres.
  LengthUnit unit = LengthUnit::kMetre;
  Axis up = {1, 1};  ///< up axis of the positions; the file's root node rotates this axis to +Y
  /// Front axis of the positions; the file's root node rotates this axis to +Z, glTF's front.
  Axis front = {2, 1};
  std::vector<GlbMaterial> materials;
  bool has_colours = false;  ///< whether each file has its own vertex colours
  /// for each polygon, the index of its material in `materials`; empty if there are no materials
  std::vector<std::uint32_t> polygon_materials;
  std::vector<GlbMorphTarget> targets;  ///< the morph targets of the face's mesh
  /// Names of the points. Each point is an empty child node of the face's node. The positions of
  /// the points differ from face to face.
  std::vector<std::string> point_names;
  GlbSkin skin;  ///< joints below the face's node; the joints' positions differ from face to face
  /// The value of `_VERTEX_ID` for each vertex. If empty, the values are 0, 1, 2, …
  std::vector<std::uint32_t> vertex_ids;
  std::vector<GlbFaceImage> images;  ///< the images embedded in every file
  /// The image of the materials with `uses_overlay`; empty: there are no such materials.
  std::optional<GlbOverlay> overlay = {};
  /// For files without embedded images: the path from the file to the folder that contains
  /// `GlbOverlay::kFile`.
  std::string shared_folder = ".";
};

}  // namespace crowdface
