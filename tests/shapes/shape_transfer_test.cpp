// SPDX-License-Identifier: Apache-2.0
#include "crowdface/shapes/shape_transfer.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>

#include <gtest/gtest.h>

#include "crowdface/core/folder.h"
#include "crowdface/core/parallel.h"
#include "crowdface/io/obj_file.h"
#include "crowdface/mesh/vector3.h"
#include "crowdface/parts/skin_contacts.h"
#include "crowdface/validity/intersections.h"

#include "parts/scene.h"
#include "shapes/acting_heads.h"

namespace crowdface {
namespace {

using Eigen::Vector3d;
using namespace testing;

double farthest(const Displacements& a, const Displacements& b) {
  return a.moves.rows() == 0 ? 0 : (a.moves - b.moves).cwiseAbs().maxCoeff();
}

TEST(ShapeTransfer, TheTemplateAsFaceHasTheShapesThemselves) {
  const Heads heads = synthetic_heads();
  const ShapeSet set = shapes_of(heads, heads[1]);
  const ShapeTransfer transfer(heads.faces, heads.adjacency, heads.parts, {}, set);
  const auto moves = transfer.transfer_to_face(1, heads[1]);
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
  const auto moves = transfer.transfer_to_face(6, heads[6]);
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
  transfer.transfer_to_face(3, heads[3]).back().add_to(face);
  EXPECT_EQ(face, heads[3]);
}

TEST(ShapeTransfer, HasTheSameBitsForAnyNumberOfThreads) {
  const Heads heads = synthetic_heads();
  const ShapeSet set = shapes_of(heads, heads[0]);
  const auto carried = [&](int threads) {
    const ThreadLimit limit(threads);
    return ShapeTransfer(heads.faces, heads.adjacency, heads.parts, {}, set)
        .transfer_to_face(2, heads[2]);
  };
  const auto one = carried(1), many = carried(4);
  for (std::size_t s = 0; s < one.size(); ++s) EXPECT_EQ(one[s].moves, many[s].moves);
}

/// By how much the gaps between the rims of an eye's lids differ at most from the template's, over
/// all heads.
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
    const auto carried =
        gaps(heads[h], transfer.transfer_to_face(static_cast<Index>(h), heads[h])[blink]);
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
  EXPECT_LT(off.carried, 0.45 * off.unchanged);
}

/// The heads of the ICT model and some of its shapes, where they are there.
struct IctModel {
  Heads heads;
  ShapeSet set;
};

std::optional<IctModel> ict_model(const std::vector<std::string>& shapes) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::path(CROWDFACE_SOURCE_DIR) / "../shared/faces";
  if (!fs::exists(folder / "ict_shapes")) return std::nullopt;
  const ObjFile neutral = read_obj(folder / "ict_shapes/generic_neutral_mesh.obj");
  HeadSet faces{neutral.topology, neutral.uvs, {}};
  for (const fs::path& file : list_files(folder / "ict16", extension_filter(".obj"))) {
    faces.heads.push_back({file.stem().string(), read_obj(file).positions});
  }
  ShapeSet set{neutral.positions, {}};
  for (const std::string& name : shapes) {
    const Positions mesh = read_obj(folder / "ict_shapes" / (name + ".obj")).positions;
    set.shapes.push_back(make_shape(name, set.neutral, mesh, kExtent));
  }
  return IctModel{Heads(std::move(faces)), std::move(set)};
}

TEST(ShapeTransfer, ABlinkClosesOnHeadsOfTheIctModel) {
  const auto ict = ict_model({"eyeBlink_L", "eyeBlink_R"});
  if (!ict) GTEST_SKIP() << "needs the ICT model's heads and shapes in ../shared/faces";
  for (const Part* eye : ict->heads.eyes()) {
    const bool left = ball_of(ict->heads, *eye, ict->set.neutral).first.x() > 0;
    const GapsOff off = gaps_off(ict->heads, ict->set, *eye, left ? 0 : 1);
    EXPECT_GT(off.unchanged, 0.3);
    EXPECT_LT(off.carried, 0.18);
  }
}

TEST(ShapeTransfer, LipsThatAreLeftClosedStayClosedOnHeadsOfTheIctModel) {
  const auto ict = ict_model({"mouthSmile_L", "cheekPuff_R"});
  if (!ict) GTEST_SKIP() << "needs the ICT model's heads and shapes in ../shared/faces";
  const auto& [heads, set] = *ict;
  std::vector<std::uint32_t> skin;
  for (Index v = 0; v < set.neutral.rows(); ++v) {
    if (is_skin(heads, v)) skin.push_back(static_cast<std::uint32_t>(v));
  }
  const SkinContacts contacts(heads.faces, heads.adjacency, skin);
  const ShapeTransfer transfer(heads.faces, heads.adjacency, heads.parts, {}, set);
  const auto changes = [&](const Positions& rest, const Displacements& moves) {
    Positions shape = rest;
    moves.add_to(shape);
    std::vector<double> gaps = contacts.gaps(shape);
    const std::vector<double> before = contacts.gaps(rest);
    for (std::size_t p = 0; p < gaps.size(); ++p) gaps[p] = std::abs(gaps[p] - before[p]);
    return gaps;
  };
  constexpr double kClosed = 0.002;
  double carried = 0, unchanged = 0;
  for (std::size_t h = 0; h < heads.faces.heads.size(); ++h) {
    const auto moves = transfer.transfer_to_face(static_cast<Index>(h), heads[h]);
    for (std::size_t s = 0; s < set.shapes.size(); ++s) {
      const auto of_template = changes(set.neutral, set.shapes[s].moves);
      const auto of_face = changes(heads[h], moves[s]);
      const auto added = changes(heads[h], set.shapes[s].moves);
      for (std::size_t p = 0; p < of_face.size(); ++p) {
        if (of_template[p] > kClosed) continue;
        carried = std::max(carried, of_face[p]);
        unchanged = std::max(unchanged, added[p]);
      }
    }
  }
  EXPECT_GT(unchanged, 0.02);
  EXPECT_LT(carried, 0.02);
}

