// SPDX-License-Identifier: Apache-2.0
#include "crowdface/run/write_face.h"

#include <string>
#include <string_view>
#include <vector>

#include "crowdface/core/file.h"
#include "crowdface/run/mesh_writers.h"
#include "crowdface/run/own_textures.h"

namespace crowdface {

void write_face(const Job& job, const TextureBlender* textures, const CastFace& face,
                MeshFormat format, const Positions& positions, const std::filesystem::path& file) {
  const MeshWriters writers(job.config, job.inputs, {format}, {&face, 1});
  if (textures == nullptr) {
    write_mesh(writers.encode(face, positions).front(), file);
    return;
  }
  const OwnTextures own(job.config, job.inputs, {&face, 1});
  std::vector<std::string> encoded = own.encode(textures->blend(face.recipe));
  const std::vector<std::string_view> of_mesh = own.of_mesh(encoded);
  write_mesh(writers.encode(face, positions, of_mesh).front(), file);
  for (const OwnFile& beside : own.files(face, std::span(&format, 1), std::move(encoded))) {
    const std::filesystem::path path = file.parent_path() / beside.name;
    make_directories(path.parent_path());
    write_file(path, beside.bytes);
  }
}

}  // namespace crowdface
