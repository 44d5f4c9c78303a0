// SPDX-License-Identifier: Apache-2.0
#include "crowdface/run/mesh_level.h"

#include <algorithm>
#include <set>
#include <string>

#include "crowdface/core/parallel.h"
#include "crowdface/heads/heads_on_body.h"
#include "crowdface/io/material_files.h"

namespace crowdface {
namespace {

std::vector<DetailLevel> levels_of(const Attachment& item, std::span<const MeasuredLevel> levels) {
  const Topology& topology = item.file.topology;
  const auto triangles = static_cast<double>(topology.corner_count() - 2 * topology.face_count());
  constexpr double kMinTriangles = 300;
  std::vector<double> shares;
  for (const MeasuredLevel& level : levels) {
    shares.push_back(std::min(1.0, std::max(level.level.share, kMinTriangles / triangles)));
  }
  return detail_levels({topology, item.file.uvs, {{item.name, item.file.positions}}},
                       face_materials(item.file.materials, topology.face_count()).of_face, shares);
}

}  // namespace

std::vector<const Attachment*> MeshLevel::items(const AttachmentSet& set) const {
  std::vector<const Attachment*> items;
  for (const Attachment& item : set.items) {
    if (whole() || find(item) != nullptr) items.push_back(&item);
  }
  if (body != nullptr) items.push_back(body);
  return items;
}

const DetailLevel* MeshLevel::find(const Attachment& item) const {
  const auto found = attachments.find(&item);
  return found == attachments.end() ? nullptr : &found->second;
}

std::vector<PlacedAttachment> MeshLevel::of(std::span<const PlacedAttachment> placed) const {
  std::vector<PlacedAttachment> reduced;
  for (const PlacedAttachment& one : placed) {
    if (!attachments.contains(one.item)) continue;  // the body
    const DetailLevel& level = attachments.at(one.item);
    reduced.push_back({one.item, one.colour, level.of(one.positions)});
    for (const Displacements& moves : one.moves) reduced.back().moves.push_back(level.of(moves));
  }
  return reduced;
}

std::vector<MeshLevel> mesh_levels(const Inputs& inputs, std::span<const FacePlan> crowd,
                                   bool with_body) {
  std::vector<MeshLevel> levels(1 + inputs.levels.size());
  if (with_body) levels[0].body = inputs.neck->body.get();
  if (inputs.levels.empty()) return levels;
  for (std::size_t l = 1; l < levels.size(); ++l) {
    levels[l].number = l;
    levels[l].face = &inputs.levels[l - 1].level;
  }
  std::set<std::string> names;
  for (const FacePlan& face : crowd) names.insert(face.attachments.begin(), face.attachments.end());
  std::vector<const Attachment*> items;
  for (const std::string& name : names) items.push_back(&inputs.attachments.at(name));
  std::vector<std::vector<DetailLevel>> of_items(items.size());
  parallel_for_each(items.size(),
                    [&](std::size_t i) { of_items[i] = levels_of(*items[i], inputs.levels); });
  for (std::size_t i = 0; i < items.size(); ++i) {
    for (std::size_t l = 1; l < levels.size(); ++l) {
      levels[l].attachments.emplace(items[i], std::move(of_items[i][l - 1]));
    }
  }
  return levels;
}

}  // namespace crowdface
