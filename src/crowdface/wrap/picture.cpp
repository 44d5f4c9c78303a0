// SPDX-License-Identifier: Apache-2.0
// The part of report.h that draws.
#include <array>

#include "crowdface/io/image.h"
#include "crowdface/render/contact_sheet.h"
#include "crowdface/render/face_renderer.h"
#include "crowdface/render/heat_colours.h"
#include "crowdface/wrap/report.h"
#include "crowdface/wrap/scan_surface.h"

namespace crowdface {
namespace {

constexpr int kSidePx = 320;
constexpr double kScaleEndMm = 2;  // where the heat map's scale ends
constexpr std::array<View, 3> kViews = {View::kFront, View::kThreeQuarter, View::kProfile};

/// Eyeballs are shown as such, lashes and tear lines not at all.
Surfaces surfaces_of(const WrapTemplate& shape) {
  std::vector<SurfaceKind> of_component(shape.parts.classes.size(), SurfaceKind::kSkin);
  for (const Part& part : shape.parts.parts) {
    for (const std::uint32_t c : part.components) {
      of_component[c] = part.part_class == PartClass::kBound ? SurfaceKind::kHidden
                        : part.eyeball && c == part.ball     ? SurfaceKind::kEye
                        : part.eyeball                       ? SurfaceKind::kHidden
                                                             : SurfaceKind::kTeeth;
    }
  }
  Surfaces surfaces;
  for (Index f = 0; f < shape.topology.face_count(); ++f) {
    surfaces.kinds.push_back(of_component[shape.components.of_vertex[shape.topology.face(f)[0]]]);
  }
  return surfaces;
}

}  // namespace

std::string wrap_picture(const WrapTemplate& shape, const Scan& scan, const WrapResult& result,
                         const HeadFrame& frame, const std::string& title) {
  const Positions standing = inverse(result.pose).apply(scan.positions);
  const std::array<const Positions*, 1> heads = {&result.positions};
  const std::vector<Camera> cameras = fit_cameras(heads, frame, kViews, {.cut_below = 0.1});
  const RenderOptions options{.size_px = kSidePx, .front = frame.front};
  const Topology scan_topology = topology_of(scan.triangles, scan.positions.rows());
  const FaceRenderer of_scan(scan_topology, options, {}, &standing),
      of_head(shape.topology, options, surfaces_of(shape), &result.positions);
  Eigen::VectorXd distances = Eigen::VectorXd::Zero(shape.topology.vertex_count);
  for (std::size_t i = 0; i < shape.skin.vertices.size(); ++i) {
    distances(shape.skin.vertices[i]) = result.distance_mm(static_cast<Index>(i));
  }
  const VertexColours colours = heat_colours(distances, kScaleEndMm);
  std::vector<Rgb8Image> scans, wrapped, heat;
  for (const Camera& camera : cameras) {
    scans.push_back(of_scan.render(standing, camera));
    wrapped.push_back(of_head.render(result.positions, camera));
    heat.push_back(of_head.render(result.positions, camera, &colours));
  }
  const std::vector<SheetCell> cells = {{side_by_side(scans), "scan"},
                                        {side_by_side(wrapped), "wrapped template"},
                                        {side_by_side(heat), "distance to the scan"}};
  const Rgb8Image sheet =
      contact_sheet(cells, {.columns = 1, .title = title, .legend = HeatLegend{kScaleEndMm, "mm"}});
  return encode_png(sheet.width, sheet.height, 3, sheet.pixels);
}

}  // namespace crowdface
