// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "crowdface/core/problems.h"
#include "crowdface/pictures/crowd_renders.h"
#include "crowdface/render/contact_sheet.h"

namespace crowdface {

/// A face, and how far each of its points is from the same point of what it is compared with, moved
/// onto it; 0 if it is compared with nothing, as the only face of a crowd is with its nearest.
struct ComparedFace {
  Positions mesh;
  Eigen::VectorXd mm;  ///< #vertices
};

/// Compares the faces of a crowd as a sheet's `compare` says.
class FaceComparison {
 public:
  /// \throws Error  of a file to compare with.
  explicit FaceComparison(const PicturedCrowd& crowd);

  ComparedFace compare(std::size_t face) const;
  /// "rms 0.12 mm, largest 3.40 mm".
  std::string label(const ComparedFace& compared) const;
  /// Of the colours that show the distances; nothing where nothing is compared.
  std::optional<HeatLegend> legend() const;

 private:
  Positions mesh_of(std::size_t face) const;
  std::optional<Positions> other(std::size_t face) const;

  const PicturedCrowd& crowd_;
  const Config::Comparison& comparison_;
  CrowdDirectory others_;  ///< the crowd that `comparison` names, if it names one
  Positions reference_;    ///< the one mesh that all are compared with, or empty
};

/// Adds what is wrong with the mesh, if it is one, that the faces are to be compared with.
void check_compared_mesh(const Config& config, const Inputs& inputs, Problems& problems);

/// \throws MissingInput if they are to be compared with those of a crowd that lacks one of them:
/// better told before the faces are made than after.
void check_compared_crowd(const Config& config, const std::vector<CastFace>& crowd);

}  // namespace crowdface
