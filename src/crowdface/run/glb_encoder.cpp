// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/log.h"
#include "crowdface/core/text.h"
#include "crowdface/heads/heads_on_body.h"
#include "crowdface/heads/named_parts.h"
#include "crowdface/io/glb_part.h"
#include "crowdface/io/glb_template.h"
#include "crowdface/io/image.h"
#include "crowdface/io/material_files.h"
#include "crowdface/mesh/vector3.h"
#include "crowdface/parts/point_grid.h"
#include "crowdface/run/attachments_in_format.h"
#include "crowdface/run/crowd_glb_options.h"
#include "crowdface/run/mesh_encoder.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;

std::uint8_t byte_at(const Image& image, int x, int y, int channel) {
  const float value = std::clamp(image.at(x, y, channel), 0.0F, 1.0F);
  return static_cast<std::uint8_t>(std::lround(255.0F * value));
}

/// Reads the bytes of a PNG or JPEG file. Returns nothing for other files, because glTF does not
/// support their formats.
std::optional<GlbImage> supported_image(const fs::path& file) {
  std::string bytes = read_file(file);
  if (bytes.starts_with("\x89PNG")) return GlbImage{std::move(bytes), "image/png"};
  if (bytes.starts_with("\xff\xd8\xff")) return GlbImage{std::move(bytes), "image/jpeg"};
  return std::nullopt;
}

/// Returns an image whose RGB is `colour` and whose alpha is `opacity`. A null `colour` gives
/// white; a null `opacity` gives an opaque image. If `opacity` has another size than `colour`, uses
/// the nearest texel of `opacity`.
GlbImage rgba_image(const Image* colour, const Image* opacity) {
  const Image& size = colour != nullptr ? *colour : *opacity;
  std::vector<std::uint8_t> pixels;
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      for (int c = 0; c < 3; ++c) {
        pixels.push_back(colour == nullptr ? 255
                                           : byte_at(*colour, x, y, colour->channels < 3 ? 0 : c));
      }
      if (opacity == nullptr) {
        pixels.push_back(255);
        continue;
      }
      const int channel = opacity->alpha_channel >= 0 ? opacity->alpha_channel : 0;
      pixels.push_back(byte_at(*opacity, x * opacity->width / size.width,
                               y * opacity->height / size.height, channel));
    }
  }
  return {encode_png(size.width, size.height, 4, pixels), "image/png"};
}

GlbMaterial material_of(const SurfaceMaterial& made_of, std::vector<GlbImage>& images) {
  using Alpha = GlbMaterial::Alpha;
  GlbMaterial material;
  material.name = made_of.name;
  const bool has_colours = !made_of.colour_map.empty();
  if (made_of.colour && !has_colours) {
    for (std::size_t c = 0; c < 3; ++c) {
      material.colour[c] = (*made_of.colour)[c];
    }
  }
  material.colour[3] = made_of.opacity;
  material.alpha = made_of.opacity < 1 ? Alpha::kBlend : Alpha::kOpaque;
  if (!has_colours && made_of.opacity_map.empty()) return material;
  std::optional<Image> colour, holes;
  if (has_colours) colour = read_image(made_of.colour_map, {.allows_jpeg = true});
  const bool own_holes = made_of.opacity_map.empty() || made_of.opacity_map == made_of.colour_map;
  if (!own_holes) holes = read_image(made_of.opacity_map, {.allows_jpeg = true});
  const bool has_holes = holes || (colour && colour->alpha_channel >= 0);
  std::optional<GlbImage> image;
  if (!holes) image = supported_image(made_of.colour_map);
  if (!image) {
    const Image* alpha = holes ? &*holes : has_holes ? &*colour : nullptr;
    image = rgba_image(colour ? &*colour : nullptr, alpha);
  }
  if (has_holes) material.alpha = Alpha::kMask;
  image->name = (has_colours ? made_of.colour_map : made_of.opacity_map).stem().string();
  material.image = images.size();
  images.push_back(std::move(*image));
  return material;
}

