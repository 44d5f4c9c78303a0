// SPDX-License-Identifier: Apache-2.0
#include "support/model_files.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <utility>

#include <nlohmann/json.hpp>

#include "crowdface/core/text.h"
#include "crowdface/io/image.h"
#include "head_models/morph/makehuman_controls.h"

namespace crowdface::testing {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// Collects quads of a three.js mesh: each with texture coordinates of its own.
struct ThreeMesh {
  json vertices = json::array(), uvs = json::array(), faces = json::array(),
       materials = json::array();

  std::size_t vertex_count() const { return vertices.size() / 3; }
  void add_vertex(double x, double y, double z) {
    for (const double value : {x, y, z}) vertices.push_back(value);
  }
  void add_quad(std::size_t material, std::array<std::size_t, 4> corners, double u, double v) {
    faces.push_back(11);
    for (const std::size_t corner : corners) faces.push_back(corner);
    faces.push_back(material);
    for (const auto& [du, dv] : {std::pair(0.0, 0.0), {0.05, 0.0}, {0.05, 0.05}, {0.0, 0.05}}) {
      faces.push_back(uvs.size() / 2);
      uvs.push_back(u + du);
      uvs.push_back(v + dv);
    }
  }
  /// A square of its own, 2 cm wide, facing the front.
  void add_square(const std::string& name, double x, double y, double z, double u) {
    const std::size_t first = vertex_count(), material = materials.size();
    materials.push_back({{"DbgName", name}});
    for (const auto& [dx, dy] : {std::pair(-0.1, -0.1), {0.1, -0.1}, {0.1, 0.1}, {-0.1, 0.1}}) {
      add_vertex(x + dx, y + dy, z);
    }
    add_quad(material, {first, first + 1, first + 2, first + 3}, u, 0.9);
  }
};

void add_tube(ThreeMesh& mesh) {
  constexpr auto kColumns = MakeHumanStandIn::kColumns, kRows = MakeHumanStandIn::kRows;
  const std::size_t first = mesh.vertex_count(), material = mesh.materials.size();
  mesh.materials.push_back({{"DbgName", "body"}});
  const std::array<std::pair<int, int>, kColumns> round = {
      {{0, 2}, {1, 1}, {2, 0}, {1, -1}, {0, -2}, {-1, -1}, {-2, 0}, {-1, 1}}};
  for (std::uint32_t j = 0; j <= kRows; ++j) {
    for (const auto& [x, z] : round) mesh.add_vertex(0.4 * x, 5 + 0.3 * j, 0.4 * z);
  }
  for (std::size_t j = 0; j < kRows; ++j) {
    for (std::size_t i = 0; i < kColumns; ++i) {
      const std::size_t a = first + j * kColumns + i, b = first + j * kColumns + (i + 1) % kColumns;
      mesh.add_quad(material, {a, b, b + kColumns, a + kColumns}, 0.1 * static_cast<double>(i),
                    0.07 * static_cast<double>(j));
    }
  }
}

void write(const fs::path& file, const std::string& bytes) {
  fs::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary) << bytes;
}

}  // namespace

MakeHumanStandIn write_makehuman(const fs::path& package) {
  ThreeMesh mesh;
  mesh.add_square("joint-head", 0, 7, 0, 0);
  mesh.add_square("helper-r-eye", -0.3, 7.3, 0.9, 0.1);
  add_tube(mesh);
  mesh.add_square("helper-l-eye", 0.3, 7.3, 0.9, 0.2);
  mesh.add_square("helper-upper-teeth", 0, 6.75, 0.8, 0.3);
  mesh.add_square("helper-lower-teeth", 0, 6.55, 0.8, 0.4);
  write(package / "public/data/models/human_full_size.json", json{{"vertices", mesh.vertices},
                                                                  {"uvs", {mesh.uvs}},
                                                                  {"faces", mesh.faces},
                                                                  {"materials", mesh.materials}}
                                                                 .dump());
  MakeHumanStandIn out;
  out.vertex_count = static_cast<Index>(mesh.vertex_count());
  out.targets = {"data/targets/armslegs/l-foot-scale-decr.target"};
  for (const std::string& name : makehuman_target_names()) {
    out.targets.push_back(concat("data/targets/", name, ".target"));
  }
  std::sort(out.targets.begin(), out.targets.end());
  json list = json::object();
  for (const std::string& name : out.targets) list[name] = json::array();
  write(package / "src/json/targets/target-list.json", json{{"targets", list}}.dump());
  std::string bytes;
  for (std::size_t t = 0; t < out.targets.size(); ++t) {
    for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto value = static_cast<std::uint16_t>(MakeHumanStandIn::thousandths(t, v, axis));
        bytes.push_back(static_cast<char>(value & 0xffU));
        bytes.push_back(static_cast<char>(value >> 8U));
      }
    }
  }
  write(package / "public/data/targets/targets.bin", bytes);
  return out;
}

int skin_grey(const std::string& folder) {
  const int dark = folder.find("african") != std::string::npos ? 60 : 200;
  return dark + (folder.starts_with("old") ? 20 : 0) + (folder.ends_with("2") ? 5 : 0);
}

