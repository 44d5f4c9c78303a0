// SPDX-License-Identifier: Apache-2.0
#include "crowdface/run/write_face.h"

#include <string>
#include <string_view>
#include <vector>

#include "crowdface/core/file.h"
#include "crowdface/core/parallel.h"
#include "crowdface/heads/face_attachments.h"
#include "crowdface/heads/face_shapes.h"
#include "crowdface/io/single_precision.h"
#include "crowdface/run/attachment_writers.h"
#include "crowdface/run/glb_form.h"
#include "crowdface/run/mesh_writers.h"
#include "crowdface/run/own_textures.h"

namespace crowdface {

namespace {

namespace fs = std::filesystem;

/// What a face wears, beside its mesh, and the materials of that.
void write_attachments(const Job& job, const CastFace& face, MeshFormat format,
                       std::span<const WornAttachment> worn, const fs::path& file) {
  const std::span<const MeshFormat> formats(&format, 1);
  if (worn.empty() || !(attachments_have_files(formats) || format == MeshFormat::kUsd)) return;
  std::vector<EncodedMesh> meshes;
  const AttachmentWriters writers(job.inputs, formats);
  writers.add_to(meshes, face.id, worn);
  for (const EncodedMesh& mesh : meshes) {
    if (!mesh.name.shape.empty()) continue;
    mesh.file.write(file.parent_path() / (file.stem().string() + file_end(mesh.name)));
  }
  for (const std::string& name : face.attachments) {
    for (const MaterialFile& material : job.inputs.attachments.at(name).materials.files) {
      const fs::path to = file.parent_path() / attachment_folder(name) / material.relative;
      make_directories(to.parent_path());
      write_file(to, MappedFile(material.from).bytes());
    }
  }
}

/// The eyes' iris, which a USD layer names beside itself.
void write_iris(const Job& job, MeshFormat format, const fs::path& folder) {
  if (format != MeshFormat::kUsd) return;
  const GlbOptions options = glb_options(job.config, job.inputs);
  if (!options.overlay) return;
  const fs::path file = folder / GlbOverlay::kFile;
  make_directories(file.parent_path());
  write_file(file, options.overlay->png);
}

}  // namespace

void write_face(const Job& job, const FaceTextures& textures, const CastFace& face,
                MeshFormat format, const Positions& positions, const std::filesystem::path& file) {
  const MeshWriters writers(job.config, job.inputs, {format}, {&face, 1});
  std::vector<Displacements> moves;
  if (writers.holds_shapes()) {
    moves = FaceShapes(job.config, job.inputs).of_face(face.recipe, as_written(positions));
  }
  std::vector<WornAttachment> worn;
  if (!face.attachments.empty()) {
    worn = FaceAttachments(job.config, job.inputs, {&face, 1}).worn_by(face, positions, moves);
  }
  write_attachments(job, face, format, worn, file);
  write_iris(job, format, file.parent_path());
  if (!textures.any()) {
    writers.encode(face, positions, moves, {}, worn).front().file.write(file);
    return;
  }
  const OwnTextures own(job.config, job.inputs, {&face, 1});
  const auto encoded = std::make_shared<OwnTextures::Encoded>(textures.picture_count());
  parallel_for_each(encoded->size(), [&](std::size_t p) {
    (*encoded)[p] = own.encode(p, textures.blend(face.recipe, p));
  });
  const std::vector<std::string_view> of_mesh = own.of_mesh(*encoded);
  writers.encode(face, positions, moves, of_mesh, worn).front().file.write(file);
  for (const OwnFile& beside : own.files(face, std::span(&format, 1), encoded)) {
    const std::filesystem::path path = file.parent_path() / beside.name;
    make_directories(path.parent_path());
    beside.file.write(path);
  }
}

}  // namespace crowdface
