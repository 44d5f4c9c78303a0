// SPDX-License-Identifier: Apache-2.0
#include "crowdface/run/write_face.h"

#include <string>
#include <vector>

#include "crowdface/core/file.h"
#include "crowdface/heads/coloured_textures.h"
#include "crowdface/heads/face_attachments.h"
#include "crowdface/heads/face_shapes.h"
#include "crowdface/run/face_encoders.h"
#include "crowdface/run/face_files.h"
#include "crowdface/run/face_finisher.h"

namespace crowdface {

namespace {

namespace fs = std::filesystem;

/// Copies the material files that the face's attachments refer to.
void write_attachment_materials(const Job& job, const FacePlan& face, const fs::path& folder) {
  for (const ColouredAttachment& coloured : job.inputs.attachments.attachments_of(face)) {
    for (const AttachmentFile& file : files_of(coloured)) {
      const fs::path to =
          folder / attachment_folder(coloured.item->name, coloured.label()) / file.file.destination;
      make_directories(to.parent_path());
      if (file.is_coloured) {
        write_file(to, coloured_texture(file.file.source, *coloured.colour));
      } else {
        write_file(to, MappedFile(file.file.source).bytes());
      }
    }
  }
}

}  // namespace

void write_face(const Job& job, const FaceTextures& textures, const FacePlan& face,
                MeshFormat format, const Positions& positions, const std::filesystem::path& file) {
  const std::vector<MeshFormat> formats(1, format);
  const FaceEncoders encoders(job.config, job.inputs, std::vector<MeshFormat>(1, format),
                              {&face, 1});
  const FaceAttachments attachments(job.config, job.inputs, {&face, 1});
  const FaceShapes shapes(job.config, job.inputs);
  FinishedFace finished(face, positions);
  StageTimes busy;
  FaceFinisher{textures, attachments, shapes, &encoders}.finish(finished, busy);
  const fs::path folder = file.parent_path();
  if (refers_to_attachment_textures(traits_of(format)))
    write_attachment_materials(job, face, folder);
  const auto shared = shared_files(format, job.config, job.inputs);
  if (shared && shared->is_referenced_by_meshes) shared->write(folder);
  const std::vector<FaceFile> files = mesh_files(job.config, job.inputs, face,
                                                 {.formats = formats,
                                                  .folder = folder,
                                                  .stem = file.stem().string(),
                                                  .includes_all_variants = false});
  for (const FaceFile& one : files) make_directories(one.path.parent_path());
  write_files_of(finished, files);
}

}  // namespace crowdface
