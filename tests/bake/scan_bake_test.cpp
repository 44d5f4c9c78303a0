// SPDX-License-Identifier: Apache-2.0
#include "crowdface/bake/scan_bake.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "crowdface/core/file.h"
#include "crowdface/core/parallel.h"
#include "crowdface/core/text.h"
#include "crowdface/io/image.h"
#include "crowdface/io/mesh_as_obj.h"
#include "crowdface/io/obj_colours.h"
#include "crowdface/io/obj_writer.h"
#include "crowdface/io/read_mesh.h"
#include "crowdface/io/srgb.h"
#include "crowdface/mesh/normals.h"
#include "crowdface/wrap/scan_file.h"
#include "head_models/synth/synthetic_skin.h"

#include "support/temporary_folder.h"

namespace crowdface::testing {
namespace {

namespace fs = std::filesystem;
using Bytes = std::vector<std::uint8_t>;

constexpr int kTexels = 512;
constexpr double kMmPerCm = 10;
/// The person whose skin the template has: 44 years old, because the wrinkles of old people would
/// be filled into the holes of younger scans.
constexpr std::uint64_t kTemplateSkin = 8;

/// CIE L*a*b* of an sRGB texel, for D65.
Eigen::Array3d lab_of(const std::uint8_t* srgb) {
  Eigen::Vector3d light;
  for (int c = 0; c < 3; ++c) light[c] = linear_of_srgb(srgb[c] / 255.0);
  Eigen::Matrix3d to_xyz;
  to_xyz << 0.4124, 0.3576, 0.1805, 0.2126, 0.7152, 0.0722, 0.0193, 0.1192, 0.9505;
  const Eigen::Array3d xyz = (to_xyz * light).array() / Eigen::Array3d(0.9505, 1, 1.089);
  const Eigen::Array3d f =
      xyz.unaryExpr([](double t) { return t > 0.008856 ? std::cbrt(t) : 7.787 * t + 16.0 / 116; });
  return {116 * f[1] - 16, 500 * (f[0] - f[1]), 200 * (f[1] - f[2])};
}

double percentile(std::vector<double> values, double share) {
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// Energy of the finest band: of the difference between texels and the mean of their neighbourhood.
double finest_energy(const Bytes& srgb, const std::function<bool(int x, int y)>& is_used) {
  const auto grey = [&](int x, int y) {
    const std::uint8_t* at = srgb.data() + 3 * (y * kTexels + x);
    return (at[0] + at[1] + at[2]) / 3.0;
  };
  double energy = 0;
  for (int y = 1; y + 1 < kTexels; ++y) {
    for (int x = 1; x + 1 < kTexels; ++x) {
      if (!is_used(x, y)) continue;
      double mean = 0;
      for (int j = -1; j <= 1; ++j) {
        for (int i = -1; i <= 1; ++i) mean += grey(x + i, y + j) / 9;
      }
      energy += (grey(x, y) - mean) * (grey(x, y) - mean);
    }
  }
  return energy;
}

/// A template of head 1 with another skin, and a scan of head 2 in another topology. The
/// wrapped template has the true places of head 2.
class ScanBaking : public ::testing::Test {
 protected:
  ScanBaking()
      : coarse_(8000, SyntheticHeads::Parts::kEyesAndTeeth),
        fine_(30000, SyntheticHeads::Parts::kEyesAndTeeth),
        skins_(kTexels),
        paint_(skins_.albedo(1, 2)),
        wrapped_(kMmPerCm * coarse_.positions(1, 2)) {
    write_file(folder_ / "template.png",
               encode_png(kTexels, kTexels, 3, skins_.albedo(1, kTemplateSkin)));
    folder_.write("template.mtl", "newmtl skin\nmap_Kd template.png\n");
    encode_obj({coarse_.topology(), kMmPerCm * coarse_.positions(1, 1), coarse_.uvs()}, "",
               {{"skin", 0}}, "template.mtl")
        .write(folder_ / "template.obj");
    file_ = read_mesh_as_obj(folder_ / "template.obj");
    shape_ = make_template(file_.topology, file_.positions, {});
    scan_mesh_ = {fine_.topology(), kMmPerCm * fine_.positions(1, 2), fine_.uvs()};
  }

  void write_paint(const std::string& name, const Bytes& srgb) const {
    write_file(folder_ / name, encode_png(kTexels, kTexels, 3, srgb));
  }
  /// A scan with the texture of head 2.
  fs::path textured_scan() const {
    write_paint("scan.png", paint_);
    folder_.write("scan.mtl", "newmtl all\nmap_Kd scan.png\n");
    encode_obj(scan_mesh_, "", {{"all", 0}}, "scan.mtl").write(folder_ / "scan.obj");
    return folder_ / "scan.obj";
  }

  BakedPicture bake(const fs::path& scan_file, const BakeOptions& options = {}) {
    FileMesh mesh = read_mesh(scan_file);
    const Scan scan = scan_of(mesh, scan_file);
    const ScanSurface surface(keep_skin(scan));
    const ScanColours colours(std::move(mesh), scan_file);
    EXPECT_TRUE(colours.has_colours());
    EXPECT_TRUE(colours.warnings().empty());
    const BakeTemplate target(file_, shape_, kTexels);
    EXPECT_EQ(target.picture_names().size(), 1U);
    return ScanBake(target, wrapped_, surface, colours, options).bake_picture(0);
  }

  /// Whether a texel is in the face, and at least half of its colour comes from the scan.
  static bool is_face(const BakedPicture& picture, int x, int y) {
    return x > 0.31 * kTexels && x < 0.69 * kTexels && y > 0.34 * kTexels && y < 0.74 * kTexels &&
           picture.mask_without_scan[static_cast<std::size_t>(y * kTexels + x)] < 128;
  }
  std::vector<double> errors(const BakedPicture& picture) const {
    std::vector<double> all;
    for (int y = 0; y < kTexels; ++y) {
      for (int x = 0; x < kTexels; ++x) {
        if (!is_face(picture, x, y)) continue;
        const std::size_t at = 3 * static_cast<std::size_t>(y * kTexels + x);
        all.push_back((lab_of(&picture.srgb[at]) - lab_of(&paint_[at])).matrix().norm());
      }
    }
    EXPECT_GT(all.size(), 0.7 * 0.38 * 0.4 * kTexels * kTexels);
    return all;
  }

  TemporaryFolder folder_;
  SyntheticHeads coarse_, fine_;
  SyntheticSkins skins_;
  Bytes paint_;  ///< the truth: the texture of head 2
  Positions wrapped_;
  ObjFile file_;
  WrapTemplate shape_;
  Mesh scan_mesh_;
};

TEST_F(ScanBaking, ATextureComesBackSharpAndInItsColours) {
  const BakedPicture picture = bake(textured_scan());
  const std::vector<double> error = errors(picture);
  EXPECT_LT(percentile(error, 0.5), 0.5);
  EXPECT_LT(percentile(error, 0.95), 3);
  const auto is_used = [&](int x, int y) { return is_face(picture, x, y); };
  const double sharpness = finest_energy(picture.srgb, is_used) / finest_energy(paint_, is_used);
  EXPECT_GT(sharpness, 0.8);
  EXPECT_LT(sharpness, 1.2);
  EXPECT_LT(picture.share_without_scan, 0.1) << "the backs of the eyeballs take most of it";
}

TEST_F(ScanBaking, BytesDoNotDependOnTheNumberOfThreads) {
  const fs::path scan = textured_scan();
  const BakedPicture many = bake(scan);
  const ThreadLimit limit(1);
  const BakedPicture one = bake(scan);
  EXPECT_EQ(one.srgb, many.srgb);
  EXPECT_EQ(one.mask_without_scan, many.mask_without_scan);
}

/// The colour of the texture at each vertex.
TEST_F(ScanBaking, ColoursAtVerticesAreBakedToo) {
  Positions colours = Positions::Zero(scan_mesh_.positions.rows(), 3);
  for (Index f = 0; f < scan_mesh_.topology.face_count(); ++f) {
    const auto vertices = scan_mesh_.topology.face(f), uvs = scan_mesh_.topology.face_uvs(f);
    for (std::size_t c = 0; c < vertices.size(); ++c) {
      const auto uv = scan_mesh_.uvs.row(uvs[c]);
      const auto x = static_cast<std::size_t>(std::clamp(uv[0] * kTexels, 0.0, kTexels - 1.0));
      const auto y =
          static_cast<std::size_t>(std::clamp((1 - uv[1]) * kTexels, 0.0, kTexels - 1.0));
      for (std::size_t k = 0; k < 3; ++k) {
        colours(vertices[c], static_cast<Index>(k)) = paint_[3 * (y * kTexels + x) + k] / 255.0;
      }
    }
  }
  const std::string plain = encode_obj({scan_mesh_.topology, scan_mesh_.positions, {}}, "").text();
  const fs::path scan = folder_.write("vertices.obj", with_colours(plain, byte_colours(colours)));
  const std::vector<double> error = errors(bake(scan));
  EXPECT_LT(percentile(error, 0.5), 1.5);
  EXPECT_LT(percentile(error, 0.95), 6);  // brows are finer than the scan's vertices
}

/// The left half of the head uses the texture upside down, by another material; the right half by
/// tiles.
TEST_F(ScanBaking, TexturesOfSeveralMaterialsAndTilesAreBaked) {
  Bytes turned = paint_;
  std::reverse(turned.begin(), turned.end());
  for (std::size_t i = 0; i < turned.size(); i += 3) std::swap(turned[i], turned[i + 2]);
  write_paint("turned.png", turned);
  write_paint("tiles.1001.png", paint_);
  write_paint("tiles.1002.png", paint_);
  folder_.write("two.mtl",
                "newmtl one\nmap_Kd turned.png\nnewmtl other\nmap_Kd tiles.<UDIM>.png\n");
  Mesh mesh{{}, scan_mesh_.positions, scan_mesh_.uvs};
  mesh.topology.vertex_count = scan_mesh_.topology.vertex_count;
  const Index uv_rows = mesh.uvs.rows();
  mesh.uvs.conservativeResize(3 * uv_rows, 2);
  for (Index i = 0; i < uv_rows; ++i) {
    mesh.uvs.row(uv_rows + i) = Eigen::RowVector2d(1, 1) - mesh.uvs.row(i);
    mesh.uvs.row(2 * uv_rows + i) = Eigen::RowVector2d(1, 0) + mesh.uvs.row(i);
  }
  Index first_other = 0;
  for (const bool one : {true, false}) {
    for (Index f = 0; f < scan_mesh_.topology.face_count(); ++f) {
      const auto vertices = scan_mesh_.topology.face(f), uvs = scan_mesh_.topology.face_uvs(f);
      const bool is_left = mesh.positions(vertices[0], 0) > 0;
      if (is_left != one) continue;
      const bool is_low = mesh.positions(vertices[0], 1) < 0;
      std::vector<std::uint32_t> rows(uvs.begin(), uvs.end());
      const Index shift = one ? uv_rows : is_low ? 2 * uv_rows : 0;
      for (std::uint32_t& row : rows) row += static_cast<std::uint32_t>(shift);
      mesh.topology.add_face(vertices, rows);
    }
    if (one) first_other = mesh.topology.face_count();
  }
  encode_obj(mesh, "", {{"one", 0}, {"other", first_other}}, "two.mtl").write(folder_ / "two.obj");
  const std::vector<double> error = errors(bake(folder_ / "two.obj"));
  EXPECT_LT(percentile(error, 0.5), 0.5);
  EXPECT_LT(percentile(error, 0.95), 3);
}

/// A glTF file: each half of the head has a material with its own image; one more has a plain
/// colour.
TEST_F(ScanBaking, MaterialsOfGltfAreBaked) {
  Bytes other = paint_;
  for (std::size_t i = 0; i < other.size(); i += 3) std::swap(other[i], other[i + 2]);
  write_paint("one.png", paint_);
  write_paint("other.png", other);
  // Vertices are repeated at every corner; corners are sorted by material.
  std::array<std::string, 3> positions, uvs;
  std::array<std::size_t, 3> counts = {};
  for (Index f = 0; f < scan_mesh_.topology.face_count(); ++f) {
    const auto vertices = scan_mesh_.topology.face(f), rows = scan_mesh_.topology.face_uvs(f);
    const Eigen::RowVector3d at = scan_mesh_.positions.row(vertices[0]);
    const std::size_t material = at.y() < -60 ? 2 : at.x() > 0 ? 1 : 0;
    for (std::size_t c = 1; c + 1 < vertices.size(); ++c) {
      for (const std::size_t corner : {std::size_t{0}, c, c + 1}) {
        const Eigen::RowVector3f place = scan_mesh_.positions.row(vertices[corner]).cast<float>();
        Eigen::RowVector2f uv = scan_mesh_.uvs.row(rows[corner]).cast<float>();
        uv.y() = 1 - uv.y();
        positions[material].append(reinterpret_cast<const char*>(place.data()), 12);
        uvs[material].append(reinterpret_cast<const char*>(uv.data()), 8);
        ++counts[material];
      }
    }
  }
  std::string bytes, views, accessors, primitives;
  for (std::size_t m = 0; m < 3; ++m) {
    for (const auto& [data, type] : {std::pair(&positions[m], "VEC3"), {&uvs[m], "VEC2"}}) {
      const char* comma = bytes.empty() ? "" : ",";
      views += concat(comma, R"({"buffer":0,"byteOffset":)", bytes.size(), R"(,"byteLength":)",
                      data->size(), "}");
      accessors +=
          concat(comma, R"({"bufferView":)", 2 * m + (data == &uvs[m] ? 1 : 0),
                 R"(,"componentType":5126,"count":)", counts[m], R"(,"type":")", type, "\"}");
      bytes += *data;
    }
    primitives += concat(m == 0 ? "" : ",", R"({"attributes":{"POSITION":)", 2 * m,
                         R"(,"TEXCOORD_0":)", 2 * m + 1, R"(},"material":)", m, "}");
  }
  folder_.write("scan.bin", bytes);
  const fs::path scan = folder_.write(
      "scan.gltf",
      concat(R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],)",
             R"("nodes":[{"mesh":0}],"meshes":[{"primitives":[)", primitives,
             R"(]}],"images":[{"uri":"one.png"},{"uri":"other.png"}],)",
             R"("textures":[{"source":0},{"source":1}],"materials":[)",
             R"({"name":"a","pbrMetallicRoughness":{"baseColorTexture":{"index":0}}},)",
             R"({"name":"b","pbrMetallicRoughness":{"baseColorTexture":{"index":1}}},)",
             R"({"name":"c","pbrMetallicRoughness":{"baseColorFactor":[0.5,0.1,0.1,1]}}],)",
             R"("buffers":[{"uri":"scan.bin","byteLength":)", bytes.size(), R"(}],"bufferViews":[)",
             views, R"(],"accessors":[)", accessors, "]}"));
  const BakedPicture picture = bake(scan);
  std::vector<double> halves, plain;
  const Bytes red = {188, 89, 89};  // sRGB of the factors
  for (int y = 0; y < kTexels; ++y) {
    for (int x = 0; x < kTexels; ++x) {
      const std::size_t at = static_cast<std::size_t>(y * kTexels + x);
      if (picture.mask_without_scan[at] > 0) continue;
      const Eigen::Array3d found = lab_of(&picture.srgb[3 * at]);
      const auto off = [&](const std::uint8_t* srgb) {
        return (found - lab_of(srgb)).matrix().norm();
      };
      if (is_face(picture, x, y)) {
        const Bytes& half = x > kTexels / 2 ? other : paint_;
        halves.push_back(std::min(off(&half[3 * at]), off(red.data())));
      } else if (y > 0.8 * kTexels && x > 0.4 * kTexels && x < 0.6 * kTexels) {
        plain.push_back(off(red.data()));
      }
    }
  }
  EXPECT_LT(percentile(halves, 0.5), 0.5);
  EXPECT_LT(percentile(halves, 0.9), 3);
  EXPECT_GT(plain.size(), 1000U);
  EXPECT_LT(percentile(plain, 0.95), 1);
}

