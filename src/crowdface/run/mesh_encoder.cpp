// SPDX-License-Identifier: Apache-2.0
#include "crowdface/run/mesh_encoder.h"

#include <array>

#include "crowdface/core/file.h"
#include "crowdface/heads/heads_on_body.h"
#include "crowdface/io/npy.h"
#include "crowdface/io/ply_template.h"
#include "crowdface/run/crowd_glb_options.h"

namespace crowdface {
namespace {

/// The files with the mesh topology, shared by all faces, for formats that store only positions.
std::optional<SharedFiles> topology_arrays(const Config&, const Inputs& inputs) {
  const TextureCoordinates& uvs = inputs.head_set.uvs;
  Hasher key;
  key.add(inputs.topology_digest)
      .add_array(std::span(inputs.head_set.topology.corner_uvs))
      .add_array(std::span(uvs.data(), static_cast<std::size_t>(uvs.size())));
  std::vector<std::string> shapes;
  for (const Shape& shape : inputs.shapes.shapes) shapes.push_back(shape.name);
  for (const std::string& shape : shapes) key.add(shape);
  return SharedFiles{"topology", key.digest(), false,
                     [&inputs, shapes](const std::filesystem::path& folder) {
                       return write_topology_arrays(inputs.head_set.topology, inputs.head_set.uvs,
                                                    shapes, folder / "topology");
                     }};
}

/// The image of the iris as a separate file, for mesh formats that cannot embed it.
std::optional<SharedFiles> iris_file(const Config& config, const Inputs& inputs) {
  const GlbOptions options = glb_options(config, inputs);
  if (!options.overlay) return std::nullopt;
  return SharedFiles{"iris", Hasher().add(options.overlay->png).digest(), true,
                     [png = options.overlay->png](const std::filesystem::path& folder) {
                       std::filesystem::path file = folder / GlbOverlay::kFile;
                       make_directories(file.parent_path());
                       write_file(file, png);
                       return std::vector{std::move(file)};
                     }};
}

/// A mesh format, with the functions that make its encoders, its size estimate and its shared
/// files.
struct MeshEncoding {
  MeshFormat format;
  MeshEncoders (*make)(const MeshSource& source);
  /// Approximate total size, in bytes, of a face's mesh file and of the face's shape files.
  std::uint64_t (*estimate)(const MeshSize& size);
  std::optional<SharedFiles> (*shared)(const Config& config, const Inputs& inputs) = nullptr;
};

constexpr std::uint64_t kVector = 3 * sizeof(float);

constexpr std::array<MeshEncoding, kMeshFormatCount> kEncodings = {{
    {MeshFormat::kObj, obj_encoders,
     [](const MeshSize& size) { return size.obj_bytes * (1 + size.shape_count); }},
    {MeshFormat::kPly, ply_encoders,
     [](const MeshSize& size) {
       return kVector * size.vertex_count + size.polygon_count +
              sizeof(std::uint32_t) * size.corner_count;
     }},
    {MeshFormat::kGlb, glb_encoders,  // 36 bytes per vertex, 12 bytes per triangle
     [](const MeshSize& size) {
       return 3 * kVector * size.vertex_count +
              kVector * (size.corner_count - 2 * size.polygon_count) +
              (kVector + sizeof(std::uint32_t)) * size.displacement_count;
     }},
    {MeshFormat::kPoints, npy_encoders,
     [](const MeshSize& size) {
       return kVector * size.vertex_count +
              (kVector + 2 * sizeof(std::uint32_t)) * size.displacement_count;
     },
     topology_arrays},
    {MeshFormat::kUsd, usd_encoders,  // about ten characters per number, six per index
     [](const MeshSize& size) {
       return 10 * (6 * size.vertex_count + 2 * size.uv_count) + 12 * size.corner_count +
              36 * size.displacement_count;
     },
     iris_file},
}};

constexpr bool are_encodings_complete() {
  for (std::size_t f = 0; f < kEncodings.size(); ++f) {
    const MeshEncoding& row = kEncodings[f];
    if (row.format != static_cast<MeshFormat>(f) || row.make == nullptr || row.estimate == nullptr)
      return false;
  }
  return true;
}
static_assert(are_encodings_complete(), "every MeshFormat has its row, in the enumeration's order");

}  // namespace

bool has_own_texture(const MeshSource& source, const Attachment& item) {
  return !source.config.neck.body_texture.empty() && source.inputs.heads_on_body->is_body(item);
}

MeshEncoders make_mesh_encoders(MeshFormat format, const MeshSource& source) {
  return kEncodings[static_cast<std::size_t>(format)].make(source);
}

std::optional<SharedFiles> shared_files(MeshFormat format, const Config& config,
                                        const Inputs& inputs) {
  const MeshEncoding& encoding = kEncodings[static_cast<std::size_t>(format)];
  return encoding.shared == nullptr ? std::nullopt : encoding.shared(config, inputs);
}

MeshEncoders ply_encoders(const MeshSource& source) {
  MeshEncoders encoders;
  for (const MeshLevel& level : source.levels) {
    encoders.push_back(make_encoder(
        std::make_shared<const PlyTemplate>(level.topology(source.inputs)),
        [&inputs = source.inputs](const PlyTemplate& ply, const FaceMesh& face) {
          const bool with_normals = has_normals(inputs, face.target);
          return ply.encode(*face.positions, with_normals ? *face.normals : kNoPositions,
                            face.display_name, *face.colours);
        }));
  }
  return encoders;
}

MeshEncoders npy_encoders(const MeshSource& source) {
  return {{[](const FaceMesh& face) { return encode_npy(*face.positions, face.display_name); }, 0,
           npy_encode_bytes(source.inputs.head_set.topology.vertex_count)}};
}

std::uint64_t estimate_mesh_bytes(const Inputs& inputs, std::span<const MeshFormat> formats) {
  const Topology& topology = inputs.head_set.topology;
  MeshSize size{.vertex_count = static_cast<std::uint64_t>(topology.vertex_count),
                .polygon_count = static_cast<std::uint64_t>(topology.face_count()),
                .corner_count = static_cast<std::uint64_t>(topology.corner_count()),
                .uv_count = static_cast<std::uint64_t>(inputs.head_set.uvs.rows()),
                .shape_count = inputs.shapes.shapes.size()};
  double levels = 1;
  for (const MeasuredLevel& level : inputs.detail_levels) levels += level.level.share;
  for (const Shape& shape : inputs.shapes.shapes)
    size.displacement_count += shape.moves.vertices.size();
  for (const ObjFile& file : inputs.head_files) size.obj_bytes += file.file.bytes().size();
  size.obj_bytes /= inputs.head_files.size();
  std::uint64_t bytes = 0;
  for (const MeshFormat format : formats) {
    bytes += kEncodings[static_cast<std::size_t>(format)].estimate(size);
  }
  return static_cast<std::uint64_t>(levels * static_cast<double>(bytes));
}

}  // namespace crowdface
