// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "crowdface/core/problems.h"
#include "crowdface/pictures/crowd_renders.h"
#include "crowdface/render/contact_sheet.h"

namespace crowdface {

/// A face and the distance of each of its vertices to the same vertex of another mesh, after that
/// mesh is fitted rigidly to the face. If there is no other mesh, as for the only face of a crowd,
/// all distances are 0.
struct ComparedFace {
  Positions mesh;
  Eigen::VectorXd mm;  ///< #V distances
};

/// Compares the faces of a crowd with other meshes, as the contact sheet's key `compare` specifies.
class FaceComparison {
 public:
  /// \throws Error if a file to compare with cannot be read.
  explicit FaceComparison(const PicturedCrowd& crowd);

  ComparedFace compare(std::size_t face) const;
  /// Summary of the distances: "rms 0.12 mm, largest 3.40 mm".
  std::string label(const ComparedFace& compared) const;
  /// Legend for the colours of the distances; nothing if faces are not compared.
  std::optional<HeatLegend> legend() const;

 private:
  Positions mesh_of(std::size_t face) const;
  std::optional<Positions> other(std::size_t face) const;

  const PicturedCrowd& crowd_;
  const Config::Comparison& comparison_;
  CrowdDirectory others_;  ///< the crowd that `comparison` names, if any
  Positions reference_;    ///< the mesh to compare all faces with, or empty
};

/// Checks the mesh file that the config names to compare with, if any, and adds errors to
/// `problems`.
void check_compared_mesh(const Config& config, const Inputs& inputs, Problems& problems);

/// Checks, before the run makes any face, that the crowd to compare with has a mesh for every face
/// of this crowd.
/// \throws MissingInput if a mesh is missing.
void check_compared_crowd(const Config& config, const std::vector<FacePlan>& crowd);

}  // namespace crowdface