/// Binds each vertex of an attachment to the joints of the nearest skin vertex; a rigid attachment
/// is bound as a whole, by its centroid.
CompressedRows<Influence> influences_of(const Attachment& item, const Inputs& inputs) {
  CompressedRows<Influence> influences;
  if (inputs.rig.empty()) return influences;
  const Positions& points = item.file.positions;
  const bool is_body = inputs.heads_on_body && inputs.heads_on_body->is_body(item);
  const PointGrid grid(is_body ? inputs.mean_head : inputs.attachments.fitted_head_positions,
                       skin_vertices(inputs));
  const auto nearest = [&](const Eigen::Vector3d& point) {
    return inputs.rig.skin.influences.items_of(grid.nearest(point).vertex);
  };
  const bool is_rigid = item.moves == AttachmentMove::kRigid;
  const Eigen::Vector3d middle = points.colwise().mean().transpose();
  for (Index p = 0; p < points.rows(); ++p) {
    influences.add_group(nearest(is_rigid ? middle : row3(points, p)));
  }
  return influences;
}

/// The materials and images of an attachment.
struct GlbLook {
  std::vector<GlbMaterial> materials;
  std::vector<std::uint32_t> of_face;
  std::vector<GlbImage> images;
};

/// Converts the materials and images of an attachment.
/// \param own_texture  whether each face has one texture of its own, which all materials of the
///                     attachment use
GlbLook look_of(const Attachment& item, bool own_texture) {
  PolygonMaterials named = polygon_materials(item.file.materials, item.file.topology.face_count());
  GlbLook look;
  look.of_face = std::move(named.material_of_polygon);
  if (own_texture) {
    for (const std::string& name : named.names) {
      GlbMaterial& material = look.materials.emplace_back();
      material.name = name;
      material.image = 0;
    }
    return look;
  }
  for (const SurfaceMaterial& material : surface_materials_of(named.names, item.materials)) {
    look.materials.emplace_back();
    look.materials.back().name = material.name;
    try {
      look.materials.back() = material_of(material, look.images);
    } catch (const InvalidInput& error) {
      log_warning(concat(error.what(), "; GLB files omit it"));
    }
  }
  return look;
}

GlbPart part_of(const Attachment& item, const GlbLook& look, const Inputs& inputs,
                const DetailLevel* level) {
  const CompressedRows<Influence> influences = influences_of(item, inputs);
  GivenNormals fixed = normals_at_neck_ring(inputs, item, level);
  std::vector<std::string> targets;
  for (const Shape& shape : inputs.shapes.shapes) targets.push_back(shape.name);
  if (level == nullptr) {
    return {item.name,   item.file.topology, item.file.uvs,      look.materials,  look.of_face,
            look.images, influences,         std::move(targets), std::move(fixed)};
  }
  return {item.name,
          level->topology,
          level->uvs,
          look.materials,
          select_rows(look.of_face, level->source_faces),
          look.images,
          select_rows(influences, level->vertices),
          std::move(targets),
          std::move(fixed)};
}

}  // namespace

MeshEncoders glb_encoders(const MeshSource& source) {
  const Inputs& inputs = source.inputs;
  std::map<const Attachment*, GlbLook> looks;
  for (const Attachment* item : source.levels.front().attachments_in_files(inputs.attachments)) {
    looks.emplace(item, look_of(*item, has_own_texture(source, *item)));
  }
  const auto make_part = [&](const Attachment& item, const DetailLevel* here) {
    return part_of(item, looks.at(&item), inputs, here);
  };
  using FormatData = MeshWithAttachments<GlbTemplate, GlbPart>;
  MeshEncoders encoders;
  for (const MeshLevel& level : source.levels) {
    encoders.push_back(make_encoder(
        std::make_shared<const FormatData>(
            FormatData{GlbTemplate(level.topology(inputs), level.uvs(inputs),
                                   glb_options(source.config, inputs, source.shared_folder, level)),
                       AttachmentsInFormat<GlbPart>(inputs.attachments, level, make_part)}),
        [](const FormatData& format_data, const FaceMesh& face) {
          return format_data.mesh.encode(
              *face.positions, *face.normals, face.id, face.moves, face.images, *face.points,
              format_data.parts.placed<PlacedGlbPart>(face.placed_attachments), *face.joints,
              *face.colours);
        }));
  }
  return encoders;
}

}  // namespace crowdface
