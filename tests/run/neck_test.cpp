// SPDX-License-Identifier: Apache-2.0
// Whole runs of crowds whose faces all end on one body.
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "crowdface/cast/face_area.h"
#include "crowdface/core/text.h"
#include "crowdface/crowd/verify.h"
#include "crowdface/heads/heads_on_body.h"
#include "crowdface/io/image.h"
#include "crowdface/io/obj_writer.h"
#include "crowdface/io/srgb.h"
#include "crowdface/mesh/all_columns.h"
#include "crowdface/mesh/edge_distances.h"
#include "crowdface/mesh/normals.h"
#include "crowdface/neck/match_rims.h"
#include "crowdface/run/generate.h"
#include "crowdface/run/pipeline.h"
#include "head_models/synth/synthetic_head.h"

#include "support/crowd_files.h"
#include "support/expect_error.h"
#include "support/mesh_files.h"
#include "support/reference.h"
#include "support/temporary_folder.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;
using testing::expect_error;
using ::testing::HasSubstr;
using testing::Singles;
using Single = std::array<float, 3>;

Single single(const Eigen::RowVector3d& row) {
  return {static_cast<float>(row.x()), static_cast<float>(row.y()), static_cast<float>(row.z())};
}

/// The mesh as OBJ text with one `vn` line for each vertex.
std::string with_normals(const Mesh& mesh) {
  std::istringstream lines(encode_obj(mesh, "").text());
  std::string text, normals;
  for (Index v = 0; v < mesh.positions.rows(); ++v) normals += "vn 0 0 1\n";
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("f ")) {
      text += line + '\n';
      continue;
    }
    text += std::exchange(normals, "") + "f";
    for (const std::string& corner : words_of(line.substr(2))) {
      text += concat(' ', corner, '/', corner.substr(0, corner.find('/')));
    }
    text += '\n';
  }
  return text;
}

/// A body: rings of quads downwards from the seam, numbered from below and against the heads'
/// direction. Its polygons face inward.
Mesh body_below(const Positions& seam) {
  constexpr Index kRings = 4;
  const auto around = static_cast<std::uint32_t>(seam.rows());
  Mesh mesh;
  mesh.positions.resize(kRings * seam.rows(), 3);
  const auto at = [&](Index ring, std::uint32_t i) {
    return static_cast<std::uint32_t>(kRings - 1 - ring) * around + (around - 1 - (i + 5) % around);
  };
  const Eigen::RowVector3d middle = seam.colwise().mean();
  for (Index ring = 0; ring < kRings; ++ring) {
    for (std::uint32_t i = 0; i < around; ++i) {
      const Eigen::RowVector3d out = seam.row(i) - middle;
      const double step = static_cast<double>(ring);
      mesh.positions.row(at(ring, i)) =
          seam.row(i) + 0.2 * step * out - Eigen::RowVector3d(0, 1.5 * step, 0);
    }
  }
  std::vector<std::vector<std::uint32_t>> faces;
  for (Index ring = 0; ring + 1 < kRings; ++ring) {
    for (std::uint32_t i = 0; i < around; ++i) {
      const std::uint32_t next = (i + 1) % around;
      mesh.topology.add_face(
          std::array{at(ring, i), at(ring, next), at(ring + 1, next), at(ring + 1, i)});
    }
  }
  mesh.topology.vertex_count = mesh.positions.rows();
  return mesh;
}

/// A folder of synthetic heads and a body for them.
class Neck : public ::testing::Test {
 protected:
  static constexpr Index kHeads = 5;

  Neck() : heads_(9000, SyntheticHeads::Parts::kEyesAndTeeth) {
    Positions mean = Positions::Zero(heads_.topology().vertex_count, 3);
    for (Index h = 0; h < kHeads; ++h) {
      const Mesh mesh{heads_.topology(), heads_.positions(5, static_cast<std::uint64_t>(h)),
                      heads_.uvs()};
      mean += mesh.positions / static_cast<double>(kHeads);
      folder_.write(concat("heads/head_", h, ".obj"), with_normals(mesh));
    }
    const Adjacency adjacency = build_adjacency(heads_.topology());
    rim_ = lowest_rim(open_rims(heads_.topology(), adjacency), mean, {0, 1, 0}, 10);
    seam_ = mean(rim_, kAllColumns);
    for (Index i = 0; i < seam_.rows(); ++i) {
      seam_.row(i) += Eigen::RowVector3d(0.3, 0.2 * std::sin(static_cast<double>(i) / 9), 0.4);
      for (double& value : seam_.row(i)) value = std::round(1e5 * value) / 1e5;
    }
    write_body(body_below(seam_));
  }