/// Triangles of the skin that pass through others in each head's shapes, and neither on the
/// template in that shape nor in the head at rest.
struct NewCrossings {
  Index carried = 0, unchanged = 0;
};

NewCrossings new_crossings(const Heads& heads, const ShapeSet& set) {
  const std::vector<Triangle> triangles =
      triangles_of(heads.faces.topology, heads.components, heads.components.largest());
  const auto crossing = [&](const Positions& mesh) {
    return intersecting_pairs(triangles, mesh, near_pairs(triangles, mesh, 0));
  };
  const auto in_shape = [](const Positions& mesh, const Displacements& moves) {
    Positions moved = mesh;
    moves.add_to(moved);
    return moved;
  };
  const ShapeTransfer transfer(heads.faces, heads.adjacency, heads.parts, {}, set);
  NewCrossings sum;
  for (std::size_t h = 0; h < heads.faces.heads.size(); ++h) {
    const auto at_rest = crossing(heads[h]);
    const auto moves = transfer.transfer_to_face(static_cast<Index>(h), heads[h]);
    for (std::size_t s = 0; s < set.shapes.size(); ++s) {
      auto known = crossing(in_shape(set.neutral, set.shapes[s].moves));
      known.insert(known.end(), at_rest.begin(), at_rest.end());
      const NewIntersections added(triangles, set.neutral.rows(), known);
      sum.carried += added.count(crossing(in_shape(heads[h], moves[s])));
      sum.unchanged += added.count(crossing(in_shape(heads[h], set.shapes[s].moves)));
    }
  }
  return sum;
}

TEST(ShapeTransfer, TakesNoSkinThroughSkinOnHeadsOfTheIctModel) {
  const auto ict = ict_model({"eyeBlink_L", "mouthSmile_R", "mouthPucker"});
  if (!ict) GTEST_SKIP() << "needs the ICT model's heads and shapes in ../shared/faces";
  const NewCrossings crossings = new_crossings(ict->heads, ict->set);
  EXPECT_GT(crossings.unchanged, 500);
  EXPECT_LT(crossings.carried, 90) << "lids that would open stay through each other instead";
}

TEST(ShapeTransfer, LidsKeepOffTheEyeball) {
  const Heads heads = synthetic_heads();
  const Part& eye = *heads.eyes().at(0);
  const ShapeSet set = shapes_of(heads, heads[0]);
  const ShapeTransfer transfer(heads.faces, heads.adjacency, heads.parts, {}, set);
  for (std::size_t h = 1; h < 6; ++h) {
    const auto [centre, radius] = ball_of(heads, eye, heads[h]);
    const Displacements blink = transfer.transfer_to_face(static_cast<Index>(h), heads[h])[0];
    for (std::size_t i = 0; i < blink.vertices.size(); ++i) {
      const Vector3d before = row3(heads[h], blink.vertices[i]) - centre;
      const Vector3d after = before + row3(blink.moves, static_cast<Index>(i));
      if (before.norm() > 1.3 * radius) continue;
      EXPECT_GT(after.norm(), std::min(before.norm(), radius) - 0.025) << h << ' ' << i;
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
    transfer.transfer_to_face(static_cast<Index>(h), heads[h])[2].add_to(face);
    const auto [after, radius_after] = ball_of(heads, eye, face);
    EXPECT_LT((after - before).norm(), 0.01) << h;
    EXPECT_NEAR(radius_after, radius, 1e-6);
    EXPECT_GT((face - heads[h]).rowwise().norm().maxCoeff(), 0.25 * radius);
  }
}

/// Teeth turn and go along as a whole.
TEST(ShapeTransfer, RigidPartsStayRigid) {
  const Heads heads = synthetic_heads();
  const Part* teeth = nullptr;
  for (const Part& part : heads.parts.parts) {
    if (!part.is_eyeball && part.part_class == PartClass::kRigid) teeth = &part;
  }
  ASSERT_NE(teeth, nullptr);
  Positions open = heads[0];
  for (const std::uint32_t v : teeth->vertices) {
    const double y = open(v, 1), z = open(v, 2);
    open(v, 1) = std::cos(0.3) * y - std::sin(0.3) * z;
    open(v, 2) = std::sin(0.3) * y + std::cos(0.3) * z;
  }
  const ShapeSet set{heads[0], {make_shape("jaw", heads[0], open, kExtent)}};
  const ShapeTransfer transfer(heads.faces, heads.adjacency, heads.parts, {}, set);
  Positions face = heads[4];
  transfer.transfer_to_face(4, heads[4])[0].add_to(face);
  const std::uint32_t a = teeth->vertices.front();
  for (const std::uint32_t b : teeth->vertices) {
    EXPECT_NEAR((row3(face, a) - row3(face, b)).norm(),
                (row3(heads[4], a) - row3(heads[4], b)).norm(), 1e-9);
  }
  EXPECT_GT((row3(face, a) - row3(heads[4], a)).norm(), 0.5);
}

}  // namespace
}  // namespace crowdface
