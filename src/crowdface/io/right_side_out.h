// SPDX-License-Identifier: Apache-2.0
// Orientation of meshes whose faces point inwards, for example after mirroring or from a program
// with the opposite winding.
#pragma once

#include <string_view>

#include "crowdface/io/file_mesh.h"
#include "crowdface/io/obj_file.h"

namespace crowdface {

/// Text of the note about a mesh whose faces were reversed.
inline constexpr std::string_view kReversedFacesNote =
    "its faces pointed inward (inside out) and are flipped";

/// Reverses the faces of a mesh that is inside out, and adds a note.
void reverse_inward_faces(FileMesh& mesh);
/// Reverses the faces of an OBJ file that is inside out, also in its text.
ObjFile with_outward_faces(ObjFile file);

}  // namespace crowdface
