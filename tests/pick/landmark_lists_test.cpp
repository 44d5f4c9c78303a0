// SPDX-License-Identifier: Apache-2.0
#include "crowdface/pick/landmark_lists.h"

#include <cstring>

#include <gtest/gtest.h>

#include "crowdface/core/text.h"
#include "crowdface/pick/landmark_file.h"

#include "support/expect_error.h"
#include "support/temporary_folder.h"

namespace crowdface::testing {
namespace {

void expect_chin_and_nose(const std::string& name, const std::string& text) {
  SCOPED_TRACE(name);
  const TemporaryFolder folder;
  const LandmarkFile file = read_landmarks(folder.write(name, text));
  EXPECT_TRUE(file.template_places.empty());
  ASSERT_EQ(file.scan_places.size(), 2U);
  EXPECT_EQ(file.scan_places.at("chin").point, Eigen::Vector3d(1, -2.5, 3));
  EXPECT_EQ(file.scan_places.at("nose tip").point, Eigen::Vector3d(4, 5, 6));
}

TEST(LandmarkLists, AreReadAsOtherProgramsWriteThem) {
  expect_chin_and_nose(
      "picked.pp",
      "<!DOCTYPE PickedPoints>\n<PickedPoints>\n <DocumentData/>\n"
      " <point x=\"1\" y=\"-2.5\" z=\"3\" name=\"chin\" active=\"1\"/>\n"
      " <point active=\"1\" name=\"nose tip\" z=\"6\" y=\"5\"\n x=\"4\"/>\n"
      " <point x=\"0\" y=\"0\" z=\"0\" name=\"off\" active=\"0\"/>\n</PickedPoints>\n");
  expect_chin_and_nose("picked.csv", "name,x,y,z\r\nchin,1,-2.5,3\r\n\"nose tip\",4,5,6\r\n");
  expect_chin_and_nose("picked.csv", "Name;X;Y;Z\nchin;1,0;-2,5;3,0\nnose tip;4;5;6\n");
  expect_chin_and_nose("excel.csv",
                       "sep=;\r\nName;X;Y;Z\r\nchin;1,0;\u22122,5;3\r\nnose tip;4;5;6");
  expect_chin_and_nose("sheet.csv", "Name,X,Y,Z\nchin,\"1,0\",\"-2,5\",3\n\"nose tip\",4,5,6\n");
  expect_chin_and_nose("slicer.fcsv",
                       "# Markups fiducial file version = 4.11\n# CoordinateSystem = LPS\n"
                       "vtkMRMLMarkups_0,1,-2.5,3,0,0,0,1,1,1,0,chin,,\r\n"
                       "vtkMRMLMarkups_1,4,5,6,0,0,0,1,1,1,0,nose tip,,\r\n");
  expect_chin_and_nose("picked.tsv", "1\t-2.5\t3\tchin\n4\t5\t6\tnose tip\n");
  expect_chin_and_nose("picked.json",
                       R"({"chin": [1, -2.5, 3], "nose tip": {"x": 4, "y": 5, "z": 6}})");
  expect_chin_and_nose("list.json", R"([{"name": "chin", "position": [1, -2.5, 3]},
                                        {"label": "nose tip", "point": [4, 5, 6]}])");
  expect_chin_and_nose("slicer.mrk.json", R"({"markups": [{"type": "Fiducial", "controlPoints": [
      {"id": "1", "label": "chin", "position": [1, -2.5, 3]},
      {"id": "2", "label": "nose tip", "position": [4, 5, 6]}]}]})");
}