  /// Gives each head a texture: a grey of its own at the neck, lighter towards the crown.
  void paint_heads() const {
    constexpr int kSide = 128;
    for (int h = 0; h < kHeads; ++h) {
      const std::string name = concat("heads/head_", h);
      std::vector<std::uint8_t> grey;
      for (int t = 0; t < kSide * kSide; ++t) {
        grey.push_back(static_cast<std::uint8_t>(250 - (190 - 30 * h) * (t / kSide) / kSide));
      }
      folder_.write(name + ".png", encode_png(kSide, kSide, 1, grey));
      folder_.write(name + ".mtl", concat("newmtl skin\nmap_Kd head_", h, ".png\n"));
      folder_.write(name + ".obj", concat("mtllib head_", h, ".mtl\nusemtl skin\n",
                                          testing::read_text(folder_ / (name + ".obj"))));
    }
  }
  void write_body(const Mesh& body) {
    body_ = body;
    encode_obj(body, "").write(folder_ / "body.obj");
  }
  fs::path configure(const std::string& neck, const std::string& more,
                     const std::string& output = "", const std::string& name = "out") const {
    return folder_.write(
        concat(name, ".yaml"),
        concat("schema: 1\ncrowd: {name: mob, count: 4, seed: 3}\n",
               "faces: {directory: heads, units: cm}\n", neck.empty() ? "" : "neck: ", neck, "\n",
               "output: {directory: ", name, ", contact_sheet: none", output, "}\n", more));
  }
  fs::path run(const std::string& neck, const std::string& more, const std::string& output = "",
               const std::string& name = "out") const {
    generate(configure(neck, more, output, name), {}, {folder_ / "cache", Replace::kRefuse, false});
    return folder_ / name;
  }
  void expect_refused(const std::vector<std::string>& phrases) const {
    for (const std::string& phrase : phrases) {
      expect_error(ExitCode::kBadData, {"body.obj", phrase},
                   [&] { load_job(configure("{body: body.obj}", ""), {}); });
    }
  }

  /// The unit normals of head and body together: the sum of the area vectors of all polygons there.
  Singles normals_at_seam(const Inputs& inputs) const {
    std::map<Single, Eigen::Vector3d> sums;
    const auto add = [&](const Topology& topology, const Positions& positions, double sign) {
      for (Index f = 0; f < topology.face_count(); ++f) {
        for (const std::uint32_t v : topology.face(f)) {
          sums.try_emplace(single(positions.row(v)), Eigen::Vector3d::Zero()).first->second +=
              sign * face_area_vector(topology, f, positions);
        }
      }
    };
    Positions mean = inputs.mean;
    inputs.neck->seam.fit(mean);
    add(inputs.faces.topology, mean, 1);
    add(body_.topology, body_.positions, body_sign_);
    Singles normals;
    for (Index i = 0; i < seam_.rows(); ++i) {
      normals.push_back(single(sums.at(single(seam_.row(i))).normalized().transpose()));
    }
    return normals;
  }

  testing::TemporaryFolder folder_;
  SyntheticHeads heads_;
  Rim rim_;
  Positions seam_;  ///< in the order of `rim_`
  Mesh body_;
  double body_sign_ = -1;  ///< of its area vectors
};

/// Points of a file and, if it has any, their normals.
struct Surface {
  Singles points, normals;
};

/// The rows after `key` in a USD layer: "[(1, 2, 3), …]".
Singles usd_rows(const std::string& layer, const std::string& key) {
  Singles rows;
  const std::size_t begin = layer.find(key);
  if (begin == layer.npos) return rows;
  std::string text = layer.substr(begin + key.size(), layer.find(']', begin) - begin - key.size());
  std::ranges::replace_if(
      text, [](char c) { return c == '(' || c == ')' || c == ','; }, ' ');
  std::istringstream numbers(text);
  for (Single row{}; numbers >> row[0] >> row[1] >> row[2];) rows.push_back(row);
  return rows;
}

/// The corners' positions and normals of an OBJ file.
Surface obj_surface(const fs::path& file) {
  Singles v, vn;
  Surface surface;
  std::istringstream lines(testing::read_text(file));
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string word;
    words >> word;
    Single row{};
    if (word == "v" || word == "vn") {
      words >> row[0] >> row[1] >> row[2];
      (word == "v" ? v : vn).push_back(row);
    }
    const bool is_face = word == "f";
    while (is_face && words >> word) {
      surface.points.push_back(v.at(std::stoul(word) - 1));
      const std::size_t slash = word.rfind('/');
      surface.normals.push_back(vn.at(std::stoul(word.substr(slash + 1)) - 1));
    }
  }
  return surface;
}

Surface surface_of(const fs::path& file) {
  if (file.extension() == ".obj") return obj_surface(file);
  if (file.extension() == ".ply") {
    testing::PlyFile ply = testing::read_ply(file);
    return {ply.points, ply.normals};
  }
  if (file.extension() == ".glb") {
    testing::GlbFile glb = testing::read_glb(file);
    return {glb.points, glb.normals};
  }
  if (file.extension() == ".usda") {
    const std::string layer = testing::read_text(file);
    return {usd_rows(layer, "point3f[] points = ["), usd_rows(layer, "normal3f[] normals = [")};
  }
  std::string dictionary;
  const auto numbers = testing::read_npy_numbers<float>(file, dictionary);
  Surface surface;
  for (std::size_t i = 0; i + 2 < numbers.size(); i += 3) {
    surface.points.push_back({numbers[i], numbers[i + 1], numbers[i + 2]});
  }
  return surface;
}

