// SPDX-License-Identifier: Apache-2.0
#include "crowdface/heads/mask_checks.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "crowdface/core/text.h"
#include "crowdface/heads/named_parts.h"
#include "crowdface/region/vertex_weights.h"

namespace crowdface {

void check_masks(const std::vector<std::string>& files, Problems& problems) {
  for (const std::string& file : files) {
    const MaskSource mask(file);
    if (mask.is_tiled()) continue;
    try {
      if (holds_vertex_weights(file)) {
        read_vertex_weights(file);
      } else {
        mask.read(0);
      }
    } catch (const RecoverableError& error) {
      problems.add(error);
    }
  }
}

std::vector<std::string> single_image_mask_warnings(const Config& config, const Inputs& inputs) {
  std::set<std::pair<double, double>> tiles;
  const Topology& topology = inputs.head_set.topology;
  for (Index f = 0; f < topology.face_count(); ++f) {
    const auto uvs = topology.face_uvs(f);
    if (uvs.empty() || inputs.skin_components.component_of_vertex[topology.face(f)[0]] !=
                           inputs.skin_components.largest())
      continue;
    Eigen::RowVector2d middle(0, 0);
    for (const std::uint32_t uv : uvs) {
      if (uv != kNoIndex) {
        middle += inputs.head_set.uvs.row(uv) / static_cast<double>(uvs.size());
      }
    }
    tiles.emplace(std::floor(middle.x()), std::floor(middle.y()));
  }
  const bool is_in_first_tile =
      tiles.empty() || (tiles.size() == 1 && *tiles.begin() == std::pair(0.0, 0.0));
  std::vector<std::string> warnings;
  for (const std::string& mask : config.regions.mask) {
    if (is_in_first_tile || MaskSource(mask).is_tiled() || holds_vertex_weights(mask)) continue;
    const std::string where = tiles.size() > 1
                                  ? concat("the skin's texture has ", tiles.size(), " tiles")
                                  : "the skin's texture coordinates lie outside the first tile";
    warnings.push_back(concat("mask ", mask, " is one image, but ", where,
                              ": outside the first tile the pixels at the image's edge are "
                              "repeated; with <UDIM> in its name, each tile has its own image"));
  }
  return warnings;
}

std::vector<std::string> ineffective_mask_warnings(const Config& config, const Inputs& inputs) {
  const std::vector<std::string>& names = config.regions.names;
  if (names.empty() || config.regions.mask.empty()) return {};
  if (names.size() == 1) {
    return {concat(
        "the mask of a single region has no effect, because uncovered skin belongs to the last "
        "region, which is the same: for the uncovered skin, add a second region, names: [",
        names[0], ", rest]")};
  }
  std::vector<std::string> warnings;
  const std::vector<bool> skin = skin_of(inputs);
  bool all_are_everywhere = true;
  for (std::size_t r = 0; r < names.size(); ++r) {
    double least = 1, most = 0;
    for (std::size_t v = 0; v < skin.size(); ++v) {
      if (!skin[v]) continue;
      const double weight = inputs.regions.alpha(static_cast<Index>(v), static_cast<Index>(r));
      least = std::min(least, weight);
      most = std::max(most, weight);
    }
    if (most == 0) {
      warnings.push_back(
          concat("the region ", names[r], " covers no skin: its mask is zero on the whole skin"));
    }
    constexpr double kNothing = 0.02;
    all_are_everywhere = all_are_everywhere && least > kNothing;
  }
  if (all_are_everywhere) {
    warnings.push_back(concat("the masks (", join(config.regions.mask),
                              ") overlap everywhere: each vertex of the skin belongs to all of ",
                              join(names), "; are they skin textures instead of masks?"));
  }
  return warnings;
}

}  // namespace crowdface