TEST(LandmarkLists, AreReadAsProgramsForMorphometricsWriteThem) {
  const TemporaryFolder folder;
  const auto expect_points = [&](const char* name, const char* text, const char* first = "1",
                                 const char* second = "2") {
    SCOPED_TRACE(text);
    const auto places = read_landmarks(folder.write(name, text)).scan_places;
    ASSERT_EQ(places.size(), 2U);
    EXPECT_EQ(places.at(first).point, Eigen::Vector3d(1, -2.5, 3));
    EXPECT_EQ(places.at(second).point, Eigen::Vector3d(4, 5, 6));
  };
  expect_points("a.PTS", "Version 1.0\r\n3\r\nchin 1 -2.5 3\r\n7 4 5 6\r\nS0002 9999 9999 9999\r\n",
                "chin", "7");
  expect_points("a.pts", "version: 1\nn_points: 2\n{\n1 -2.5 3\n4 5 6\n}\n");
  expect_points("a.tps",
                "LM3=3\n1 -2.5 3\nNA NA NA\n4\t5\t6\nCURVES3=1\nPOINTS3=1\n7 8 9\n"
                "IMAGE=anna 1.jpg\nID=0\nSCALE=1.0\n",
                "1", "3");
  expect_points("a.dta",
                "'made by a program\n1 2L 3 1 9999 Dim=3\n\nchin\nnose\n\n1 -2.5 3\n4 5 6\n",
                "chin", "nose");
  expect_points("a.dta", "1 1L 9 1 9999 Dim=3\n\nanna b\n\n1 -2.5 3\n4 5 6\n9999 9999 9999\n");
  expect_points("a.nts", "\"c\n1 1 6 0 DIM=3\n1 -2.5 3 4 5 6\n");
  expect_points("a.landmarkAscii",
                "# Avizo 3D ASCII 2.0\n\ndefine Markers 2\n\nParameters {\n NumSets 1,\n"
                " ContentType \"LandmarkSet\"\n}\n\nMarkers { float[3] Coordinates } @1\n\n"
                "# Data section follows\n@1\n1 -2.5 3\n4 5 6\n\n@2\n0 0 0\n");
}

TEST(LandmarkLists, OfPhotosOrSeveralMeshesAreRefused) {
  const TemporaryFolder folder;
  const auto refuse = [&](const char* name, const char* text, const char* where, const char* why) {
    expect_error(ExitCode::kUsage, {concat(name, where), why},
                 [&] { read_landmarks(folder.write(name, text)); });
  };
  refuse("a.pts", "version: 1\nn_points: 1\n{\n1 2\n}\n", ":4: ", "as on a photo");
  refuse("a.tps", "LM=1\n1 2\nID=0\n", ":1: ", "as on a photo");
  refuse("a.nts", "1 1 2 0 DIM=2\n1 2\n", ":1: ", "as on a photo");
  refuse("a.tps", "LM3=1\n1 2 3\nID=0\nLM3=1\n1 2 3\n", ":4: ", "several specimens");
  refuse("a.nts", "1 2 6 0 DIM=3\n1 2 3 4 5 6\n1 2 3 4 5 6\n", ":1: ", "several specimens");
  refuse("a.landmarkAscii", "# Avizo 3D ASCII 2.0\n NumSets 2,\n@1\n1 2 3\n",
         ":2: ", "several specimens");
  refuse("a.landmarkAscii", "# AmiraMesh BINARY-LITTLE-ENDIAN 2.1\n@1\n1 2 3\n", ":1: ", "as text");
  refuse("a.tps", "LM3=1\n1 2 3\nSCALE=0.01\n", ":3: ", "found a scale");
  refuse("a.tps", "LM3=2\n1 2 3\nID=0\n", ": ", "LM3=n and n lines");
  refuse("a.tps", "LM3=1\n1 x 3\n", ":2: ", "found \"x\"");
  refuse("a.nts", "1 1 9 0 DIM=3\n1 2 3\n", ":1: ", "expected 9 numbers");
  refuse("a.nts", "1 1 99999999999999999999 0 DIM=3\n1 2 3\n", ":1: ", "expected a header");
}

// The first of four numbers was dropped, so that x, y, z were y, z and the error.
TEST(LandmarkLists, NumbersAfterThePointAreIgnored) {
  expect_chin_and_nose("metashape.csv",
                       "# CoordinateSystem: LOCAL\n#Label,X/Easting,Y/Northing,Z/Altitude,Error\n"
                       "chin,1,-2.5,3,0.1\nnose tip,4,5,6,0.2,7,8\n");
  expect_chin_and_nose("rows.csv", "1,chin,1,-2.5,3,0.1\n2,nose tip,4,5,6,0.2\n");
  expect_chin_and_nose("rows.csv", "1,1,-2.5,3,chin\n2,4,5,6,nose tip\n");
  expect_chin_and_nose("colours.csv", "1,-2.5,3,chin,255,0,0\n4,5,6,nose tip,255,0,0\n");
}

TEST(LandmarkLists, HeadersNameTheColumns) {
  expect_chin_and_nose("a.csv",
                       "\n# c\nError,Name,Z (m),Y (m),X (m)\n1,chin,3,-2.5,1\n"
                       "2,nose tip,6,5,4\n");
  expect_chin_and_nose("b.csv", "id,label,x,y,z,note\n7,chin,1,-2.5,3,\n8,nose tip,4,5,6,good\n");
  expect_chin_and_nose("title.csv",
                       "Anna; 12 May;;\n;;;\nSubject;7;;\nname;x;y;z\nchin;1;-2,5;3\n"
                       "nose tip;4;5;6\n");
  expect_chin_and_nose("titles.csv", "Landmarks,,,\nof Anna,,,\nchin,1,-2.5,3\nnose tip,4,5,6\n");
  expect_chin_and_nose("r.txt", "x\ty\tz\nchin\t1\t-2.5\t3\nnose tip\t4\t5\t6\n");
}

