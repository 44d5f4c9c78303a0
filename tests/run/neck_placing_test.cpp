// SPDX-License-Identifier: Apache-2.0
// How heads are placed on a body, and which bodies fit.
#include <algorithm>
#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "crowdface/cast/compared_area.h"
#include "crowdface/heads/heads_on_body.h"
#include "crowdface/mesh/alignment.h"
#include "crowdface/run/job.h"

#include "neck_crowd.h"
#include "support/crowd_files.h"
#include "support/expect_error.h"
#include "support/mesh_files.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;
using testing::body_below;
using testing::expect_error;
using ::testing::HasSubstr;

class NeckPlacing : public testing::NeckCrowd {
 protected:
  /// Moves the vertices of a head's file.
  template <class Move>
  void change_head(Index h, const Move& move) const {
    const std::string name = concat("heads/head_", h, ".obj");
    Mesh mesh{heads_.topology(), read_obj(folder_ / name).positions, heads_.uvs()};
    for (Index v = 0; v < mesh.positions.rows(); ++v) {
      const Eigen::Vector3d moved = move(Eigen::Vector3d(mesh.positions.row(v).transpose()));
      mesh.positions.row(v) = moved.transpose();
    }
    folder_.write(name, testing::with_normals(mesh));
  }
  Positions mesh_of(const std::string& crowd, const std::string& face) const {
    return read_obj(folder_ / crowd / "meshes" / (face + ".obj")).positions;
  }
  /// The angle of the best rotation of a face onto another above the bend, in degrees.
  static double degrees_between(const Job& job, const Positions& face, const Positions& other) {
    const std::vector<std::uint32_t>& bent = job.inputs.heads_on_body->seam.neck_bend.vertices();
    Eigen::VectorXd weights = Eigen::VectorXd::Ones(face.rows());
    for (const std::uint32_t v : bent) weights[v] = 0;
    for (const std::uint32_t v : job.inputs.heads_on_body->seam.rim) weights[v] = 0;
    return fit_similarity(face, other, ScaleFit::kRigid, weights).angle_degrees();
  }
};

double degrees_of(const Eigen::Matrix3d& rotation) {
  return Similarity{rotation}.angle_degrees();
}

TEST_F(NeckPlacing, HeadsAreMovedButNotTiltedScaledOrBent) {
  const Job plain = load_job(configure("", "", "", "plain"), {});
  const Job job = load_job(configure("{body: body.obj}", ""), {});
  for (std::size_t h = 0; h < kHeads; ++h) {
    const auto& [placed, turn, shift_mm, rotation_degrees, max_bend_mm] =
        job.inputs.heads_on_body->heads[h];
    const Positions& head = job.inputs.head_set.heads[h].positions;
    const Positions by = head - plain.inputs.head_set.heads[h].positions;
    const Eigen::RowVector3d shift = (placed.moved_pivot - placed.pivot).transpose();
    EXPECT_TRUE(placed.rotation.isIdentity(1e-12));
    EXPECT_TRUE(turn.isZero(0));
    EXPECT_LT(rotation_degrees, 1e-9);
    EXPECT_NEAR(shift_mm, 10 * shift.norm(), 1e-6);
    EXPECT_LT((by.rowwise() - shift).cwiseAbs().maxCoeff(), 1e-9);
    const Positions rest = seam_ - head(rim_, kAllColumns);
    EXPECT_NEAR(max_bend_mm, 10 * rest.rowwise().norm().maxCoeff(), 1e-3);
    EXPECT_LT(rest.colwise().mean().norm(), 1e-5);
  }
}

// Heads in another pose than the body are turned alike: their rims tell by how much.
TEST_F(NeckPlacing, TurnedHeadsAreTurnedBackTogether) {
  const Job straight = load_job(configure("{body: body.obj}", ""), {});
  const Eigen::AngleAxisd turn(0.2, Eigen::Vector3d(0.6, 0.8, 0));
  for (Index h = 0; h < kHeads; ++h) {
    change_head(h, [&](const Eigen::Vector3d& p) { return turn * p; });
  }
  const Job job = load_job(configure("{body: body.obj}", ""), {});
  const Eigen::Matrix3d& rotation = job.inputs.heads_on_body->heads[2].placement.rotation;
  EXPECT_LT(degrees_of(rotation * turn), 2) << "the wave of the body's ring tilts it a little";
  for (std::size_t h = 0; h < kHeads; ++h) {
    EXPECT_EQ(job.inputs.heads_on_body->heads[h].placement.rotation, rotation);
    EXPECT_TRUE(job.inputs.heads_on_body->heads[h].pose_rotation.isZero(0));
    EXPECT_TRUE(straight.inputs.heads_on_body->heads[h].placement.rotation.isIdentity(1e-12));
  }
}