/// Expects each position of the seam in the file, exactly, with the seam's normal within rounding;
/// `found` has the normals of the first file and expects those of all others to be the same.
void expect_seam(const Surface& surface, const std::string& what, const Positions& seam,
                 const Singles& normals, std::map<Single, Single>& found) {
  SCOPED_TRACE(what);
  ASSERT_GT(surface.points.size(), 100U);
  std::map<Single, std::vector<std::size_t>> at;
  for (std::size_t i = 0; i < surface.points.size(); ++i) at[surface.points[i]].push_back(i);
  for (Index i = 0; i < seam.rows(); ++i) {
    const Single place = single(seam.row(i));
    ASSERT_TRUE(at.contains(place)) << "vertex " << i << " of the seam is elsewhere or missing";
    for (const std::size_t row : at[place]) {
      if (surface.normals.empty()) continue;
      const Single& normal = surface.normals.at(row);
      EXPECT_EQ(found.try_emplace(place, normal).first->second, normal);
      for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_NEAR(normal[c], normals[static_cast<std::size_t>(i)][c], 1e-5);
      }
    }
  }
}

void expect_seam(const fs::path& file, const Positions& seam, const Singles& normals,
                 std::map<Single, Single>& found) {
  expect_seam(surface_of(file), file.filename().string(), seam, normals, found);
}

constexpr const char* kAllWithLevels = ", meshes: [obj, ply, glb, usd, points], lods: [40 %, 10 %]";
constexpr const char* kVaried =
    "sampling: {asymmetry: [0.4, 1.3], mirror: drawn, smoothness: [0.3, 1]}\n"
    "families:\n  - {name: smith, members: 2, target: head_1, max_distance: 4 mm}\n";

TEST_F(Neck, EveryFileOfEveryFaceEndsInTheBodysRing) {
  for (const char* boundary : {"fixed", "free"}) {
    const auto out =
        run("{body: body.obj}", concat("smoothing: {boundary: ", boundary, "}\n", kVaried),
            kAllWithLevels, boundary);
    const Job job = load_job(folder_ / concat(boundary, ".yaml"), {});
    const Singles normals = normals_at_seam(job.inputs);
    std::map<Single, Single> found;
    std::size_t files = 0, mirrored = 0;
    for (const auto& line : testing::plan_lines(out)) mirrored += line.contains("mirrored");
    for (const auto& entry : fs::directory_iterator(out / "meshes")) {
      if (!entry.is_regular_file()) continue;
      expect_seam(entry.path(), seam_, normals, found);
      ++files;
    }
    EXPECT_EQ(files, 6 * (5 + 2 * 4)) << "six faces in five formats, levels of detail in four";
    EXPECT_GT(mirrored, 0U);
    EXPECT_TRUE(verify_crowd(out).good());
  }
}

constexpr const char* kThreeRecipes =
    "recipes:\n"
    "  - {id: a, target: head_1, regions: {all: {weights: {head_2: 1, head_0: 1}, smoothness: "
    "0.7}}}\n"
    "  - {id: b, target: head_3, regions: {all: {weights: {head_2: 1}, smoothness: 0.4}}}\n"
    "  - {id: c, target: head_4, mirrored: true, "
    "regions: {all: {weights: {head_1: 1}, smoothness: 0.9}}}\n";

// The body changes neither the plan nor the faces above the bend.
TEST_F(Neck, TheCrowdIsTheSame) {
  const std::string more = concat(kThreeRecipes, kVaried);
  const auto plain = run("", more, "", "plain"), fitted = run("{body: body.obj}", more);
  const Job job = load_job(folder_ / "out.yaml", {});
  std::vector<double> areas = face_areas(job.inputs.faces.topology, job.inputs.skin,
                                         job.inputs.mean, FaceArea::kFront, {2, 1});
  for (const std::uint32_t v : job.inputs.neck->seam.neck.vertices()) areas[v] = 0;
  for (const std::uint32_t v : rim_) areas[v] = 0;
  const auto before = testing::plan_lines(plain), after = testing::plan_lines(fitted);
  ASSERT_EQ(before.size(), after.size());
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_EQ(before[i].at("regions"), after[i].at("regions"));
    const auto mesh_of = [&](const fs::path& crowd) {
      return read_obj(crowd / "meshes" / concat(before[i].at("id").get<std::string>(), ".obj"))
          .positions;
    };
    EXPECT_LT(face_distance(mesh_of(plain), mesh_of(fitted), areas), 1e-4) << before[i].at("id");
  }
  const auto faces = [](const fs::path& crowd) {
    return testing::read_json(crowd / "report.json").at("faces");
  };
  for (std::size_t i = 0; i < before.size(); ++i) {
    const auto skin = faces(plain).at(i).at("skin"), bent = faces(fitted).at(i).at("skin");
    EXPECT_EQ(skin.at("flipped"), bent.at("flipped"));
    EXPECT_NEAR(bent.at("stretch").get<double>(), skin.at("stretch").get<double>(), 0.01);
    EXPECT_NEAR(bent.at("wider_mm").get<double>(), skin.at("wider_mm").get<double>(), 0.01);
  }
}

