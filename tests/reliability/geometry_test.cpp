// SPDX-License-Identifier: Apache-2.0
// Tests 9 and 10 of docs/reliability.md: heads that are not one mesh, and meshes that are odd.
#include <algorithm>
#include <functional>
#include <sstream>

#include <gtest/gtest.h>

#include "crowdface/core/text.h"
#include "crowdface/run/generate.h"

#include "support/crowd_files.h"
#include "support/expect_error.h"
#include "support/small_crowd.h"

namespace crowdface::testing {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> words_of(const std::string& line) {
  std::istringstream in(line);
  std::vector<std::string> words;
  for (std::string word; in >> word;) words.push_back(word);
  return words;
}

bool is_line(const std::string& line, std::string_view keyword) {
  const auto words = words_of(line);
  return !words.empty() && words[0] == keyword;
}

/// An OBJ file as its lines, and where its vertices, texture coordinates and faces stand.
class ObjText {
 public:
  explicit ObjText(const fs::path& path) {
    std::istringstream in(read_text(path));
    for (std::string line; std::getline(in, line);) lines_.push_back(line);
  }

  std::string& vertex(std::size_t i) { return nth("v", i); }
  std::string& uv(std::size_t i) { return nth("vt", i); }
  std::string& face(std::size_t i) { return nth("f", i); }
  std::size_t vertices() const { return count("v"); }
  std::size_t uvs() const { return count("vt"); }
  std::size_t faces() const { return count("f"); }
  void append(const std::string& line) { lines_.push_back(line); }
  void remove(const std::string& line) { lines_.erase(std::ranges::find(lines_, line)); }

  std::string text() const {
    std::string all;
    for (const std::string& line : lines_) all += line + '\n';
    return all;
  }

 private:
  std::string& nth(std::string_view keyword, std::size_t i) {
    for (std::string& line : lines_) {
      if (is_line(line, keyword) && i-- == 0) return line;
    }
    throw std::out_of_range(concat(keyword, " of the test's mesh"));
  }
  std::size_t count(std::string_view keyword) const {
    return static_cast<std::size_t>(std::ranges::count_if(
        lines_, [&](const std::string& line) { return is_line(line, keyword); }));
  }

  std::vector<std::string> lines_;
};

/// A face line with its corners in another order.
std::string reordered(const std::string& face,
                      const std::function<void(std::string*, std::string*)>& order) {
  std::vector<std::string> words = words_of(face);
  order(words.data() + 1, words.data() + words.size());
  return join(words, " ");
}
std::string flipped(const std::string& face) {
  return reordered(face, [](auto begin, auto end) { std::reverse(begin, end); });
}
std::string turned(const std::string& face) {
  return reordered(face, [](auto begin, auto end) { std::rotate(begin, begin + 1, end); });
}

using Edit = std::function<void(ObjText&)>;

class Geometry : public ::testing::Test {
 protected:
  /// Writes a head anew, edited.
  void edit(const std::string& head, const Edit& edit) const {
    ObjText obj(folder_.head(head));
    edit(obj);
    folder_.folder().write("heads/" + head + ".obj", obj.text());
  }

  void run(const std::vector<std::string>& set = {}) const {
    generate(folder_.config(), {set, {}, {}, {}}, {folder_.cache(), Replace::kForce, false});
  }

