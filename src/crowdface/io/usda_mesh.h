// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "crowdface/io/encoded_file.h"
#include "crowdface/io/glb_options.h"
#include "crowdface/io/usd_subdivision.h"
#include "crowdface/io/usda_text.h"
#include "crowdface/mesh/colour_rows.h"
#include "crowdface/mesh/displacements.h"
#include "crowdface/mesh/topology.h"

namespace crowdface {

/// How the points of a Mesh prim begin: the first that stands in a layer is the face's.
inline constexpr std::string_view kUsdaPoints = "point3f[] points = [";

/// A Mesh prim of one topology: faces as they are, texture coordinates as the primvar `st`, material subsets,
/// and blend shapes of UsdSkel. All but its vectors is made once.
class UsdaMesh {
 public:
  struct Form {
    Subdivision subdivision = Subdivision::kNone;
    std::vector<std::string> materials = {};         ///< names; may be empty
    std::vector<std::uint32_t> face_materials = {};  ///< #F rows of materials; empty: all the first
    /// Blend shapes, and the vertices that each face has moved there; none: each face's displacements say.
    std::vector<GlbTarget> targets = {};
    std::string lines = {};  ///< further ones of the prim
  };

  /// \param uvs  #T by 2; may be empty.
  UsdaMesh(const Topology& topology, const TextureCoordinates& uvs, const Form& form);

  /// Where a prim and what belongs to it stand in one layer.
  struct Place {
    std::string face;       ///< path of the prim above, which holds the skeleton
    std::string name;       ///< the prim's
    std::string materials;  ///< path of the prim that holds the materials
  };
  /// Adds the prim; the file refers to this object.
  /// \param normals  #V by 3, unit; not written for meshes that are subdivided.
  /// \param moves    #targets. \param what  for messages.
  /// \param colours  #V, as the primvar displayColor, in linear light; or no rows.
  /// \throws InvalidInput if positions or normals are not #V by 3 or not finite.
  void add(EncodedFile& file, const Place& place, const Positions& positions,
           const Positions& normals, std::span<const Displacements> moves, const std::string& what,
           const ColourRows& colours = {}) const;

  /// Prims' names of the materials; of those of no face: empty.
  const std::vector<std::string>& materials() const { return materials_; }
  /// The names of the targets, quoted.
  const std::vector<std::string>& tokens() const { return tokens_; }

  std::size_t memory_bytes() const;
  /// What one `add` takes.
  std::size_t encode_bytes() const;

 private:
  void add_shapes(EncodedFile& file, const Place& place, std::span<const Displacements> moves,
                  const std::string& what) const;
  void add_subsets(EncodedFile& file, const Place& place) const;

  Index vertices_;
  Subdivision subdivision_;
  std::string faces_;  ///< what describes the mesh beside its vectors
  std::vector<std::string> materials_;
  std::vector<std::string> subsets_;  ///< their faces
  std::vector<std::string> shapes_;   ///< prims' names of the targets …
  std::vector<std::string> tokens_;
  std::vector<std::string> indices_;  ///< … and their vertices
  std::size_t target_rows_ = 0;       ///< of all targets, at most
};

}  // namespace crowdface
