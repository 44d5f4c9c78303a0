// SPDX-License-Identifier: Apache-2.0
// Synthetic heads, a body for them, and crowds whose faces all end on it.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "crowdface/core/text.h"
#include "crowdface/heads/heads_on_body.h"
#include "crowdface/io/image.h"
#include "crowdface/io/obj_writer.h"
#include "crowdface/mesh/all_columns.h"
#include "crowdface/mesh/normals.h"
#include "crowdface/neck/match_rims.h"
#include "crowdface/run/generate.h"
#include "crowdface/run/job.h"
#include "head_models/synth/synthetic_head.h"

#include "support/expect_error.h"
#include "support/mesh_files.h"
#include "support/temporary_folder.h"

namespace crowdface::testing {

namespace fs = std::filesystem;
using Single = std::array<float, 3>;

inline Single single(const Eigen::RowVector3d& row) {
  return {static_cast<float>(row.x()), static_cast<float>(row.y()), static_cast<float>(row.z())};
}

/// The mesh as OBJ text with one `vn` line for each vertex.
inline std::string with_normals(const Mesh& mesh) {
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
inline Mesh body_below(const Positions& seam) {
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
class NeckCrowd : public ::testing::Test {
 protected:
  static constexpr Index kHeads = 5;

  NeckCrowd() : heads_(9000, SyntheticHeads::Parts::kEyesAndTeeth) {
    Positions mean = Positions::Zero(heads_.topology().vertex_count, 3);
    for (Index h = 0; h < kHeads; ++h) {
      const Mesh mesh{heads_.topology(), heads_.positions(5, static_cast<std::uint64_t>(h)),
                      heads_.uvs()};
      mean += mesh.positions / static_cast<double>(kHeads);
      folder_.write(concat("heads/head_", h, ".obj"), with_normals(mesh));
    }
    const Adjacency adjacency = build_adjacency(heads_.topology());
    rim_ = lowest_rim(find_open_rims(heads_.topology(), adjacency), mean, {0, 1, 0}, 10);
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
                                          read_text(folder_ / (name + ".obj"))));
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
    Positions mean = inputs.mean_head;
    inputs.heads_on_body->seam.bend_to_seam(mean);
    add(inputs.head_set.topology, mean, 1);
    add(body_.topology, body_.positions, body_sign_);
    Singles normals;
    for (Index i = 0; i < seam_.rows(); ++i) {
      normals.push_back(single(sums.at(single(seam_.row(i))).normalized().transpose()));
    }
    return normals;
  }

  TemporaryFolder folder_;
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
inline Singles usd_rows(const std::string& layer, const std::string& key) {
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
inline Surface obj_surface(const fs::path& file) {
  Singles v, vn;
  Surface surface;
  std::istringstream lines(read_text(file));
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

inline Surface surface_of(const fs::path& file) {
  if (file.extension() == ".obj") return obj_surface(file);
  if (file.extension() == ".ply") {
    PlyFile ply = read_ply(file);
    return {ply.points, ply.normals};
  }
  if (file.extension() == ".glb") {
    GlbFile glb = read_glb(file);
    return {glb.points, glb.normals};
  }
  if (file.extension() == ".usda") {
    const std::string layer = read_text(file);
    return {usd_rows(layer, "point3f[] points = ["), usd_rows(layer, "normal3f[] normals = [")};
  }
  std::string dictionary;
  const auto numbers = read_npy_numbers<float>(file, dictionary);
  Surface surface;
  for (std::size_t i = 0; i + 2 < numbers.size(); i += 3) {
    surface.points.push_back({numbers[i], numbers[i + 1], numbers[i + 2]});
  }
  return surface;
}

/// Expects each position of the seam in the file, exactly, with the seam's normal within rounding;
/// `found` has the normals of the first file and expects those of all others to be the same.
inline void expect_seam(const Surface& surface, const std::string& what, const Positions& seam,
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

inline void expect_seam(const fs::path& file, const Positions& seam, const Singles& normals,
                        std::map<Single, Single>& found) {
  expect_seam(surface_of(file), file.filename().string(), seam, normals, found);
}

inline constexpr const char* kAllWithLevels =
    ", meshes: [obj, ply, glb, usd, points], lods: [40 %, 10 %]";
inline constexpr const char* kVaried =
    "sampling: {asymmetry: [0.4, 1.3], mirror: drawn, smoothness: [0.3, 1]}\n"
    "families:\n  - {name: smith, members: 2, target: head_1, max_distance: 4 mm}\n";

inline constexpr const char* kThreeRecipes =
    "recipes:\n"
    "  - {id: a, target: head_1, regions: {all: {weights: {head_2: 1, head_0: 1}, smoothness: "
    "0.7}}}\n"
    "  - {id: b, target: head_3, regions: {all: {weights: {head_2: 1}, smoothness: 0.4}}}\n"
    "  - {id: c, target: head_4, mirrored: true, "
    "regions: {all: {weights: {head_1: 1}, smoothness: 0.9}}}\n";

}  // namespace crowdface::testing
