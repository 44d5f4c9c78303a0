// SPDX-License-Identifier: Apache-2.0
// Counts skin that passes through skin in a crowd's faces and in their shapes: what docs/shapes.md
// tabulates.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <iterator>
#include <optional>
#include <string>

#include "crowdface/core/text.h"
#include "crowdface/heads/cache_folder.h"
#include "crowdface/heads/face_shapes.h"
#include "crowdface/heads/named_parts.h"
#include "crowdface/io/single_precision.h"
#include "crowdface/mesh/triangles.h"
#include "crowdface/mesh/vector3.h"
#include "crowdface/run/casting.h"
#include "crowdface/run/face_builder.h"
#include "crowdface/run/job.h"
#include "crowdface/shapes/gap_preserver.h"
#include "crowdface/validity/intersections.h"

#include "measured_lids.h"

using namespace crowdface;

namespace {

struct Counted {
  Index of_template = 0, unchanged = 0, carried = 0, most = 0, faces = 0;
};

class Crossings {
 public:
  explicit Crossings(const Inputs& inputs)
      : triangles_(triangles_of(inputs.head_set.topology, inputs.skin_components,
                                inputs.skin_components.largest())),
        vertex_count_(inputs.head_set.topology.vertex_count) {}

  std::vector<TrianglePair> of(const Positions& positions) const {
    return intersecting_pairs(triangles_, positions, near_pairs(triangles_, positions, 0));
  }
  /// Triangles that pass through others in `mesh` and are none of those of the others.
  Index beyond(const std::vector<TrianglePair>& of_template,
               const std::vector<TrianglePair>& at_rest, const Positions& mesh) const {
    std::vector<TrianglePair> known = of_template;
    known.insert(known.end(), at_rest.begin(), at_rest.end());
    return NewIntersections(triangles_, vertex_count_, known).count(of(mesh));
  }
  Index all(const std::vector<TrianglePair>& pairs) const {
    return NewIntersections(triangles_, vertex_count_, {}).count(pairs);
  }

 private:
  std::vector<Triangle> triangles_;
  Index vertex_count_;
};

Positions in_shape(const Positions& face, const Displacements& moves) {
  Positions mesh = face;
  moves.add_to(mesh);
  return mesh;
}

constexpr double kTenthOfMm = 0.01;  // of centimetres

/// Of blinks of a crowd in centimetres.
struct LidFigures {
  std::size_t closing = 0, closed = 0, deep = 0, deep_at_rest = 0, deeper = 0, blinks = 0;
  double widest = 0, max_deeper = 0, deepest = 0, of_template = 0;

  /// \param moves  of the face
  void add(MeasuredLids& eye, const Positions& neutral, const Positions& face,
           const Displacements& of_template_moves, const Displacements& moves) {
    const BallRadii ball = eye.map_in(face), there = eye.map_in(neutral);
    const Positions closed_there = in_shape(neutral, of_template_moves),
                    here = in_shape(face, moves);
    eye.find_points(neutral, closed_there);
    const auto wanted = eye.gaps(closed_there), now = eye.gaps(here);
    ++blinks;
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      if (!wanted[i] || !now[i] || *wanted[i] > 3 * kTenthOfMm) continue;
      ++closing;
      if (*now[i] <= 3 * kTenthOfMm) ++closed;
      widest = std::max(widest, *now[i]);
    }
    const auto in_template = eye.depths(there, closed_there), at_rest = eye.depths(ball, face),
               in_face = eye.depths(ball, here);
    for (std::size_t i = 0; i < in_face.size(); ++i) {
      const double may_be = std::max(2 * kTenthOfMm, at_rest[i]);
      if (in_face[i] > 2 * kTenthOfMm) ++deep;
      if (at_rest[i] > 2 * kTenthOfMm) ++deep_at_rest;
      if (in_face[i] > may_be + kTenthOfMm / 2) ++deeper;
      max_deeper = std::max(max_deeper, in_face[i] - may_be);
      deepest = std::max(deepest, in_face[i]);
      of_template = std::max(of_template, in_template[i]);
    }
  }
};