// A body with the heads' vertices tells their pose with all its skin.
TEST_F(NeckPlacing, TurnedHeadsAreTurnedBackToAHead) {
  const Mesh head{heads_.topology(), read_obj(folder_ / "heads/head_2.obj").positions, {}};
  encode_obj(head, "").write(folder_ / "body.obj");
  const Eigen::AngleAxisd turn(0.16, Eigen::Vector3d(0.8, 0.6, 0));
  for (Index h = 0; h < kHeads; ++h) {
    change_head(h, [&](const Eigen::Vector3d& p) { return turn * p; });
  }
  const Job job = load_job(configure("{body: body.obj}", ""), {});
  const Eigen::Matrix3d& rotation = job.inputs.heads_on_body->heads[2].placement.rotation;
  EXPECT_LT(degrees_of(rotation * turn), 3) << "heads differ in form";
  EXPECT_EQ(rotation, job.inputs.heads_on_body->heads[0].placement.rotation);
}

// A head in another pose than the others: its faces are turned back, and are the same faces as
// without a body.
TEST_F(NeckPlacing, FacesOfATurnedHeadAreTurnedBack) {
  const std::string more = concat(testing::kThreeRecipes,
                                  "  - {id: d, target: head_4, regions: {all: {weights: "
                                  "{head_1: 1}, smoothness: 0.2}}}\n"
                                  "  - {id: e, target: head_1, regions: {all: {weights: "
                                  "{head_4: 1}, smoothness: 0.9}}}\n"
                                  "  - {id: g, target: head_1, mirrored: true, regions: {all: "
                                  "{weights: {head_2: 1}, smoothness: 0.4}}}\n"
                                  "  - {id: f, target: head_4, regions: {all: {weights: "
                                  "{head_1: 1}, smoothness: 1}}}\n",
                                  "sampling: {asymmetry: [0.4, 1.3]}\n");
  run("{body: body.obj}", more, "", "straight");
  const Eigen::AngleAxisd turn(0.16, Eigen::Vector3d(-0.8, 0.36, 0.48));  // 9.2 degrees
  change_head(4, [&](const Eigen::Vector3d& p) { return turn * p; });
  run("", more, "", "plain");
  const auto out = run("{body: body.obj}", more);
  const Job job = load_job(folder_ / "out.yaml", {});
  const auto heads = testing::read_json(out / "report.json").at("neck").at("heads");
  for (std::size_t h = 0; h < kHeads; ++h) {
    const double degrees = heads.at(h).at("turned_degrees").get<double>();
    EXPECT_NEAR(degrees, h == 4 ? 9.17 : 0, h == 4 ? 1.5 : 0) << h;
  }
  const auto left = [&](const std::string& crowd, const std::string& id) {
    return degrees_between(job, mesh_of(crowd, id), mesh_of("straight", id));
  };
  // A slightly smoothed face has its target's pose (d). In a strongly smoothed face, the sources'
  // detail adds their poses (e). One turned head tilts the plane that mirrors all faces (c, g).
  EXPECT_GT(left("plain", "d"), 8);
  EXPECT_GT(left("plain", "e"), 0.8);
  EXPECT_GT(left("plain", "g"), 1.5);
  for (const char* id : {"a", "b", "c", "d", "e", "f", "g"}) EXPECT_LT(left("out", id), 0.5) << id;
  const auto before = testing::plan_lines(folder_ / "plain"), after = testing::plan_lines(out);
  ASSERT_EQ(before.size(), after.size());
  std::vector<double> areas =
      compared_vertex_areas(job.inputs.head_set.topology, job.inputs.skin_components,
                            job.inputs.mean_head, ComparedArea::kFront, {2, 1});
  for (const std::uint32_t v : job.inputs.heads_on_body->seam.neck_bend.vertices()) areas[v] = 0;
  for (const std::uint32_t v : rim_) areas[v] = 0;
  bool any_asymmetric = false;
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_EQ(before[i].at("regions"), after[i].at("regions"));
    const std::string id = before[i].at("id");
    // The fits of levels depend a little on the place of a head, here 3 cm elsewhere.
    EXPECT_LT(face_distance(mesh_of("plain", id), mesh_of("out", id), areas), 5e-3) << id;
    any_asymmetric |= before[i].at("target") == "head_4" && before[i].contains("asymmetry");
  }
  EXPECT_TRUE(any_asymmetric);
  const auto faces = [](const fs::path& crowd) {
    return testing::read_json(crowd / "report.json").at("faces");
  };
  for (std::size_t i = 0; i < before.size(); ++i) {  // the turn is no defect
    const auto skin = faces(folder_ / "plain").at(i).at("skin"),
               moved = faces(out).at(i).at("skin");
    // one triangle may lie at the limit
    EXPECT_LE(moved.at("flipped").get<int>(), skin.at("flipped").get<int>() + 1);
    EXPECT_NEAR(moved.at("stretch").get<double>(), skin.at("stretch").get<double>(), 0.01);
  }
}

