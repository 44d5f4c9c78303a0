// SPDX-License-Identifier: Apache-2.0
#include "crowdface/run/attachment_writers.h"

#include <utility>

#include "crowdface/core/contains.h"
#include "crowdface/core/text.h"
#include "crowdface/run/attachment_parts.h"

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
  for (std::size_t level = 0; level <= inputs.levels.size(); ++level) {
    for (const std::string& name : face.attachments) {
      names.push_back({MeshFormat::kObj, {}, level, name});
      for (const Shape& shape : shapes_in_files(inputs.attachments.at(name), formats, inputs)) {
        names.push_back({MeshFormat::kObj, shape.name, level, name});
      }
    }
  }
  return names;
}

AttachmentWriters::AttachmentWriters(const Inputs& inputs, std::span<const MeshFormat> formats,
                                     const std::string& shared, std::span<const WornLevel> levels)
    : formats_(formats.begin(), formats.end()), inputs_(inputs), levels_(levels) {
  for (const Attachment& item : inputs.attachments.items) {
    forms_.emplace(
        &item, Form{ObjTemplate(item.file, item.file.topology),
                    library_line(item.materials.files,
                                 std::filesystem::path(shared) / attachment_folder(item.name))});
  }
  if (!attachments_have_files(formats_)) return;
  for (const WornLevel& level : levels) add_level_forms(level);
}

void AttachmentWriters::add_level_forms(const WornLevel& level) {
  LevelForms& forms = level_forms_.emplace_back();
  for (const Attachment& item : inputs_.attachments.items) {
    const DetailLevel* here = level.find(item);
    if (here == nullptr) continue;
    const FaceMaterials materials =
        face_materials(item.file.materials, item.file.topology.face_count());
    using Normals = PlainObjTemplate::Normals;
    const bool normals = !item.file.corner_normals.empty();
    LevelForm form{
        PlainObjTemplate(here->topology, here->uvs, material_ranges(materials, here->faces),
                         normals ? Normals::kVertex : Normals::kNone),
        {}};
    if (normals) form.fans.emplace(here->topology);
    forms.emplace(&item, std::move(form));
  }
}

/// At rest and in each shape that has a file.
template <class Add>
void AttachmentWriters::add_poses(const WornAttachment& worn, const Add& add) const {
  add({}, worn.positions);
  const std::span<const Shape> shapes = shapes_in_files(*worn.item, formats_, inputs_);
  for (std::size_t s = 0; s < shapes.size(); ++s) {
    Positions acting = worn.positions;
    worn.moves[s].add_to(acting);
    add(shapes[s].name, acting);
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
    add_poses(one, add);
  }
  for (std::size_t level = 1; level <= level_forms_.size(); ++level) {
    add_level(meshes, level, id, levels_[level - 1].of(worn));
  }
}

void AttachmentWriters::add_level(std::vector<EncodedMesh>& meshes, std::size_t level,
                                  const std::string& id,
                                  std::span<const WornAttachment> worn) const {
  for (const WornAttachment& one : worn) {
    const LevelForm& form = level_forms_[level - 1].at(one.item);
    const Topology& topology = levels_[level - 1].find(*one.item)->topology;
    const std::string& libraries = forms_.at(one.item).libraries;
    const auto add = [&](const std::string& shape, const Positions& positions) {
      MeshName name{MeshFormat::kObj, shape, level, one.item->name};
      const std::string what = concat(id, ", ", part_of(name));
      const std::string head = concat(libraries, libraries.empty() ? "" : "\n", "o ", id, '_',
                                      one.item->name, "_LOD", level, '\n');
      Positions normals;
      if (form.fans) normals = vertex_normals(*form.fans, topology, positions);
      meshes.push_back({std::move(name), form.obj.encode(head, positions, normals, what)});
    };
    add_poses(one, add);
  }
}

std::size_t AttachmentWriters::encode_bytes() const {
  if (!attachments_have_files(formats_)) return 0;
  const auto bytes = [&](const Attachment& item, const auto& form) {
    return form.obj.encode_bytes() * (1 + shapes_in_files(item, formats_, inputs_).size());
  };
  std::size_t sum = worn_at_most(forms_, bytes);
  for (const LevelForms& forms : level_forms_) sum += worn_at_most(forms, bytes);
  return sum;
}

}  // namespace crowdface