/// Shapes made to be added to another are looked at where they are.
Displacements with_prerequisite(const std::vector<Displacements>& shapes, std::size_t shape,
                                std::optional<std::size_t> prerequisite) {
  if (!prerequisite) return shapes[shape];
  const Displacements &one = shapes[shape], &other = shapes[*prerequisite];
  Displacements both;
  std::set_union(one.vertices.begin(), one.vertices.end(), other.vertices.begin(),
                 other.vertices.end(), std::back_inserter(both.vertices));
  both.moves.setZero(static_cast<Index>(both.vertices.size()), 3);
  for (const Displacements* moves : {&one, &other}) {
    for (std::size_t i = 0; i < moves->vertices.size(); ++i) {
      const auto at = std::ranges::lower_bound(both.vertices, moves->vertices[i]);
      both.moves.row(at - both.vertices.begin()) += moves->moves.row(static_cast<Index>(i));
    }
  }
  return both;
}

/// Of what lies within 0.02 mm of where it was on the template: how far from that on faces.
struct LipFigures {
  double carried = 0, unchanged = 0;

  void add(const GapPreserver& lips, const Positions& neutral, const Positions& face,
           const Displacements& of_template, const Displacements& moves) {
    const auto rest = lips.measure_gaps(neutral),
               there = lips.measure_gaps(in_shape(neutral, of_template));
    const auto before = lips.measure_gaps(face), after = lips.measure_gaps(in_shape(face, moves)),
               same = lips.measure_gaps(in_shape(face, of_template));
    for (std::size_t p = 0; p < rest.size(); ++p) {
      if (std::abs(there[p] - rest[p]) > kTenthOfMm / 5) continue;
      carried = std::max(carried, std::abs(after[p] - before[p]));
      unchanged = std::max(unchanged, std::abs(same[p] - before[p]));
    }
  }
};

/// How much more or less a shape stretches edges of a face than the template's, as natural
/// logarithms.
void add_stretch(const std::vector<Triangle>& skin, const Positions& neutral, const Positions& face,
                 const Displacements& of_template, const Displacements& moves,
                 std::vector<double>& stretch) {
  const Positions there = in_shape(neutral, of_template), here = in_shape(face, moves);
  std::vector<bool> moved(static_cast<std::size_t>(neutral.rows()), false);
  for (const std::uint32_t v : of_template.vertices) moved[v] = true;
  for (const Triangle& triangle : skin) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = triangle[k], b = triangle[(k + 1) % 3];
      if (a > b || !(moved[a] && moved[b])) continue;
      const auto length = [&](const Positions& mesh) {
        return (row3(mesh, a) - row3(mesh, b)).norm();
      };
      stretch.push_back(
          std::abs(std::log(length(here) * length(neutral) / (length(face) * length(there)))));
    }
  }
}

