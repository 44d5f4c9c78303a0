// SPDX-License-Identifier: Apache-2.0
#include "crowdface/run/attachment_writers.h"

#include <utility>

#include "crowdface/core/contains.h"
#include "crowdface/core/text.h"
#include "crowdface/run/attachment_parts.h"
#include "crowdface/run/library_line.h"

namespace crowdface {

namespace {

/// The shapes that an attachment has files of: where the face has, and it bends.
std::span<const Shape> shapes_in_files(const Attachment& item, std::span<const MeshFormat> formats,
                                       const Inputs& inputs) {
  if (item.moves != AttachmentMove::kBend || !contains(formats, MeshFormat::kObj)) return {};
  return inputs.shapes.shapes;
}

}  // namespace

bool attachments_have_files(std::span<const MeshFormat> formats) {
  return contains(formats, MeshFormat::kObj) || contains(formats, MeshFormat::kPly);
}

std::vector<MeshName> mesh_names_of(const CastFace& face, const std::vector<MeshFormat>& formats,
                                    const Inputs& inputs) {
  std::vector<MeshName> names = mesh_names(formats, inputs);
  if (!attachments_have_files(formats)) return names;
  for (const std::string& name : face.attachments) {
    names.push_back({MeshFormat::kObj, {}, 0, name});
    for (const Shape& shape : shapes_in_files(inputs.attachments.at(name), formats, inputs)) {
      names.push_back({MeshFormat::kObj, shape.name, 0, name});
    }
  }
  return names;
}

AttachmentWriters::AttachmentWriters(const Inputs& inputs, std::span<const MeshFormat> formats,
                                     const std::string& shared)
    : formats_(formats.begin(), formats.end()), inputs_(inputs) {
  for (const Attachment& item : inputs.attachments.items) {
    forms_.emplace(
        &item, Form{ObjTemplate(item.file, item.file.topology),
                    library_line(item.materials.files,
                                 std::filesystem::path(shared) / attachment_folder(item.name))});
  }
}

void AttachmentWriters::add_to(std::vector<EncodedMesh>& meshes, const std::string& id,
                               std::span<const WornAttachment> worn) const {
  if (!attachments_have_files(formats_)) return;
  for (const WornAttachment& one : worn) {
    const Form& form = forms_.at(one.item);
    const auto add = [&](const std::string& shape, const Positions& positions) {
      MeshName name{MeshFormat::kObj, shape, 0, one.item->name};
      EncodedFile file = form.obj.encode(positions, concat(id, ", ", part_of(name)));
      if (!form.libraries.empty()) file.replace_line("mtllib", form.libraries);
      meshes.push_back({std::move(name), std::move(file)});
    };
    add({}, one.positions);
    const std::span<const Shape> shapes = shapes_in_files(*one.item, formats_, inputs_);
    for (std::size_t s = 0; s < shapes.size(); ++s) {
      Positions acting = one.positions;
      one.moves[s].add_to(acting);
      add(shapes[s].name, acting);
    }
  }
}

std::size_t AttachmentWriters::encode_bytes() const {
  if (!attachments_have_files(formats_)) return 0;
  return worn_at_most(forms_, [&](const Attachment& item, const Form& form) {
    return form.obj.encode_bytes() * (1 + shapes_in_files(item, formats_, inputs_).size());
  });
}

}  // namespace crowdface
