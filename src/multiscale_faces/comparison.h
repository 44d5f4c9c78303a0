// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "multiscale_faces/front_patch.h"

namespace crowdface::multiscale {

/// Distances between two faces `a` and `b`.
struct Differences {
  double rms = 0, largest = 0;  ///< distances between the same vertices of both faces
  double rms_to_surface = 0;    ///< rms distance of `b`'s vertices from the surface of `a`
};
/// \param a, b  #P by 3, in the patch's numbers.
Differences differences(const FrontPatch& patch, const Positions& a, const Positions& b);

/// The energy of each wavelength band of a head, on the patch: Σ over its vertices of the squared
/// length of S(finer bound) − S(coarser bound), where S is Laplacian smoothing (Eq. 1).
/// \param positions  #V by 3 of whole heads, in millimetres.
/// \param bounds_mm  half-amplitude wavelengths, ascending. The first band contains the wavelengths
///                   below the first bound.
std::vector<double> band_energies(const Topology& topology, const FrontPatch& patch,
                                  const Positions& positions, const std::vector<double>& bounds_mm);

/// The largest distance between corresponding vertices of two faces `a` and `b`, over the vertices
/// on the given rims (boundary loops).
double largest_rim_distance(const std::vector<std::vector<std::uint32_t>>& rims, const Positions& a,
                            const Positions& b);

/// Returns by how many degrees a face's creases exceed the creases of the heads that it is made
/// from. At an edge, the crease is the angle between the normals of both triangles, and the excess
/// is the face's crease minus the largest crease of any head at this edge. Returns the largest
/// excess over the edges inside of region borders, or 0.
/// \param border  #P: whether a vertex lies in the border between regions.
double largest_new_crease(const FrontPatch& patch, const Positions& face,
                          const std::vector<Positions>& heads, const std::vector<bool>& border);

}  // namespace crowdface::multiscale