TEST(LandmarkLists, AHeaderBelowPointsDropsNoPoint) {
  const TemporaryFolder folder;
  const auto path = folder.write("two.csv", "chin,1,-2.5,3\nname,x,y,z\nnose tip,4,5,6\n");
  expect_error(ExitCode::kUsage, {"two.csv:2"}, [&] { read_landmarks(path); });
}

TEST(LandmarkLists, NamesMayBeNumbersOrHoldANumberSign) {
  const TemporaryFolder folder;
  for (const char* text : {"0,1,-2.5,3\n12,4,5,6\n", "id;x;y;z\n0;1;-2,5;3\n12;4;5;6\n",
                           "x y z name\n1 -2.5 3 0\n4 5 6 12\n"}) {
    const auto places = read_landmarks(folder.write("numbers.txt", text)).scan_places;
    ASSERT_EQ(places.size(), 2U) << text;
    EXPECT_EQ(places.at("0").point, Eigen::Vector3d(1, -2.5, 3)) << text;
    EXPECT_EQ(places.at("12").point, Eigen::Vector3d(4, 5, 6)) << text;
  }
  const auto labels =
      read_landmarks(folder.write("l.txt", " # c\nPoint #0,1,2,3\nPoint #1,4,5,6\n")).scan_places;
  ASSERT_EQ(labels.size(), 2U);
  EXPECT_EQ(labels.at("Point #1").point, Eigen::Vector3d(4, 5, 6));
}

TEST(LandmarkLists, TextMayHaveAnotherEncodingAndOtherLineEnds) {
  expect_chin_and_nose(
      "declared.pp",
      "\xEF\xBB\xBF<?xml version=\"1.0\"?>\n<!DOCTYPE PickedPoints>\n<PickedPoints>"
      "<point x=\"1\" y=\"-2.5\" z=\"3\" name=\"chin\"/>"
      "<point x=\"4\" y=\"5\" z=\"6\" name=\"nose tip\"/></PickedPoints>");
  expect_chin_and_nose("mark.csv",
                       "\xEF\xBB\xBF"
                       "chin,1,-2.5,3\nnose tip,4,5,6\n");
  const std::string lines = "chin\t1\t-2,5\t3\rnose tip\t4\t5\t6\r";
  expect_chin_and_nose("lone_cr.txt", lines);
  std::string little = "\xFF\xFE", big = "\xFE\xFF";
  for (const char c : lines) {
    little += {c, '\0'};
    big += {'\0', c};
  }
  expect_chin_and_nose("little.txt", little);
  expect_chin_and_nose("big.txt", big);
  const TemporaryFolder folder;
  const auto places = read_landmarks(folder.write("w.csv", "Nasenfl\xFCgel,1,2,3\n")).scan_places;
  EXPECT_TRUE(places.contains("Nasenfl\xC3\xBCgel"));
}

TEST(LandmarkLists, NamesMayHaveAnEncodingOfWindows) {
  const TemporaryFolder folder;
  const std::string western = "Nasenfl\xFCgel", gbk = "\xB1\xC7\xBC\xE2", of_gbk = "\u9f3b\u5c16";
  const auto has_name = [&](const char* file, const std::string& text, const std::string& name) {
    return read_landmarks(folder.write(file, text)).scan_places.contains(name);
  };
  EXPECT_TRUE(has_name("a.json", "{\"" + western + "\": [1, 2, 3]}", "Nasenfl\u00fcgel"));
  EXPECT_TRUE(has_name("a.yaml", "scan: {" + western + ": 7}\n", "Nasenfl\u00fcgel"));
  EXPECT_TRUE(has_name("b.csv", gbk + ",1,2,3\n", of_gbk));
  EXPECT_TRUE(has_name("b.fcsv", "0,1,2,3,0,0,0,1,1,1,0," + gbk + ",,\n", of_gbk));
  EXPECT_TRUE(has_name("b.json", "{\"" + gbk + "\": [1, 2, 3]}", of_gbk));
  EXPECT_TRUE(has_name("b.yaml", "scan: {" + gbk + ": 7}\n", of_gbk));
  EXPECT_TRUE(has_name(
      "b.pp", "<PickedPoints><point x=\"1\" y=\"2\" z=\"3\" name=\"" + gbk + "\"/></PickedPoints>",
      of_gbk));
}

