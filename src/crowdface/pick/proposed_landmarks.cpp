// SPDX-License-Identifier: Apache-2.0
#include "crowdface/pick/proposed_landmarks.h"

#include <algorithm>
#include <vector>

#include "crowdface/core/error.h"
#include "crowdface/paint/bands.h"
#include "crowdface/paint/face_landmarks.h"
#include "crowdface/paint/face_marks.h"

namespace crowdface {

std::map<std::string, std::uint32_t> propose_landmarks(const WrapTemplate& shape) {
  std::map<std::string, std::uint32_t> proposals;
  if (!shape.face) return proposals;
  const FaceLandmarks found = find_face_landmarks(shape.topology, shape.components, shape.parts,
                                                  head_shape(shape), *shape.face);
  for (const auto& [name, place] : found.points) {
    const auto nearest = std::ranges::max_element(place.shares) - place.shares.begin();
    proposals[name] = place.corners[static_cast<std::size_t>(nearest)];
  }
  return proposals;
}

PickableMesh make_pickable(const WrapTemplate& shape, const Positions& positions) {
  std::vector<Triangle> skin = shape.skin.triangles, others;
  for (Triangle& t : skin) {
    for (std::uint32_t& v : t) v = shape.skin.vertices[v];
  }
  for (const Triangle& t : occluding_triangles(shape)) {
    const PartClass of_part = shape.parts.classes[shape.components.component_of_vertex[t[0]]];
    if (of_part != PartClass::kSkin) others.push_back(t);
  }
  return {positions, std::move(skin), others};
}

SkinRegions face_regions(const WrapTemplate& shape) {
  if (!shape.face) return {};
  const HeadShape head = head_shape(shape);
  const FaceMarks marks = marks_of_face(shape.topology, head, *shape.face);
  std::vector<Band> bands = {Band::kBrow, Band::kNose, Band::kMouth};
  for (const Band more : {Band::kEars, Band::kNeck}) {
    bands.push_back(more);
    try {
      propose_bands(shape.topology, head, marks, bands);
    } catch (const InvalidInput&) {
      bands.pop_back();
    }
  }
  const auto alpha = propose_bands(shape.topology, head, marks, bands);
  SkinRegions regions;
  for (const Band band : bands) {
    for (const auto& [name, known] : kBandNames) {
      if (known == band) regions.names.emplace_back(name);
    }
  }
  for (const std::uint32_t v : shape.skin.vertices) {
    Index most = 0;
    alpha.row(v).maxCoeff(&most);
    regions.region_of_vertex.push_back(static_cast<std::size_t>(most));
  }
  return regions;
}

MirrorPlane symmetry_plane(const WrapTemplate& shape, const Positions& positions) {
  HeadShape head = head_shape(shape);
  head.positions = positions;
  return {shape.axes.side(), symmetry_offset(shape.topology, head, shape.axes)};
}

}  // namespace crowdface