TEST_F(Neck, HeadsAreMovedButNotTiltedScaledOrBent) {
  const Job plain = load_job(configure("", "", "", "plain"), {});
  const Job job = load_job(configure("{body: body.obj}", ""), {});
  for (std::size_t h = 0; h < kHeads; ++h) {
    const auto& [placed, moved_mm, bent_mm] = job.inputs.neck->heads[h];
    const Positions& head = job.inputs.faces.heads[h].positions;
    const Positions by = head - plain.inputs.faces.heads[h].positions;
    const Eigen::RowVector3d shift = (placed.to - placed.from).transpose();
    EXPECT_TRUE(placed.rotation.isIdentity(1e-12));
    EXPECT_NEAR(moved_mm, 10 * shift.norm(), 1e-6);
    EXPECT_LT((by.rowwise() - shift).cwiseAbs().maxCoeff(), 1e-9);
    const Positions rest = seam_ - head(rim_, kAllColumns);
    EXPECT_NEAR(bent_mm, 10 * rest.rowwise().norm().maxCoeff(), 1e-3);
    EXPECT_LT(rest.colwise().mean().norm(), 1e-5);
  }
}

// Heads that look elsewhere than the body are turned alike: their rims tell by how much.
TEST_F(Neck, TurnedHeadsAreTurnedBackTogether) {
  const Job straight = load_job(configure("{body: body.obj}", ""), {});
  const Eigen::AngleAxisd turn(0.2, Eigen::Vector3d(0.6, 0.8, 0));
  for (Index h = 0; h < kHeads; ++h) {
    const std::string name = concat("heads/head_", h, ".obj");
    Mesh mesh{heads_.topology(), read_obj(folder_ / name).positions, heads_.uvs()};
    for (Index v = 0; v < mesh.positions.rows(); ++v) {
      const Eigen::Vector3d turned = turn * Eigen::Vector3d(mesh.positions.row(v).transpose());
      mesh.positions.row(v) = turned.transpose();
    }
    folder_.write(name, with_normals(mesh));
  }
  const Job job = load_job(configure("{body: body.obj}", ""), {});
  const Eigen::Matrix3d& rotation = job.inputs.neck->heads[2].placed.rotation;
  EXPECT_NEAR(Eigen::AngleAxisd(rotation).angle(), 0.2, 0.1);  // the rings are nearly round
  for (std::size_t h = 0; h < kHeads; ++h) {
    EXPECT_EQ(job.inputs.neck->heads[h].placed.rotation, rotation);
    EXPECT_TRUE(straight.inputs.neck->heads[h].placed.rotation.isIdentity(1e-12));
  }
}

// A finished crowd gets a body, another falloff and no body again; its faces stay who they are.
TEST_F(Neck, MayChangeInAFinishedCrowd) {
  const auto files = [&](const std::string& name) { return testing::crowd_files(folder_ / name); };
  const std::string more = concat(kVaried, "traits: {face_height: {}}\n");
  run("", more);
  const auto plain = files("out");
  const auto before = testing::plan_lines(folder_ / "out");
  for (const char* neck : {"{body: body.obj}", "{body: body.obj, falloff: 40 mm}", "mean"}) {
    SCOPED_TRACE(neck);
    run(neck, more);
    const auto lines = testing::plan_lines(folder_ / "out");
    ASSERT_EQ(lines.size(), before.size());
    for (std::size_t i = 0; i < lines.size(); ++i) {
      auto line = lines[i];
      line["traits"] = before[i].at("traits");
      EXPECT_EQ(line, before[i]);
    }
    EXPECT_NE(files("out").at("meshes/mob_0001.obj"), plain.at("meshes/mob_0001.obj"));
    fs::remove_all(folder_ / "again");
    run(neck, more, "", "again");
    EXPECT_THAT(testing::differing_files(files("again"), files("out")), ::testing::IsEmpty());
  }
  run("", more);
  EXPECT_THAT(testing::differing_files(plain, files("out")), ::testing::IsEmpty());
}