// One landmark that was hidden on the scan refused the whole file.
TEST(LandmarkLists, LandmarksWithoutAPositionAreIgnored) {
  const std::string points = "chin,1,-2.5,3\nnose tip,4,5,6\n";
  for (const char* row : {"ear,,,\n", "ear,NA,NA,NA\n", "ear,nan,nan,nan\n"}) {
    expect_chin_and_nose("a.csv", points + row);
    expect_chin_and_nose("b.csv", "name,x,y,z\n" + points + row);
  }
  expect_chin_and_nose("c.csv", ",name,x,y,z\n0,chin,1,-2.5,3\n1,ear,,,\n2,nose tip,4,5,6\n");
  expect_chin_and_nose("d.json", R"({"chin": [1, -2.5, 3], "nose tip": [4, 5, 6], "ear": null})");
  expect_chin_and_nose("e.json", R"([{"name": "chin", "coord": [1, -2.5, 3]},
      {"name": "ear", "coord": null}, {"name": "nose tip", "coord": [4, 5, 6]}])");
}

// A landmark "Nose tip" of the scan was ignored without a word.
TEST(MatchLandmarks, NamesMayDifferInCaseAndBlanks) {
  LandmarkFile file;
  const auto add = [](auto& places, const char* name, double x) {
    places[name].point = Eigen::Vector3d(x, 0, 0);
  };
  for (const char* name : {"nose_tip", "chin", "Ear", "ear", "lid"})
    add(file.template_places, name, 0);
  add(file.scan_places, "Nose Tip", 1);
  add(file.scan_places, "chin", 2);
  add(file.scan_places, "CHIN", 3);
  add(file.scan_places, "ear", 4);
  const Positions origin = Positions::Zero(1, 3);
  std::map<std::string, double> found;
  for (const WrapLandmark& landmark : match_landmarks(file, origin, Scan())) {
    found[landmark.name] = landmark.scan_position.x();
  }
  EXPECT_EQ(found, (std::map<std::string, double>{{"chin", 2}, {"ear", 4}, {"nose_tip", 1}}));
}

TEST(LandmarkLists, NamesMayEndInAColon) {
  expect_chin_and_nose("a.txt", "chin:\t1\t-2.5\t3\nnose tip:\t4\t5\t6\n");
}

// Points with the axes RAS stood on the mirrored and turned place of the mesh, which has LPS.
TEST(LandmarkLists, PointsOfSlicerGetTheAxesOfItsMeshes) {
  expect_chin_and_nose("ras.fcsv",
                       "# Markups fiducial file version = 4.13\n# CoordinateSystem = RAS\n"
                       "1,-1,2.5,3,0,0,0,1,1,1,0,chin,,,2,0\n"
                       "2,0,0,0,0,0,0,1,1,1,0,missing,,,0,0\n"
                       "3,-4,-5,6,0,0,0,1,1,1,0,nose tip,,,2,0\n");
  expect_chin_and_nose("old.fcsv",
                       "# Markups fiducial file version = 4.10\n# CoordinateSystem = 0\n"
                       "a,1,-2.5,3,0,0,0,1,1,1,0,chin,,\nb,4,5,6,0,0,0,1,1,1,0,nose tip,,\n");
  const auto markups = [](const char* axes, const char* chin, const char* nose) {
    return std::string(R"({"markups": [{"type": "Fiducial", )") + axes +
           R"("controlPoints": [{"label": "chin", "position": )" + chin +
           R"(, "positionStatus": "defined"}, {"label": "nose tip", "position": )" + nose +
           R"(}, {"label": "a", "position": [0, 0, 0], "positionStatus": "undefined"},
              {"label": "b", "position": [], "positionStatus": "missing"}]}]})";
  };
  expect_chin_and_nose("lps.mrk.json",
                       markups(R"("coordinateSystem": "LPS", )", "[1, -2.5, 3]", "[4, 5, 6]"));
  expect_chin_and_nose("ras.mrk.json",
                       markups(R"("coordinateSystem": "RAS", )", "[-1, 2.5, 3]", "[-4, -5, 6]"));
  expect_chin_and_nose("two.mrk.json", R"({"markups": [
      {"coordinateSystem": "LPS", "controlPoints": [{"label": "chin", "position": [1, -2.5, 3]}]},
      {"coordinateSystem": "RAS", "controlPoints": [{"label": "nose tip", "position": [-4, -5, 6]}]}
      ]})");
  expect_chin_and_nose("lps.csv",
                       "label,l,p,s,defined,selected,visible,locked,description\n"
                       "chin,1,-2.5,3,1,1,1,0,\nnose tip,4,5,6,1,1,1,0,\nm,0,0,0,0,1,1,0,\n");
  expect_chin_and_nose("ras.csv",
                       "label,r,a,s,defined,selected,visible,locked,description\n"
                       "chin,-1,2.5,3,1,1,1,0,\nnose tip,-4,-5,6,1,1,1,0,\n");
}

