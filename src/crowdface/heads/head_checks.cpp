// SPDX-License-Identifier: Apache-2.0
#include "crowdface/heads/head_checks.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "crowdface/core/parallel.h"
#include "crowdface/core/selection.h"
#include "crowdface/core/text.h"
#include "crowdface/core/units.h"
#include "crowdface/heads/named_parts.h"
#include "crowdface/mesh/alignment.h"
#include "crowdface/mesh/all_columns.h"
#include "crowdface/mesh/same_graph.h"
#include "crowdface/mesh/winding.h"
#include "crowdface/paint/face_marks.h"

namespace crowdface {
namespace {

constexpr double kSameUv = 1e-4;

/// Describes the first corner whose texture coordinates differ between the meshes; empty if there
/// is none. Compares the coordinates and not their indices, because programs renumber texture
/// coordinates on export.
std::string first_uv_difference(const HeadMesh& expected, const HeadMesh& found) {
  const auto text = [](const TextureCoordinates& uvs, std::uint32_t row) {
    return row == kNoIndex ? std::string("none") : concat(uvs(row, 0), ' ', uvs(row, 1));
  };
  for (Index f = 0; f < expected.topology.face_count(); ++f) {
    const auto [begin, end] = expected.topology.corners(f);
    for (std::uint32_t c = begin; c < end; ++c) {
      const std::uint32_t a =
          expected.topology.corner_uvs.empty() ? kNoIndex : expected.topology.corner_uvs[c];
      const std::uint32_t b =
          found.topology.corner_uvs.empty() ? kNoIndex : found.topology.corner_uvs[c];
      if (a == kNoIndex && b == kNoIndex) continue;
      if (a != kNoIndex && b != kNoIndex &&
          (expected.uvs.row(a) - found.uvs.row(b)).cwiseAbs().maxCoeff() <= kSameUv) {
        continue;
      }
      return concat("face ", f + 1, ", corner ", c - begin + 1,
                    ": expected the texture coordinate ", text(expected.uvs, a), ", found ",
                    text(found.uvs, b));
    }
  }
  return {};
}

/// Whether each polygon of `found` is also a polygon of `first`.
bool has_only_polygons_of(const Topology& first, const Topology& found) {
  std::set<std::vector<std::uint32_t>> faces;
  for (Index f = 0; f < first.face_count(); ++f) {
    const auto face = first.face(f);
    faces.emplace(face.begin(), face.end());
  }
  for (Index f = 0; f < found.face_count(); ++f) {
    const auto face = found.face(f);
    if (!faces.contains({face.begin(), face.end()})) return false;
  }
  return true;
}

/// If the proportions of a mesh clearly differ from the proportions of another head, returns the
/// end of a message that asks whether the mesh is only a part of a head; otherwise empty.
std::string part_of_head(const Positions& other, const Positions& found) {
  constexpr double kMinShare = 0.7;  // heads of people differ less in their proportions
  const auto sizes = [](const Positions& positions) -> Eigen::Array3d {
    return (positions.colwise().maxCoeff() - positions.colwise().minCoeff()).transpose().array();
  };
  const Eigen::Array3d shares = sizes(found) / sizes(other);
  if (!(shares.minCoeff() < kMinShare * shares.maxCoeff())) return {};
  return concat("; it is ", format_fixed(shares.x(), 2), ", ", format_fixed(shares.y(), 2), " and ",
                format_fixed(shares.z(), 2),
                " times as large along X, Y and Z as the other: is it only a part of a head?");
}

/// Whether an OBJ file ends without a line break, so that its last line may be cut off.
bool ends_within_line(const ObjFile& file) {
  const std::string_view text = file.file.bytes();
  return !text.empty() && text.back() != '\n' && text.back() != '\r';
}

/// Explains why a head has another topology than most heads (usually an export setting), and
/// how to fix the difference.
std::string cause_of_difference(const HeadFile& usual_head, const HeadFile& head) {
  const Topology &usual = usual_head.mesh->topology, &found = head.mesh->topology;
  const auto triangles = [](const Topology& topology) {
    return topology.corner_count() - 2 * topology.face_count();
  };
  const bool same_vertices = usual.vertex_count == found.vertex_count;
  const bool same_faces = usual.face_count() == found.face_count();
  Topology reversed = found;
  reverse_faces(reversed);
  if (same_vertices && has_same_polygons(usual, reversed)) {
    return "; its polygons have the reverse order of corners, so that one of the two heads is "
           "mirrored: mirror it back (scale it by -1 along one axis, and flip its polygons), or "
           "export both with the same axes";
  }
  if (same_vertices && same_faces) {
    return "; it has as many vertices and polygons, but in another order or with other "
           "connections: export it again and keep the vertex order, or wrap another head onto it "
           "(crowdface wrap)";
  }
  if (same_vertices && triangles(usual) == triangles(found)) {
    const bool is_cut = found.face_count() > usual.face_count();
    const bool has_order = has_same_polygons(usual, found);
    return concat(is_cut ? "; its polygons were cut into triangles"
                         : "; its triangles were joined to polygons",
                  has_order ? "" : ", and its vertices are in another order", ": export it ",
                  is_cut ? "without triangulating" : "like the others",
                  has_order ? ""
                            : " and keep the vertex order, or wrap another head onto it "
                              "(crowdface wrap)");
  }
  if (same_vertices && has_only_polygons_of(usual, found)) {
    return concat("; it lacks ", usual.face_count() - found.face_count(),
                  " of the polygons: show hidden parts and export all parts again");
  }
  if (triangles(usual) == triangles(found)) {
    return found.vertex_count > usual.vertex_count
               ? "; its vertices were split, at texture seams or hard edges: export it with "
                 "vertices shared"
               : "; some of its vertices were joined: export it without welding or merging";
  }
  return concat(
      "; it has ", found.vertex_count, " vertices and ", found.face_count(),
      " polygons, the other ", usual.vertex_count, " and ", usual.face_count(),
      part_of_head(usual_head.file.positions, head.file.positions),
      ": it is another mesh; to fit the mesh of the others to a scan, use crowdface wrap; "
      "hair, glasses and the like belong in the config's section attachments");
}

}  // namespace

void compare_meshes(const std::vector<HeadFile>& heads, Problems& problems) {
  if (heads.empty()) return;
  // If several meshes are equally frequent, the first of these is the usual mesh.
  const auto frequency = [&](const HeadFile& head) {
    return std::ranges::count(heads, head.mesh, &HeadFile::mesh);
  };
  const HeadFile& usual_head = *std::ranges::max_element(heads, {}, frequency);
  for (const HeadFile& head : heads) {
    if (head.mesh == usual_head.mesh) continue;
    const HeadMesh &usual = *usual_head.mesh, &mesh = *head.mesh;
    std::string difference = first_difference(usual.topology, mesh.topology);
    if (!difference.empty()) {
      difference += cause_of_difference(usual_head, head);
    } else {
      difference = first_uv_difference(usual, mesh);
      if (!difference.empty()) {
        difference +=
            "; give all heads the texture coordinates of one (Maya: Transfer Attributes, Blender: "
            "Copy UV Maps)";
      }
    }
    if (difference.empty()) continue;
    if (ends_within_line(head.file)) {
      difference +=
          "; its text ends within a line: if the file is cut off, copy or export it again";
    }
    problems.add(ExitCode::kBadData, concat(head.file.path.string(), ": not the same mesh as ",
                                            usual_head.file.path.string(), ": ", difference));
  }
}

std::optional<std::string> check_orientation_and_size(const Config& config, const Inputs& inputs) {
  if (config.faces.align == Align::kNone) return std::nullopt;
  // Use only the skin, without the eyeballs: find_face_marks recognises the face by the relief of
  // the skin.
  const HeadShape head{inputs.mean_head, skin_of(inputs), {}};
  const Topology& topology = inputs.head_set.topology;
  const Orientation asked{config.faces.up, config.faces.front};
  auto marks = find_face_marks(topology, head, axes_of(asked));
  if (!marks) {
    const auto found = find_orientation(topology, head);
    if (!found || *found == asked) {
      const auto coarse = long_edges_message(topology, head, axes_of(asked));
      if (!coarse) return std::nullopt;
      return concat("no face is found on the mean head, so units, up and front are not checked: ",
                    *coarse);
    }
    throw InvalidInput(
        concat("the heads look along ", name_of(found->front), " with ", name_of(found->up),
               " up, but faces.front is ", name_of(asked.front), " and faces.up is ",
               name_of(asked.up), "; set up: ", name_of(found->up),
               " and front: ", name_of(found->front), " (faces.align: none skips this check)"));
  }
  // Limits of the distance from the eyes to the mouth. Children have at least 45 mm, adults at most
  // about 85 mm; the limits leave a margin.
  constexpr double kMinMm = 35, kMaxMm = 120;
  const double mm = marks->eye_to_mouth() * mm_per(config.faces.units);
  if (mm >= kMinMm && mm <= kMaxMm) return std::nullopt;
  const auto up = inputs.head_set.heads[0].positions.col(config.faces.up.index);
  const double units = up.maxCoeff() - up.minCoeff();
  constexpr double kTypicalMm = 65;
  LengthUnit fitting = nearest_unit(marks->eye_to_mouth(), kTypicalMm, kLengthUnits);
  const double other = marks->eye_to_mouth() * mm_per(fitting);
  if (other < kMinMm || other > kMaxMm) fitting = fitting_unit(marks->eye_to_mouth(), kTypicalMm);
  throw InvalidInput(
      concat("the first head is ", format_fixed(units, 2), " units high; with faces.units ",
             name_of(config.faces.units), " it is ",
             format_fixed(units * mm_per(config.faces.units) / 10, 1), " cm high and ",
             format_fixed(mm, 0),
             " mm from the eyes to the mouth, where people have about 65 mm; set units: ",
             name_of(fitting), " (faces.align: none skips this check)"));
}

std::vector<std::string> same_person_warnings(const Inputs& inputs, double mm) {
  constexpr Index kSamples = 2000;
  // Two heads may be the same person if their distance is at most kMaxMm and small for this crowd:
  // at most kMaxNearestRatio times the median, over all other heads, of the distance to the nearest
  // head. Heads at most kIdenticalMm apart are copies of one head; the median does not matter then.
  constexpr double kMaxMm = 1, kMaxNearestRatio = 0.4, kIdenticalMm = 0.01;
  const std::vector<Head>& heads = inputs.head_set.heads;
  std::vector<Positions> sampled(heads.size());
  std::vector<Index> rows;
  for (Index v = 0; v < inputs.mean_head.rows(); ++v) {
    if (inputs.skin_components.component_of_vertex[static_cast<std::size_t>(v)] ==
        inputs.skin_components.largest())
      rows.push_back(v);
  }
  const std::size_t step =
      std::max<std::size_t>(1, rows.size() / static_cast<std::size_t>(kSamples));
  std::vector<Index> some;
  for (std::size_t i = 0; i < rows.size(); i += step) some.push_back(rows[i]);
  if (some.size() < 3) return {};
  const auto distance = [&](std::size_t a, std::size_t b) {
    const Positions from = heads[a].positions(some, kAllColumns),
                    to = heads[b].positions(some, kAllColumns);
    const Positions moved = fit_similarity(from, to, ScaleFit::kRigid).apply(from);
    return mm * std::sqrt((moved - to).rowwise().squaredNorm().mean());
  };
  std::vector<std::vector<double>> apart(heads.size(), std::vector<double>(heads.size(), 0));
  parallel_for_each(heads.size(), [&](std::size_t a) {
    for (std::size_t b = a + 1; b < heads.size(); ++b) apart[a][b] = distance(a, b);
  });
  std::vector<double> nearest;
  for (std::size_t a = 0; a < heads.size(); ++a) {
    double least = std::numeric_limits<double>::max();
    for (std::size_t b = 0; b < heads.size(); ++b) {
      if (b != a) least = std::min(least, apart[std::min(a, b)][std::max(a, b)]);
    }
    nearest.push_back(least);
  }
  std::vector<std::string> warnings;
  for (std::size_t a = 0; a < heads.size(); ++a) {
    for (std::size_t b = a + 1; b < heads.size(); ++b) {
      const double mean = apart[a][b];
      std::vector<double> others;
      for (std::size_t c = 0; c < heads.size(); ++c) {
        if (c != a && c != b) others.push_back(nearest[c]);
      }
      const double middle =
          others.empty() ? 0 : nth_smallest(std::move(others), (heads.size() - 2) / 2);
      if (mean > kMaxMm || (mean > kMaxNearestRatio * middle && mean > kIdenticalMm)) continue;
      warnings.push_back(concat("heads ", heads[a].name, " and ", heads[b].name, " are ",
                                format_fixed(mean, 2),
                                " mm apart (rms): are they the same person? Faces that mix the two "
                                "then vary less than expected"));
    }
  }
  return warnings;
}

std::vector<std::string> few_decimals_warnings(const std::vector<HeadFile>& heads, double mm) {
  constexpr Index kMinVertices = 500, kSampled = 2000;
  constexpr double kMaxStepMm = 0.1, kRounding = 0.01;  // single precision changes the last digits
  std::vector<std::string> warnings;
  for (const HeadFile& head : heads) {
    const Positions& positions = head.file.positions;
    if (positions.rows() < kMinVertices) continue;
    const auto is_rounded_to = [&](double step) {
      for (Index v = 0; v < positions.rows();
           v += std::max<Index>(1, positions.rows() / kSampled)) {
        const Eigen::Array3d steps = positions.row(v).transpose().array() / step;
        if (!((steps - steps.round()).abs() <= kRounding).all()) return false;
      }
      return true;
    };
    double step = 1;
    while (step * mm > kMaxStepMm && !is_rounded_to(step)) step /= 10;
    if (step * mm <= kMaxStepMm) continue;
    warnings.push_back(concat(head.file.path.string(), ": its positions are rounded to ", step * mm,
                              " mm, which makes the surface rough: export more decimals, or in a "
                              "smaller unit"));
  }
  return warnings;
}

std::optional<std::string> far_from_origin_warning(const Config& config, const Inputs& inputs) {
  constexpr double kMinMm = 0.01, kHalfStep = 0x1p-24;
  double farthest = 0;
  for (const Head& head : inputs.head_set.heads) {
    farthest = std::max(farthest, head.positions.cwiseAbs().maxCoeff());
  }
  const double farthest_mm = farthest * mm_per(config.faces.units);
  if (farthest_mm * kHalfStep <= kMinMm) return std::nullopt;
  return concat("heads reach ", format_fixed(farthest_mm / 1000, 0),
                " m from the origin, where single precision rounds positions by up to ",
                format_fixed(farthest_mm * kHalfStep, 2), " mm: move the heads to the origin");
}

}  // namespace crowdface
