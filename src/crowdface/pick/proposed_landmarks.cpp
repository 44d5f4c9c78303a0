// SPDX-License-Identifier: Apache-2.0
#include "crowdface/pick/proposed_landmarks.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "crowdface/core/error.h"
#include "crowdface/paint/bands.h"
#include "crowdface/paint/face_marks.h"

namespace crowdface {
namespace {

/// Casts rays at a head from the front. Coordinates: across (along the side axis) and height.
class FrontView {
 public:
  FrontView(const PickableMesh& mesh, const HeadAxes& axes)
      : mesh_(mesh), axes_(axes), side_(axes.side()) {
    const Eigen::Vector3d middle = (mesh.low() + mesh.high()) / 2;
    start_ = middle.dot(axes.front) + (mesh.high() - mesh.low()).norm();
  }
  std::optional<PickableMesh::Met> look(double across, double height) const {
    return mesh_.meet(across * side_ + height * axes_.up + start_ * axes_.front, -axes_.front);
  }
  std::optional<PickedPlace> place(double across, double height) const {
    return mesh_.cast(across * side_ + height * axes_.up + start_ * axes_.front, -axes_.front,
                      kBesideMm);
  }
  double across(const Eigen::Vector3d& point) const { return point.dot(side_); }
  double height(const Eigen::Vector3d& point) const { return point.dot(axes_.up); }
  double front(const Eigen::Vector3d& point) const { return point.dot(axes_.front); }
  const HeadAxes& axes() const { return axes_; }
  const PickableMesh& mesh() const { return mesh_; }

