// SPDX-License-Identifier: Apache-2.0
// The colour of the skin above the ring, and bodies in that colour.
#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "crowdface/crowd/verify.h"
#include "crowdface/io/image.h"
#include "crowdface/io/srgb.h"
#include "crowdface/mesh/edge_distances.h"
#include "crowdface/mesh/normals.h"

#include "neck_crowd.h"
#include "support/crowd_files.h"
#include "support/expect_error.h"
#include "support/mesh_files.h"
#include "support/temporary_folder.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;
using testing::body_below;
using testing::expect_error;
using ::testing::HasSubstr;
using testing::kThreeRecipes;

using NeckColour = testing::NeckCrowd;

/// The cells of a row of crowd.csv by their columns.
std::map<std::string, std::string> table_row(const fs::path& crowd, const std::string& id) {
  std::istringstream lines(testing::read_text(crowd / "crowd.csv"));
  const auto cells = [](const std::string& line) {
    std::vector<std::string> found = {""};
    for (const char c : line) {
      if (c == ',') {
        found.emplace_back();
      } else if (c != '\r') {
        found.back() += c;
      }
    }
    return found;
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

TEST_F(NeckColour, TheTableTellsTheMeanOfTheTextureAboveTheRing) {
  paint_heads();
  const auto out = run("{body: body.obj}", kThreeRecipes);
  const Inputs inputs = std::move(load_job(folder_ / "out.yaml", {}).inputs);
  EdgeDistances distances(inputs.adjacency, inputs.mean_head);
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
      const double area = inside * face_area_vector(heads_.topology(), f, inputs.mean_head).norm();
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

TEST_F(NeckColour, TheBodysTextureAgreesWithTheFaceAtTheRing) {
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
  EXPECT_TRUE(verify_crowd(out).is_intact());
}

TEST_F(NeckColour, TheBodyInFilesHasTheFacesTexture) {
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
  EXPECT_TRUE(verify_crowd(out).is_intact());
}

TEST_F(NeckColour, PicturesShowTheBodyInTheFacesColour) {
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
  EXPECT_TRUE(verify_crowd(folder_ / "shown").is_intact());
  EXPECT_EQ(testing::read_text(folder_ / "alone/meshes/mob_0002.obj"),
            testing::read_text(folder_ / "shown/meshes/mob_0002.obj"));
}

/// Number of vertices of the reduced mesh in a crowd's gallery.
int gallery_vertices(const fs::path& crowd) {
  const std::string script = testing::read_text(crowd / "gallery/data/mesh.js");
  constexpr std::string_view kKey = "\"vertices\":";
  return std::stoi(script.substr(script.find(kKey) + kKey.size()));
}

TEST_F(NeckColour, TheGallerySplitsNoBodyThatHasNoTexture) {
  // If each polygon of the body had texture coordinates of its own, its vertices would be split, and
  // the reduction of the mesh could remove triangles of the face only.
  paint_heads();
  paint_body(folder_, body_);
  const auto crowd = [&](const std::string& neck, const std::string& name) {
    const fs::path config = folder_.write(
        concat(name, ".yaml"),
        concat("schema: 1\ncrowd: {name: mob, count: 0}\n",
               "faces: {directory: heads, units: cm}\nneck: ", neck, '\n', kThreeRecipes,
               "output: {directory: ", name, ", meshes: [], contact_sheet: {cell: 32}}\n"));
    generate(config, {}, {folder_ / "cache", Replace::kRefuse, false});
    return folder_ / name;
  };
  const fs::path textured =
      crowd("{body: body.obj, body_texture: body.png, show_body: true}", "textured");
  const fs::path plain = crowd("{body: body.obj, show_body: true}", "plain");
  EXPECT_LE(gallery_vertices(plain), gallery_vertices(textured));
  const std::string face = testing::read_text(plain / "gallery/data/faces/a.js");
  EXPECT_NE(face.find("\"colours\":"), std::string::npos) << "the body has the face's colour";
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

TEST_F(NeckColour, NoSeamShowsOnSheets) {
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

TEST_F(NeckColour, OnlyABodyCanBeShown) {
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

TEST_F(NeckColour, TheTableTellsTheColoursOfVertices) {
  const auto plain = run("{body: body.obj}", kThreeRecipes, "", "plain");
  EXPECT_FALSE(table_row(plain, "a").contains("neck_srgb")) << "there are no colours";
  for (Index h = 0; h < kHeads; ++h) {
    const std::string file = concat("heads/head_", h, ".obj");
    std::istringstream lines(testing::read_text(folder_ / file));
    std::string text;
    for (std::string line; std::getline(lines, line);) {
      if (line.starts_with("v "))
        line += concat(" ", (100.0 + 20.0 * static_cast<double>(h)) / 255, " 0.4 0.2");
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

}  // namespace
}  // namespace crowdface
