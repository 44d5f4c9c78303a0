// SPDX-License-Identifier: Apache-2.0
#include "crowdface/pick/proposed_landmarks.h"

#include <algorithm>
#include <vector>

#include "crowdface/core/error.h"
#include "crowdface/paint/face_marks.h"
#include "crowdface/paint/mask_bands.h"

namespace crowdface {

FaceLandmarks find_face_landmarks(const WrapTemplate& wrap_template) {
  if (!wrap_template.face_match) return {};
  return find_face_landmarks(wrap_template.topology, wrap_template.components, wrap_template.parts,
                             head_shape(wrap_template), *wrap_template.face_match);
}

std::map<std::string, std::uint32_t> propose_landmarks(const WrapTemplate& wrap_template) {
  std::map<std::string, std::uint32_t> proposals;
  for (const auto& [name, place] : find_face_landmarks(wrap_template).points) {
    const auto nearest = std::ranges::max_element(place.barycentric) - place.barycentric.begin();
    proposals[name] = place.corners[static_cast<std::size_t>(nearest)];
  }
  return proposals;
}

PickableMesh make_pickable(const WrapTemplate& wrap_template, const Positions& positions) {
  std::vector<Triangle> skin = wrap_template.skin.triangles, others;
  for (Triangle& t : skin) {
    for (std::uint32_t& v : t) v = wrap_template.skin.vertices[v];
  }
  for (const Triangle& t : occluding_triangles(wrap_template)) {
    const PartClass of_part =
        wrap_template.parts.classes[wrap_template.components.component_of_vertex[t[0]]];
    if (of_part != PartClass::kSkin) others.push_back(t);
  }
  return {positions, std::move(skin), others};
}

SkinRegions face_regions(const WrapTemplate& wrap_template) {
  if (!wrap_template.face_match) return {};
  const HeadShape head = head_shape(wrap_template);
  const FaceMarks marks = marks_of_face(wrap_template.topology, head, *wrap_template.face_match);
  std::vector<MaskBand> bands = {MaskBand::kBrow, MaskBand::kNose, MaskBand::kMouth};
  for (const MaskBand more : {MaskBand::kEars, MaskBand::kNeck}) {
    bands.push_back(more);
    try {
      propose_bands(wrap_template.topology, head, marks, bands);
    } catch (const InvalidInput&) {
      bands.pop_back();
    }
  }
  const auto alpha = propose_bands(wrap_template.topology, head, marks, bands);
  SkinRegions regions;
  for (const MaskBand band : bands) {
    for (const auto& [name, known] : kMaskBandNames) {
      if (known == band) regions.names.emplace_back(name);
    }
  }
  for (const std::uint32_t v : wrap_template.skin.vertices) {
    Index most = 0;
    alpha.row(v).maxCoeff(&most);
    regions.region_of_vertex.push_back(static_cast<std::size_t>(most));
  }
  return regions;
}

MirrorPlane symmetry_plane(const WrapTemplate& wrap_template, const Positions& positions) {
  HeadShape head = head_shape(wrap_template);
  head.positions = positions;
  return {wrap_template.axes.side(),
          symmetry_offset(wrap_template.topology, head, wrap_template.axes)};
}

}  // namespace crowdface
