// SPDX-License-Identifier: Apache-2.0
#include "crowdface/shapes/shape_transfer.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <gtest/gtest.h>

#include "crowdface/core/list_files.h"
#include "crowdface/core/parallel.h"
#include "crowdface/io/obj_file.h"
#include "crowdface/mesh/vector3.h"
#include "crowdface/parts/rigid_motion.h"
#include "crowdface/synth/synthetic_head.h"

#include "parts/scene.h"

namespace crowdface {
namespace {

using Eigen::Vector3d;

constexpr double kExtent = 43;

/// Heads of one topology, and what they consist of.
struct Heads {
  FaceSet faces;
  Adjacency adjacency;
  Components components;
  PartList parts;

  explicit Heads(FaceSet set)
      : faces(std::move(set)),
        adjacency(build_adjacency(faces.topology)),
        components(find_components(adjacency)),
        parts(find_parts(faces.topology, adjacency, components, mean_head(faces))) {}
  const Positions& operator[](std::size_t i) const { return faces.heads[i].positions; }
  std::vector<const Part*> eyes() const {
    std::vector<const Part*> eyes;
    for (const Part& part : parts.parts) {
      if (part.eyeball) eyes.push_back(&part);
    }
    return eyes;
  }
};

Heads synthetic_heads() {
  const SyntheticHeads synthetic(5000, SyntheticHeads::Parts::kEyesAndTeeth);
  FaceSet set{synthetic.topology(), synthetic.uvs(), {}};
  for (const std::uint64_t i : {0, 1, 2, 3, 4, 5}) {
    set.heads.push_back({"head" + std::to_string(i), synthetic.positions(5, i)});
  }
  return Heads(std::move(set));
}

bool is_skin(const Heads& heads, Index v) {
  return heads.components.of_vertex[static_cast<std::size_t>(v)] == heads.components.largest();
}

/// An eye's centre and radius on a head: those on the mean head, carried there.
std::pair<Vector3d, double> ball_of(const Heads& heads, const Part& eye, const Positions& head) {
  const ComponentShape& ball = heads.parts.shapes[eye.ball];
  const RigidMotion motion = fit_rigid_motion(mean_head(heads.faces), head, eye.vertices,
                                              std::vector<double>(eye.vertices.size(), 1.0));
  return {motion.apply(ball.centre), motion.scale * ball.radius};
}

/// The rims of the lids in front of an eye: the highest vertex of the lower lid and the lowest of the
/// upper one in each of some columns.
struct Rims {
  std::vector<std::uint32_t> low, high;
};

Rims rims_of(const Heads& heads, const Part& eye, const Positions& head) {
  const auto [centre, radius] = ball_of(heads, eye, head);
  constexpr int kColumns = 9;
  Rims rims{std::vector<std::uint32_t>(kColumns, kNoIndex),
            std::vector<std::uint32_t>(kColumns, kNoIndex)};
  for (Index v = 0; v < head.rows(); ++v) {
    const Vector3d from = (row3(head, v) - centre) / radius;
    if (!is_skin(heads, v) || from.z() < 0.6 || std::abs(from.x()) > 0.7 || length3(from) > 1.6)
      continue;
    const auto column = static_cast<std::size_t>((from.x() + 0.7) / 1.4 * kColumns);
    const auto row = static_cast<std::uint32_t>(v);
    if (column >= kColumns) continue;
    std::uint32_t& low = rims.low[column];
    std::uint32_t& high = rims.high[column];
    if (from.y() < 0 && (low == kNoIndex || head(v, 1) > head(low, 1))) low = row;
    if (from.y() >= 0 && (high == kNoIndex || head(v, 1) < head(high, 1))) high = row;
  }
  for (std::size_t i = kColumns; i-- > 0;) {
    if (rims.low[i] != kNoIndex && rims.high[i] != kNoIndex) continue;
    rims.low.erase(rims.low.begin() + static_cast<std::ptrdiff_t>(i));
    rims.high.erase(rims.high.begin() + static_cast<std::ptrdiff_t>(i));
  }
  return rims;
}

/// The upper lid comes down onto the lower one, around the eyeball.
Positions blinking(const Heads& heads, const Part& eye, const Positions& head) {
  const auto [centre, radius] = ball_of(heads, eye, head);
  const Rims rims = rims_of(heads, eye, head);
  Positions result = head;
  for (Index v = 0; v < head.rows(); ++v) {
    const Vector3d from = row3(head, v) - centre;
    if (!is_skin(heads, v) || from.z() < 0 || length3(from) > 2.5 * radius) continue;
    double weights = 0, low = 0, high = 0;
    for (std::size_t i = 0; i < rims.low.size(); ++i) {
      const double off = (head(v, 0) - (head(rims.low[i], 0) + head(rims.high[i], 0)) / 2) / radius;
      const double weight = std::exp(-60 * off * off) + 1e-9;
      weights += weight;
      low += weight * head(rims.low[i], 1);
      high += weight * head(rims.high[i], 1);
    }
    low /= weights;
    high /= weights;
    if (head(v, 1) < (low + high) / 2) continue;
    const double off = std::max(0.0, head(v, 1) - high) / radius;
    const double aside = std::max(0.0, std::abs(from.x()) - 0.7 * radius) / radius;
    const double share = std::exp(-off * off - 4 * aside * aside);
    const Vector3d down = from - Vector3d(0, share * (high - low), 0);
    result.row(v) = (centre + down * (length3(from) / length3(down))).transpose();
  }
  return result;
}

/// One corner of the mouth goes up.
Positions smiling(const Heads& heads, const Positions& head) {
  Positions result = head;
  for (Index v = 0; v < head.rows(); ++v) {
    if (!is_skin(heads, v)) continue;
    const Vector3d from = row3(head, v) - Vector3d(4, -4, 6);
    const double share = std::exp(-dot3(from, from) / 6);
    if (share > 0.01) result.row(v) += share * Eigen::RowVector3d(0.5, 0.7, -0.2);
  }
  return result;
}

Positions with_gaze(const Heads& heads, const Part& eye, const Positions& head, double angle) {
  const Vector3d centre = ball_of(heads, eye, head).first;
  Positions result = head;
  for (const std::uint32_t v : eye.vertices) {
    const Vector3d from = row3(head, v) - centre;
    result.row(v) =
        (centre + Vector3d(std::cos(angle) * from.x() + std::sin(angle) * from.z(), from.y(),
                           std::cos(angle) * from.z() - std::sin(angle) * from.x()))
            .transpose();
  }
  return result;
}

ShapeSet shapes_of(const Heads& heads, const Positions& neutral) {
  ShapeSet set{neutral, {}};
  const auto eyes = heads.eyes();
  const auto add = [&](const char* name, const Positions& mesh) {
    set.shapes.push_back(shape_of(name, neutral, mesh, kExtent));
  };
  add("blink", blinking(heads, *eyes.at(0), neutral));
  add("smile", smiling(heads, neutral));
  add("gaze", with_gaze(heads, *eyes.at(0), neutral, 0.3));
  add("nothing", neutral);
  return set;
}

double farthest(const Displacements& a, const Displacements& b) {
  return a.moves.rows() == 0 ? 0 : (a.moves - b.moves).cwiseAbs().maxCoeff();
}

TEST(ShapeTransfer, TheTemplateAsFaceHasTheShapesThemselves) {
  const Heads heads = synthetic_heads();
  const ShapeSet set = shapes_of(heads, heads[1]);
  const ShapeTransfer transfer(heads.faces, heads.adjacency, heads.parts, {}, set);
  const auto moves = transfer.carry(1, heads[1]);
  ASSERT_EQ(moves.size(), set.shapes.size());
  for (std::size_t s = 0; s < moves.size(); ++s) {
    EXPECT_EQ(moves[s].vertices, set.shapes[s].moves.vertices);
    EXPECT_LT(farthest(moves[s], set.shapes[s].moves), 1e-9) << set.shapes[s].name;
  }
}

TEST(ShapeTransfer, ATurnedMovedAndScaledTemplateHasThemTurnedAndScaled) {
  Heads heads = synthetic_heads();
  const Eigen::RowVector3d shift(3, -20, 1);
  const auto elsewhere = [&](const Positions& positions) {
    return testing::moved(positions, 0.2, 1.4, shift);
  };
  heads.faces.heads.push_back({"elsewhere", elsewhere(heads[0])});
  const ShapeSet set = shapes_of(heads, heads[0]);
  const ShapeTransfer transfer(heads.faces, heads.adjacency, heads.parts, {}, set);
  const auto moves = transfer.carry(6, heads[6]);
  for (std::size_t s = 0; s < moves.size(); ++s) {
    Positions face = heads[6], shape = heads[0];
    moves[s].add_to(face);
    set.shapes[s].moves.add_to(shape);
    // The eyeballs' maps are grids over the head's own front, and a turned head's lie elsewhere.
    EXPECT_LT((face - elsewhere(shape)).cwiseAbs().maxCoeff(), 2e-3) << set.shapes[s].name;
  }
}

TEST(ShapeTransfer, AShapeOfZeroMovesNothing) {
  const Heads heads = synthetic_heads();
  const ShapeSet set = shapes_of(heads, heads[0]);
  EXPECT_TRUE(set.shapes.back().moves.vertices.empty());
  const ShapeTransfer transfer(heads.faces, heads.adjacency, heads.parts, {}, set);
  Positions face = heads[3];
  transfer.carry(3, heads[3]).back().add_to(face);
  EXPECT_EQ(face, heads[3]);
}

TEST(ShapeTransfer, HasTheSameBitsForAnyNumberOfThreads) {
  const Heads heads = synthetic_heads();
  const ShapeSet set = shapes_of(heads, heads[0]);
  const auto carried = [&](int threads) {
    const ThreadLimit limit(threads);
    return ShapeTransfer(heads.faces, heads.adjacency, heads.parts, {}, set).carry(2, heads[2]);
  };
  const auto one = carried(1), many = carried(4);
  for (std::size_t s = 0; s < one.size(); ++s) EXPECT_EQ(one[s].moves, many[s].moves);
}

/// By how much the gaps between the rims of an eye's lids differ at most from the template's, over all
/// heads.
struct GapsOff {
  double carried = 0, unchanged = 0;
};

/// \param blink  number of the shape that closes the eye
GapsOff gaps_off(const Heads& heads, const ShapeSet& set, const Part& eye, std::size_t blink) {
  const ShapeTransfer transfer(heads.faces, heads.adjacency, heads.parts, {}, set);
  const Rims rims = rims_of(heads, eye, set.neutral);
  EXPECT_GT(rims.low.size(), 3U);
  const auto gaps = [&](const Positions& head, const Displacements& moves) {
    Positions moved = head;
    moves.add_to(moved);
    std::vector<double> heights;
    for (std::size_t i = 0; i < rims.low.size(); ++i) {
      heights.push_back(moved(rims.high[i], 1) - moved(rims.low[i], 1));
    }
    return heights;
  };
  const Displacements& shape = set.shapes[blink].moves;
  const auto wanted = gaps(set.neutral, shape);
  GapsOff off;
  for (std::size_t h = 0; h < heads.faces.heads.size(); ++h) {
    const auto carried = gaps(heads[h], transfer.carry(static_cast<Index>(h), heads[h])[blink]);
    const auto unchanged = gaps(heads[h], shape);
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      off.carried = std::max(off.carried, std::abs(carried[i] - wanted[i]));
      off.unchanged = std::max(off.unchanged, std::abs(unchanged[i] - wanted[i]));
    }
  }
  return off;
}

TEST(ShapeTransfer, ABlinkClosesOnEyesOfOtherSizes) {
  const Heads heads = synthetic_heads();
  const ShapeSet set = shapes_of(heads, heads[0]);
  const GapsOff off = gaps_off(heads, set, *heads.eyes().at(0), 0);
  EXPECT_GT(off.unchanged, 0.15);
  EXPECT_LT(off.carried, 0.4 * off.unchanged);
}

TEST(ShapeTransfer, ABlinkClosesOnHeadsOfTheIctModel) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::path(CROWDFACE_SOURCE_DIR) / "../shared/faces";
  const fs::path shapes = folder / "ict_shapes";
  if (!fs::exists(shapes)) GTEST_SKIP() << "needs the ICT model's shapes in " << shapes;
  const ObjFile neutral = read_obj(shapes / "generic_neutral_mesh.obj");
  FaceSet faces{neutral.topology, neutral.uvs, {}};
  for (const fs::path& file : list_files(folder / "ict16", has_ending(".obj"))) {
    faces.heads.push_back({file.stem().string(), read_obj(file).positions});
  }
  const Heads heads(std::move(faces));
  ShapeSet set{neutral.positions, {}};
  for (const char* name : {"eyeBlink_L", "eyeBlink_R"}) {
    const Positions mesh = read_obj(shapes / (std::string(name) + ".obj")).positions;
    set.shapes.push_back(shape_of(name, set.neutral, mesh, kExtent));
  }
  for (const Part* eye : heads.eyes()) {
    const bool left = ball_of(heads, *eye, set.neutral).first.x() > 0;
    const GapsOff off = gaps_off(heads, set, *eye, left ? 0 : 1);
    EXPECT_GT(off.unchanged, 0.3);
    EXPECT_LT(off.carried, 0.12);
  }
}

