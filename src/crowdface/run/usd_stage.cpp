// SPDX-License-Identifier: Apache-2.0
#include "crowdface/run/usd_stage.h"

#include <algorithm>
#include <cmath>

#include "crowdface/core/text.h"
#include "crowdface/crowd/crowd_directory.h"
#include "crowdface/io/usda_text.h"
#include "crowdface/run/mesh_level.h"

namespace crowdface {
namespace {

/// Places the faces in a grid of rows and columns, in the coordinate axes of the stage (the USD
/// layer of the crowd).
struct Rows {
  /// offsets from a face to the face in the next column, and to the face in the next row
  Eigen::Vector3d side, back;
  std::size_t columns = 1;

  Eigen::Vector3d place(std::size_t face) const {
    const double middle = static_cast<double>(columns - 1) / 2;
    const std::size_t row = face / columns, column = face % columns;
    return (static_cast<double>(column) - middle) * side + static_cast<double>(row) * back;
  }
};

/// Returns the spacing of the faces along an axis: 4/3 of the largest extent of a head along this
/// axis.
double face_spacing(const Inputs& inputs, Eigen::Index axis) {
  double most = 0;
  for (const Head& head : inputs.head_set.heads) {
    const auto along = head.positions.col(axis);
    most = std::max(most, along.maxCoeff() - along.minCoeff());
  }
  return std::ceil(400 * most / 3) / 100;
}

Rows rows_of(const Config& config, const Inputs& inputs, std::size_t faces) {
  const Axis up = config.faces.up, front = config.faces.front;
  const Eigen::Index side = 3 - up.index - front.index;
  // whether the USD stage has the same axes as the heads, see UsdaTemplate
  const bool keeps_axes = up.sign > 0 && up.index > 0;
  Rows rows;
  rows.side = Eigen::Vector3d::Unit(keeps_axes ? side : 0) * face_spacing(inputs, side);
  const Axis to_front = keeps_axes ? front : Axis{2, 1};
  rows.back =
      Eigen::Vector3d::Unit(to_front.index) * -to_front.sign * face_spacing(inputs, front.index);
  rows.columns = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(faces))));
  return rows;
}

/// Returns the USD text that references the layer of a face: "prepend references =
/// @./meshes/ID.usda@".
std::string reference(const CrowdDirectory& here, const std::string& id, std::size_t level) {
  return concat("prepend references = @./",
                here.relative(here.mesh(id, MeshFormat::kUsd, level_suffix(level, ""))), "@\n");
}

std::string face_text(const CrowdDirectory& here, const std::string& prim, const std::string& id,
                      std::size_t levels, const Eigen::Vector3d& place) {
  std::string metadata = "        " + reference(here, id, 0), variants;
  if (levels > 0) {
    metadata =
        "        variants = {\n            string LOD = \"LOD0\"\n        }\n"
        "        prepend variantSets = \"LOD\"\n";
    variants = "        variantSet \"LOD\" = {\n";
    for (std::size_t level = 0; level <= levels; ++level) {
      variants += concat("            \"LOD", level, "\" (\n                ",
                         reference(here, id, level), "            ) {\n            }\n");
    }
    variants += "        }\n";
  }
  return concat("\n    def Xform \"", prim, "\" (\n", metadata,
                "    )\n    {\n        double3 xformOp:translate = (", place.x() + 0.0, ", ",
                place.y() + 0.0, ", ", place.z() + 0.0,
                ")\n        uniform token[] xformOpOrder = [\"xformOp:translate\"]\n", variants,
                "    }\n");
}

}  // namespace

std::string make_usd_stage_text(const Config& config, const Inputs& inputs,
                                std::span<const FacePlan> crowd) {
  const std::string root = usda_name(config.crowd.name);
  std::string text = concat("#usda 1.0\n(\n    defaultPrim = \"", root, "\"\n",
                            usda_layer_metadata(config.faces.units, config.faces.up),
                            ")\n\ndef Xform \"", root, "\" (\n    kind = \"group\"\n)\n{\n");
  const Rows rows = rows_of(config, inputs, crowd.size());
  const CrowdDirectory here{".", config.output.faces_per_folder.value_or(0)};
  UsdaNames names;
  for (std::size_t i = 0; i < crowd.size(); ++i) {
    text += face_text(here, names.add(crowd[i].id), crowd[i].id, inputs.detail_levels.size(),
                      rows.place(i));
  }
  return text + "}\n";
}

}  // namespace crowdface
