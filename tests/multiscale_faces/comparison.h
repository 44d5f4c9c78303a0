// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "multiscale_faces/front_patch.h"

namespace crowdface::multiscale {

/// Distances between two faces `a` and `b`.
struct Differences {
  /// between corresponding vertices of both faces
  double rms_distance = 0, largest_distance = 0;
  /// from the vertices of `b` to the surface of `a`
  double rms_distance_to_surface = 0;
};
/// Measures the distances between two faces.
/// \param a, b  #P by 3: one row per vertex of the patch.
Differences differences(const FrontPatch& patch, const Positions& a, const Positions& b);

/// Returns the energy of each wavelength band of a head: the sum of |S(finer bound) − S(coarser
/// bound)|² over the vertices of the patch. S(λ) is the whole head after Laplacian smoothing (Eq.
/// 1) with the half-amplitude wavelength λ.
/// \param positions  #V by 3 of whole heads, in millimetres.
/// \param bounds_mm  upper bounds of the bands (half-amplitude wavelengths), ascending.
std::vector<double> band_energies(const Topology& topology, const FrontPatch& patch,
                                  const Positions& positions, const std::vector<double>& bounds_mm);

/// Returns the largest distance between corresponding vertices of two faces `a` and `b`. Considers
/// only the vertices on the given rims (boundary loops).
double largest_rim_distance(const std::vector<std::vector<std::uint32_t>>& rims, const Positions& a,
                            const Positions& b);

/// Compares the creases of a face with the creases of its source heads. The crease at an edge is
/// the angle between the normals of the two triangles. The excess at an edge is the face's crease
/// minus the largest crease of any source head. Returns the largest excess, in degrees, over the
/// edges in the border between regions; 0 if no excess is positive.
/// \param heads   source heads, #P by 3 each.
/// \param border  for each vertex of the patch, whether it lies in the border between regions.
double largest_new_crease(const FrontPatch& patch, const Positions& face,
                          const std::vector<Positions>& heads, const std::vector<bool>& border);

}  // namespace crowdface::multiscale
