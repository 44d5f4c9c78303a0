// SPDX-License-Identifier: Apache-2.0
#include "crowdface/run/attachment_writers.h"

#include <algorithm>
#include <utility>

#include "crowdface/core/text.h"
#include "crowdface/run/library_line.h"

namespace crowdface {

bool attachments_have_files(std::span<const MeshFormat> formats) {
  return std::find(formats.begin(), formats.end(), MeshFormat::kObj) != formats.end();
}

std::vector<MeshName> mesh_names_of(const CastFace& face, const std::vector<MeshFormat>& formats,
                                    const Inputs& inputs) {
  std::vector<MeshName> names = mesh_names(formats, inputs);
  if (!attachments_have_files(formats)) return names;
  for (const std::string& name : face.attachments) {
    names.push_back({MeshFormat::kObj, {}, 0, name});
    if (inputs.attachments.at(name).moves != AttachmentMove::kBend) continue;
    for (const Shape& shape : inputs.shapes.shapes) {
      names.push_back({MeshFormat::kObj, shape.name, 0, name});
    }
  }
  return names;
}

std::filesystem::path attachment_folder(const std::string& name) {
  return std::filesystem::path("attachments") / name;
}

AttachmentWriters::AttachmentWriters(const Inputs& inputs, const std::string& shared)
    : shapes_(inputs.shapes.shapes) {
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
    const auto add = [&](const std::string& shape, const Positions& positions) {
      MeshName name{MeshFormat::kObj, shape, 0, one.item->name};
      EncodedFile file = form.obj.encode(positions, concat(id, ", ", part_of(name)));
      if (!form.libraries.empty()) file.replace_line("mtllib", form.libraries);
      meshes.push_back({std::move(name), std::move(file)});
    };
    add({}, one.positions);
    if (one.item->moves != AttachmentMove::kBend) continue;
    for (std::size_t s = 0; s < one.moves.size(); ++s) {
      Positions acting = one.positions;
      one.moves[s].add_to(acting);
      add(shapes_[s].name, acting);
    }
  }
}

/// One of each kind is no more than all that there are.
std::size_t AttachmentWriters::encode_bytes() const {
  std::map<std::string, std::size_t> largest;
  for (const auto& [item, form] : forms_) {
    const bool bends = item->moves == AttachmentMove::kBend;
    std::size_t& most = largest[item->kind];
    most = std::max(most, form.obj.encode_bytes() * (bends ? 1 + shapes_.size() : 1));
  }
  std::size_t bytes = 0;
  for (const auto& [kind, most] : largest) bytes += most;
  return bytes;
}

}  // namespace crowdface
