// SPDX-License-Identifier: Apache-2.0
#include "crowdface/run/face_encoders.h"

#include <algorithm>
#include <set>
#include <utility>

#include "crowdface/core/contains.h"
#include "crowdface/core/text.h"
#include "crowdface/heads/heads_on_body.h"
#include "crowdface/heads/named_parts.h"
#include "crowdface/io/npy.h"
#include "crowdface/io/single_precision.h"
#include "crowdface/io/usda_text.h"
#include "crowdface/mesh/all_columns.h"
#include "crowdface/mesh/triangles.h"

namespace crowdface {
namespace {

std::size_t normals_bytes(const Topology& topology) {
  return static_cast<std::size_t>(topology.vertex_count + topology.face_count()) * 3 *
         sizeof(double);
}

std::string in_shape(const std::string& what, const Inputs& inputs, ShapeNumber shape) {
  return shape ? concat(what, ", ", inputs.shapes.shapes[*shape].name) : what;
}

std::vector<Index> targets_of(std::span<const FacePlan> crowd) {
  std::set<Index> targets;
  for (const FacePlan& face : crowd) targets.insert(face.recipe.target);
  return {targets.begin(), targets.end()};
}

}  // namespace

std::span<const Shape> shapes_in_files(const Attachment& item, std::span<const MeshFormat> formats,
                                       const Inputs& inputs) {
  const bool faces_have = any_format(formats, [](const MeshFormatTraits& format) {
    return format.attachments == DataStorage::kOwnFiles && format.shapes == DataStorage::kOwnFiles;
  });
  if (item.moves != AttachmentMove::kBend || !faces_have) return {};
  return inputs.shapes.shapes;
}

FaceEncoders::FaceEncoders(const Config& config, const Inputs& inputs,
                           std::vector<MeshFormat> formats, std::span<const FacePlan> crowd,
                           const std::string& shared)
    : config_(config),
      inputs_(inputs),
      formats_(std::move(formats)),
      levels_(mesh_levels(inputs, crowd, config.neck.write_body)) {
  const std::vector<Index> targets = targets_of(crowd);
  const MeshSource source{config, inputs, levels_, targets, shared};
  bool need_normals = false;
  for (const MeshFormat format : formats_) {
    encoders_.emplace(format, make_mesh_encoders(format, source));
    for (const MeshLevel& level : levels_) {
      need_normals |= std::ranges::any_of(
          targets, [&](Index target) { return needs_normals(format, level.level_number, target); });
    }
  }
  if (any_format(formats_,
                 [](const auto& format) { return format.attachments == DataStorage::kOwnFiles; })) {
    for (const MeshLevel& level : levels_) {
      attachments_.emplace_back(inputs.attachments, level,
                                [&](const Attachment& item, const DetailLevel* here) {
                                  return obj_attachment(item, here, shared);
                                });
    }
  }
  if (blends_textures(inputs)) texture_encoder_.emplace(config, inputs, crowd, shared);
  if (need_normals) fans_.emplace(inputs.head_set.topology);
  const auto carrier_of = [&](const PointSet& points) {
    return PointCarrier(points, inputs.parts, skin_vertices(inputs),
                        triangles_of(inputs.head_set.topology));
  };
  if (!inputs.points.empty()) points_.emplace(carrier_of(inputs.points));
  if (!inputs.rig.empty() && encoders_.contains(MeshFormat::kGlb)) {
    joints_.emplace(carrier_of(inputs.rig.points));
  }
}

bool FaceEncoders::holds_shapes() const {
  return !inputs_.shapes.shapes.empty() && any_format(formats_, [](const auto& format) {
    return format.shapes != DataStorage::kNowhere;
  });
}

bool FaceEncoders::needs_normals(MeshFormat format, std::size_t level, Index target) const {
  switch (traits_of(format).normals) {
    case FileNormals::kNone:
      return false;
    case FileNormals::kReducedLevels:
      return level > 0;
    case FileNormals::kLikeTarget:
      return has_normals(inputs_, target);
    case FileNormals::kAlways:
      break;
  }
  return true;
}

PlacedAttachment FaceEncoders::placed_body(const FinishedFace& face) const {
  const Attachment& body = *inputs_.heads_on_body->body;
  PlacedAttachment placed{
      &body, std::nullopt, body.file.positions,
      std::vector<Displacements>(inputs_.shapes.shapes.size(), {{}, Positions(0, 3)})};
  if (config_.neck.body_texture.empty()) return placed;
  placed.face_id = face.face.id;
  placed.texture_png = face.textures->back().front();
  return placed;
}

void FaceEncoders::prepare(FinishedFace& face) const {
  face.encoders = this;
  const Index target = face.face.recipe.target;
  const bool need_normals = std::ranges::any_of(formats_, [&](MeshFormat format) {
    return needs_normals(format, levels_.size() - 1, target);
  });
  if (need_normals) face.normals = normals_of(face.positions);
  if (points_) face.points = points_->place_points(target, face.positions);
  if (joints_) face.joints = joints_->place_points(target, face.positions);
  if (holds_textures()) face.images = texture_encoder_->glb_images(*face.textures);
  face.image_names = face_picture_paths(config_, inputs_, face.face.id);
  for (std::size_t level = 0; level < levels_.size(); ++level) {
    face.meshes.push_back(mesh_at_level(level, face));
  }
}

Positions FaceEncoders::normals_of(const Positions& positions) const {
  Positions normals = vertex_normals(*fans_, inputs_.head_set.topology, positions);
  if (inputs_.heads_on_body) inputs_.heads_on_body->seam.set_normals(normals);
  return normals;
}

FaceMesh FaceEncoders::mesh_at_level(std::size_t level, FinishedFace& face) const {
  const std::string id = face.face.id + level_suffix(level, "_");
  FaceMesh mesh{.id = id,
                .display_name = id,
                .target = face.face.recipe.target,
                .positions = &face.positions,
                .normals = &face.normals,
                .moves = face.moves,
                .placed_attachments = face.placed_attachments,
                .colours = &face.colours,
                .joints = &face.joints,
                .images = face.images,
                .image_names = face.image_names};
  if (texture_encoder_) mesh.material_file = material_file_name(face.face.id);
  if (level == 0) {
    mesh.points = &face.points;
    return mesh;
  }
  const DetailLevel& detail = *levels_[level].face_level;
  FinishedFace::ReducedMesh& reduced = face.reduced_meshes.emplace_back();
  reduced.positions = detail.restrict_rows(face.positions);
  if (face.normals.rows() > 0) reduced.normals = detail.restrict_rows(face.normals);
  for (const Displacements& shape : face.moves)
    reduced.moves.push_back(detail.restrict_rows(shape));
  reduced.placed_attachments = levels_[level].reduced_attachments(face.placed_attachments);
  if (face.colours.rows() > 0) reduced.colours = face.colours(detail.vertices, kAllColumns);
  mesh.positions = &reduced.positions;
  mesh.normals = &reduced.normals;
  mesh.moves = reduced.moves;
  mesh.placed_attachments = reduced.placed_attachments;
  mesh.colours = &reduced.colours;
  return mesh;
}

EncodedFile FaceEncoders::mesh(const FinishedFace& face, MeshFormat format, std::size_t level,
                               ShapeNumber shape) const {
  const MeshEncoder& encoder = encoders_.at(format)[level];
  if (!shape) return encoder.encode(face.meshes[level]);
  FaceMesh acting = face.meshes[level];
  acting.display_name = in_shape(acting.id, inputs_, shape);
  Positions positions = face.positions, normals;
  face.moves[*shape].add_to(positions);
  if (needs_normals(format, level, acting.target)) {
    normals = normals_of(positions);
    if (level > 0) normals = levels_[level].face_level->restrict_rows(normals);
  }
  if (level > 0) positions = levels_[level].face_level->restrict_rows(positions);
  acting.positions = &positions;
  acting.normals = &normals;
  return encoder.encode(acting);
}

EncodedFile FaceEncoders::attachment(const FinishedFace& face, const std::string& name,
                                     std::size_t level, ShapeNumber shape) const {
  const std::span<const PlacedAttachment> placed = face.meshes[level].placed_attachments;
  const auto one =
      std::ranges::find(placed, name, [](const auto& item) { return item.item->name; });
  FaceMesh mesh{.id = concat(face.face.id, '_', name, level_suffix(level, "_")),
                .display_name = {},
                .positions = &one->positions,
                .colour_label = one->look().label()};
  mesh.display_name = in_shape(mesh.id, inputs_, shape);
  Positions acting;
  if (shape) {
    acting = one->positions;
    one->moves[*shape].add_to(acting);
    mesh.positions = &acting;
  }
  return attachments_[level].at(*one->item).encode(mesh);
}

EncodedFile FaceEncoders::points(const FinishedFace& face) const {
  const std::vector<std::string>& names = inputs_.points.names;
  require_finite(face.points, static_cast<Index>(names.size()), face.face.id);
  std::string text = concat("{\n  \"face\": \"", face.face.id, "\",\n  \"points\": {\n");
  for (std::size_t p = 0; p < names.size(); ++p) {
    std::string row = usda_rows(face.points.row(static_cast<Index>(p)));
    row.front() = '[';
    row.back() = ']';
    text += concat("    \"", names[p], "\": ", row, p + 1 < names.size() ? ",\n" : "\n");
  }
  return {text + "  }\n}\n"};
}

std::size_t FaceEncoders::memory_bytes() const {
  std::size_t bytes = fans_ ? fans_->memory_bytes() : 0;
  for (const auto& [format, encoders] : encoders_) {
    for (const MeshEncoder& encoder : encoders) bytes += encoder.memory_bytes;
  }
  for (const auto& attachments : attachments_) bytes += attachments.memory_bytes();
  return bytes;
}

std::size_t FaceEncoders::encoding_memory_bytes() const {
  const std::size_t shapes = inputs_.shapes.shapes.size();
  std::size_t bytes = (holds_shapes() ? 2 * displacement_bytes(inputs_.shapes) : 0) +
                      (fans_ ? normals_bytes(inputs_.head_set.topology) : 0);
  for (const auto& [format, encoders] : encoders_) {
    const bool has_own_files = traits_of(format).shapes == DataStorage::kOwnFiles;
    for (const MeshEncoder& encoder : encoders) {
      bytes += (has_own_files ? 1 + shapes : 1) * encoder.encoding_memory_bytes;
    }
  }
  for (const auto& attachments : attachments_) {
    bytes += attachments.encoding_memory_bytes([&](const Attachment& item) {
      return 1 + shapes_in_files(item, formats_, inputs_).size();
    });
  }
  for (const MeshLevel& level : levels_) {
    if (!level.is_whole_mesh()) bytes += level.face_level->vertices.size() * 2 * 3 * sizeof(double);
  }
  return bytes + (texture_encoder_ ? texture_encoder_->encoding_memory_bytes() : 0);
}

}  // namespace crowdface
