// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <limits>
#include <vector>

#include <Eigen/Geometry>

#include "head_models/synth/identity.h"
#include "head_models/synth/mean_head.h"
#include "head_models/synth/noise.h"

namespace crowdface::synth {

/// The fine relief of a head's skin: folds and lines that deepen with age, uneven skin, lip creases
/// and pores. Each identity has its own relief.
class Relief {
 public:
  /// \param edge_cm  typical edge length of the mesh; relief too fine for this length is left out.
  /// \param omitted_edge_cm  if finite: relief that a mesh with this edge length represents is left
  ///                         out as well.
  Relief(const Identity& identity, double edge_cm,
         double omitted_edge_cm = std::numeric_limits<double>::infinity());

  /// Returns the displacement of the relief along the normal of the average skin, cm.
  double height(const SkinPoint& mean) const;

  /// Returns the part of `height` that is due to folds and lines, cm.
  /// \param position  point on the average head.
  double fold_height(const Eigen::Vector3d& position) const;
  /// Returns how strongly folds and lines shade the skin: the sum of their depths, each divided by
  /// a length that grows with the width of the fold. About 1 in a steep groove, negative on ridges.
  /// \param position  point on the average head.
  double fold_shade(const Eigen::Vector3d& position) const;

 private:
  /// A curve in the front view of the face, engraved (depth > 0) or raised (depth < 0). Lengths in
  /// cm.
  struct Stroke {
    static constexpr int kPieces = 12;  ///< number of straight pieces of the curve
    std::array<Eigen::Vector2d, kPieces + 1> points;
    double width, depth;  ///< width and depth of the curve's groove, cm
    /// Absolute value: height of a ridge beside the groove, as a fraction of the groove's depth.
    /// Sign: for a viewer who looks along the curve from its start, in the front view, the ridge is
    /// on the left (positive) or on the right (negative).
    double bulge;
    /// Bounding box, in the front view, of the points that the curve displaces.
    Eigen::AlignedBox2d affected_box;
  };
  /// Returns the relief without folds and lines, cm: uneven skin, pores and lip creases.
  double grain(const Eigen::Vector3d& position) const;
  /// Returns the contribution of one curve to fold_height at a point of the front view, cm.
  double stroke_height(const Stroke& stroke, const Eigen::Vector2d& place) const;
  /// Returns Σ weight(s) · stroke_height(s) at a point, over all curves s in `strokes_`.
  template <class Weight>
  double sum_of_strokes(const Eigen::Vector3d& position, const Weight& weight) const;
  /// Returns the depth of wrinkles at a point as a negative height, cm; positive on their borders.
  double wrinkle_height(const Eigen::Vector3d& position) const;
  /// Adds the curve of a fold.
  /// \param side  1: the curve itself; −1: the curve mirrored in the plane x = 0.
  void add_stroke(std::size_t fold_index, double side, double depth);

  /// the curves of all folds and lines, and their mirror images
  std::vector<Stroke> strokes_;
  /// Noise that displaces all folds of a head together, in x and in y.
  SmoothNoise fold_offset_noise_x_, fold_offset_noise_y_;
  /// bends wrinkles sideways, by about ±0.45 of the distance between neighbouring wrinkles
  SmoothNoise wrinkle_waves_;
  SmoothNoise wrinkle_gaps_;  ///< noise; wrinkles have gaps where its value is low
  /// The wrinkles of an area. Lengths in cm.
  struct Wrinkles {
    double depth, spacing;  ///< depth of the wrinkles; mean distance between neighbouring wrinkles
    double offset;          ///< 0 … 1: shifts the wrinkles by this fraction of the spacing
  };
  std::vector<Wrinkles> wrinkles_;
  /// Noise of one wavelength.
  struct Octave {
    SmoothNoise noise;
    double amplitude;  ///< amplitude of the noise, cm
  };
  std::vector<Octave> broad_octaves_;  ///< noise that makes the skin uneven
  std::vector<Octave> fine_octaves_;   ///< noise that makes pores
  SmoothNoise lip_creases_;            ///< noise that is stretched to creases across the lips
  double lip_depth_;                   ///< amplitude of lip_creases_, cm
};

}  // namespace crowdface::synth