/// The difference of each vertex from the mean of its neighbours; zero on open borders.
Positions curvature(const Inputs& inputs, const Positions& positions) {
  Positions result = Positions::Zero(positions.rows(), 3);
  for (Index v = 0; v < positions.rows(); ++v) {
    const auto around = inputs.adjacency.of(v);
    if (inputs.adjacency.boundary[static_cast<std::size_t>(v)] || around.empty()) continue;
    for (const std::uint32_t other : around) result.row(v) += positions.row(other);
    result.row(v) = result.row(v) / static_cast<double>(around.size()) - positions.row(v);
  }
  return result;
}

// Across the falloff, the bend changes the heads' curvature by less than the curvature that they
// have there, and least at its upper end.
TEST_F(Neck, TheBendIsSmootherThanTheHeads) {
  const Job job = load_job(configure("{body: body.obj}", ""), {});
  const Seam& seam = job.inputs.neck->seam;
  double change = 0, own = 0;
  for (const Head& head : job.inputs.faces.heads) {
    Positions fitted = head.positions;
    seam.fit(fitted);
    const Positions before = curvature(job.inputs, head.positions);
    const Positions after = curvature(job.inputs, fitted);
    for (const std::uint32_t v : seam.neck.vertices()) {
      change += (after.row(v) - before.row(v)).squaredNorm();
      own += before.row(v).squaredNorm();
    }
  }
  EXPECT_LT(std::sqrt(change), 0.5 * std::sqrt(own));
}

TEST_F(Neck, ShapesDoNotMoveTheRing) {
  Positions shrug = read_obj(folder_ / "heads/head_0.obj").positions;
  for (Index v = 0; v < shrug.rows(); ++v) shrug(v, 1) += 0.5 - 0.02 * shrug(v, 1);
  encode_obj({heads_.topology(), shrug, heads_.uvs()}, "")
      .write(folder_.write("shapes/a", "").parent_path() / "shrug.obj");
  const auto out =
      run("{body: body.obj}", "shapes: {neutral: heads/head_0.obj, directory: shapes}\n",
          ", meshes: [obj, glb, usd]");
  const Job job = load_job(folder_ / "out.yaml", {});
  const std::vector<std::uint32_t>& moved = job.inputs.shapes.shapes[0].moves.vertices;
  EXPECT_GT(moved.size(), 5000U);
  for (const std::uint32_t v : rim_) EXPECT_FALSE(std::ranges::binary_search(moved, v));
  const Singles normals = normals_at_seam(job.inputs);
  std::map<Single, Single> found;
  for (int face = 1; face <= 4; ++face) {
    expect_seam(out / "meshes" / concat("mob_000", face, "+shrug.obj"), seam_, normals, found);
  }
}

TEST_F(Neck, MayBeThatOfAHeadOrTheirMean) {
  const Positions head = read_obj(folder_ / "heads/head_3.obj").positions;
  const Job like = load_job(configure("{like: head_3}", ""), {});
  EXPECT_EQ(like.inputs.faces.heads[3].positions, head);
  EXPECT_EQ(like.inputs.neck->seam.positions, head(rim_, kAllColumns));
  for (const char* neck : {"mean", "{like: mean, falloff: 4 cm}"}) {
    const Job mean = load_job(configure(neck, ""), {});
    Positions sum = Positions::Zero(seam_.rows(), 3);
    for (const Head& one : mean.inputs.faces.heads) sum += one.positions(rim_, kAllColumns);
    const Positions& ring = mean.inputs.neck->seam.positions;
    EXPECT_LT((sum / double{kHeads} - ring).cwiseAbs().maxCoeff(), 1e-9);
  }
  EXPECT_EQ(testing::read_text(run("", "", "", "plain") / "config.yaml").find("neck"),
            std::string::npos);
}

