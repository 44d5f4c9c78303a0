// SPDX-License-Identifier: Apache-2.0
// Meshes whose faces look inward, as they do after a mirroring or in a program that winds the other way.
#pragma once

#include "crowdface/io/file_mesh.h"
#include "crowdface/io/obj_file.h"

namespace crowdface {

/// Turns the faces round if the mesh is inside out, and notes that.
void turn_right_side_out(FileMesh& mesh);
/// The same of an OBJ file: its text then has the faces turned.
ObjFile right_side_out(ObjFile file);

}  // namespace crowdface
