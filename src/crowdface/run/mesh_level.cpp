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

std::vector<DetailLevel> levels_of(const Attachment& item, std::span<const MeasuredLevel> levels,
                                   Borders borders) {
  const Topology& topology = item.file.topology;
  const auto triangles = static_cast<double>(topology.corner_count() - 2 * topology.face_count());
  constexpr double kMinTriangles = 300;
  std::vector<double> shares;
  for (const MeasuredLevel& level : levels) {
    shares.push_back(std::min(1.0, std::max(level.level.share, kMinTriangles / triangles)));
  }
  return detail_levels(
      {topology, item.file.uvs, {{item.name, item.file.positions}}},
      polygon_materials(item.file.materials, topology.face_count()).material_of_polygon, shares,
      borders);
}

}  // namespace

std::vector<const Attachment*> MeshLevel::attachments_in_files(const AttachmentSet& set) const {
  std::vector<const Attachment*> items;
  for (const Attachment& item : set.items) {
    if (is_whole_mesh() || find(item) != nullptr) items.push_back(&item);
  }
  if (body != nullptr) items.push_back(body);
  return items;
}

const DetailLevel* MeshLevel::find(const Attachment& item) const {
  const auto found = attachments.find(&item);
  return found == attachments.end() ? nullptr : &found->second;
}

std::vector<PlacedAttachment> MeshLevel::reduced_attachments(
    std::span<const PlacedAttachment> placed) const {
  std::vector<PlacedAttachment> reduced;
  for (const PlacedAttachment& one : placed) {
    const DetailLevel& level = attachments.at(one.item);
    reduced.push_back({one.item,
                       one.colour,
                       level.restrict_rows(one.positions),
                       {},
                       one.face_id,
                       one.texture_png});
    for (const Displacements& moves : one.moves)
      reduced.back().moves.push_back(level.restrict_rows(moves));
  }
  return reduced;
}

std::vector<MeshLevel> mesh_levels(const Inputs& inputs, std::span<const FacePlan> crowd,
                                   bool with_body) {
  std::vector<MeshLevel> levels(1 + inputs.detail_levels.size());
  const Attachment* const body = with_body ? inputs.heads_on_body->body.get() : nullptr;
  for (MeshLevel& level : levels) level.body = body;
  if (inputs.detail_levels.empty()) return levels;
  for (std::size_t l = 1; l < levels.size(); ++l) {
    levels[l].level_number = l;
    levels[l].face_level = &inputs.detail_levels[l - 1].level;
  }
  std::set<std::string> names;
  for (const FacePlan& face : crowd) names.insert(face.attachments.begin(), face.attachments.end());
  std::vector<const Attachment*> items;
  for (const std::string& name : names) items.push_back(&inputs.attachments.at(name));
  if (body != nullptr) items.push_back(body);
  std::vector<std::vector<DetailLevel>> of_items(items.size());
  parallel_for_each(items.size(), [&](std::size_t i) {
    // The reduced body keeps every vertex of the ring at the neck, because faces join the body at
    // this ring.
    const Borders borders = items[i] == body ? Borders::kKeep : Borders::kCollapse;
    of_items[i] = levels_of(*items[i], inputs.detail_levels, borders);
  });
  for (std::size_t i = 0; i < items.size(); ++i) {
    for (std::size_t l = 1; l < levels.size(); ++l) {
      levels[l].attachments.emplace(items[i], std::move(of_items[i][l - 1]));
    }
  }
  return levels;
}

GivenNormals normals_at_neck_ring(const Inputs& inputs, const Attachment& item,
                                  const DetailLevel* level) {
  if (!inputs.heads_on_body || !inputs.heads_on_body->is_body(item)) return {};
  GivenNormals fixed{inputs.heads_on_body->body_rim, inputs.heads_on_body->seam.normals};
  if (level == nullptr) return fixed;
  for (std::uint32_t& vertex : fixed.vertices) {
    const auto found = std::ranges::lower_bound(level->vertices, vertex);
    vertex = static_cast<std::uint32_t>(found - level->vertices.begin());
  }
  return fixed;
}

}  // namespace crowdface
