// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "crowdface/attach/attachment_move.h"
#include "crowdface/core/hash.h"
#include "crowdface/heads/head_textures.h"
#include "crowdface/io/glb_skin.h"
#include "crowdface/io/material_files.h"
#include "crowdface/io/obj_file.h"
#include "crowdface/lod/detail_level.h"
#include "crowdface/mesh/adjacency.h"
#include "crowdface/mesh/colour_rows.h"
#include "crowdface/mesh/mirror_map.h"
#include "crowdface/parts/part_list.h"
#include "crowdface/region/region_weights.h"
#include "crowdface/shapes/point_carrier.h"
#include "crowdface/shapes/shape_set.h"
#include "crowdface/smooth/smoothing_operator.h"

namespace crowdface {

/// A mesh that may sit on heads, and the files that say what it is made of.
struct Attachment {
  std::string name, kind;
  AttachmentMove moves = AttachmentMove::kBend;
  ObjFile file;
  Digest text;  ///< of the file's bytes
  MaterialFiles materials;
};

/// All that may sit on the heads of a crowd.
struct AttachmentSet {
  Positions fitted_to;  ///< #V by 3, the mesh beside which all stand; of no rows: there are none
  std::vector<Attachment> items;
  Digest digest;  ///< of all files' contents and of that mesh

  bool empty() const { return items.empty(); }
  /// The one of that name, which must be there.
  const Attachment& at(const std::string& name) const { return items[index(name)]; }
  std::size_t index(const std::string& name) const;
};

/// A rig of the template: joints, what each vertex is bound to, and where the joints stand at rest.
struct Rig {
  GlbSkin skin;     ///< in the heads' axes
  PointSet points;  ///< of the joints, in their order, beside the template
  Digest digest;

  bool empty() const { return skin.joints.empty(); }
};

/// A level of detail, and how far it is from the whole mesh.
struct MeasuredLevel {
  DetailLevel level;
  LevelError heads;   ///< over all heads, mm
  LevelError shapes;  ///< over all shapes of the template, mm; 0 without
};

/// Everything a job reads, checked: heads, their topology, masks, and what follows from them.
struct Inputs {
  std::filesystem::path cache;  ///< where what is found of them is kept; empty: nowhere
  FaceSet faces;
  Positions mean;              ///< the mean head
  std::vector<ObjFile> files;  ///< #heads; topology and positions have moved to `faces`
  std::vector<Digest> texts;   ///< #heads, of the files' bytes
  /// #heads colours of vertices, none of heads that have none; empty if no head has any.
  std::vector<ColourRows> colours;
  Digest colours_digest;
  FaceMaterials materials;  ///< of the first head's faces
  Adjacency adjacency;
  Components components;
  PartList parts;   ///< `parts: none`: empty
  Components skin;  ///< the components with all skin joined into the largest
  std::shared_ptr<const MirrorMap> mirror;  ///< if the config has faces mirrored
  ShapeSet shapes;
  Digest shapes_digest;  ///< if there are any
  std::vector<MeasuredLevel> levels;
  PointSet points;
  Digest points_digest;  ///< if there are any
  Rig rig;
  AttachmentSet attachments;
  RegionWeights regions;
  std::vector<double> distance_mask;  ///< #V, from `distance.mask`; empty without
  double edge_length_mm = 0;          ///< rms edge length of the skin, averaged over the heads
  std::uint64_t max_level = 0;        ///< L_max
  std::vector<Digest> head_digests;   ///< #heads, of the positions used
  Digest topology_digest;
  Digest mask_digest;                 ///< of α
  HeadTextures textures;              ///< of colours, if pictures are to show them
  std::vector<HeadTextures> maps;     ///< of other kinds, if they are blended for faces
  std::vector<std::string> warnings;  ///< in a fixed order; also logged

  /// Adds one, and logs it.
  void warn(std::string text);
};

/// The numbers of a matrix as they lie in memory.
template <class Rows>
auto numbers_of(const Rows& rows) {
  return std::span(rows.data(), static_cast<std::size_t>(rows.size()));
}

}  // namespace crowdface