/// A hole in the cheek: the template's texture fills it, in the tone of the scan.
TEST_F(ScanBaking, AHoleIsFilledInTheToneOfTheScan) {
  const Eigen::RowVector3d cheek(35, -40, 70);  // mm; 12 mm around it are missing
  Mesh holed{{}, scan_mesh_.positions, scan_mesh_.uvs};
  holed.topology.vertex_count = scan_mesh_.topology.vertex_count;
  for (Index f = 0; f < scan_mesh_.topology.face_count(); ++f) {
    const auto vertices = scan_mesh_.topology.face(f);
    if ((holed.positions.row(vertices[0]).head<2>() - cheek.head<2>()).norm() < 12 &&
        holed.positions(vertices[0], 2) > 0) {
      continue;
    }
    holed.topology.add_face(vertices, scan_mesh_.topology.face_uvs(f));
  }
  textured_scan();
  encode_obj(holed, "", {{"all", 0}}, "scan.mtl").write(folder_ / "holed.obj");
  const BakedPicture whole = bake(folder_ / "scan.obj"), picture = bake(folder_ / "holed.obj");
  const Bytes other = skins_.albedo(1, kTemplateSkin);
  std::vector<double> error, unmatched, elsewhere;
  for (std::size_t i = 0; i < picture.mask_without_scan.size(); ++i) {
    if (whole.mask_without_scan[i] > 0) continue;
    const Eigen::Array3d truth = lab_of(&paint_[3 * i]), found = lab_of(&picture.srgb[3 * i]);
    if (picture.mask_without_scan[i] == 0) {
      elsewhere.push_back((found - truth).matrix().norm());
    } else if (picture.mask_without_scan[i] == 255) {
      error.push_back((found - truth).matrix().norm());
      unmatched.push_back((lab_of(&other[3 * i]) - truth).matrix().norm());
    }
  }
  EXPECT_GT(error.size(), 300U);
  EXPECT_GT(percentile(unmatched, 0.5), 8);
  EXPECT_LT(percentile(error, 0.5), 3);
  EXPECT_LT(percentile(error, 0.95), 6) << "mottles of the true skin are not filled in";
  EXPECT_LT(percentile(elsewhere, 0.5), 0.5);
}

