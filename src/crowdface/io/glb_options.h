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

/// How a surface looks where textures are not read.
struct GlbMaterial {
  std::string name;                            ///< may be empty
  std::array<float, 4> colour = {1, 1, 1, 1};  ///< linear red green blue, opacity; each in [0, 1]
  std::optional<std::size_t> image = {};  ///< its colours, times `colour`: one of the file's images
  bool overlay = false;                   ///< its colours are the overlay's, opaque
  std::optional<std::size_t> normal_image = {};     ///< its tangent-space normals, likewise
  std::optional<std::size_t> roughness_image = {};  ///< how rough it is, in the green channel
};

/// A picture that all files have, such as an iris, and where on it each vertex lies. Files that bring no
/// pictures along find it beside them.
struct GlbOverlay {
  static constexpr const char* kFile = "topology/iris.png";

  std::string png;
  std::vector<std::array<std::uint16_t, 2>> places;  ///< #V; 65535 is the right or lower edge
};

/// A morph target that every file has: its name, and the vertices that it moves, ascending.
struct GlbTarget {
  std::string name;
  std::vector<std::uint32_t> vertices;
};

struct GlbOptions {
  LengthUnit unit = LengthUnit::kMetre;  ///< of the positions; the file's node scales to metres
  Axis up = {1, 1};                      ///< of the positions; the node turns them to +Y …
  Axis front = {2, 1};                   ///< … and +Z, which is glTF's front
  std::vector<GlbMaterial> materials;
  bool colours = false;                       ///< each file has colours of its own at vertices
  std::vector<std::uint32_t> face_materials;  ///< #F, rows of materials; empty: none has any
  std::vector<GlbTarget> targets;
  std::vector<std::string> points;        ///< nodes below the face's, at places of its own
  GlbSkin skin;                           ///< joints below the face's node, at places of its own
  std::vector<std::uint32_t> vertex_ids;  ///< #V, what `_VERTEX_ID` says; empty: 0, 1, 2, …
  /// "image/png" or "image/jpeg" of each image that every file brings along.
  std::vector<std::string> image_types;
  std::optional<GlbOverlay> overlay = {};
  std::string shared =
      ".";  ///< where GlbOverlay::kFile is found from files that do not bring it along
};

}  // namespace crowdface
