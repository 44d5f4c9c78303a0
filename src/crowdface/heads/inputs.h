// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "crowdface/attach/attachment_move.h"
#include "crowdface/cast/face_plan.h"
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

struct HeadsOnBody;  // heads/heads_on_body.h

/// A mesh that faces may wear, such as hair or glasses, and the material files of this mesh.
struct Attachment {
  std::string name, kind;                        ///< kind: such as "hair" or "glasses"
  AttachmentMove moves = AttachmentMove::kBend;  ///< how the attachment follows the skin
  ObjFile file;                                  ///< content of the mesh file
  Digest text_digest;                            ///< hash of the file's bytes
  MaterialFiles materials;  ///< the material files and textures that the mesh uses
  Tint tint = Tint::kNone;  ///< the kind of hair whose colour the attachment takes, if any
};

/// An attachment, and the colour that a face gives to this attachment.
struct ColouredAttachment {
  const Attachment* item;
  std::optional<HairColour> colour = {};  ///< nothing if the face does not colour the attachment

  /// The colour as text, see colour_label; empty without a colour.
  std::string label() const { return colour ? colour_label(*colour) : std::string(); }
  /// The attachment's name; with a colour, "NAME+LABEL".
  std::string name() const;
  /// Factors on the linear RGB values of the attachment's textures.
  std::array<float, 3> tint() const {
    return colour ? tint_factors(*colour) : std::array<float, 3>{1, 1, 1};
  }
};

/// All attachments of a crowd.
struct AttachmentSet {
  /// vertex positions of the head for which the attachments were made, #V by 3; no rows without
  /// attachments
  Positions fitted_head_positions;
  std::vector<Attachment> items;
  Digest digest;  ///< hash of the contents of all files and of the fitted head

  bool empty() const { return items.empty(); }
  /// The attachment with this name, which must exist.
  const Attachment& at(const std::string& name) const { return items[index(name)]; }
  /// Index into `items` of the attachment with this name, which must exist.
  std::size_t index(const std::string& name) const;
  /// The attachments that a face wears, with their colours.
  std::vector<ColouredAttachment> attachments_of(const FacePlan& face) const;
  /// The attachment with this name, in the colour that suits the hair colour. Has no colour if the
  /// attachment has no tint or `hair` is empty.
  ColouredAttachment coloured(const std::string& name, const std::optional<HairColour>& hair) const;
  /// All attachments in all colours that these faces wear, without duplicates, sorted by name.
  std::vector<ColouredAttachment> attachments_of(std::span<const FacePlan> faces) const;
};

/// The template's rig: joints, skinning weights, and the joints' positions at rest.
struct Rig {
  GlbSkin skin;     ///< joints and skinning weights, in the axes of the heads
  PointSet points;  ///< position of each joint on the template
  Digest digest;

  bool empty() const { return skin.joints.empty(); }
};

/// A level of detail, and its error relative to the full mesh.
struct MeasuredLevel {
  DetailLevel level;
  LevelError heads_error;  ///< error of the level on all heads, in millimetres
  /// error on all shapes (expressions), in millimetres: on the template's shapes or, if the heads
  /// have shapes of their own, on the shapes of each head; 0 without shapes
  LevelError shapes_error;
};

/// All inputs of a job, checked: heads, their topology, masks, and data computed from these.
struct Inputs {
  std::filesystem::path cache;  ///< folder that caches the results; empty: no cache
  HeadSet head_set;             ///< the heads after alignment and placement on a body
  Positions mean_head;          ///< vertex-wise mean of the heads
  /// #heads: the files of the heads; their topology and positions have moved to `head_set`
  std::vector<ObjFile> head_files;
  std::vector<Digest> head_file_digests;  ///< #heads, hashes of the head files' bytes
  /// #heads, vertex colours; no rows for heads without colours. Empty if no head has vertex
  /// colours.
  std::vector<ColourRows> vertex_colours;
  Digest colours_digest;       ///< hash of `vertex_colours`, if there are any
  PolygonMaterials materials;  ///< material of each polygon of the first head
  Adjacency adjacency;         ///< edge-neighbours of each vertex of the heads
  Components components;       ///< connected components of the heads: skin, eyeballs, teeth, …
  PartList parts;              ///< eyeballs, teeth and other parts; empty for `parts: none`
  /// like `components`, but all components of skin are merged into the largest one
  Components skin_components;
  /// mirror points of the vertices; null unless the config asks for mirrored faces
  std::shared_ptr<const MirrorMap> mirror_map;
  /// the heads placed on a common body; null unless the config has `neck`
  std::shared_ptr<const HeadsOnBody> heads_on_body;
  ShapeSet shapes;       ///< expressions (blend shapes)
  Digest shapes_digest;  ///< hash of the shapes, if there are any
  /// the levels of detail, one for each entry of the config key `output.lods`
  std::vector<MeasuredLevel> detail_levels;
  PointSet points;            ///< named points that every face gets
  Digest points_digest;       ///< hash of `points`, if there are any
  Rig rig;                    ///< joints and skinning weights; empty: none
  AttachmentSet attachments;  ///< attachments that faces may wear
  RegionWeights regions;      ///< #V by #regions: weights α of the vertices in the regions
  /// weight of each vertex in the distance between two faces, from `distance.mask`; empty without a
  /// mask
  std::vector<double> distance_weights;
  double edge_length_mm = 0;         ///< rms edge length of the skin, averaged over the heads
  std::uint64_t max_level = 0;       ///< L_max: largest number of smoothing iterations
  std::vector<Digest> head_digests;  ///< #heads, hashes of the positions in `head_set`
  /// #heads, hashes of the positions that the heads had before they were placed on a body
  std::vector<Digest> head_digests_before_placement;
  Digest topology_digest;  ///< hash of the heads' topology
  Digest mask_digest;      ///< hash of the masks' weights α
  /// colour textures, if they are blended or rendered; otherwise empty
  HeadTextures textures;
  std::vector<HeadTextures> other_textures;  ///< blended textures of all kinds except colour
  std::vector<std::string> warnings;         ///< all logged warnings, in a fixed order

  /// Adds and logs a warning.
  void warn(std::string text);
};

/// Returns the numbers of a matrix, in the order in which they lie in memory.
template <class Rows>
auto numbers_of(const Rows& rows) {
  return std::span(rows.data(), static_cast<std::size_t>(rows.size()));
}

}  // namespace crowdface
