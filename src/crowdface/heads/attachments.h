// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "crowdface/attach/attachment_move.h"
#include "crowdface/core/hash.h"
#include "crowdface/io/material_files.h"
#include "crowdface/io/obj_file.h"
#include "crowdface/mesh/topology.h"

namespace crowdface {

/// A mesh that may sit on heads, and the files that say what it is made of.
struct Attachment {
  std::string name, kind;
  AttachmentMove moves = AttachmentMove::kBend;
  ObjFile file;
  MaterialFiles materials;
};

/// All that may sit on the heads of a crowd.
struct AttachmentSet {
  Positions fitted_to;  ///< #V by 3, the mesh beside which all stand; of no rows: there are none
  std::vector<Attachment> items;
  Digest digest;  ///< of all files' contents and of that mesh

  bool empty() const { return items.empty(); }
  /// The one of that name, which must be there.
  const Attachment& at(const std::string& name) const { return items[index(name)]; }
  std::size_t index(const std::string& name) const;
};

}  // namespace crowdface
