// SPDX-License-Identifier: Apache-2.0
#include "crowdface/pictures/crowd_renders.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "crowdface/core/file.h"
#include "crowdface/core/parallel.h"
#include "crowdface/core/text.h"
#include "crowdface/io/image.h"
#include "crowdface/pictures/surfaces.h"
#include "crowdface/render/contact_sheet.h"

namespace crowdface {
namespace {

/// Fraction of the heads' height that may lie below the lower edge of the image, because images of
/// faces need not show the shoulders.
constexpr double kCutBelow = 0.22;

/// Estimates the extreme points of the attachments on all heads, so that images can leave room for
/// these points. Each attachment was made for one head, the `fitted_to` head. The extreme vertices
/// of the attachment are mapped from this head's bounding box to the bounding box of every head.
std::vector<Eigen::Vector3d> extent_of(const AttachmentSet& attachments, const HeadSet& head_set) {
  std::vector<Eigen::Vector3d> farthest;
  for (const Attachment& item : attachments.items) {
    const Positions& points = item.file.positions;
    if (points.rows() == 0) continue;
    for (int i = 0; i < 27; ++i) {  // directions to the sides, edges and corners of a cube
      const Eigen::Vector3i towards(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
      Index best = 0;
      (points * towards.cast<double>()).maxCoeff(&best);
      farthest.emplace_back(points.row(best));
    }
  }
  if (farthest.empty()) return farthest;
  const auto box_of = [](const Positions& positions) {
    return std::pair<Eigen::Array3d, Eigen::Array3d>(positions.colwise().minCoeff().transpose(),
                                                     positions.colwise().maxCoeff().transpose());
  };
  const auto [low, high] = box_of(attachments.fitted_head_positions);
  std::vector<Eigen::Vector3d> reach;
  for (const Head& head : head_set.heads) {
    const auto [own_low, own_high] = box_of(head.positions);
    for (const Eigen::Vector3d& point : farthest) {
      reach.push_back(own_low +
                      (point.array() - low) * (own_high - own_low) / (high - low).max(1e-9));
    }
  }
  return reach;
}

/// Returns, for each vertex, the displacement of the blend shape that moves the vertex farthest
/// down. Images must leave room for an open jaw, which reaches below the neutral head.
Positions lowest_displacements(const ShapeSet& set, const Eigen::Vector3d& up) {
  Positions lowest = Positions::Zero(set.neutral.rows(), 3);
  for (const Shape& shape : set.shapes) {
    Positions moves = Positions::Zero(set.neutral.rows(), 3);
    shape.moves.add_to(moves);
    for (Index v = 0; v < moves.rows(); ++v) {
      if (moves.row(v).dot(up) < lowest.row(v).dot(up)) lowest.row(v) = moves.row(v);
    }
  }
  return lowest;
}

/// Converts vertex colours for rendering; nothing if there are no colours or if textures replace
/// them.
std::optional<VertexColours> shown_colours(const ColourRows& colours,
                                           const TextureSet* texture_set) {
  constexpr float kMaxByte = 255;
  if (colours.rows() == 0 || texture_set != nullptr) return std::nullopt;
  return VertexColours(colours.cast<float>() / kMaxByte);
}

std::vector<Camera> fit_to_heads(const Config& config, const Config::ContactSheet& sheet,
                                 const Inputs& inputs, const PicturedMesh& mesh) {
  std::vector<const Positions*> heads;
  for (const Head& head : inputs.head_set.heads) heads.push_back(&head.positions);
  std::vector<Positions> acting;
  if (sheet.face_count_on_shape_pages > 0 && !inputs.shapes.shapes.empty()) {
    const Positions moves = lowest_displacements(inputs.shapes, unit_vector(config.faces.up));
    for (const Head& head : inputs.head_set.heads) acting.emplace_back(head.positions + moves);
  }
  for (const Positions& head : acting) heads.push_back(&head);
  const HeadFrame frame{config.faces.up, config.faces.front};
  const bool cuts = std::ranges::any_of(inputs.head_set.heads, [&](const Head& head) {
    return has_shoulders(head.positions, frame, kCutBelow);
  });
  FramingOptions options{.bottom_cut_fraction = cuts ? kCutBelow : 0,
                         .extra_points = extent_of(inputs.attachments, inputs.head_set)};
  if (mesh.has_body()) {
    options.bottom_cut_fraction = -PicturedMesh::kShoulderHeight;
    options.extra_points.push_back(mesh.lowest_shown_point());
  }
  return fit_cameras(heads, frame, sheet.views, options);
}

}  // namespace

CrowdRenders::CrowdRenders(const Config& config, const Config::ContactSheet& sheet,
                           const Inputs& inputs, const FaceTextures* textures)
    : mesh_(config, inputs, textures),
      textures_(textures),
      cameras_(fit_to_heads(config, sheet, inputs, mesh_)),
      renderer_(mesh_.topology(), RenderOptions{.size_px = sheet.cell, .front = config.faces.front},
                mesh_.surfaces(),
                &PicturedFace(mesh_, inputs.head_set.heads.front().positions).positions()),
      inputs_(inputs),
      shows_textures_(sheet.texture != SheetTexture::kNo),
      max_texels_(max_rendered_texels(sheet)),
      attachment_surfaces_(max_texels_, shows_textures_) {}

FacePictures CrowdRenders::render_files(const std::string& id, Index target,
                                        const Positions& positions,
                                        std::span<const Displacements> moves,
                                        const FaceTextureSet* face_textures,
                                        const std::vector<PlacedAttachment>& placed,
                                        const ColourRows& colours,
                                        const BlendedPicture* body) const {
  std::optional<TextureSet> of_target;
  if (face_textures == nullptr) of_target = texture_set_of(target);
  const TextureSet* painted = face_textures != nullptr ? &face_textures->texture_set()
                              : of_target              ? &*of_target
                                                       : nullptr;
  const std::optional<VertexColours> shown = shown_colours(colours, painted);
  FacePictures pictures{render_png(positions, shown ? &*shown : nullptr, painted, placed, body),
                        std::nullopt};
  if (gallery_ != nullptr) {
    pictures.gallery_script = gallery_->face_script(id, positions, moves, painted,
                                                    shown ? &*shown : nullptr, placed, body);
  }
  return pictures;
}

std::string CrowdRenders::gallery_script_of_head(Index head,
                                                 std::span<const Displacements> moves) const {
  const auto& [name, positions] = inputs_.head_set.heads[static_cast<std::size_t>(head)];
  const std::optional<TextureSet> texture_set = texture_set_of(head);
  const auto colours = colours_of(head, texture_set ? &*texture_set : nullptr);
  const auto body = blend_body_texture(recipe_of_head(head));
  // A new face may have the same name as this head. The prefix "head" gives the head's script
  // another name than the face's script.
  return gallery_->face_script(concat("head ", name), positions, moves,
                               texture_set ? &*texture_set : nullptr, colours ? &*colours : nullptr,
                               {}, body ? &*body : nullptr);
}

std::optional<BlendedPicture> CrowdRenders::blend_body_texture(const Recipe& recipe) const {
  if (!mesh_.has_body() || textures_->body_painter() == nullptr) return std::nullopt;
  return textures_->paint_body(recipe);
}

std::optional<VertexColours> CrowdRenders::colours_of(Index head,
                                                      const TextureSet* texture_set) const {
  if (inputs_.vertex_colours.empty()) return std::nullopt;
  return shown_colours(inputs_.vertex_colours[static_cast<std::size_t>(head)], texture_set);
}

Rgb8Image CrowdRenders::render_front(const Positions& positions,
                                     const VertexColours* colours) const {
  const PicturedFace shown(mesh_, positions, nullptr, colours);
  return renderer_.render(shown.positions(), cameras_.front(), shown.colours());
}

std::optional<FaceTextureSet> CrowdRenders::face_texture_set(Index target) const {
  if (!shows_textures_ ||
      !(inputs_.textures.are_blended() || are_any_rendered(inputs_.other_textures)))
    return std::nullopt;
  return FaceTextureSet(inputs_.textures, inputs_.other_textures, target, max_texels_);
}

std::optional<FaceTextureSet> CrowdRenders::face_texture_set(const FaceTextures& textures,
                                                             const Recipe& recipe) const {
  std::optional<FaceTextureSet> texture_set = face_texture_set(recipe.target);
  if (!texture_set) return texture_set;
  parallel_for_each(textures.picture_count(),
                    [&](std::size_t p) { texture_set->add(p, textures.blend(recipe, p)); });
  return texture_set;
}

std::optional<TextureSet> CrowdRenders::texture_set_of(Index head) const {
  if (!shows_textures_) return std::nullopt;
  std::optional<TextureSet> texture_set = texture_set_of_head(inputs_.textures, head, max_texels_);
  if (!texture_set && are_any_rendered(inputs_.other_textures)) {
    texture_set.emplace().texture_of_polygon.assign(
        static_cast<std::size_t>(inputs_.head_set.topology.face_count()), TextureLayer::kNone);
  }
  if (texture_set)
    add_shading_maps_of_head(inputs_.other_textures, head, max_texels_, *texture_set);
  return texture_set;
}

std::string CrowdRenders::render_png(const Positions& positions, const VertexColours* colours,
                                     const TextureSet* texture_set,
                                     const std::vector<PlacedAttachment>& placed,
                                     const BlendedPicture* body) const {
  const PicturedFace shown(mesh_, positions, texture_set, colours, body, max_texels_);
  std::vector<Rgb8Image> views;
  const std::vector<AttachmentMesh> meshes = attachment_surfaces_.meshes(placed);
  for (const Camera& camera : cameras_) {
    views.push_back(
        renderer_.render(shown.positions(), camera, shown.colours(), shown.textures(), meshes));
  }
  const Rgb8Image image = joined_pictures(views);
  return encode_png(image.width, image.height, 3, image.pixels);
}

std::string CrowdRenders::render_png(const Positions& positions, const FaceTextures& textures,
                                     const Recipe& recipe) const {
  const std::optional<FaceTextureSet> face_textures = face_texture_set(textures, recipe);
  const auto body = blend_body_texture(recipe);
  const BlendedPicture* const shown_body = body ? &*body : nullptr;
  if (face_textures)
    return render_png(positions, nullptr, &face_textures->texture_set(), {}, shown_body);
  const auto colours = shown_colours(textures.vertex_colours(recipe), nullptr);
  return colours ? render_png(positions, &*colours, nullptr, {}, shown_body)
                 : render_png(positions, recipe.target);
}

std::string CrowdRenders::render_png(const Positions& positions, Index head) const {
  const std::optional<TextureSet> texture_set = texture_set_of(head);
  const auto colours = colours_of(head, texture_set ? &*texture_set : nullptr);
  const auto body = blend_body_texture(recipe_of_head(head));
  return render_png(positions, colours ? &*colours : nullptr, texture_set ? &*texture_set : nullptr,
                    {}, body ? &*body : nullptr);
}

Rgb8Image read_render(const std::filesystem::path& path) {
  Image image = read_image(path, {.is_crowdface_file = true});
  Rgb8Image result(image.width, image.height);
  if (auto* bytes = std::get_if<std::vector<std::uint8_t>>(&image.pixels);
      bytes != nullptr && image.channels == 3) {
    result.pixels = std::move(*bytes);
    return result;
  }
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      for (int c = 0; c < 3; ++c) {
        const float value = image.at(x, y, std::min(c, image.channels - 1));
        result.at(x, y)[c] = static_cast<std::uint8_t>(std::lround(value * 255.0F));
      }
    }
  }
  return result;
}

}  // namespace crowdface
