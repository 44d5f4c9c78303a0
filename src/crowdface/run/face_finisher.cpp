// SPDX-License-Identifier: Apache-2.0
#include "crowdface/run/face_finisher.h"

#include "crowdface/core/parallel.h"
#include "crowdface/io/single_precision.h"

namespace crowdface {

/// Blends the textures in parallel; each is encoded and discarded before its thread blends the
/// next.
/// \return the textures for renders.
std::optional<OwnCoat> FaceFinisher::paint(const Recipe& recipe, OwnTextures::Encoded& files,
                                           StageBusy& busy) const {
  std::optional<OwnCoat> coat;
  if (renders != nullptr) coat = renders->own_coat(recipe.target);
  const bool written = encoders != nullptr && encoders->holds_textures();
  if (!written && !coat) return coat;
  files.resize(textures.picture_count());
  parallel_for_each(textures.picture_count(), [&](std::size_t p) {
    const BlendedPicture picture = [&] {
      const Busy timer(busy.blend);
      return textures.blend(recipe, p);
    }();
    if (written) {
      const Busy timer(busy.encode);
      files[p] = encoders->textures().encode(p, picture);
    }
    if (coat) {
      const Busy timer(busy.render);
      coat->add(p, picture);
    }
  });
  return coat;
}

void FaceFinisher::finish(FinishedFace& face, StageBusy& busy) const {
  const Recipe& recipe = face.face.recipe;
  const std::optional<OwnCoat> coat = paint(recipe, *face.textures, busy);
  face.colours = textures.vertex_colours(recipe);
  const bool with_shapes = (encoders != nullptr && encoders->holds_shapes()) ||
                           (renders != nullptr && renders->show_shapes());
  // Round the positions as mesh files do, so that `sheet`, which reads these files, gets the same
  // shapes, attachments and renders.
  Positions single;
  if (with_shapes || renders != nullptr || !face.face.attachments.empty()) {
    single = as_written(face.positions);
  }
  if (with_shapes) {
    const Busy timer(busy.encode);
    face.moves = shapes.of_face(recipe, single, &face.crossing);
  }
  {
    const Busy timer(busy.blend);
    face.worn = attachments.worn_by(face.face, single, face.moves);
  }
  if (renders != nullptr) {
    const Busy timer(busy.render);
    face.pictures = renders->draw(face.face.id, recipe.target, single, face.moves,
                                  coat ? &*coat : nullptr, face.worn, face.colours);
  }
  if (encoders != nullptr) {
    const Busy timer(busy.encode);
    encoders->prepare(face);
  }
}

}  // namespace crowdface
