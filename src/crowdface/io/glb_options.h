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

/// A glTF material: base colour, and indices of the images that it uses.
struct GlbMaterial {
  std::string name;                            ///< may be empty
  std::array<float, 4> colour = {1, 1, 1, 1};  ///< linear RGB and opacity, each in [0, 1]
  /// Index of the base colour image, multiplied by `colour`.
  std::optional<std::size_t> image = {};
  bool overlay = false;  ///< whether the base colour comes from the overlay image, opaque
  std::optional<std::size_t> normal_image = {};  ///< index of the tangent-space normal map
  /// Index of the roughness map; roughness is in the green channel.
  std::optional<std::size_t> roughness_image = {};
};

/// An image that all files share, such as an iris, with texture coordinates for each vertex. Files
/// that do not embed images refer to the image file `kFile`.
struct GlbOverlay {
  static constexpr const char* kFile = "topology/iris.png";

  std::string png;
  /// #V: texture coordinates of each vertex; 65535 is the right or lower edge
  std::vector<std::array<std::uint16_t, 2>> places;
};

/// A morph target present in every file: its name and the vertices it moves, ascending.
struct GlbTarget {
  std::string name;
  std::vector<std::uint32_t> vertices;
};

/// An image that every face's file has, with different content in each file.
struct GlbFaceImage {
  std::string type;    ///< "image/png" or "image/jpeg"
  std::string suffix;  ///< follows the mesh's name in the image's name, such as ".normal"
};

struct GlbOptions {
  /// Length unit of the positions; the file's node scales to metres.
  LengthUnit unit = LengthUnit::kMetre;
  Axis up = {1, 1};  ///< up axis of the positions; the node rotates it to +Y
  /// Front axis of the positions; the node rotates it to +Z, glTF's front.
  Axis front = {2, 1};
  std::vector<GlbMaterial> materials;
  bool colours = false;  ///< whether each file has its own vertex colours
  /// #F: the material of each face, as index into `materials`; empty if there are no materials
  std::vector<std::uint32_t> face_materials;
  std::vector<GlbTarget> targets;
  /// Names of the points: child nodes of the face's node, whose positions differ per face.
  std::vector<std::string> points;
  GlbSkin skin;  ///< joints under the face's node; positions differ per face
  std::vector<std::uint32_t> vertex_ids;  ///< #V values of `_VERTEX_ID`; empty: 0, 1, 2, …
  std::vector<GlbFaceImage> images;       ///< the images embedded in every file
  std::optional<GlbOverlay> overlay = {};
  /// Folder relative to which files without embedded images refer to `GlbOverlay::kFile`.
  std::string shared_folder = ".";
};

}  // namespace crowdface
