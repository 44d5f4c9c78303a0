// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "crowdface/core/problems.h"
#include "crowdface/pictures/crowd_renders.h"
#include "crowdface/render/contact_sheet.h"

namespace crowdface {

/// A face of the crowd, compared with a second mesh that is first fitted rigidly to the face. The
/// distance at a vertex is the distance between the vertex's positions in both meshes. If there is
/// no second mesh, all distances are 0.
struct ComparedFace {
  Positions mesh;      ///< vertex positions of the face
  Eigen::VectorXd mm;  ///< #V: distance at each vertex, in millimetres
};

/// Compares the faces of a crowd with other meshes, as the contact sheet's key `compare` specifies.
class FaceComparison {
 public:
  /// \throws Error if a file with a mesh for comparison cannot be read.
  explicit FaceComparison(const PicturedCrowd& crowd);

  /// Compares a face with its second mesh. \param face  index of the face in the crowd
  ComparedFace compare(std::size_t face) const;
  /// Summary of the distances: "rms 0.12 mm, largest 3.40 mm".
  std::string label(const ComparedFace& compared) const;
  /// Legend for the colours of the distances; nothing if faces are not compared.
  std::optional<HeatLegend> legend() const;

 private:
  /// Reads the vertex positions of a face from the crowd's folder.
  Positions mesh_of(std::size_t face) const;
  /// Returns the mesh to compare with a face; nothing if the config compares no faces, or if the
  /// crowd has only this face.
  std::optional<Positions> compared_mesh(std::size_t face) const;

  const PicturedCrowd& crowd_;
  const Config::MeshComparison& comparison_;
  /// the folder of the crowd that the config names for comparison (`comparison_`), if any
  CrowdDirectory other_crowd_;
  Positions reference_mesh_;  ///< the mesh with which all faces are compared; may have no rows
};

/// Checks the mesh file that the config names for comparison, if any. Adds errors to `problems`.
void check_compared_mesh(const Config& config, const Inputs& inputs, Problems& problems);

/// If the config names another crowd for comparison, checks that the other crowd has a mesh for
/// every face in `crowd`. Called before the run makes any face.
/// \throws MissingInput if a mesh is missing.
void check_compared_crowd(const Config& config, const std::vector<FacePlan>& crowd);

}  // namespace crowdface