namespace {

/// A picture of 4 by 4 texels, the last of its first row clear.
std::string small_picture(std::uint8_t grey) {
  std::vector<std::uint8_t> pixels;
  for (int i = 0; i < 16; ++i) {
    pixels.insert(pixels.end(), {grey, grey, grey, static_cast<std::uint8_t>(i == 3 ? 0 : 255)});
  }
  return encode_png(4, 4, 4, pixels);
}

/// Squares around these x, the first of each pair at (0.1, 0.1) of the texture, the second where it is clear.
void write_attachments(const fs::path& folder, const std::string& name,
                       const std::vector<double>& at_x, const std::vector<std::string>& materials) {
  ThreeMesh mesh;
  json anchors = json::array(), weights = json::array(), offsets = json::array();
  for (const std::string& material : materials) {
    mesh.materials.push_back(
        {{"DbgName", material}, {"mapDiffuse", concat("textures/", material, ".png")}});
    write(folder / "textures" / concat(material, ".png"), small_picture(90));
  }
  for (std::size_t i = 0; i < at_x.size(); ++i) {
    const std::size_t first = mesh.vertex_count();
    for (const auto& [dx, dy] : {std::pair(0.0, 0.0),
                                 {kAttachmentSide, 0.0},
                                 {kAttachmentSide, kAttachmentSide},
                                 {0.0, kAttachmentSide}}) {
      mesh.add_vertex(0, 0, 0);
      json anchor = json::array();
      for (const std::uint32_t v : kAttachmentAnchors) anchor.push_back(v);
      anchors.push_back(anchor);
      weights.push_back({0.5, 0.25, 0.25});
      offsets.push_back({at_x[i] + dx, dy, 0.01});
    }
    const double place = i % 2 == 0 ? 0.1 : 0.9;
    mesh.add_quad(0, {first, first + 1, first + 2, first + 3}, place, place);
  }
  const json licence = {
      {"license", "AGPL3 (see there)"}, {"author", "Some One"}, {"homepage", "http://here"}};
  write(folder / concat(name, ".json"), json{{"vertices", mesh.vertices},
                                             {"uvs", {mesh.uvs}},
                                             {"faces", mesh.faces},
                                             {"materials", mesh.materials},
                                             {"ref_vIdxs", anchors},
                                             {"weights", weights},
                                             {"offsets", offsets},
                                             {"metadata", {{"license", licence}}}}
                                            .dump());
}

}  // namespace

void write_makehuman_wardrobe(const fs::path& package) {
  const fs::path proxies = package / "public/data/proxies";
  write_attachments(proxies / "eyes/HighPolyEyes", "HighPolyEyes", {-1.5, -1.5, 1.5, 1.5},
                    {"brown", "brownlight", "green", "bluegreen", "grey", "lightblue", "blue"});
  const auto add = [&](const std::string& kind, const std::string& name) {
    write_attachments(proxies / kind / name, name, {0.2}, {lower_case(name)});
  };
  for (const char* name : {"Eyelashes01", "eyelashes02", "eyelashes03"}) add("eyelashes", name);
  add("teeth", "Teeth_Base");
  add("tongue", "tongue01");
  for (int i = 1; i <= 12; ++i) {
    add("eyebrows", concat("eyebrow0", i < 10 ? "0" : "", i));
  }
  for (const char* name : {"afro01", "bob01", "bob02", "Braid01", "long01", "ponytail01", "short01",
                           "short02", "short03", "short04", "Full_beard", "Moustache"}) {
    add("hair", name);
  }
  for (const std::string age : {"young", "middleage", "old"}) {
    for (const std::string ancestry : {"african", "asian", "caucasian"}) {
      for (const std::string sex : {"female", "male"}) {
        const std::string name = concat(age, '_', ancestry, '_', sex);
        const fs::path folder = package / "public/data/skins" / name;
        for (const std::string variant : {"", "2"}) {
          const std::string full = name + variant;
          write(folder / concat(full, ".json"),
                json{{"mapDiffuse", concat("textures/", full, ".png")}}.dump());
          write(folder / "textures" / concat(full, ".png"),
                small_picture(static_cast<std::uint8_t>(skin_grey(full))));
        }
      }
    }
  }
}

void write_ict(const fs::path& checkout, int modes) {
  for (int k = -1; k < modes; ++k) {
    std::string text = "mtllib ICTFaceModelMaterial.mtl\n";
    const double step = k < 0 ? 0 : (k + 1) / 100.0;
    for (int v = 0; v < 20; ++v) {
      const int column = v % 4, row = v / 4;
      text += concat("v ", column + step * (v % 3), " ", row + step, " ", 10 - step, "\n");
    }
    for (int v = 0; v < 20; ++v) {
      const int column = v % 4, row = v / 4;
      text += concat("vt ", 0.6 * column, " ", 0.2 * row, "\n");
    }
    const auto quad = [&](int a) {
      text += "f";
      for (const int corner : {a, a + 1, a + 5, a + 4}) text += concat(' ', corner, '/', corner);
      text += '\n';
    };
    text += "g face\nusemtl M_Face\n";
    for (const int a : {9, 10, 11, 6}) quad(a);
    text += "usemtl M_Teeth\n";
    quad(2);
    text += "usemtl M_ScleraLeft\n";
    quad(14);
    std::string number = concat(std::max(k, 0));
    number.insert(0, 3 - number.size(), '0');
    write(checkout / "FaceXModel" /
              (k < 0 ? "generic_neutral_mesh.obj" : concat("identity", number, ".obj")),
          text);
  }
  write(checkout / "FaceXModel/ICTFaceModelMaterial.mtl", "newmtl M_Face\n");
}

}  // namespace crowdface::testing