  SmallCrowdFolder folder_{[] {
    SmallCrowd crowd;
    crowd.count = 2;
    crowd.heads = 3;
    return crowd;
  }()};
};

// Test 9.
TEST_F(Geometry, HeadsThatAreNotOneMeshAreRefusedWithTheirFirstDifference) {
  struct Case {
    std::string what;
    Edit edit;
    std::string said;
  };
  std::vector<Case> cases;
  const ObjText plain(folder_.head("cyd"));
  for (const std::size_t v : {std::size_t{0}, plain.vertices() / 2, plain.vertices() - 1}) {
    for (const char* number : {"nan", "inf", "-inf", "1e38", "-1e38", "1e39", "1e400"}) {
      cases.push_back({concat(number, " in vertex ", v + 1),
                       [=](ObjText& obj) { obj.vertex(v) = concat("v 0 ", number, " 0"); },
                       number});
    }
  }
  const std::string vertex_count = concat("expected ", plain.vertices(), " vertices, found ");
  const std::string face_count = concat("expected ", plain.faces(), " faces, found ");
  const std::size_t last = plain.faces() - 1;
  const auto face = [](std::size_t f) { return concat("face ", f + 1, ": expected vertices"); };
  const std::vector<Case> topology = {
      {"a vertex more", [](ObjText& obj) { obj.append("v 1 2 3"); },
       vertex_count + concat(plain.vertices() + 1)},
      {"a vertex less", [](ObjText& obj) { obj.remove(obj.vertex(obj.vertices() - 1)); },
       vertex_count + concat(plain.vertices() - 1)},
      {"a face more", [](ObjText& obj) { obj.append(obj.face(0)); },
       face_count + concat(plain.faces() + 1)},
      {"a face less", [](ObjText& obj) { obj.remove(obj.face(obj.faces() - 1)); },
       face_count + concat(plain.faces() - 1)},
      {"the first face flipped", [](ObjText& obj) { obj.face(0) = flipped(obj.face(0)); }, face(0)},
      {"the last face flipped", [last](ObjText& obj) { obj.face(last) = flipped(obj.face(last)); },
       face(last)},
      {"a texture coordinate moved", [](ObjText& obj) { obj.uv(3) = "vt 0.123 0.456"; },
       "found 0.123 0.456"},
      {"no texture coordinate at a face",
       [](ObjText& obj) {
         auto words = words_of(obj.face(2));
         for (std::size_t i = 1; i < words.size(); ++i) words[i].erase(words[i].find('/'));
         obj.face(2) = join(words, " ");
       },
       "face 3, corner 1: expected the texture coordinate"},
      {"another texture coordinate at a corner",
       [](ObjText& obj) {
         auto words = words_of(obj.face(4));
         words[1] = concat(words[1].substr(0, words[1].find('/')), "/1");
         words[2] = concat(words[2].substr(0, words[2].find('/')), "/1");
         obj.face(4) = join(words, " ");
       },
       "face 5, corner "},
  };
  cases.insert(cases.end(), topology.begin(), topology.end());
  const std::string whole = read_text(folder_.head("cyd"));
  for (const Case& one : cases) {
    SCOPED_TRACE(one.what);
    edit("cyd", one.edit);
    expect_error(ExitCode::kBadData, {"cyd.obj", one.said}, [&] { run(); });
    EXPECT_FALSE(fs::exists(folder_.out()));
    EXPECT_FALSE(fs::exists(folder_.cache()));
    folder_.folder().write("heads/cyd.obj", whole);
  }
  EXPECT_GE(cases.size(), 30U);
}

/// Programs write the faces of one mesh in other orders, and from other corners on.
TEST_F(Geometry, FacesInAnotherOrderGiveTheSamePositions) {
  const auto positions = [&] {
    run();
    std::string lines;
    for (const auto& [name, bytes] : testing::crowd_files(folder_.out())) {
      if (!name.ends_with(".obj")) continue;
      for (const std::string_view line : split_lines(bytes)) {
        if (line.starts_with("v ")) lines += concat(line, '\n');
      }
    }
    fs::remove_all(folder_.out());
    fs::remove_all(folder_.cache());
    return lines;
  };
  const std::string expected = positions();
  ASSERT_FALSE(expected.empty());
  const std::string whole = read_text(folder_.head("cyd"));
  const std::size_t last = ObjText(folder_.head("cyd")).faces() - 1;
  const std::vector<Edit> edits = {
      [](ObjText& obj) { std::swap(obj.face(0), obj.face(1)); },
      [=](ObjText& obj) { std::swap(obj.face(0), obj.face(last)); },
      [=](ObjText& obj) { std::swap(obj.face(last - 1), obj.face(last)); },
      [](ObjText& obj) { obj.face(5) = turned(obj.face(5)); }};
  for (const Edit& one : edits) {
    edit("cyd", one);
    EXPECT_EQ(positions(), expected);
    folder_.folder().write("heads/cyd.obj", whole);
  }
}

// Test 10.
TEST_F(Geometry, OddMeshesAreBlendedAsThePlainComputationHasIt) {
  const ObjText plain(folder_.head("ann"));
  const std::size_t v = plain.vertices();
  const auto add_vertices = [](ObjText& obj, std::initializer_list<const char*> places) {
    for (const char* place : places) obj.append(concat("v ", place));
  };
  const auto remove_faces = [](ObjText& obj, std::size_t first, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) obj.remove(obj.face(first));
  };
  const auto corner = [](std::size_t index) { return concat(index, "/1"); };
  const auto triangle = [&](std::size_t a, std::size_t b, std::size_t c) {
    return concat("f ", corner(a), " ", corner(b), " ", corner(c));
  };
  struct Case {
    std::string what;
    Edit edit;
  };
  const std::vector<Case> cases = {
      {"a fin: an edge with three faces",
       [&](ObjText& obj) {
         add_vertices(obj, {"0 0 12"});
         obj.append(triangle(1, 2, v + 1));
       }},
      {"an edge with five faces",
       [&](ObjText& obj) {
         add_vertices(obj, {"0 0 12", "1 0 12", "2 0 12"});
         for (std::size_t i = 1; i <= 3; ++i) obj.append(triangle(24, 25, v + i));
       }},
      {"a face twice", [](ObjText& obj) { obj.append(obj.face(7)); }},
      {"a face twice, the second flipped", [](ObjText& obj) { obj.append(flipped(obj.face(7))); }},
      {"neighbours with opposite winding",
       [](ObjText& obj) { obj.face(7) = flipped(obj.face(7)); }},
      {"every second face flipped",
       [](ObjText& obj) {
         for (std::size_t f = 0; f < obj.faces(); f += 2) obj.face(f) = flipped(obj.face(f));
       }},
      {"two sheets that share one vertex",
       [&](ObjText& obj) {
         add_vertices(obj, {"9 9 9", "9 10 9"});
         obj.append(triangle(33, v + 1, v + 2));
       }},
      {"an isolated vertex", [&](ObjText& obj) { add_vertices(obj, {"4 4 4"}); }},
      {"a hundred isolated vertices",
       [&](ObjText& obj) {
         for (int i = 0; i < 100; ++i) add_vertices(obj, {"4 4 4"});
       }},
      {"an isolated vertex far away", [&](ObjText& obj) { add_vertices(obj, {"400 400 400"}); }},
      {"a hole", [&](ObjText& obj) { remove_faces(obj, 40, 1); }},
      {"a large hole", [&](ObjText& obj) { remove_faces(obj, 30, 20); }},
      {"half the mesh", [&](ObjText& obj) { remove_faces(obj, 0, plain.faces() / 2); }},
      {"one face", [&](ObjText& obj) { remove_faces(obj, 1, plain.faces() - 1); }},
      {"a face of no area: three vertices in one place",
       [&](ObjText& obj) {
         add_vertices(obj, {"5 5 5", "5 5 5", "5 5 5"});
         obj.append(triangle(v + 1, v + 2, v + 3));
       }},
      {"a face of no area: three vertices in a line",
       [&](ObjText& obj) {
         add_vertices(obj, {"5 5 5", "6 5 5", "7 5 5"});
         obj.append(triangle(v + 1, v + 2, v + 3));
       }},
      {"two vertices of the mesh in one place",
       [](ObjText& obj) { obj.vertex(44) = obj.vertex(45); }},
      {"all vertices of a row in one place",
       [](ObjText& obj) {
         for (std::size_t i = 50; i < 60; ++i) obj.vertex(i) = "v 1 2 3";
       }},
      {"all vertices in a plane",
       [&](ObjText& obj) {
         for (std::size_t i = 0; i < v; ++i) {
           const auto words = words_of(obj.vertex(i));
           obj.vertex(i) = concat("v ", words[1], " ", words[2], " 0");
         }
       }},
      {"twenty components",
       [&](ObjText& obj) {
         for (std::size_t i = 0; i < 20; ++i) {
           add_vertices(obj, {"0 0 20", "1 0 20", "0 1 20", "0 0 21"});
           const std::size_t a = v + 4 * i + 1;
           obj.append(triangle(a, a + 1, a + 2));
           obj.append(triangle(a, a + 3, a + 1));
         }
       }},
      {"a large component beside the mesh",
       [&](ObjText& obj) {
         for (std::size_t i = 0; i < 200; ++i) {
           obj.append(concat("v ", i % 2 == 0 ? 0 : 40, " 30 ", 0.1 * static_cast<double>(i)));
         }
         for (std::size_t i = 0; i + 2 < 200; ++i) {
           obj.append(triangle(v + i + 1, v + i + 2, v + i + 3));
         }
       }},
  };
  EXPECT_GE(cases.size(), 20U);
  std::map<std::string, std::string> whole;
  for (const std::string& head : folder_.names()) whole[head] = read_text(folder_.head(head));
  for (const Case& one : cases) {
    SCOPED_TRACE(one.what);
    for (const std::string& head : folder_.names()) edit(head, one.edit);
    EXPECT_NO_THROW(run());
    expect_meshes_match_plan(folder_, folder_.out());
    // The default, with pictures: no crash, nothing that is not finite (which writers refuse).
    EXPECT_NO_THROW(run({"parts=auto", "smoothing.levels=basis",
                         "output.contact_sheet={columns: 2, rows: 1, cell: 32}"}));
    for (const auto& [head, text] : whole) folder_.folder().write("heads/" + head + ".obj", text);
  }
}

TEST_F(Geometry, HeadsWithoutAreaCannotBeCompared) {
  for (const std::string& head : folder_.names()) {
    edit(head, [](ObjText& obj) {
      for (std::size_t i = 0; i < obj.vertices(); ++i) obj.vertex(i) = "v 1 2 3";
    });
  }
  expect_error(ExitCode::kBadData, {"area"}, [&] { run(); });
  EXPECT_FALSE(fs::exists(folder_.out()));
}

}  // namespace
}  // namespace crowdface::testing
