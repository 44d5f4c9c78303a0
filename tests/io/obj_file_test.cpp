// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/obj_file.h"

#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/expect_error.h"
#include "support/temporary_folder.h"

namespace crowdface {
namespace {

using testing::expect_error;
using testing::TemporaryFolder;

ObjFile read_obj_text(const std::string& text) {
  const TemporaryFolder folder;
  return read_obj(folder.write("head.obj", text));
}

TEST(ReadObj, KeepsQuadsNgonsOrderAndGroups) {
  const ObjFile file = read_obj_text(
      "# comment\nmtllib a.mtl\no head\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0.5 0 1.0\n"
      "vt 0 0\nvt 1 0\nvt 1 1 0\nvt 0 1\nvt 0.5\nvn 0 0 1\n"
      "g left\ns 1\nusemtl skin\nf 1/1/1 2/2/1 3/3/1 4/4/1\n"
      "g right\nusemtl lips of rose\nf -4/-4/-1 -1/-1/-1 -3/-3/-1\nf 1/1/1 2/2/1 5/5/1 3/3/1 "
      "4/4/1\n");
  EXPECT_EQ(file.topology.vertex_count, 5);
  EXPECT_EQ(file.topology.face_offsets, (std::vector<std::uint32_t>{0, 4, 7, 12}));
  EXPECT_EQ(file.topology.corner_vertices,
            (std::vector<std::uint32_t>{0, 1, 2, 3, 1, 4, 2, 0, 1, 4, 2, 3}));
  EXPECT_EQ(file.topology.corner_uvs,
            (std::vector<std::uint32_t>{0, 1, 2, 3, 1, 4, 2, 0, 1, 4, 2, 3}));
  EXPECT_EQ(file.corner_normals, std::vector<std::uint32_t>(12, 0));
  EXPECT_EQ(file.positions.row(4), Eigen::RowVector3d(2, 0.5, 0));
  EXPECT_EQ(file.uvs.row(4), Eigen::RowVector2d(0.5, 0));
  EXPECT_EQ(file.material_libraries, (std::vector<std::string>{"a.mtl"}));
  const PolygonMaterials materials = polygon_materials(file.materials, file.topology.face_count());
  EXPECT_EQ(materials.names, (std::vector<std::string>{"skin", "lips of rose"}));
  EXPECT_EQ(materials.material_of_polygon, (std::vector<std::uint32_t>{0, 1, 1}));
}

TEST(PolygonMaterials, NameIsKeptOnceAndOnlyIfAFaceHasIt) {
  const std::vector<MaterialRange> ranges = {{"skin", 1}, {"unused", 2}, {"lips", 2}, {"skin", 3}};
  const PolygonMaterials materials = polygon_materials(ranges, 5);
  EXPECT_EQ(materials.names, (std::vector<std::string>{"", "skin", "lips"}));
  EXPECT_EQ(materials.material_of_polygon, (std::vector<std::uint32_t>{0, 1, 2, 1, 1}));
  EXPECT_EQ(polygon_materials({}, 2).material_of_polygon, (std::vector<std::uint32_t>{0, 0}));
}

/// A small mesh in many ways of writing it.
constexpr const char* kMeshText =
    "# one\nmtllib one.mtl\no one\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nvn 0 0 1\nvt 0 0\nvt 1 0\n"
    "vt 0 1\ng left\nusemtl skin\nf 1/1/1 2/2/1 3/3/1\nv 2 2 2\nf -1/1/1 2/2/1 3/3/1\n";

std::string with(std::string text, const std::string& part, const std::string& other) {
  return text.replace(text.find(part), part.size(), other);
}

TEST(SummariseObj, IsOfTheMeshAndNotOfPlacesNamesOrComments) {
  const ObjSummary summary = summarise_obj(kMeshText);
  EXPECT_EQ(summary.vertex_count, 5U);
  EXPECT_EQ(summary.uv_count, 3U);
  EXPECT_EQ(summary.normal_count, 1U);
  EXPECT_EQ(summary.face_count, 2U);
  const std::vector<std::pair<std::string, std::string>> same = {
      {"v 0 1 0", "v -3e2 1 7.5 1"},    {"vn 0 0 1", "vn 1 0 0"},
      {"# one\n", "# other\n# more\n"}, {"o one", "o two"},
      {"one.mtl", "another.mtl"},       {"usemtl skin", "usemtl lips"}};
  for (const auto& [part, other] : same) {
    EXPECT_EQ(summarise_obj(with(kMeshText, part, other)).mesh_digest, summary.mesh_digest)
        << other;
  }
  const std::vector<std::pair<std::string, std::string>> different = {
      {"vt 1 0", "vt 1 0.5"},
      {"f 1/1/1", "f 4/1/1"},
      {"f 1/1/1 2/2/1 3/3/1\nv 2 2 2\n", "v 2 2 2\nf 1/1/1 2/2/1 3/3/1\n"},
      {"v 0 0 0\n", ""},
      {"v 0 0 0\n", "v 0 0 0\nv 0 0 0\n"},
      {"vn 0 0 1\n", "vn 0 0 1\nvn 0 0 1\n"},
      {"g left\n", ""},
      {"f -1/1/1", "s 1\nf -1/1/1"},
      {"v 2 2 2\n", "x 2 2 2\n"}};
  for (const auto& [part, other] : different) {
    EXPECT_NE(summarise_obj(with(kMeshText, part, other)).mesh_digest, summary.mesh_digest)
        << other;
  }
}

TEST(ReadObjBeside, TellsAllButTheMesh) {
  const TemporaryFolder folder;
  const auto path = folder.write("head.obj", kMeshText);
  const ObjFile whole = read_obj(path);
  const ObjFile beside = read_obj_of_known_mesh(path, MappedFile(path), summarise_obj(kMeshText));
  EXPECT_EQ(beside.positions, whole.positions);
  EXPECT_EQ(beside.material_libraries, whole.material_libraries);
  ASSERT_EQ(beside.groups.size(), whole.groups.size());
  ASSERT_EQ(beside.materials.size(), 1U);
  EXPECT_EQ(beside.materials[0].name, "skin");
  EXPECT_EQ(beside.materials[0].first_face, whole.materials[0].first_face);
  EXPECT_EQ(beside.topology.corner_count(), 0);
  EXPECT_EQ(beside.uvs.rows(), 0);
}

// One of 40 MB took eleven gigabytes, a copy a face.
TEST(ReadObj, NamesBeyondAThousandBytesAreRefused) {
  const auto with = [](const std::string& line) {
    return "v 0 0 0\nv 1 0 0\nv 0 1 0\n" + line + "\nf 1 2 3\n";
  };
  for (const std::string statement : {"usemtl ", "g ", "o ", "mtllib "}) {
    EXPECT_NO_THROW(read_obj_text(with(statement + std::string(1000, 'm'))));
    EXPECT_THROW(read_obj_text(with(statement + std::string(1001, 'm'))), InvalidInput)
        << statement;
  }
}

TEST(ReadObj, RoundsNumbersCorrectly) {
  // The loader's own number reader is off in the last bits; the scan's is not.
  const ObjFile file = read_obj_text("v 0.1 10.635861 -1e-3\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_EQ(file.positions.row(0), Eigen::RowVector3d(0.1, 10.635861, -0.001));
}

TEST(ReadObj, TakesWindowsLineEndsAndNoFinalOne) {
  const ObjFile file = read_obj_text("v 0 0 0\r\nv 1 0 0\r\n\r\n  v 0 1 0\t\r\nf 1 2 3");
  EXPECT_EQ(file.topology.face_count(), 1);
  EXPECT_TRUE(file.topology.corner_uvs.empty());
  EXPECT_TRUE(file.corner_normals.empty());
}

struct Malformed {
  std::string name;
  std::string text;
  std::vector<std::string> phrases;
};

const std::string kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

const std::vector<Malformed> kMalformed = {
    {"nan",
     "v 0 0 nan\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
     {":1:", "finite number", "\"nan\"", "has no position"}},
    {"inf", "v 0 0 0\nv 1 inf 0\nv 0 1 0\nf 1 2 3\n", {":2:", "finite number", "\"inf\""}},
    {"word", "v 0 0 0\nv 1 0 0\nv abc 1 0\nf 1 2 3\n", {":3:", "finite number", "\"abc\""}},
    {"overflow", "v 1e400 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", {":1:", "\"1e400\""}},
    {"huge", "v 1e38 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", {":1:", "within", "\"1e38\""}},
    {"hexadecimal", "v 0x10 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", {":1:", "\"0x10\""}},
    {"comma", "v 0,5 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", {":1:", "\"0,5\"", "decimal point"}},
    {"two_coordinates", "v 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", {":1:", "3 coordinates", "2 words"}},
    {"index_beyond", kTriangle + "f 1 2 99\n", {":4:", "between 1 and 3", "\"99\""}},
    {"index_zero", kTriangle + "f 0 1 2\n", {":4:", "\"0\"", "counts from 1"}},
    {"index_relative_beyond", kTriangle + "f -4 -2 -1\n", {":4:", "-1 and -3", "\"-4\""}},
    {"index_wraps", kTriangle + "f 1 2 4294967297\n", {":4:", "\"4294967297\""}},
    {"index_huge", kTriangle + "f 1 2 99999999999999999999\n", {":4:", "number of a vertex"}},
    {"index_word", kTriangle + "f 1 2 x\n", {":4:", "number of a vertex", "\"x\""}},
    {"index_decimal", kTriangle + "f 1 2 3.0\n", {":4:", "\"3.0\""}},
    {"two_corners", kTriangle + "f 1 2\n", {"no face"}},
    {"empty", "", {"an empty file"}},
    {"web_page", "\n<!DOCTYPE html>\n<html>", {"web page", "raw file"}},
    {"lfs_pointer", "version https://git-lfs.github.com/spec/v1\noid sha256:4d\n", {"Git LFS"}},
    {"no_faces", kTriangle, {"no face"}},
    {"binary", std::string("\x7f\x45\x4c\x46\x00\x01\x02\n v\n", 11), {":1:"}},
    {"words", "this is no mesh\nat all\n", {":1:", "OBJ statement", "\"this\""}},
    {"nul_byte", kTriangle + std::string("f 1 2 \0 3\n", 10), {":4:"}},
};

/// Names a case in test lists; without it they would show addresses.
void PrintTo(const Malformed& malformed, std::ostream* out) {
  *out << malformed.name;
}

class MalformedObj : public ::testing::TestWithParam<Malformed> {};

TEST_P(MalformedObj, IsRefusedWithItsPlace) {
  const TemporaryFolder folder;
  const auto path = folder.write("bad.obj", GetParam().text);
  try {
    read_obj(path);
    FAIL() << "was read";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::kBadData);
    EXPECT_THAT(error.what(), ::testing::StartsWith(path.string()));
    for (const std::string& phrase : GetParam().phrases) {
      EXPECT_THAT(error.what(), ::testing::HasSubstr(phrase));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Cases, MalformedObj, ::testing::ValuesIn(kMalformed),
                         [](const auto& test) { return test.param.name; });

struct Dialect {
  std::string name;
  std::string text;
  std::string mended;  ///< what is left of it
  std::string note;    ///< a part of what is said, or nothing
};

const std::string kUvs = "vt 0 0\nvt 1 0\nvt 0 1\n";
const std::string kFace = "f 1 2 3\n";

const std::vector<Dialect> kDialects = {
    {"normal_beyond", kTriangle + "vn 0 0 1\nf 1//1 2//2 3//1\n", kTriangle + "\n" + kFace,
     "normals"},
    {"normal_none", kTriangle + "f 1//1 2//2 3//1\n", kTriangle + kFace, "normals"},
    {"normal_zero", kTriangle + "vn 0 0 1\nf 1//0 2//1 3//1\n", kTriangle + "\n" + kFace,
     "normals"},
    {"normal_empty", kTriangle + "f 1// 2// 3//\n", kTriangle + kFace, "normals"},
    {"normal_at_one_corner", kTriangle + "vn 0 0 1\nf 1//1 2 3\n", kTriangle + "\n" + kFace,
     "normals"},
    {"normal_nan", kTriangle + "vn nan -nan(ind) 0\nf 1//1 2//1 3//1\n",
     kTriangle + "vn 0 0 1\nf 1//1 2//1 3//1\n", "normals"},
    {"normal_of_two", kTriangle + "vn 0 0\n" + kFace, kTriangle + "vn 0 0 1\n" + kFace, "normals"},
    {"normal_with_uv", kTriangle + kUvs + "f 1/1/7 2/2/7 3/3/7\n",
     kTriangle + kUvs + "f 1/1 2/2 3/3\n", "normals"},
    {"uv_none", kTriangle + "f 1/1 2/1 3/1\n", kTriangle + kFace, "texture coordinates"},
    {"uv_empty", kTriangle + "f 1/ 2/ 3/\n", kTriangle + kFace, ""},
    {"uv_at_two_corners", kTriangle + kUvs + "f 1/1 2 3/1\n", kTriangle + kUvs + kFace,
     "texture coordinates"},
    {"uv_nan", kTriangle + "vt nan 0\nf 1/1 2/1 3/1\n", kTriangle + "vt 0 0\n" + kFace,
     "texture coordinates"},
    {"continued_face", kTriangle + "f 1 2 \\\n3\n", kTriangle + "f 1 2  3\n\n", ""},
    {"continued_vertex", "v 0 \\\r\n0 0\r\n" + kTriangle + kFace,
     "v 0  0 0\r\n\n" + kTriangle + kFace, ""},
    {"old_mac", "v 0 0 0\rv 1 0 0\rv 0 1 0\rf 1 2 3\r", kTriangle + "f 1 2 3\r", ""},
    {"byte_order_mark", "\xEF\xBB\xBF" + kTriangle + kFace, kTriangle + kFace, ""},
    {"padding", kTriangle + kFace + std::string(3, '\0'), kTriangle + kFace, ""},
    {"padding_line", kTriangle + kFace + std::string("\n\0\n", 3), kTriangle + kFace + "\n", ""},
    {"comment_behind", "v 0 0 0 # nose\nv 1 0 0\nv 0 1 0\n" + kFace, kTriangle + kFace, ""},
    {"capitals", "V 0 0 0\nV 1 0 0\nV 0 1 0\nVT 0 0\nG Head\nF 1/1 2/1 3/1\n",
     kTriangle + "vt 0 0\ng Head\nf 1/1 2/1 3/1\n", ""},
    {"capital_material", kTriangle + "USEMTL Skin\n" + kFace, kTriangle + "usemtl Skin\n" + kFace,
     ""},
    {"edge", kTriangle + kFace + "f 1 2\n", kTriangle + kFace + "\n", "fewer than 3 corners"},
    {"colours_nan", "v 0 0 0 nan nan nan\nv 1 0 0\nv 0 1 0\n" + kFace, kTriangle + kFace,
     "colours"},
    {"nine_numbers", "v 0 0 0 1 1 1 1 1 1\nv 1 0 0\nv 0 1 0\n" + kFace, kTriangle + kFace,
     "colours"},
};

void PrintTo(const Dialect& dialect, std::ostream* out) {
  *out << dialect.name;
}

class ObjDialect : public ::testing::TestWithParam<Dialect> {};

TEST_P(ObjDialect, IsReadAsTheTextItStandsFor) {
  const ObjFile file = read_obj_text(GetParam().text);
  EXPECT_EQ(file.file.bytes(), GetParam().mended);
  EXPECT_TRUE(file.is_mended);
  EXPECT_EQ(file.topology.face_count(), 1);
  EXPECT_EQ(file.notes.size(), GetParam().note.empty() ? 0U : 1U);
  if (!file.notes.empty()) {
    EXPECT_THAT(file.notes[0], ::testing::HasSubstr(GetParam().note));
  }
}

INSTANTIATE_TEST_SUITE_P(Cases, ObjDialect, ::testing::ValuesIn(kDialects),
                         [](const auto& test) { return test.param.name; });

TEST(ReadObj, NameMayEndInABackslash) {
  const std::string text = kTriangle + "usemtl Eyes\\\nf 1 2 3\n";
  const ObjFile file = read_obj_text(text);
  EXPECT_FALSE(file.is_mended);
  EXPECT_EQ(file.file.bytes(), text);
  ASSERT_EQ(file.materials.size(), 1U);
  EXPECT_EQ(file.materials[0].name, "Eyes\\");
  EXPECT_EQ(read_obj_text(kTriangle + "usemtl Eyes \\\nleft\nf 1 2 3\n").materials[0].name,
            "Eyes  left");
}

TEST(ReadObj, PassesOverStatementsOfOthersAndSaysSo) {
  const ObjFile file = read_obj_text(kTriangle + "crease 1 2\n#MRGB ff00ff\ncrease 2 3\nf 1 2 3\n");
  EXPECT_FALSE(file.is_mended);
  ASSERT_EQ(file.notes.size(), 1U);
  EXPECT_THAT(file.notes[0], ::testing::HasSubstr("\"crease\" (line 4)"));
}

// A neck that is closed by one polygon may have more corners than a byte counts.
TEST(ReadObj, ReadsPolygonsOfManyCorners) {
  std::string text, face = "f";
  for (int i = 1; i <= 300; ++i) {
    text += "v " + std::to_string(i) + " 0 0\n";
    face += " " + std::to_string(i);
  }
  const ObjFile file = read_obj_text(text + face + "\nf -1 -2 -3\n");
  EXPECT_EQ(file.topology.face_offsets, (std::vector<std::uint32_t>{0, 300, 303}));
  EXPECT_EQ(file.topology.corner_vertices[299], 299U);
  EXPECT_EQ(file.topology.corner_vertices[300], 299U);
}

TEST(ReadObj, NamesAFileThatIsNotThere) {
  expect_error(ExitCode::kMissingInput, {"nowhere.obj"}, [] { read_obj("nowhere.obj"); });
}

TEST(ReadObj, SurvivesEveryCutOfAFile) {
  // Each prefix of a good file is either read or refused as bad data.
  const std::string text =
      "mtllib a.mtl\nv 0.5 0 0\nv 1 0 -1e-2\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvn 0 0 1\n"
      "usemtl a\nf 1/1/1 2/2/1 3/3/1\n";
  const TemporaryFolder folder;
  int read = 0;
  for (std::size_t size = 0; size <= text.size(); ++size) {
    const auto path = folder.write("cut.obj", text.substr(0, size));
    try {
      EXPECT_EQ(read_obj(path).topology.face_count(), 1);
      ++read;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::kBadData) << size;
    }
  }
  EXPECT_GE(read, 2);  // with and without the final line end
}

TEST(ReadObj, SaysThatAFileEndsWithinALine) {
  const TemporaryFolder folder;
  for (const std::string end : {"v 0 1", "v 0 1 -", "v"}) {
    const auto path = folder.write("cut.obj", "v 0 0 0\nv 1 0 0\n" + end);
    expect_error(ExitCode::kBadData, {"cut.obj:3:", "the file ends within this line"},
                 [&] { read_obj(path); });
  }
  const std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 2 3";
  EXPECT_THAT(read_obj(folder.write("cut.obj", text)).notes,
              ::testing::Contains(::testing::HasSubstr("the file ends within a line")));
  EXPECT_THAT(read_obj(folder.write("cut.obj", text + "\n")).notes,
              ::testing::Not(::testing::Contains(::testing::HasSubstr("ends within a line"))));
}

}  // namespace
}  // namespace crowdface