// A full body has no open rim at its neck, but the vertices of the seam can be named.
TEST_F(Neck, TheRimMayBeNamed) {
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

TEST_F(Neck, ABodyThatDoesNotFitIsRefused) {
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

/// The cells of a row of crowd.csv by their columns.
std::map<std::string, std::string> table_row(const fs::path& crowd, const std::string& id) {
  std::istringstream lines(testing::read_text(crowd / "crowd.csv"));
  const auto cells = [](const std::string& line) {
    std::vector<std::string> cells = {""};
    for (const char c : line) {
      if (c == ',') {
        cells.emplace_back();
      } else if (c != '\r') {
        cells.back() += c;
      }
    }
    return cells;
  };
  std::string line;
  std::getline(lines, line);
  const std::vector<std::string> names = cells(line);
  std::map<std::string, std::string> row;
  while (std::getline(lines, line)) {
    const std::vector<std::string> values = cells(line);
    if (values.front() != id) continue;
    for (std::size_t c = 0; c < names.size(); ++c) row[names[c]] = values.at(c);
  }
  return row;
}

TEST_F(Neck, TheTableTellsTheMeanOfTheTextureAboveTheRing) {
  paint_heads();
  const auto out = run("{body: body.obj}", kThreeRecipes);
  const Inputs inputs = std::move(load_job(folder_ / "out.yaml", {}).inputs);
  EdgeDistances distances(inputs.adjacency, inputs.mean);
  distances.search(rim_, 2);  // 20 mm
  for (const char* id : {"a", "b", "mob_0001"}) {
    const Image image = read_image(out / "meshes/blended" / concat(id, ".png"));
    double sum = 0, areas = 0;
    for (Index f = 0; f < heads_.topology().face_count(); ++f) {
      double inside = 0;
      Eigen::RowVector2d place = Eigen::RowVector2d::Zero();
      const auto corners = heads_.topology().face(f), uvs = heads_.topology().face_uvs(f);
      for (std::size_t c = 0; c < corners.size(); ++c) {
        if (std::isfinite(distances.distance(corners[c]))) inside += 1;
        place += heads_.uvs().row(uvs[c]) / static_cast<double>(corners.size());
      }
      const double area = inside * face_area_vector(heads_.topology(), f, inputs.mean).norm();
      const double value = image.at(static_cast<int>(place.x() * image.width),
                                    static_cast<int>((1 - place.y()) * image.height), 0);
      sum += area * linear_of_srgb(value);
      areas += area;
    }
    const double found = std::stod(table_row(out, id).at("neck_linear_r"));
    EXPECT_NEAR(found / (sum / areas), 1, 0.03) << id;
  }
  const auto faces = testing::read_json(out / "report.json").at("faces");
  EXPECT_EQ(faces.size(), 7U);
  for (const auto& face : faces) {
    const auto row = table_row(out, face.at("id"));
    EXPECT_EQ(face.at("neck").at("srgb"), row.at("neck_srgb"));
    EXPECT_EQ(face.at("neck").at("linear").at(0).get<double>(), std::stod(row.at("neck_linear_r")));
  }
  // The same without pictures and blended files, from the targets' textures.
  generate(configure("{body: body.obj}", concat("textures: {blend: target}\n", kThreeRecipes), "",
                     "plain"),
           {}, {folder_ / "cache", Replace::kRefuse, false});
  const auto of_target = table_row(folder_ / "plain", "c").at("neck_linear_r");
  EXPECT_NE(of_target, table_row(out, "c").at("neck_linear_r"));
  EXPECT_EQ(of_target, table_row(folder_ / "plain", "c").at("neck_linear_g"));
}

/// Gives the body texture coordinates around its axis and a grey texture.
void paint_body(testing::TemporaryFolder& folder, Mesh body) {
  body.uvs.resize(body.positions.rows(), 2);
  const Eigen::RowVector3d middle = body.positions.colwise().mean();
  const double low = body.positions.col(1).minCoeff(), high = body.positions.col(1).maxCoeff();
  for (Index v = 0; v < body.positions.rows(); ++v) {
    // Seen from above: the ring is the inner circle.
    const Eigen::RowVector3d out = body.positions.row(v) - middle;
    const double radius = 0.2 + 0.25 * (high - body.positions(v, 1)) / (high - low);
    const double angle = std::atan2(out.z(), out.x());
    body.uvs.row(v) << 0.5 + radius * std::cos(angle), 0.5 + radius * std::sin(angle);
  }
  body.topology.corner_uvs = body.topology.corner_vertices;
  encode_obj(body, "").write(folder / "body.obj");
  folder.write("body.png",
               encode_png(256, 256, 1, std::vector<std::uint8_t>(std::size_t{256} * 256, 90)));
}

/// The value of an image at texture coordinates.
double value_at(const Image& image, const Eigen::RowVector2d& uv) {
  return image.at(static_cast<int>(uv.x() * image.width),
                  static_cast<int>((1 - uv.y()) * image.height), 0);
}

TEST_F(Neck, TheBodysTextureAgreesWithTheFaceAtTheRing) {
  paint_heads();
  paint_body(folder_, body_);
  const auto out = run("{body: body.obj, body_texture: body.png}", kThreeRecipes);
  const ObjFile body = read_obj(folder_ / "body.obj");
  const auto far = [&](const std::string& id) {
    const Image image = read_image(out / "meshes/blended" / concat(id, ".body.png"));
    EXPECT_EQ(image.width, 256);
    const Image face = read_image(out / "meshes/blended" / concat(id, ".png"));
    // The face's texture depends on the height only; the ring has a few polygons of height.
    for (Index i = 0; i < seam_.rows(); i += 5) {
      const std::uint32_t v = rim_[static_cast<std::size_t>(i)];
      double above = 0, count = 0;
      for (Index f = 0; f < heads_.topology().face_count(); ++f) {
        const auto corners = heads_.topology().face(f), uvs = heads_.topology().face_uvs(f);
        for (std::size_t c = 0; c < corners.size(); ++c) {
          if (corners[c] != v) continue;
          above += value_at(face, heads_.uvs().row(uvs[c]));
          count += 1;
        }
      }
      Index at = 0;
      (body.positions.rowwise() - seam_.row(i)).rowwise().norm().minCoeff(&at);
      EXPECT_NEAR(value_at(image, body.uvs.row(at)), above / count, 0.05) << id << ' ' << i;
    }
    return value_at(image, Eigen::RowVector2d(0.94, 0.5));
  };
  EXPECT_NE(far("a"), far("b")) << "each face its own";
  EXPECT_TRUE(verify_crowd(out).good());
}

/// The points and normals of the mesh `body` in a GLB or USD file; empty if there is none.
Surface body_in(const fs::path& file) {
  if (file.extension() == ".glb") {
    const testing::GlbFile glb = testing::read_glb(file, 1);
    EXPECT_EQ(glb.scene.at("meshes").at(1).at("name"), "body");
    return {glb.points, glb.normals};
  }
  const std::string layer = testing::read_text(file);
  const std::size_t begin = layer.find("def Mesh \"body\"");
  if (begin == layer.npos) return {};
  const std::string mesh = layer.substr(begin);
  return {usd_rows(mesh, "point3f[] points = ["), usd_rows(mesh, "normal3f[] normals = [")};
}

TEST_F(Neck, GlbAndUsdFilesContainTheBody) {
  const auto out =
      run("{body: body.obj, write_body: true}", "", ", meshes: [obj, ply, glb, usd], lods: [40 %]");
  const Job job = load_job(folder_ / "out.yaml", {});
  const Singles normals = normals_at_seam(job.inputs);
  std::map<Single, Single> found;
  for (const char* file :
       {"mob_0001.glb", "mob_0002.usda", "mob_0003+LOD1.glb", "mob_0004+LOD1.usda"}) {
    expect_seam(out / "meshes" / file, seam_, normals, found);
    // The body has the normals of the faces, not those of its own polygons alone.
    expect_seam(body_in(out / "meshes" / file), file, seam_, normals, found);
  }
  for (const char* file : {"mob_0001.obj", "mob_0001.ply", "mob_0001+LOD1.obj"}) {
    EXPECT_EQ(testing::read_text(out / "meshes" / file).find("body"), std::string::npos) << file;
  }
  EXPECT_EQ(body_in(out / "meshes/mob_0001.glb").points.size(),
            static_cast<std::size_t>(body_.positions.rows()));
  EXPECT_LT(body_in(out / "meshes/mob_0001+LOD1.glb").points.size(),
            static_cast<std::size_t>(body_.positions.rows()));
  EXPECT_TRUE(verify_crowd(out).good());
  // Faces are those of a crowd without the body.
  const auto plain = run("{body: body.obj}", "", ", meshes: [obj]", "plain");
  EXPECT_EQ(testing::read_text(out / "meshes/mob_0004.obj"),
            testing::read_text(plain / "meshes/mob_0004.obj"));
}

TEST_F(Neck, TheBodyInFilesHasTheFacesTexture) {
  paint_heads();
  paint_body(folder_, body_);
  const auto out = run("{body: body.obj, body_texture: body.png, write_body: true}", kThreeRecipes,
                       ", meshes: [glb, usd], lods: [40 %]");
  for (const char* id : {"a", "b", "mob_0001"}) {
    const std::string picture =
        testing::read_text(out / "meshes/blended" / concat(id, ".body.png"));
    for (const char* level : {"", "+LOD1"}) {
      const fs::path file = out / "meshes" / concat(id, level);
      EXPECT_NE(testing::read_text(file.string() + ".glb").find(picture), std::string::npos)
          << file << " contains the texture";
      EXPECT_THAT(testing::read_text(file.string() + ".usda"),
                  HasSubstr(concat("@./blended/", id, ".body.png@")));
    }
  }
  EXPECT_FALSE(fs::exists(out / "meshes/attachments/body")) << "no file names these";
  EXPECT_TRUE(verify_crowd(out).good());
}

TEST_F(Neck, PicturesShowTheBodyInTheFacesColour) {
  paint_heads();
  const auto pictures = [&](const std::string& neck, const std::string& name) {
    const fs::path config = folder_.write(
        concat(name, ".yaml"),
        concat("schema: 1\ncrowd: {name: mob, count: 2, seed: 3}\n",
               "faces: {directory: heads, units: cm}\nneck: ", neck, "\noutput: {directory: ", name,
               ", meshes: [obj], contact_sheet: {cell: 96}}\n"));
    generate(config, {}, {folder_ / "cache", Replace::kRefuse, false});
    return read_image(folder_ / name / "renders/mob_0001.png");
  };
  // Heads alone are larger: their necks may be cut off, but shoulders must be seen.
  const Image alone = pictures("{body: body.obj}", "alone");
  const Image shown = pictures("{body: body.obj, show_body: true}", "shown");
  const auto skin_rows = [](const Image& image) {  // rows that differ from the background
    int rows = 0;
    for (int y = 0; y < image.height; ++y) {
      const float grey = image.at(0, y, 0) - image.at(image.width / 2, y, 0);
      rows += std::abs(grey) > 0.05F ? 1 : 0;
    }
    return rows;
  };
  EXPECT_NE(skin_rows(shown), skin_rows(alone));
  EXPECT_TRUE(verify_crowd(folder_ / "shown").good());
  EXPECT_EQ(testing::read_text(folder_ / "alone/meshes/mob_0002.obj"),
            testing::read_text(folder_ / "shown/meshes/mob_0002.obj"));
}

/// The largest change of light from one row to the next at the seam, in the middle of a picture.
/// \param below  the picture whose lowest rows, which show the body, are used
double largest_step(const Image& image, const Image& below) {
  const auto value = [&](int y) {
    const Image& from = y < image.height * 92 / 100 ? image : below;
    double sum = 0;
    for (int x = image.width / 2 - 3; x < image.width / 2 + 3; ++x) sum += from.at(x, y, 0) / 6;
    return sum;
  };
  double step = 0;
  for (int y = image.height * 84 / 100; y + 1 < image.height; ++y) {
    step = std::max(step, std::abs(value(y + 1) - value(y)));
  }
  return step;
}

TEST_F(Neck, NoSeamShowsOnSheets) {
  paint_heads();
  paint_body(folder_, body_);
  const fs::path config = folder_.write(
      "out.yaml",
      concat("schema: 1\ncrowd: {name: mob, count: 0}\n",
             "faces: {directory: heads, units: cm}\nneck: {body: body.obj, "
             "body_texture: body.png, show_body: true}\n",
             kThreeRecipes,
             "output: {directory: out, meshes: [points], contact_sheet: {cell: 256}}\n"));
  generate(config, {}, {folder_ / "cache", Replace::kRefuse, false});
  const auto picture = [&](const char* id) {
    return read_image(folder_ / "out/renders" / concat(id, ".png"));
  };
  const Image a = picture("a"), b = picture("b"), c = picture("c");
  const double across = largest_step(a, c);
  for (const Image* face : {&a, &b, &c}) {
    EXPECT_LT(largest_step(*face, *face), 0.3 * across) << "a face on the body of another";
  }
}

TEST_F(Neck, OnlyABodyCanBeShown) {
  const Mesh head{heads_.topology(), read_obj(folder_ / "heads/head_2.obj").positions, {}};
  encode_obj(head, "").write(folder_ / "body.obj");
  expect_error(ExitCode::kBadData, {"body.obj", "found a head"},
               [&] { load_job(configure("{body: body.obj, show_body: true}", ""), {}); });
  expect_error(ExitCode::kUsage, {"show_body", "need body"},
               [&] { load_job(configure("{like: mean, show_body: true}", ""), {}); });
  write_body(body_below(seam_));
  folder_.write("body.png", encode_png(4, 4, 1, std::vector<std::uint8_t>(16, 90)));
  expect_error(ExitCode::kUsage, {"body_texture", "neither textures"},
               [&] { load_job(configure("{body: body.obj, body_texture: body.png}", ""), {}); });
}

TEST_F(Neck, TheTableTellsTheColoursOfVertices) {
  const auto plain = run("{body: body.obj}", kThreeRecipes, "", "plain");
  EXPECT_FALSE(table_row(plain, "a").contains("neck_srgb")) << "there are no colours";
  for (Index h = 0; h < kHeads; ++h) {
    const std::string file = concat("heads/head_", h, ".obj");
    std::istringstream lines(testing::read_text(folder_ / file));
    std::string text;
    for (std::string line; std::getline(lines, line);) {
      if (line.starts_with("v ")) line += concat(" ", (100.0 + 20.0 * h) / 255, " 0.4 0.2");
      text += line + '\n';
    }
    folder_.write(file, text);
  }
  const auto out = run("{body: body.obj}",
                       "recipes:\n  - {id: a, target: head_1, regions: "
                       "{all: {weights: {head_1: 1}, smoothness: 0.7}}}\n"
                       "  - {id: b, target: head_1, regions: "
                       "{all: {weights: {head_3: 1}, smoothness: 0.7}}}\n");
  EXPECT_EQ(table_row(out, "a").at("neck_srgb"), "#786633");
  EXPECT_NEAR(std::stod(table_row(out, "a").at("neck_linear_g")), linear_of_srgb(0.4), 1e-4);
  const std::string between = table_row(out, "b").at("neck_srgb");
  EXPECT_GT(between, "#8A6633");
  EXPECT_LT(between, "#8D6633");
}

TEST_F(Neck, FarNecksAreWarnedOf) {
  const Job job = load_job(configure("{body: body.obj, falloff: 12 mm}", ""), {});
  EXPECT_THAT(job.inputs.warnings, ::testing::Contains(HasSubstr("a falloff of 12 mm")));
}

}  // namespace
}  // namespace crowdface