TEST(ShapeTransfer, LidsKeepOffTheEyeball) {
  const Heads heads = synthetic_heads();
  const Part& eye = *heads.eyes().at(0);
  const ShapeSet set = shapes_of(heads, heads[0]);
  const ShapeTransfer transfer(heads.faces, heads.adjacency, heads.parts, {}, set);
  for (std::size_t h = 1; h < 6; ++h) {
    const auto [centre, radius] = ball_of(heads, eye, heads[h]);
    const Displacements blink = transfer.carry(static_cast<Index>(h), heads[h])[0];
    for (std::size_t i = 0; i < blink.vertices.size(); ++i) {
      const Vector3d before = row3(heads[h], blink.vertices[i]) - centre;
      const Vector3d after = before + row3(blink.moves, static_cast<Index>(i));
      if (length3(before) > 1.3 * radius) continue;
      EXPECT_GT(length3(after), std::min(length3(before), radius) - 0.02) << h << ' ' << i;
    }
  }
}

TEST(ShapeTransfer, GazeTurnsAnEyeballAboutItsOwnCentre) {
  const Heads heads = synthetic_heads();
  const Part& eye = *heads.eyes().at(0);
  const ShapeSet set = shapes_of(heads, heads[0]);
  const ShapeTransfer transfer(heads.faces, heads.adjacency, heads.parts, {}, set);
  for (std::size_t h = 1; h < 6; ++h) {
    Positions face = heads[h];
    const auto [before, radius] = ball_of(heads, eye, face);
    transfer.carry(static_cast<Index>(h), heads[h])[2].add_to(face);
    const auto [after, radius_after] = ball_of(heads, eye, face);
    EXPECT_LT(length3(after - before), 0.01) << h;
    EXPECT_NEAR(radius_after, radius, 1e-6);
    EXPECT_GT((face - heads[h]).rowwise().norm().maxCoeff(), 0.25 * radius);
  }
}

