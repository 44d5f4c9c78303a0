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

/// The text before the points of a Mesh prim. In a layer, the face's prim comes first, so the first
/// occurrence of this text is followed by the points of the face.
inline constexpr std::string_view kUsdaPoints = "point3f[] points = [";

/// Writes a Mesh prim of one topology: polygons, texture coordinates as the primvar `st`, material
/// subsets, and UsdSkel blend shapes. Formats positions, normals, colours and displacements for
/// each file, and everything else once.
class UsdaMesh {
 public:
  /// What the Mesh prim contains in addition to the polygons. This content is the same in the files
  /// of all faces.
  struct Options {
    Subdivision subdivision = Subdivision::kNone;  ///< how viewers subdivide the mesh
    std::vector<std::string> materials = {};       ///< names of the materials; may be empty
    /// for each polygon, the index of its material in `materials`; empty: all polygons use the
    /// first material
    std::vector<std::uint32_t> polygon_materials = {};
    /// The blend shapes. If the vertices that a blend shape moves differ from face to face,
    /// `GlbMorphTarget::vertices` is empty.
    std::vector<GlbMorphTarget> targets = {};
    std::string extra_prim_lines = {};  ///< lines of USD text that are added to the Mesh prim
  };

  /// \param uvs  #T by 2; may be empty.
  UsdaMesh(const Topology& topology, const TextureCoordinates& uvs, const Options& options);

  /// Name of the Mesh prim in a layer, and paths of the prims that the Mesh prim refers to.
  struct PrimPaths {
    /// path of the face's prim, which is the parent of the Mesh prim and contains the skeleton
    std::string face_prim;
    std::string name;       ///< name of the Mesh prim, the last component of its path
    std::string materials;  ///< path of the prim that contains the materials
  };
  /// Adds the Mesh prim to `file`, which then references memory of this object.
  /// \param normals  #V by 3, unit; not written for meshes with subdivision.
  /// \param moves  for each blend shape, its displacements.
  /// \param what  names the mesh in messages.
  /// \param colours  one row per vertex, written as the primvar displayColor in linear light; or no
  ///                 rows.
  /// \throws InvalidInput if positions or normals are not #V by 3 or not finite.
  void add(EncodedFile& file, const PrimPaths& prim_paths, const Positions& positions,
           const Positions& normals, std::span<const Displacements> moves, const std::string& what,
           const ColourRows& colours = {}) const;

  /// Prim names of the materials; the name of a material that no polygon uses is empty.
  const std::vector<std::string>& materials() const { return materials_; }
  /// Names of the blend shapes, in quotes.
  const std::vector<std::string>& quoted_shape_names() const { return quoted_shape_names_; }

  /// Memory used by this object, in bytes.
  std::size_t memory_bytes() const;
  /// Memory needed for one call of `add`, in bytes.
  std::size_t encoding_memory_bytes() const;

 private:
  /// Adds the prims of the blend shapes.
  void add_shapes(EncodedFile& file, const PrimPaths& prim_paths,
                  std::span<const Displacements> moves, const std::string& what) const;
  /// Binds the materials: one material to the whole mesh, or each material to its polygons.
  void add_subsets(EncodedFile& file, const PrimPaths& prim_paths) const;

  Index vertex_count_;
  Subdivision subdivision_;
  /// the text of polygons, texture coordinates and options, which is the same in all files
  std::string shared_text_;
  /// prim names of the materials; empty for a material that no polygon uses
  std::vector<std::string> materials_;
  std::vector<std::string> subsets_;  ///< for each material, the USD text that lists its polygons
  std::vector<std::string> shapes_;   ///< prim names of the blend shapes
  std::vector<std::string> quoted_shape_names_;  ///< names of the blend shapes, in quotes
  /// for each blend shape, the text of its vertex list; "" if the list differs from face to face
  std::vector<std::string> indices_;
  /// upper bound of the number of displacements in all blend shapes together
  std::size_t max_displacement_count_ = 0;
};

}  // namespace crowdface
