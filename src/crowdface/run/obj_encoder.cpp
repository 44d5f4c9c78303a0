// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <map>
#include <utility>

#include "crowdface/core/parallel.h"
#include "crowdface/core/text.h"
#include "crowdface/crowd/crowd_directory.h"
#include "crowdface/heads/heads_on_body.h"
#include "crowdface/io/material_files.h"
#include "crowdface/io/obj_colours.h"
#include "crowdface/io/obj_template.h"
#include "crowdface/io/plain_obj_template.h"
#include "crowdface/mesh/normals.h"
#include "crowdface/run/mesh_encoder.h"

namespace crowdface {

namespace {

/// The materials of the polygons of a level of detail, as ranges of consecutive polygons with equal
/// material.
std::vector<MaterialRange> material_ranges(const ObjFile& file, Index faces,
                                           const DetailLevel& level) {
  const PolygonMaterials materials = polygon_materials(file.materials, faces);
  std::vector<MaterialRange> ranges;
  for (std::size_t t = 0; t < level.source_faces.size(); ++t) {
    const std::string& name = materials.names[materials.material_of_polygon[level.source_faces[t]]];
    if (name.empty() || (!ranges.empty() && ranges.back().name == name)) continue;
    ranges.push_back({name, static_cast<Index>(t)});
  }
  return ranges;
}

bool is_same(const MaterialRange& a, const MaterialRange& b) {
  return a.name == b.name && a.first_face == b.first_face;
}

/// The `mtllib` line that names the material files; empty if there are none.
/// \param from  the folder to which the paths in the line are relative
std::string library_line(const std::vector<MaterialFile>& files,
                         const std::filesystem::path& from) {
  std::string line;
  for (const MaterialFile& file : files) {
    if (!file.is_material_file) continue;
    line += concat(line.empty() ? "mtllib " : " ", (from / file.destination).generic_string());
  }
  return line;
}

/// Returns two sizes in bytes: the memory of all converted meshes together, and the maximum memory
/// for encoding one mesh.
template <class Templates, class TemplateOf>
std::pair<std::size_t, std::size_t> sizes_of(const Templates& templates,
                                             const TemplateOf& template_of) {
  std::size_t memory = 0, encode = 0;
  for (const auto& each : templates) {
    memory += template_of(each).memory_bytes();
    encode = std::max(encode, template_of(each).encoding_memory_bytes());
  }
  return {memory, encode};
}

/// Returns new `mtllib` lines; the key is the index of the target head. The result has no line for
/// a target head whose own `mtllib` line already names the material files that this run writes.
std::map<Index, std::string> replacing_library_lines(const MeshSource& source) {
  std::map<Index, std::string> lines;
  for (const Index target : source.target_heads) {
    const ObjFile& file = source.inputs.head_files[static_cast<std::size_t>(target)];
    if (file.material_libraries.empty()) continue;
    const MaterialFiles found = find_material_files(file.material_path(), file.material_libraries);
    if (source.shared_folder.empty() && !found.has_library_at_other_path) continue;
    lines[target] = library_line(found.files, source.shared_folder);
  }
  return lines;
}

/// Returns `usemtl` lines to write after the `mtllib` lines; the key is the index of the target
/// head. The result has a line only for a target head whose first polygons have no material
/// although the material files define exactly one material. Without a `usemtl` line, programs
/// ignore this material.
std::map<Index, std::string> usemtl_lines(const MeshSource& source) {
  std::map<Index, std::string> lines;
  for (const Index target : source.target_heads) {
    const ObjFile& file = source.inputs.head_files[static_cast<std::size_t>(target)];
    if (file.material_libraries.empty()) continue;
    if (!file.materials.empty() && file.materials.front().first_face == 0) continue;
    const std::string material =
        find_textures(file.material_path(), file.material_libraries).single_material;
    if (!material.empty()) lines[target] = concat("\nusemtl ", material);
  }
  return lines;
}

/// Returns the encoder for the whole mesh. An encoded file is the OBJ file of the target head with
/// the vertex positions of the face.
MeshEncoder whole_encoder(const MeshSource& source) {
  const std::span<const Index> targets = source.target_heads;
  std::vector<std::optional<ObjTemplate>> made(targets.size());
  GivenNormals fixed;
  if (source.inputs.heads_on_body) {
    fixed = {source.inputs.heads_on_body->seam.rim, source.inputs.heads_on_body->seam.normals};
  }
  parallel_for_each(targets.size(), [&](std::size_t t) {
    made[t].emplace(source.inputs.head_files[static_cast<std::size_t>(targets[t])],
                    source.inputs.head_set.topology, !source.inputs.vertex_colours.empty(), fixed);
  });
  const auto templates = std::make_shared<std::map<Index, ObjTemplate>>();
  for (std::size_t t = 0; t < targets.size(); ++t)
    templates->emplace(targets[t], std::move(*made[t]));
  const auto [memory, encode] = sizes_of(
      *templates, [](const auto& each) -> auto& { return each.second; });
  return {
      [templates](const FaceMesh& face) {
        return templates->at(face.target).encode(*face.positions, face.display_name, *face.colours);
      },
      memory, encode};
}

/// Returns the encoder that writes the OBJ files of faces at a level of detail. It writes these
/// files from scratch. (The OBJ file of a whole mesh is a copy of the target head's file with other
/// positions.) Target heads with the same materials share one PlainObjTemplate, which holds the
/// text that is equal for all faces.
MeshEncoder level_encoder(const MeshSource& source, const DetailLevel& level) {
  struct LevelTemplates {
    std::vector<PlainObjTemplate> obj;
    std::map<Index, std::size_t> template_of_target;  ///< for each target head: index into `obj`
  };
  const Inputs& inputs = source.inputs;
  const auto templates = std::make_shared<LevelTemplates>();
  std::vector<std::vector<MaterialRange>> known;
  for (const Index target : source.target_heads) {
    const std::vector<MaterialRange> ranges =
        material_ranges(inputs.head_files[static_cast<std::size_t>(target)],
                        inputs.head_set.topology.face_count(), level);
    const auto same = std::find_if(known.begin(), known.end(), [&](const auto& others) {
      return std::equal(others.begin(), others.end(), ranges.begin(), ranges.end(), is_same);
    });
    templates->template_of_target[target] = static_cast<std::size_t>(same - known.begin());
    if (same != known.end()) continue;
    known.push_back(ranges);
    templates->obj.emplace_back(level.topology, level.uvs, ranges,
                                PlainObjTemplate::Normals::kVertex);
  }
  const auto [memory, encode] = sizes_of(
      templates->obj, [](const auto& each) -> auto& { return each; });
  return {
      [templates, &inputs](const FaceMesh& face) {
        std::string head;
        for (const std::string& library :
             inputs.head_files[static_cast<std::size_t>(face.target)].material_libraries) {
          head += concat("mtllib ", library, '\n');
        }
        EncodedFile plain = templates->obj[templates->template_of_target.at(face.target)].encode(
            concat(head, "o ", face.id, '\n'), *face.positions, *face.normals, face.display_name);
        if (face.colours->rows() == 0) return plain;
        return EncodedFile(with_colours(plain.text(), *face.colours));
      },
      memory, inputs.vertex_colours.empty() ? encode : 3 * encode + 2 * memory};
}

}  // namespace

MeshEncoders obj_encoders(const MeshSource& source) {
  MeshEncoders encoders;
  const std::map<Index, std::string> others = replacing_library_lines(source);
  const std::map<Index, std::string> materials = usemtl_lines(source);
  for (const MeshLevel& level : source.levels) {
    MeshEncoder encoder =
        level.is_whole_mesh() ? whole_encoder(source) : level_encoder(source, *level.face_level);
    encoder.encode = [encode = std::move(encoder.encode), others, materials](const FaceMesh& face) {
      EncodedFile file = encode(face);
      const auto other = others.find(face.target);
      if (!face.material_file.empty()) {
        const auto material = materials.find(face.target);
        file.replace_line("mtllib", concat("mtllib ", face.material_file,
                                           material == materials.end() ? "" : material->second));
      } else if (other != others.end() && !other->second.empty()) {
        file.replace_line("mtllib", other->second);
      }
      return file;
    };
    encoders.push_back(std::move(encoder));
  }
  return encoders;
}

MeshEncoder obj_attachment(const Attachment& item, const DetailLevel* level,
                           const std::string& shared) {
  const auto libraries_of = [&files = item.materials.files, name = item.name,
                             shared](const FaceMesh& mesh) {
    return library_line(files,
                        std::filesystem::path(shared) / attachment_folder(name, mesh.colour_label));
  };
  if (level == nullptr) {
    return make_encoder(std::make_shared<const ObjTemplate>(item.file, item.file.topology),
                        [libraries_of](const ObjTemplate& obj, const FaceMesh& mesh) {
                          EncodedFile file = obj.encode(*mesh.positions, mesh.display_name);
                          const std::string libraries = libraries_of(mesh);
                          if (!libraries.empty()) file.replace_line("mtllib", libraries);
                          return file;
                        });
  }
  using Normals = PlainObjTemplate::Normals;
  std::shared_ptr<const NormalFans> fans;
  if (!item.file.corner_normals.empty()) fans = std::make_shared<NormalFans>(level->topology);
  return make_encoder(std::make_shared<const PlainObjTemplate>(
                          level->topology, level->uvs,
                          material_ranges(item.file, item.file.topology.face_count(), *level),
                          fans ? Normals::kVertex : Normals::kNone),
                      [=](const PlainObjTemplate& obj, const FaceMesh& mesh) {
                        Positions normals;
                        if (fans) normals = vertex_normals(*fans, level->topology, *mesh.positions);
                        const std::string libraries = libraries_of(mesh);
                        return obj.encode(
                            concat(libraries, libraries.empty() ? "" : "\n", "o ", mesh.id, '\n'),
                            *mesh.positions, normals, mesh.display_name);
                      });
}

}  // namespace crowdface
