// SPDX-License-Identifier: Apache-2.0
#include "crowdface/run/face_finisher.h"

#include "crowdface/core/parallel.h"
#include "crowdface/io/image.h"
#include "crowdface/io/single_precision.h"

namespace crowdface {

// Textures are blended in parallel. To save memory, each thread encodes a texture and discards it
// before the thread blends the next texture.
std::optional<FaceTextureSet> FaceFinisher::paint(const Recipe& recipe,
                                                  FaceTextureEncoder::Encoded& files,
                                                  StageTimes& busy) const {
  std::optional<FaceTextureSet> texture_set;
  if (renders != nullptr) texture_set = renders->face_texture_set(recipe.target);
  const bool written = encoders != nullptr && encoders->holds_textures();
  if (!written && !texture_set) return texture_set;
  files.resize(textures.picture_count());
  parallel_for_each(textures.picture_count(), [&](std::size_t p) {
    const BlendedPicture picture = [&] {
      const StageTimer timer(busy.blend_seconds);
      return textures.blend(recipe, p);
    }();
    if (written) {
      const StageTimer timer(busy.encode_seconds);
      files[p] = encoders->textures().encode(p, picture);
    }
    if (texture_set) {
      const StageTimer timer(busy.render_seconds);
      texture_set->add(p, picture);
    }
  });
  return texture_set;
}

void FaceFinisher::paint_body(FinishedFace& face, StageTimes& busy) const {
  {
    const StageTimer timer(busy.blend_seconds);
    face.body_texture = textures.paint_body(face.face.recipe);
  }
  if (encoders == nullptr) return;
  const StageTimer timer(busy.encode_seconds);
  face.textures->push_back({encode_png(face.body_texture->width, face.body_texture->height, 3,
                                       face.body_texture->srgb)});
}

void FaceFinisher::finish(FinishedFace& face, StageTimes& busy) const {
  const Recipe& recipe = face.face.recipe;
  const std::optional<FaceTextureSet> texture_set = paint(recipe, *face.textures, busy);
  if (textures.body_painter() != nullptr) paint_body(face, busy);
  face.colours = textures.vertex_colours(recipe);
  const bool with_shapes = (encoders != nullptr && encoders->holds_shapes()) ||
                           (renders != nullptr && renders->needs_shapes());
  // Round the positions to the precision of mesh files. The command `sheet` reads mesh files, and
  // must get the same shapes, attachments and renders.
  Positions single;
  if (with_shapes || renders != nullptr || !face.face.attachments.empty()) {
    single = round_to_single(face.positions);
  }
  if (with_shapes) {
    const StageTimer timer(busy.encode_seconds);
    face.moves = shapes.shapes_of_face(recipe, single, &face.skin_intersections);
  }
  {
    const StageTimer timer(busy.blend_seconds);
    face.placed_attachments = attachments.attachments_of(face.face, single, face.moves);
  }
  if (renders != nullptr) {
    const StageTimer timer(busy.render_seconds);
    face.pictures = renders->render_files(
        face.face.id, recipe.target, single, face.moves, texture_set ? &*texture_set : nullptr,
        face.placed_attachments, face.colours, face.body_texture ? &*face.body_texture : nullptr);
  }
  if (encoders != nullptr) {
    const StageTimer timer(busy.encode_seconds);
    if (encoders->holds_body()) face.placed_attachments.push_back(encoders->placed_body(face));
    encoders->prepare(face);
  }
}

}  // namespace crowdface
