// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/obj_writer.h"

#include "crowdface/core/text.h"
#include "crowdface/io/obj_template.h"
#include "crowdface/io/plain_obj_template.h"

namespace crowdface {

EncodedFile encode_obj_like(const ObjFile& target, const Topology& topology,
                            const Positions& positions, const std::string& what) {
  return ObjTemplate(target, topology).encode(positions, what);
}

Digest write_obj_like(const ObjFile& target, const Topology& topology, const Positions& positions,
                      const std::filesystem::path& path) {
  const EncodedFile file = encode_obj_like(target, topology, positions, path.string());
  file.write(path);
  return file.digest();
}

EncodedFile encode_obj(const Mesh& mesh, const std::string& comment,
                       const std::vector<MaterialRange>& materials, const std::string& library) {
  const PlainObjTemplate form(mesh.topology, mesh.uvs, materials, PlainObjTemplate::Normals::kNone);
  std::string head;
  if (!comment.empty()) head = concat("# ", comment, '\n');
  if (!library.empty()) head += concat("mtllib ", library, '\n');
  return form.encode(head, mesh.positions, {}, comment).text();
}

}  // namespace crowdface