TEST(LandmarkLists, VerticesAndNamelessPointsAreTaken) {
  const TemporaryFolder folder;
  const LandmarkFile vertices =
      read_landmarks(folder.write("v.csv", "chin 966\nnose_tip 7\n"), LandmarkMesh::kTemplate);
  EXPECT_TRUE(vertices.scan_places.empty());
  EXPECT_EQ(vertices.template_places.at("chin").vertex, 966U);
  std::string header = "{'descr': '<f8', 'fortran_order': True, 'shape': (2, 3), }";
  header.resize(118, ' ');
  const std::vector<double> numbers = {1, 4, -2.5, 5, 3, 6};
  std::string bytes("\x93NUMPY\x01\x00\x76\x00", 10);
  bytes += header;
  bytes.append(reinterpret_cast<const char*>(numbers.data()), 48);
  const LandmarkFile array = read_landmarks(folder.write("p.npy", bytes));
  EXPECT_EQ(array.scan_places.at("1").point, Eigen::Vector3d(1, -2.5, 3));
  EXPECT_EQ(array.scan_places.at("2").point, Eigen::Vector3d(4, 5, 6));
}

// Each point was counted from the beginning of the file and copied to its end: 5 MB took minutes.
TEST(LandmarkLists, ManyPointsAreCheap) {
  std::string text = "<PickedPoints>\n";
  for (int i = 0; i < 300'000; ++i) text += "<point active=\"0\"\n";
  const auto read = [&](const char* last) { return parse_landmark_list(text + last, "many.pp"); };
  EXPECT_EQ(read("<point x=\"1\" y=\"2\" z=\"3\" name=\"chin\"/>")->size(), 1U);
  expect_error(ExitCode::kUsage, {"many.pp:300002: expected a number for the coordinate y"},
               [&] { read("<point x=\"1\"/>"); });
}

TEST(LandmarkLists, WhatIsWrongIsNamedWithItsPlace) {
  const TemporaryFolder folder;
  const auto refuse = [&](const char* name, const std::string& text, const char* phrase) {
    expect_error(ExitCode::kUsage, {name, phrase},
                 [&] { read_landmarks(folder.write(name, text)); });
  };
  refuse("a.csv", "chin,1,2\n", ":1: expected a vertex or x, y, z");
  refuse("b.csv", "chin,1,2,3\nchin,1,2,3\n", ":2: two landmarks are called \"chin\"");
  refuse("c.pp", "<PickedPoints>\n<point x=\"1\" y=\"a\" z=\"3\" name=\"chin\"/>",
         ":2: expected a number for the coordinate y");
  refuse("d.json", R"({"chin": [1, 2]})", "chin: expected a vertex or x, y, z");
  refuse("e.csv", "chin,1.5\n", "the number of a vertex");
  refuse("f.json", "{}", "found none");
  refuse("g.land", "version: 1\nn_points: 1\n{\n1 2 3\n}\n", "expected landmarks as .yaml, .pp");
  refuse("h.fcsv", "a,1,2\n", ":1: expected id, x, y, z");
  refuse("i.txt", "nose tip 1 2 3\n",
         ":1: expected a name and x, y, z, or a name and a vertex; if "
         "names contain blanks, separate the columns by commas");
  refuse("j.txt", "tip 0 1 2 3\n", "if names contain blanks");
  refuse("k.csv", "name,x,y,z\nchin,1,,3\n", ":2: expected a name and x, y, z");
  refuse("l.csv", "name,x,y,z\nchin,1,2,3,4\n", "in the columns of the header");
  refuse("m.csv", "1.5,2,3,0.1\n", "found 4 numbers");
  refuse("n.pp", "<html></html>", "expected an element PickedPoints");
  refuse("o.txt",
         "\xFF\xFE"
         "a",
         "expected text in UTF-8 or UTF-16");
}

}  // namespace
}  // namespace crowdface::testing
