// SPDX-License-Identifier: Apache-2.0
#include "crowdface/pictures/face_comparison.h"

#include <algorithm>
#include <cmath>
#include <system_error>

#include "crowdface/blend/blend.h"
#include "crowdface/config/yaml.h"
#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/text.h"
#include "crowdface/crowd/face_mesh.h"
#include "crowdface/io/obj_file.h"
#include "crowdface/mesh/alignment.h"

namespace crowdface {
namespace {

using Reference = Config::MeshComparison::Reference;

/// Like std::filesystem::exists. \throws MissingInput if the existence cannot be determined, for
/// example in a folder without read permission.
bool exists_or_throw(const std::filesystem::path& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (std::filesystem::status_known(status)) return std::filesystem::exists(status);
  throw MissingInput(concat(path.string(), ": cannot be read: ", error.message()));
}

/// The format of a face's mesh in a crowd. \throws MissingInput if there is no mesh.
MeshFormat format_of_face(const CrowdDirectory& directory, const std::string& id) {
  for (const MeshFormat format : all_mesh_formats()) {
    const bool is_read = traits_of(format).read != nullptr;
    if (is_read && exists_or_throw(directory.mesh(id, format))) return format;
  }
  throw MissingInput(
      concat(directory.root.string(), ": holds no mesh of ", quoted(id), " to compare with"));
}

/// The folder of another crowd. Reads `faces_per_folder` from the other crowd's config file.
/// \param folder  the other crowd's folder
CrowdDirectory crowd_at(const std::filesystem::path& folder) {
  CrowdDirectory directory{folder};
  if (!exists_or_throw(directory.config())) return directory;
  Complaints complaints;
  const auto root = parse_yaml(read_file(directory.config()), "", complaints);
  const YamlEntry* output = root ? root->find("output") : nullptr;
  const YamlEntry* faces = output != nullptr ? output->value.find("faces_per_folder") : nullptr;
  if (faces != nullptr) directory.faces_per_folder = parse_unsigned(faces->value.text).value_or(0);
  return directory;
}

/// Reads the mesh with which all faces are compared.
Positions read_reference(const std::filesystem::path& file, Index vertices) {
  Positions positions = read_obj(file).positions;
  if (positions.rows() == vertices) return positions;
  refuse_file(file,
              concat("expected ", vertices, " vertices to compare with, found ", positions.rows()));
}

}  // namespace

FaceComparison::FaceComparison(const PicturedCrowd& crowd)
    : crowd_(crowd), comparison_(crowd.config.output.contact_sheet->compare) {
  if (comparison_.reference != Reference::kFile) return;
  if (std::filesystem::is_directory(comparison_.file)) {
    other_crowd_ = crowd_at(comparison_.file);
  } else {
    reference_mesh_ = read_reference(comparison_.file, crowd.inputs.head_set.topology.vertex_count);
  }
}

Positions FaceComparison::mesh_of(std::size_t face) const {
  return read_face_positions(crowd_.directory, crowd_.faces[face].id, crowd_.config.output.meshes,
                             crowd_.inputs.head_set.topology.vertex_count);
}

std::optional<Positions> FaceComparison::compared_mesh(std::size_t face) const {
  switch (comparison_.reference) {
    case Reference::kTarget:
      return target_positions(crowd_.inputs.head_set, crowd_.faces[face].recipe);
    case Reference::kNearest:
      if (crowd_.likeness.neighbours[face].empty()) return std::nullopt;
      return mesh_of(crowd_.likeness.neighbours[face].front().face);
    case Reference::kFile:
      if (reference_mesh_.rows() > 0) return reference_mesh_;
      return read_face_positions(other_crowd_, crowd_.faces[face].id,
                                 {format_of_face(other_crowd_, crowd_.faces[face].id)},
                                 crowd_.inputs.head_set.topology.vertex_count);
    case Reference::kNothing:
      break;
  }
  return std::nullopt;
}

ComparedFace FaceComparison::compare(std::size_t face) const {
  Positions mesh = mesh_of(face);
  const auto with = compared_mesh(face);
  if (!with) return {mesh, Eigen::VectorXd::Zero(mesh.rows())};
  const Similarity move = fit_similarity(*with, mesh, ScaleFit::kRigid);
  return {mesh, mm_per(crowd_.config.faces.units) * (move.apply(*with) - mesh).rowwise().norm()};
}

std::string FaceComparison::label(const ComparedFace& compared) const {
  const Eigen::VectorXd& mm = compared.mm;
  const int digits =  // more decimals for smaller scales
      std::clamp(2 - static_cast<int>(std::floor(std::log10(comparison_.scale_mm))), 2, 6);
  const double rms = mm.size() > 0 ? mm.norm() / std::sqrt(static_cast<double>(mm.size())) : 0;
  return concat("rms ", format_fixed(rms, digits), " mm, largest ",
                format_fixed(mm.size() > 0 ? mm.maxCoeff() : 0, digits), " mm");
}

std::optional<HeatLegend> FaceComparison::legend() const {
  if (comparison_.reference == Reference::kNothing) return std::nullopt;
  const std::string other = comparison_.reference == Reference::kTarget ? "its target"
                            : comparison_.reference == Reference::kNearest
                                ? "its nearest face"
                                : comparison_.file.filename().string();
  return HeatLegend{comparison_.scale_mm, concat("distance from ", other)};
}

void check_compared_mesh(const Config& config, const Inputs& inputs, Problems& problems) {
  const auto& sheet = config.output.contact_sheet;
  if (!sheet || sheet->compare.reference != Reference::kFile) return;
  const std::filesystem::path& file = sheet->compare.file;
  try {
    if (!exists_or_throw(file) || !std::filesystem::is_directory(file)) {
      read_reference(file, inputs.head_set.topology.vertex_count);
    }
  } catch (const RecoverableError& error) {
    problems.add(error);
  }
}

void check_compared_crowd(const Config& config, const std::vector<FacePlan>& crowd) {
  const auto& sheet = config.output.contact_sheet;
  if (!sheet || sheet->compare.reference != Reference::kFile) return;
  const std::filesystem::path& folder = sheet->compare.file;
  if (!std::filesystem::is_directory(folder)) return;
  const CrowdDirectory others = crowd_at(folder);
  for (const FacePlan& face : crowd) format_of_face(others, face.id);
}

}  // namespace crowdface
