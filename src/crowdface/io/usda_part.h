// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "crowdface/io/given_normals.h"
#include "crowdface/io/part_look.h"
#include "crowdface/io/usda_material.h"
#include "crowdface/io/usda_mesh.h"
#include "crowdface/mesh/normals.h"

namespace crowdface {

/// An additional mesh, such as hair, in the USD layers of faces, with its own topology and
/// materials. The prim of the additional mesh is a sibling of the prim of the face's mesh and has
/// the same blend shapes. Like a `UsdaTemplate`, the object is built once for all faces.
class UsdaPart {
 public:
  /// Placeholder in the names of texture files. The `PartLook::name` of each face replaces it.
  static constexpr std::string_view kLookPlaceholder = "<LOOK>";

  /// A material of this part.
  struct Material {
    std::string name;
    UsdaSurface surface;
  };

  /// \param name  prim name, unique among parts.
  /// \param uvs  #T by 2; may be empty.
  /// \param materials  at least one.
  /// \param polygon_materials  for each polygon, the index of its material in `materials`.
  /// \param targets  names of the blend shapes of the face's mesh.
  /// \param fixed  normals that replace the computed normals of some vertices.
  UsdaPart(std::string name, const Topology& topology, const TextureCoordinates& uvs,
           const std::vector<Material>& materials, std::vector<std::uint32_t> polygon_materials,
           const std::vector<std::string>& targets, GivenNormals fixed = {});

  /// Adds the Mesh prim of the part below the root prim. The file references memory of this object.
  /// \param root  path of the face's root prim.
  /// \param moves  for each blend shape, its displacements.
  /// \param what  names the mesh in messages.
  /// \throws InvalidInput if positions are not #V by 3 or not finite.
  void add_mesh(EncodedFile& file, const std::string& root, const Positions& positions,
                std::span<const Displacements> moves, const std::string& what) const;
  /// Adds the part's materials below the root prim.
  /// \param look  its `name` replaces kLookPlaceholder in file names.
  void add_materials(EncodedFile& file, const std::string& root, const PartLook& look) const;

  std::size_t memory_bytes() const { return mesh_.memory_bytes() + fans_.memory_bytes(); }
  std::size_t encoding_memory_bytes() const { return mesh_.encoding_memory_bytes(); }

 private:
  std::string name_;  ///< name of the Mesh prim
  Topology topology_;
  NormalFans fans_;  ///< for each vertex, the polygons from which its normal is computed
  UsdaMesh mesh_;
  std::vector<UsdaSurface> surfaces_;  ///< the appearance of each material of the part
  GivenNormals given_normals_;         ///< normals that replace computed normals
};

/// A `UsdaPart` and its positions for the layer of one face.
struct PlacedUsdaPart {
  const UsdaPart* part;
  const Positions* positions;  ///< positions of the part's vertices on this face, #V by 3
  /// for each blend shape, the displacements of the part's vertices
  std::span<const Displacements> moves = {};
  PartLook look = {};
};

}  // namespace crowdface