/// Teeth turn and go along as a whole.
TEST(ShapeTransfer, RigidPartsStayRigid) {
  const Heads heads = synthetic_heads();
  const Part* teeth = nullptr;
  for (const Part& part : heads.parts.parts) {
    if (!part.eyeball && part.part_class == PartClass::kRigid) teeth = &part;
  }
  ASSERT_NE(teeth, nullptr);
  Positions open = heads[0];
  for (const std::uint32_t v : teeth->vertices) {
    const double y = open(v, 1), z = open(v, 2);
    open(v, 1) = std::cos(0.3) * y - std::sin(0.3) * z;
    open(v, 2) = std::sin(0.3) * y + std::cos(0.3) * z;
  }
  const ShapeSet set{heads[0], {shape_of("jaw", heads[0], open, kExtent)}};
  const ShapeTransfer transfer(heads.faces, heads.adjacency, heads.parts, {}, set);
  Positions face = heads[4];
  transfer.carry(4, heads[4])[0].add_to(face);
  const std::uint32_t a = teeth->vertices.front();
  for (const std::uint32_t b : teeth->vertices) {
    EXPECT_NEAR(length3(row3(face, a) - row3(face, b)),
                length3(row3(heads[4], a) - row3(heads[4], b)), 1e-9);
  }
  EXPECT_GT(length3(row3(face, a) - row3(heads[4], a)), 0.5);
}

}  // namespace
}  // namespace crowdface
