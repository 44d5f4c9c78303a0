// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "crowdface/io/encoded_file.h"
#include "crowdface/io/fixed_normals.h"
#include "crowdface/io/glb_skin.h"
#include "crowdface/io/part_look.h"
#include "crowdface/mesh/displacements.h"
#include "crowdface/mesh/normals.h"
#include "crowdface/mesh/topology.h"

namespace crowdface {

/// Material of an additional mesh in a GLB file.
struct GlbPartMaterial {
  enum class Alpha {
    kOpaque,
    kMask,   ///< visible or invisible, by the image's alpha
    kBlend,  ///< blended by alpha
  };
  std::string name;
  std::array<float, 4> colour = {1, 1, 1, 1};  ///< linear RGB and opacity
  /// Index of the base colour image among the part's images. The number of these images as index
  /// means the image of a PartLook.
  std::optional<std::size_t> image = {};
  Alpha alpha = Alpha::kOpaque;
};

/// An image embedded in the file.
struct GlbImage {
  std::string bytes;
  std::string type;  ///< "image/png" or "image/jpeg"
  std::string name = {};
};

/// An additional mesh with its own topology, materials and images in the GLB files of faces, as a
/// child of the face's node. Like `GlbTemplate`, the object is prepared once; per face it writes
/// only positions and normals.
class GlbPart {
 public:
  /// \param uvs  #T by 2, v upwards as in OBJ; may be empty.
  /// \param materials  at least one.
  /// \param face_materials  #F indices into `materials`.
  /// \param influences  #V, for the joints of the faces' rig; empty: the mesh is not skinned.
  /// \param targets  names of the morph targets.
  /// \param fixed  normals that do not follow from the mesh.
  GlbPart(std::string name, const Topology& topology, const TextureCoordinates& uvs,
          const std::vector<GlbPartMaterial>& materials,
          const std::vector<std::uint32_t>& face_materials, const std::vector<GlbImage>& images,
          const CompressedRows<Influence>& influences = {}, std::vector<std::string> targets = {},
          FixedNormals fixed = {});

  /// Adds node, mesh, materials and accessors to a scene.
  /// \param size  bytes in the buffer so far, a multiple of four.
  /// \param moves  #targets, indexed by vertices of this mesh.
  /// \return the buffer size afterwards, a multiple of four.
  std::size_t describe(nlohmann::ordered_json& scene, const Positions& positions,
                       std::span<const Displacements> moves, const PartLook& look,
                       std::size_t size) const;
  /// Appends the data that `describe` declares. The file references memory of this object.
  /// \throws InvalidInput if positions are not #V by 3 or not finite.
  void append(EncodedFile& file, const Positions& positions, std::span<const Displacements> moves,
              const PartLook& look) const;

  std::size_t memory_bytes() const { return shared_.size(); }
  /// Memory needed for one encode, in bytes: positions, normals with their double-precision
  /// intermediate values, and morph targets as if every vertex moved.
  std::size_t encode_bytes() const;

 private:
  struct Primitive {
    std::size_t material, indices;  ///< index of the material; number of indices
  };

  std::string name_;
  Topology topology_;
  NormalFans fans_;
  std::vector<std::uint32_t> source_vertices_;  ///< original vertex of each split vertex
  bool has_uvs_;
  std::vector<Primitive> primitives_;
  std::vector<GlbPartMaterial> materials_;
  std::vector<std::size_t> image_sizes_;
  std::vector<GlbImage> images_;        ///< without `bytes`
  std::vector<GlbSkinAttribute> skin_;  ///< without `bytes`; empty: not skinned
  std::vector<std::string> targets_;
  FixedNormals fixed_normals_;
  std::string shared_;  ///< texture coordinates, influences, triangles, images
};

/// A `GlbPart` with its positions in the file of one face.
struct PlacedGlbPart {
  const GlbPart* part;
  const Positions* positions;
  std::span<const Displacements> moves = {};
  PartLook look = {};
};

}  // namespace crowdface
