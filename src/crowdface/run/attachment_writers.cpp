// SPDX-License-Identifier: Apache-2.0
#include "crowdface/run/attachment_writers.h"

#include <algorithm>
#include <utility>

#include "crowdface/core/text.h"
#include "crowdface/run/library_line.h"

namespace crowdface {

bool attachments_have_files(std::span<const MeshFormat> formats) {
  return std::ranges::any_of(formats, [](MeshFormat format) {
    return format == MeshFormat::kObj || format == MeshFormat::kPly;
  });
}

std::vector<MeshName> mesh_names_of(const CastFace& face, const std::vector<MeshFormat>& formats,
                                    const Inputs& inputs) {
  std::vector<MeshName> names = mesh_names(formats, inputs);
  for (const std::string& name : face.attachments) {
    if (attachments_have_files(formats)) names.push_back({MeshFormat::kObj, name, 0, true});
  }
  return names;
}

std::filesystem::path attachment_folder(const std::string& name) {
  return std::filesystem::path("attachments") / name;
}

AttachmentWriters::AttachmentWriters(const Inputs& inputs, const std::string& shared) {
  for (const Attachment& item : inputs.attachments.items) {
    forms_.emplace(
        &item, Form{ObjTemplate(item.file, item.file.topology),
                    library_line(item.materials.files,
                                 std::filesystem::path(shared) / attachment_folder(item.name))});
  }
}

void AttachmentWriters::add_to(std::vector<EncodedMesh>& meshes, const std::string& id,
                               std::span<const WornAttachment> worn) const {
  for (const WornAttachment& one : worn) {
    const Form& form = forms_.at(one.item);
    EncodedFile file = form.obj.encode(one.positions, concat(id, ", ", one.item->name));
    if (!form.libraries.empty()) file.replace_line("mtllib", form.libraries);
    meshes.push_back({{MeshFormat::kObj, one.item->name, 0, true}, std::move(file)});
  }
}

}  // namespace crowdface
