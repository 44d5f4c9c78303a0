// SPDX-License-Identifier: Apache-2.0
// How far two faces are apart, as plainly as it can be computed from whole meshes: no samples, no
// code of the program.
#pragma once

#include <vector>

#include "support/reference.h"

namespace crowdface::reference {

/// What each vertex counts: the area around it on the mean of the heads, where it belongs to the
/// largest connected part and lies in front (+z) of that part's middle.
std::vector<double> front_areas(const Obj& mesh, const std::vector<Points>& heads);

/// Root mean square distance after the second was moved rigidly onto the first.
/// \param factor  millimetres in a unit.
double distance_mm(const std::vector<double>& areas, const Points& a, const Points& b,
                   double factor);

}  // namespace crowdface::reference