/// Of values the one that 99 of 100 do not exceed.
double percentile99(std::vector<double> values) {
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(0.99 * static_cast<double>(values.size()));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// In millimetres.
std::string mm(double centimetres) {
  return format_fixed(10 * centimetres, 2);
}

void print(const char* how, const LidFigures& lids) {
  std::cout << how << ": " << lids.blinks << " blinks, closed at " << lids.closed << " of "
            << lids.closing << " points of the rim where the template's is, widest "
            << mm(lids.widest) << " mm; vertices of the lids' outer skin more than 0.2 mm in an "
            << "eyeball " << lids.deep << ", at rest " << lids.deep_at_rest
            << "; by more than 0.05 mm deeper than that and than at rest " << lids.deeper
            << ", at most by " << mm(lids.max_deeper) << " mm; deepest " << mm(lids.deepest)
            << " mm, on the template " << mm(lids.of_template) << " mm\n";
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc < 2) throw UsageError("usage: crowdface_measure_shapes CONFIG [FACES]");
  const Job job = load_job(argv[1], {}, cache_directory());
  const PreparedHeads prepared = prepare(job.config, job.inputs, job.smoothing, cache_directory());
  const FaceBuilder builder(job.config, job.inputs, prepared);
  FaceAttachments attachments(job.config, job.inputs);
  const CrowdPlan crowd_plan = crowdface::plan_crowd(
      job.config, job.inputs, prepared, [&]() -> const FaceBuilder& { return builder; },
      attachments, cache_directory());
  const FaceShapes shapes(job.config, job.inputs);
  const Crossings crossings(job.inputs);
  const ShapeSet& set = job.inputs.shapes;

  std::size_t count = crowd_plan.crowd.size();
  if (argc > 2) count = std::min<std::size_t>(count, std::strtoul(argv[2], nullptr, 10));
  std::vector<Counted> counted(set.shapes.size());
  std::vector<Displacements> alone, template_moves;
  for (const Shape& shape : set.shapes) alone.push_back(shape.moves);
  for (std::size_t s = 0; s < alone.size(); ++s) {
    template_moves.push_back(with_prerequisite(alone, s, shapes.prerequisite_of(s)));
  }
  std::vector<std::vector<TrianglePair>> of_template;
  for (std::size_t s = 0; s < set.shapes.size(); ++s) {
    of_template.push_back(crossings.of(in_shape(set.neutral, template_moves[s])));
    counted[s].of_template = crossings.all(of_template[s]);
  }
  std::vector<std::uint32_t> skin;
  for (std::uint32_t v = 0; v < job.inputs.skin_components.component_of_vertex.size(); ++v) {
    if (job.inputs.skin_components.component_of_vertex[v] == job.inputs.skin_components.largest())
      skin.push_back(v);
  }
  std::vector<MeasuredLids> eyes;
  for (const Part& part : job.inputs.parts.parts) {
    if (!part.is_eyeball) continue;
    eyes.emplace_back(job.inputs.head_set, skin, job.inputs.parts, part, set.neutral,
                      head_axes(job.config));
  }
  LidFigures lids, unchanged_lids;
  const GapPreserver lips(job.inputs.head_set, job.inputs.adjacency, skin);
  std::vector<LipFigures> of_lips(set.shapes.size());
  std::vector<double> stretch, unchanged_stretch;
  const std::vector<Triangle> skin_triangles =
      triangles_of(job.inputs.head_set.topology, job.inputs.skin_components,
                   job.inputs.skin_components.largest());
  Index at_rest_in_all = 0;
  for (std::size_t f = 0; f < count; ++f) {
    const Recipe* recipe = &crowd_plan.crowd[f].recipe;
    Positions face;
    builder.build({&recipe, 1}, {&face, 1});
    face = round_to_single(face);
    const std::vector<TrianglePair> at_rest = crossings.of(face);
    at_rest_in_all += crossings.all(at_rest);
    const std::vector<Displacements> carried_shapes = shapes.shapes_of_face(*recipe, face);
    for (std::size_t s = 0; s < set.shapes.size(); ++s) {
      const Displacements& shape = template_moves[s];
      const Displacements moves = with_prerequisite(carried_shapes, s, shapes.prerequisite_of(s));
      of_lips[s].add(lips, set.neutral, face, shape, moves);
      for (MeasuredLids& eye : eyes) {
        if (eye.moved(shape) < 50 * kTenthOfMm) continue;
        add_stretch(skin_triangles, set.neutral, face, shape, moves, stretch);
        add_stretch(skin_triangles, set.neutral, face, shape, shape, unchanged_stretch);
        lids.add(eye, set.neutral, face, shape, moves);
        unchanged_lids.add(eye, set.neutral, face, shape, shape);
      }
      const Index carried = crossings.beyond(of_template[s], at_rest, in_shape(face, moves));
      counted[s].unchanged += crossings.beyond(of_template[s], at_rest, in_shape(face, shape));
      counted[s].carried += carried;
      counted[s].most = std::max(counted[s].most, carried);
      if (carried > 0) ++counted[s].faces;
    }
  }
  const auto mean = [&](Index sum) {
    return format_fixed(static_cast<double>(sum) / static_cast<double>(count), 2);
  };
  std::cout << count << " faces, at rest " << mean(at_rest_in_all) << " crossing triangles\n";
  print("carried", lids);
  print("unchanged", unchanged_lids);
  std::cout << "edges of blinks are stretched by up to a logarithm of "
            << format_fixed(percentile99(stretch), 2)
            << " otherwise than on the template (99 of 100), unchanged "
            << format_fixed(percentile99(unchanged_stretch), 2) << '\n';
  std::cout << "gaps between lips that the template leaves as they are change by up to, carried "
               "and unchanged:\n";
  for (std::size_t s = 0; s < set.shapes.size(); ++s) {
    std::cout << "  " << set.shapes[s].name << ": " << mm(of_lips[s].carried) << ' '
              << mm(of_lips[s].unchanged) << " mm\n";
  }
  std::cout << "shape: crossing triangles of the template; new in a face, unchanged and carried; "
               "at most; faces with any\n";
  for (std::size_t s = 0; s < set.shapes.size(); ++s) {
    const Counted& of = counted[s];
    std::cout << set.shapes[s].name;
    if (const auto other = shapes.prerequisite_of(s)) std::cout << "+" << set.shapes[*other].name;
    std::cout << ": " << of.of_template << ' ' << mean(of.unchanged) << ' ' << mean(of.carried)
              << ' ' << of.most << ' ' << of.faces << '\n';
  }
} catch (const Error& error) {
  std::cerr << error.what() << '\n';
  return static_cast<int>(error.code());
}