// A neck that is cut at another slope does not tilt its head.
TEST_F(NeckPlacing, SlopingRingsTiltNoHead) {
  const Eigen::AngleAxisd slope(0.14, Eigen::Vector3d::UnitX());  // 8 degrees
  const Eigen::Vector3d middle = seam_.colwise().mean().transpose();
  const auto bend = [&](const Eigen::Vector3d& p) {
    const double share = std::clamp(1 - (p.y() - middle.y()) / 4, 0.0, 1.0);  // fades over 4 cm
    return Eigen::Vector3d(p + share * (slope * (p - middle) - (p - middle)));
  };
  for (const Index h : {1, 3}) change_head(h, bend);
  const Job job = load_job(configure("{body: body.obj}", ""), {});
  for (const HeadsOnBody::Head& head : job.inputs.heads_on_body->heads)
    EXPECT_EQ(head.rotation_degrees, 0);
  EXPECT_GT(job.inputs.heads_on_body->heads[1].max_bend_mm, 5);
}

TEST_F(NeckPlacing, MayBeThatOfAHeadOrTheirMean) {
  const Positions head = read_obj(folder_ / "heads/head_3.obj").positions;
  const Job like = load_job(configure("{like: head_3}", ""), {});
  EXPECT_EQ(like.inputs.head_set.heads[3].positions, head);
  EXPECT_EQ(like.inputs.heads_on_body->seam.positions, head(rim_, kAllColumns));
  for (const char* neck : {"mean", "{like: mean, falloff: 4 cm}"}) {
    const Job mean = load_job(configure(neck, ""), {});
    Positions sum = Positions::Zero(seam_.rows(), 3);
    for (const Head& one : mean.inputs.head_set.heads) sum += one.positions(rim_, kAllColumns);
    const Positions& ring = mean.inputs.heads_on_body->seam.positions;
    EXPECT_LT((sum / double{kHeads} - ring).cwiseAbs().maxCoeff(), 1e-9);
  }
  EXPECT_EQ(testing::read_text(run("", "", "", "plain") / "config.yaml").find("neck"),
            std::string::npos);
}

// A full body has no open rim at its neck, but the vertices of the seam can be named.
TEST_F(NeckPlacing, TheRimMayBeNamed) {
  std::string numbers;
  for (const std::uint32_t v : rim_) numbers += concat(v, '\n');
  folder_.write("rim.txt", numbers);
  const Job named = load_job(configure("{body: body.obj, rim: rim.txt}", ""), {});
  const Job open = load_job(configure("{body: body.obj}", ""), {});
  EXPECT_EQ(named.inputs.head_digests, open.inputs.head_digests);
  folder_.write("rim.txt", numbers + "17 99999");
  expect_error(ExitCode::kBadData, {"rim.txt", "from 0 to", "\"99999\""},
               [&] { load_job(configure("{like: mean, rim: rim.txt}", ""), {}); });
  folder_.write("rim.txt", numbers.substr(0, numbers.size() / 2));
  expect_error(ExitCode::kBadData, {"rim.txt", "one closed loop"},
               [&] { load_job(configure("{like: mean, rim: rim.txt}", ""), {}); });
}