 private:
  static constexpr double kBesideMm = 6;
  const PickableMesh& mesh_;
  const HeadAxes& axes_;
  Eigen::Vector3d side_;
  double start_ = 0;
};

using Proposals = std::map<std::string, std::uint32_t>;

void add(const std::string& name, const std::optional<PickedPlace>& place, Proposals& proposals) {
  if (place) proposals[name] = place->vertex;
}

/// The point of the midline profile between the heights `low` and `high` where `measure` is
/// largest.
template <class Measure>
std::optional<Eigen::Vector3d> best_of_outline(const FrontView& view, double middle, double low,
                                               double high, const Measure& measure) {
  constexpr int kSteps = 200;
  std::optional<Eigen::Vector3d> best;
  double most = -std::numeric_limits<double>::infinity();
  for (int i = 0; i <= kSteps; ++i) {
    const auto met = view.look(middle, low + (high - low) * i / kSteps);
    if (!met || !met->is_skin) continue;
    const double value = measure(met->point);
    if (value <= most) continue;
    most = value;
    best = met->point;
  }
  return best;
}

void propose_middle(const FrontView& view, const FaceMarks& marks, Proposals& proposals) {
  // Lengths as fractions of the distance from mouth to eyes (about 65 mm).
  constexpr double kAroundTip = 0.08, kLipBegins = 0.02, kLipEnds = 0.15;
  // As a fraction of the distance from the lowest point of the chin to the mouth.
  constexpr double kChinEnds = 0.45;
  const double face = marks.face(), mouth = marks.mouth;
  const auto foremost = [&](double low, double high) {
    return best_of_outline(view, marks.middle, low, high,
                           [&](const Eigen::Vector3d& point) { return view.front(point); });
  };
  const auto keep = [&](const char* name, const std::optional<Eigen::Vector3d>& point) {
    if (point) add(name, view.place(marks.middle, view.height(*point)), proposals);
  };
  const auto tip = foremost(marks.tip - kAroundTip * face, marks.tip + kAroundTip * face);
  const auto lip = foremost(mouth + kLipBegins * face, mouth + kLipEnds * face);
  keep("nose_tip", tip);
  keep("lip_upper", lip);
  keep("lip_lower", foremost(mouth - kLipEnds * face, mouth - kLipBegins * face));
  keep("chin", foremost(marks.chin, marks.chin + kChinEnds * (mouth - marks.chin)));
  add("nose_bridge", view.place(marks.middle, marks.bridge), proposals);
  if (!tip || !lip) return;
  // Base of the nose: the point farthest behind the line from the tip of the nose to the upper lip.
  const double run = view.height(*tip) - view.height(*lip);
  const double slope = (view.front(*tip) - view.front(*lip)) / run;
  keep("nose_base", best_of_outline(view, marks.middle, view.height(*lip), view.height(*tip),
                                    [&](const Eigen::Vector3d& point) {
                                      const double line =
                                          view.front(*lip) +
                                          slope * (view.height(point) - view.height(*lip));
                                      return line - view.front(point);
                                    }));
}

using Places = std::vector<Eigen::Vector3d>;

Eigen::Vector3d farthest(const Places& places, const Eigen::Vector3d& direction) {
  return *std::ranges::max_element(
      places, {}, [&](const Eigen::Vector3d& place) { return place.dot(direction); });
}

/// Points of the eyeball that are visible between the lids from the front.
Places find_opening(const FrontView& view, const Eigen::Vector3d& centre, double radius) {
  constexpr int kSteps = 48;  // in each direction
  constexpr double kFar = 1.2;
  Places opening;
  for (int x = -kSteps; x <= kSteps; ++x) {
    for (int y = -kSteps; y <= kSteps; ++y) {
      const auto met = view.look(view.across(centre) + kFar * radius * x / kSteps,
                                 view.height(centre) + kFar * radius * y / kSteps);
      if (met && !met->is_skin && (met->point - centre).norm() < kFar * radius) {
        opening.push_back(met->point);
      }
    }
  }
  return opening;
}

void propose_eye(const FrontView& view, double middle, const Eigen::Vector3d& centre, double radius,
                 Proposals& proposals) {
  // kHalfSlit: half the width of the strip in the middle of the lids, in eyeball radii.
  constexpr double kReachMm = 6, kHalfSlit = 0.05;
  const Places opening = find_opening(view, centre, radius);
  if (opening.empty()) return;
  const HeadAxes& axes = view.axes();
  const bool is_left = view.across(centre) > middle;
  const std::string half = is_left ? "_left" : "_right";
  const Eigen::Vector3d outwards = is_left ? axes.side() : Eigen::Vector3d(-axes.side());
  const auto keep = [&](const char* name, const Eigen::Vector3d& seen) {
    add(name + half, view.mesh().nearest(seen, axes.front, 0, kReachMm), proposals);
  };
  const Eigen::Vector3d outer = farthest(opening, outwards), inner = farthest(opening, -outwards);
  keep("eye_outer", outer);
  keep("eye_inner", inner);
  const double between = (view.across(outer) + view.across(inner)) / 2;
  Places slit;
  for (const Eigen::Vector3d& point : opening) {
    if (std::abs(view.across(point) - between) <= kHalfSlit * radius) slit.push_back(point);
  }
  if (slit.empty()) return;
  keep("lid_upper", farthest(slit, axes.up));
  keep("lid_lower", farthest(slit, -axes.up));
}

}  // namespace

std::map<std::string, std::uint32_t> propose_landmarks(const WrapTemplate& shape,
                                                       const PickableMesh& mesh) {
  Proposals proposals;
  if (!shape.face) return proposals;
  const FaceMarks marks = marks_of_face(shape.topology, head_shape(shape), *shape.face);
  const FrontView view(mesh, marks.axes);
  propose_middle(view, marks, proposals);
  for (const Part& part : shape.parts.parts) {
    if (!part.eyeball) continue;
    const ComponentShape& ball = shape.parts.shapes[part.ball];
    propose_eye(view, marks.middle, ball.centre, ball.radius, proposals);
  }
  return proposals;
}

PickableMesh pickable(const WrapTemplate& shape, const Positions& positions) {
  std::vector<Triangle> skin = shape.skin.triangles, others;
  for (Triangle& t : skin) {
    for (std::uint32_t& v : t) v = shape.skin.vertices[v];
  }
  for (const Triangle& t : solid_triangles(shape)) {
    const PartClass of_part = shape.parts.classes[shape.components.of_vertex[t[0]]];
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
    regions.of_vertex.push_back(static_cast<std::size_t>(most));
  }
  return regions;
}

MirrorPlane middle_plane(const WrapTemplate& shape, const Positions& positions) {
  HeadShape head = head_shape(shape);
  head.positions = positions;
  return {shape.axes.side(), middle_of(shape.topology, head, shape.axes)};
}

}  // namespace crowdface