/// Light from one side in the scan's colours; the tone of the whole stays as it is.
TEST_F(ScanBaking, ShadingCanBeRemoved) {
  const Positions normals = vertex_normals(scan_mesh_.topology, scan_mesh_.positions);
  Positions colours(normals.rows(), 3);
  for (Index v = 0; v < normals.rows(); ++v) {
    const double light = 0.35 + 0.12 * normals(v, 0) + 0.1 * normals(v, 1);
    colours.row(v).setConstant(srgb_of_linear(light));
  }
  const std::string plain = encode_obj({scan_mesh_.topology, scan_mesh_.positions, {}}, "").text();
  const fs::path scan = folder_.write("lit.obj", with_colours(plain, byte_colours(colours)));
  const auto spread = [&](const BakedPicture& picture) {
    std::vector<double> greys;
    for (int y = 0; y < kTexels; ++y) {
      for (int x = 0; x < kTexels; ++x) {
        if (is_face(picture, x, y)) {
          greys.push_back(picture.srgb[3 * static_cast<std::size_t>(y * kTexels + x)]);
        }
      }
    }
    return std::array{percentile(greys, 0.5), percentile(greys, 0.95) - percentile(greys, 0.05)};
  };
  const auto lit = spread(bake(scan)), even = spread(bake(scan, {.removes_shading = true}));
  EXPECT_GT(lit[1], 30);
  EXPECT_LT(even[1], 8);
  EXPECT_NEAR(even[0], lit[0], 25);
}

}  // namespace
}  // namespace crowdface::testing