/// The body with a head on it: the seam is no open rim. Its vertices follow those of the body.
Mesh full_body(const Positions& seam) {
  Mesh mesh = body_below(seam);
  const auto around = static_cast<std::uint32_t>(seam.rows());
  const auto first = static_cast<std::uint32_t>(mesh.positions.rows());
  std::vector<std::uint32_t> ring;  // in the order of the seam
  for (std::uint32_t i = 0; i < around; ++i) {
    Index at = 0;
    (mesh.positions.rowwise() - seam.row(i)).rowwise().norm().minCoeff(&at);
    ring.push_back(static_cast<std::uint32_t>(at));
  }
  const Eigen::RowVector3d top = seam.colwise().mean() + Eigen::RowVector3d(0, 20, 0);
  mesh.positions.conservativeResize(first + around + 1, 3);
  mesh.positions.row(first + around) = top;
  for (std::uint32_t i = 0; i < around; ++i) {
    const std::uint32_t next = (i + 1) % around;
    mesh.positions.row(first + i) = seam.row(i) + Eigen::RowVector3d(0, 8, 0);
    mesh.topology.add_face(std::array{ring[i], first + i, first + next, ring[next]});
    mesh.topology.add_face(std::array{first + i, first + around, first + next});
  }
  mesh.topology.vertex_count = mesh.positions.rows();
  return mesh;
}

// A full body is closed at the neck: the vertices of its seam are named, and its head is left out.
TEST_F(NeckPlacing, TheBodysRimMayBeNamed) {
  constexpr const char* kFiles = ", meshes: [obj, glb, usd], lods: [40 %]";
  const auto open = run("{body: body.obj, write_body: true}", "", kFiles, "open");
  std::string numbers;
  const Mesh full = full_body(seam_);
  for (Index i = 0; i < seam_.rows(); ++i) {
    Index at = 0;
    (full.positions.rowwise() - seam_.row(i)).rowwise().norm().minCoeff(&at);
    numbers += concat(at, ' ');
  }
  write_body(full);
  expect_refused({"expected an open rim of", "1.60 times as large"});  // the lower end
  folder_.write("seam.txt", numbers);
  const auto closed =
      run("{body: body.obj, body_rim: seam.txt, write_body: true}", "", kFiles, "closed");
  const auto before = testing::crowd_files(open / "meshes");
  EXPECT_THAT(testing::differing_files(testing::crowd_files(closed / "meshes"), before),
              ::testing::IsEmpty());
  EXPECT_GT(before.size(), 20U);
  write_body(body_below(seam_));  // an open rim may be named, too
  run("{body: body.obj, body_rim: seam.txt, write_body: true}", "", kFiles, "named");
  EXPECT_THAT(testing::differing_files(testing::crowd_files(folder_ / "named/meshes"), before),
              ::testing::IsEmpty());
  expect_error(ExitCode::kUsage, {"body_rim", "need body"},
               [&] { load_job(configure("{like: mean, body_rim: seam.txt}", ""), {}); });
  folder_.write("seam.txt", "5 7");
  expect_error(ExitCode::kBadData, {"seam.txt", "one closed loop"},
               [&] { load_job(configure("{body: body.obj, body_rim: seam.txt}", ""), {}); });
}

TEST_F(NeckPlacing, ABodyThatDoesNotFitIsRefused) {
  Mesh body = body_below(seam_);
  body.positions *= 2.54;
  write_body(body);
  expect_refused({"neck:", "2.54 times as large"});
  body = body_below(seam_);
  body.positions.rowwise() += Eigen::RowVector3d(0, -30, 0);
  write_body(body);
  expect_refused({"elsewhere, 30"});
  write_body(body_below(seam_.topRows(seam_.rows() - 2)));
  expect_refused({concat("of ", seam_.rows(), " vertices"), concat("rims of ", seam_.rows() - 2)});
}

TEST_F(NeckPlacing, FarNecksAreWarnedOf) {
  const Job job = load_job(configure("{body: body.obj, falloff: 12 mm}", ""), {});
  EXPECT_THAT(job.inputs.warnings, ::testing::Contains(HasSubstr("a falloff of 12 mm")));
}

}  // namespace
}  // namespace crowdface
