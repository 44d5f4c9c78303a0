// SPDX-License-Identifier: Apache-2.0
// Corrects meshes whose polygons face inwards, for example after mirroring or from a program with
// the opposite winding.
#pragma once

#include <string_view>

#include "crowdface/io/file_mesh.h"
#include "crowdface/io/obj_file.h"

namespace crowdface {

/// Text of the note about a mesh whose polygons were reversed.
inline constexpr std::string_view kReversedFacesNote =
    "its faces pointed inward (inside out) and are flipped";

/// If a mesh is inside out, reverses its polygons and adds kReversedFacesNote to the mesh's notes.
void reverse_inward_faces(FileMesh& mesh);
/// Reverses the polygons of an OBJ file that is inside out, both in its mesh and in its text, and
/// sets `has_reversed_faces`. Does not add kReversedFacesNote to the file's notes.
ObjFile with_outward_faces(ObjFile file);

}  // namespace crowdface
