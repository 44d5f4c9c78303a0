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
#include "crowdface/io/glb_skin.h"
#include "crowdface/mesh/displacements.h"
#include "crowdface/mesh/normals.h"
#include "crowdface/mesh/topology.h"

namespace crowdface {

/// What a further mesh of a GLB file is made of.
struct GlbPartMaterial {
  enum class Alpha {
    kOpaque,
    kMask,   ///< there or not, by the image's alpha
    kBlend,  ///< seen through
  };
  std::string name;
  std::array<float, 4> colour = {1, 1, 1, 1};  ///< linear red green blue, opacity
  std::optional<std::size_t> image = {};       ///< its colours: one of the part's images
  Alpha alpha = Alpha::kOpaque;
};

/// A picture in a file's own bytes.
struct GlbImage {
  std::string bytes;
  std::string type;  ///< "image/png" or "image/jpeg"
};

/// A mesh of another topology that stands in the GLB files of faces, below the face's node, with materials
/// and pictures of its own. Like GlbTemplate it is prepared once; of each face only positions and
/// normals are written.
class GlbPart {
 public:
  /// \param uvs             #T by 2, v upwards as in OBJ; may be empty.
  /// \param materials       at least one.
  /// \param face_materials  #F rows of `materials`.
  /// \param influences      #V, of the joints of the faces' rig; of no groups: it has none.
  /// \param targets         names of its morph targets.
  GlbPart(std::string name, const Topology& topology, const TextureCoordinates& uvs,
          const std::vector<GlbPartMaterial>& materials,
          const std::vector<std::uint32_t>& face_materials, const std::vector<GlbImage>& images,
          const Grouped<Influence>& influences = {}, std::vector<std::string> targets = {});

  /// Adds node, mesh, materials and arrays to a scene.
  /// \param size  of the buffer so far, a multiple of four. \return its size afterwards, likewise.
  /// \param moves  #targets, in vertices of its own.
  std::size_t describe(nlohmann::ordered_json& scene, const Positions& positions,
                       std::span<const Displacements> moves, std::size_t size) const;
  /// Adds the bytes that describe() speaks of; the file refers to this object.
  /// \throws InvalidInput if positions are not #V by 3 or not finite.
  void append(EncodedFile& file, const Positions& positions,
              std::span<const Displacements> moves) const;

  std::size_t memory_bytes() const { return shared_.size(); }
  /// What one encode takes: vectors, normals as they are found, and of each target as much as if all vertices moved.
  std::size_t encode_bytes() const;

 private:
  struct Primitive {
    std::size_t material, indices;  ///< which material, and how many
  };

  std::string name_;
  Topology topology_;
  NormalFans fans_;
  std::vector<std::uint32_t> split_;  ///< the original vertex of each of the file
  bool has_uvs_;
  std::vector<Primitive> primitives_;
  std::vector<GlbPartMaterial> materials_;
  std::vector<std::size_t> image_sizes_;
  std::vector<std::string> image_types_;
  std::vector<GlbSkinAttribute> skin_;  ///< without their bytes; empty: not bound to joints
  std::vector<std::string> targets_;
  std::string shared_;  ///< texture coordinates, influences, triangles, images
};

/// One in the file of a face.
struct PlacedGlbPart {
  const GlbPart* part;
  const Positions* positions;
  std::span<const Displacements> moves = {};
};

}  // namespace crowdface
