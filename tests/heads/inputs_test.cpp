// SPDX-License-Identifier: Apache-2.0
// Inputs that do not fit together: refused with the right code, the file and the first difference.
#include "crowdface/heads/inputs.h"

#include <algorithm>
#include <functional>
#include <sstream>

#include <gtest/gtest.h>

#include "crowdface/core/text.h"
#include "crowdface/run/generate.h"
#include "crowdface/run/job.h"

#include "support/crowd_files.h"
#include "support/expect_error.h"
#include "support/small_crowd.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;
using testing::SmallCrowd;
using testing::SmallCrowdFolder;

using Lines = std::vector<std::string>;

/// Changes the lines of one head's file.
void edit(const SmallCrowdFolder& folder, const std::string& head,
          const std::function<void(Lines&)>& change) {
  Lines lines;
  std::istringstream text(testing::read_text(folder.head(head)));
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  change(lines);
  folder.folder().write("heads/" + head + ".obj", join(lines, "\n") + "\n");
}

std::size_t first_line(const Lines& lines, const std::string& start, std::size_t nth = 0) {
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (lines[i].starts_with(start) && nth-- == 0) return i;
  }
  throw std::out_of_range(start);
}

/// Expects the job to be refused and nothing to be written.
void expect_refused(const SmallCrowdFolder& folder, ExitCode code,
                    std::initializer_list<std::string> phrases) {
  testing::expect_error(code, phrases, [&] { run(folder); });
  EXPECT_FALSE(fs::exists(folder.out()));
  EXPECT_FALSE(fs::exists(folder.cache()));
}

TEST(Inputs, HeadsFarFromTheOriginAreWarnedOf) {
  const auto warnings_at = [](double cm) {
    const SmallCrowdFolder folder{SmallCrowd{}};
    for (const std::string& head : folder.names()) {
      edit(folder, head, [&](Lines& lines) {
        for (std::string& line : lines) {
          if (!line.starts_with("v ")) continue;
          std::istringstream numbers(line.substr(2));
          double x = 0, y = 0, z = 0;
          numbers >> x >> y >> z;
          line = concat("v ", x + cm, ' ', y, ' ', z);
        }
      });
    }
    return join(load_job(folder.config(), {}).inputs.warnings);
  };
  EXPECT_EQ(warnings_at(0).find("origin"), std::string::npos);
  EXPECT_NE(
      warnings_at(1e6).find(
          "10000 m from the origin, where single precision rounds positions by up to 0.60 mm"),
      std::string::npos);
}

TEST(Inputs, OtherVertexCountsAreRefused) {
  const SmallCrowdFolder more{SmallCrowd{}};
  edit(more, "cyd", [](Lines& lines) {
    lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(first_line(lines, "vt ")), "v 1 2 3");
  });
  expect_refused(more, ExitCode::kBadData, {"cyd.obj", "ann.obj", "119", "120"});

  const SmallCrowdFolder fewer{SmallCrowd{}};
  edit(fewer, "cyd", [](Lines& lines) {  // the last vertex, which is in no face
    lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(first_line(lines, "vt ") - 1));
  });
  expect_refused(fewer, ExitCode::kBadData, {"cyd.obj", "119", "118"});
}

TEST(Inputs, MissingPolygonsAreCounted) {
  const SmallCrowdFolder folder{SmallCrowd{}};
  edit(folder, "cyd", [](Lines& lines) {
    const auto face = lines.begin() + static_cast<std::ptrdiff_t>(first_line(lines, "f ", 4));
    lines.erase(face, face + 2);
  });
  expect_refused(folder, ExitCode::kBadData, {"cyd.obj", "lacks 2 of the polygons"});
}

TEST(Inputs, AFileThatEndsWithinALineAndAPartOfAHeadAreTold) {
  const SmallCrowdFolder cut{SmallCrowd{}};
  std::string text = testing::read_text(cut.head("cyd"));
  cut.folder().write("heads/cyd.obj", text.substr(0, text.size() - 1));
  EXPECT_NO_THROW(load_job(cut.config(), {})) << "only the last line end is missing";
  text.resize(text.size() - 2);  // the last texture coordinate loses a digit
  cut.folder().write("heads/cyd.obj", text);
  expect_refused(cut, ExitCode::kBadData, {"cyd.obj", "its text ends within a line"});

  const SmallCrowdFolder part{SmallCrowd{}};
  edit(part, "cyd", [](Lines& lines) {  // the first polygons and their vertices
    lines.resize(first_line(lines, "f ", 8));
    lines[first_line(lines, "v ", 1)] += '1';
    const auto begin = lines.begin() + static_cast<std::ptrdiff_t>(first_line(lines, "v ", 60));
    lines.erase(begin, lines.begin() + static_cast<std::ptrdiff_t>(first_line(lines, "vt ")));
  });
  expect_refused(part, ExitCode::kBadData, {"cyd.obj", "only a part of a head?"});
}

// With three heads, the median distance to the nearest head was that of the copies.
TEST(Inputs, CopiesOfAHeadAreTold) {
  const SmallCrowdFolder folder{SmallCrowd{}};
  const auto told = [&] {
    return join(load_job(folder.config(), {}).inputs.warnings).find("heads ann and cyd are 0.00");
  };
  EXPECT_EQ(told(), std::string::npos);
  fs::copy_file(folder / "heads/ann.obj", folder / "heads/cyd.obj",
                fs::copy_options::overwrite_existing);
  EXPECT_NE(told(), std::string::npos);
  fs::remove(folder / "heads/bob.obj");
  for (const auto& entry : fs::directory_iterator(folder / "heads")) {
    const std::string name = entry.path().stem().string();
    if (entry.path().extension() == ".obj" && name != "ann" && name != "cyd" && name != "dan") {
      fs::remove(entry.path());
    }
  }
  EXPECT_NE(told(), std::string::npos);
}

TEST(Inputs, SurfacesThatNoFaceIsMadeOfAreTold) {
  SmallCrowd crowd;
  crowd.bowl.materials = true;
  const SmallCrowdFolder folder(crowd);
  const auto warnings_of = [&](const std::string& name) {
    ConfigOverrides overrides;
    overrides.assignments = {concat("output.surfaces={", name, ": eye}")};
    return join(load_job(folder.config(), overrides).inputs.warnings);
  };
  const std::string known = load_job(folder.config(), {}).inputs.materials.names.back();
  const std::string told = "but no polygon of";
  EXPECT_NE(warnings_of("nobody").find(told), std::string::npos);
  EXPECT_EQ(warnings_of(known).find(told), std::string::npos) << known;
}

TEST(Inputs, PermutedFacesArePutInOrder) {
  const SmallCrowdFolder folder{SmallCrowd{}};
  const auto before = load_job(folder.config(), {});
  edit(folder, "bob", [](Lines& lines) {
    const std::size_t f = first_line(lines, "f ", 4);
    std::swap(lines[f], lines[f + 1]);
  });
  const auto after = load_job(folder.config(), {});
  for (std::size_t h = 0; h < before.inputs.head_set.heads.size(); ++h) {
    EXPECT_EQ(after.inputs.head_set.heads[h].positions, before.inputs.head_set.heads[h].positions);
  }
}

TEST(Inputs, FlippedWindingIsRefused) {
  const SmallCrowdFolder folder{SmallCrowd{}};
  edit(folder, "dan", [](Lines& lines) {
    std::string& line = lines[first_line(lines, "f ")];
    std::istringstream words(line.substr(2));
    std::vector<std::string> corners{std::istream_iterator<std::string>(words), {}};
    std::reverse(corners.begin(), corners.end());
    line = "f " + join(corners, " ");
  });
  expect_refused(folder, ExitCode::kBadData, {"dan.obj", "face 1", "expected", "found"});
}

TEST(Inputs, EveryOddHeadIsNamedAtOnce) {
  const SmallCrowdFolder folder{SmallCrowd{}};
  for (const char* head : {"bob", "dan"}) {
    edit(folder, head, [](Lines& lines) {
      std::string& line = lines[first_line(lines, "f ", 4)];
      line = line.substr(0, line.rfind(' '));  // a corner fewer
    });
  }
  expect_refused(folder, ExitCode::kBadData, {"bob.obj", "dan.obj"});
}

TEST(Inputs, PathsThatNoConfigCanHoldAreToldWithTheRest) {
  const SmallCrowdFolder folder{SmallCrowd{}};
  edit(folder, "dan", [](Lines& lines) { lines[first_line(lines, "v ", 3)] = "v nan 0 0"; });
  const fs::path elsewhere = folder / "caf\xe9";  // Latin-1
  fs::create_directory(elsewhere);
  fs::rename(folder / "heads", elsewhere / "heads");
  fs::rename(folder.config(), elsewhere / "config.yaml");
  testing::expect_error(ExitCode::kUsage,
                        {"caf\\xe9/config.yaml", "caf\\xe9/heads/ann.obj", "UTF-8", "dan.obj:"},
                        [&] { load_job(elsewhere / "config.yaml", {}); });
}

TEST(Inputs, OtherTextureCoordinatesAreRefused) {
  const SmallCrowdFolder folder{SmallCrowd{}};
  edit(folder, "bob", [](Lines& lines) { lines[first_line(lines, "vt ", 2)] = "vt 0.9 0.1"; });
  expect_refused(folder, ExitCode::kBadData,
                 {"bob.obj", "texture coordinate", "found 0.9 0.1", "Transfer Attributes"});
}

TEST(Inputs, AHeadThatIsTurnedAgainstTheOthersIsRefusedWithTheKeyToSet) {
  const SmallCrowdFolder folder{SmallCrowd{}};
  edit(folder, "cyd", [](Lines& lines) {
    for (std::string& line : lines) {
      std::istringstream words(line);
      std::string kind, x, y, z;
      if (words >> kind >> x >> y >> z && kind == "v") line = concat("v ", z, ' ', x, ' ', y);
    }
  });
  ConfigOverrides overrides;
  for (const char* taken : {"faces.align=none", "faces.align=rigid"}) {
    overrides.assignments = {taken};
    EXPECT_NO_THROW(load_job(folder.config(), overrides));
  }
  overrides.assignments = {"faces.align=check"};
  testing::expect_error(ExitCode::kBadData, {"head cyd is turned by", "align: rigid"},
                        [&] { load_job(folder.config(), overrides); });
}

/// As Blender writes what it has read: `vt` and `vn` lines numbered anew, one that no face uses
/// left out.
TEST(Inputs, RenumberedTextureCoordinatesAndNormalsAreTaken) {
  const SmallCrowdFolder folder{SmallCrowd{}};
  const auto plain = load_job(folder.config(), {}).inputs;
  edit(folder, "bob", [](Lines& lines) {
    std::size_t rows = 0;
    for (const std::string& line : lines) rows += line.starts_with("vt ") ? 1 : 0;
    const auto first = lines.begin() + static_cast<std::ptrdiff_t>(first_line(lines, "vt ", 0));
    std::reverse(first, first + static_cast<std::ptrdiff_t>(rows));
    for (std::string& line : lines) {
      if (!line.starts_with("f ")) continue;
      std::string renumbered = "f";
      std::istringstream corners(line.substr(2));
      for (std::string corner; corners >> corner;) {
        const std::size_t slash = corner.find('/'), next = corner.find('/', slash + 1);
        const auto uv = std::stoul(corner.substr(slash + 1, next - slash - 1));
        renumbered += concat(' ', corner.substr(0, slash), '/', rows + 1 - uv,
                             next == std::string::npos ? "" : corner.substr(next));
      }
      line = renumbered;
    }
  });
  for (const bool kept : {false, true}) {
    const auto job = load_job(folder.config(), {}, kept ? folder.cache() : fs::path());
    EXPECT_EQ(job.inputs.head_set.topology.corner_uvs, plain.head_set.topology.corner_uvs);
    EXPECT_EQ(job.inputs.head_set.uvs, plain.head_set.uvs);
    EXPECT_EQ(job.inputs.head_digests, plain.head_digests);
  }
}

TEST(Inputs, NumbersThatAreNoneAreRefused) {
  for (const char* bad : {"v nan 0 0", "v 1 inf 2", "v 1e400 0 0", "v 1 2", "v 1 2 abc", "v"}) {
    const SmallCrowdFolder folder{SmallCrowd{}};
    std::size_t line = 0;
    edit(folder, "cyd", [&](Lines& lines) {
      line = first_line(lines, "v ", 3);
      lines[line] = bad;
    });
    expect_refused(folder, ExitCode::kBadData, {concat("cyd.obj:", line + 1)});
  }
}

TEST(Inputs, HugeCoordinatesAreRefusedOrStayFinite) {
  const SmallCrowdFolder folder{SmallCrowd{}};
  edit(folder, "cyd",
       [](Lines& lines) { lines[first_line(lines, "v ", 3)] = "v 1e38 -1e38 1e300"; });
  expect_refused(folder, ExitCode::kBadData, {"cyd.obj"});
}

TEST(Inputs, MasksNeedTextureCoordinates) {
  SmallCrowd crowd;
  crowd.regions = 3;
  crowd.bowl.uvs = false;
  expect_refused(SmallCrowdFolder(crowd), ExitCode::kBadData, {"texture coordinate"});
}

TEST(Inputs, MissingMasksAndTilesAreRefused) {
  SmallCrowd crowd;
  crowd.regions = 3;
  const SmallCrowdFolder plain(crowd);
  fs::remove(plain / "mask_0.png");
  expect_refused(plain, ExitCode::kMissingInput, {"mask_0.png"});

  crowd.udim = true;
  crowd.bowl.tiles = 3;
  const SmallCrowdFolder tiles(crowd);
  fs::remove(tiles / "mask_0.1002.png");
  expect_refused(tiles, ExitCode::kMissingInput, {"mask_0", "1002"});
}

TEST(Inputs, ASingleMaskOutsideTheFirstTileIsWarnedOf) {
  const auto warnings_at = [](double u) {
    SmallCrowd crowd;
    crowd.regions = 3;
    const SmallCrowdFolder folder(crowd);
    for (const char* name : {"ann", "bob", "cyd", "dan"}) {
      edit(folder, name, [&](Lines& lines) {
        for (std::string& line : lines) {
          if (!line.starts_with("vt ")) continue;
          const std::size_t end = line.find(' ', 3);
          line = concat("vt ", *parse_double(line.substr(3, end - 3)) + u, line.substr(end));
        }
      });
    }
    return join(load_job(folder.config(), {}).inputs.warnings);
  };
  EXPECT_EQ(warnings_at(0).find("is one image"), std::string::npos);
  EXPECT_NE(warnings_at(1).find("is one image, but the skin's texture coordinates lie outside the "
                                "first tile"),
            std::string::npos);
}

TEST(Inputs, MasksThatCannotBeReadAreRefused) {
  SmallCrowd crowd;
  crowd.regions = 3;
  const SmallCrowdFolder folder(crowd);
  const std::string whole = testing::read_text(folder / "mask_0.png");
  for (const std::string& bytes :
       {std::string("not an image"), std::string(), whole.substr(0, whole.size() / 2)}) {
    folder.folder().write("mask_0.png", bytes);
    expect_refused(folder, ExitCode::kBadData, {"mask_0.png"});
  }
}

TEST(Inputs, TooFewChannelsAreRefused) {
  SmallCrowd crowd;
  crowd.regions = 3;
  SmallCrowdFolder folder(crowd);
  crowd.regions = 5;  // one image for five regions
  folder.configure(crowd);
  expect_refused(folder, ExitCode::kBadData, {"mask_0.png", "5"});
}

TEST(Inputs, MissingHeadsAreRefused) {
  const SmallCrowdFolder folder{SmallCrowd{}};
  fs::remove_all(folder / "heads");
  expect_refused(folder, ExitCode::kMissingInput, {"heads"});
}

TEST(Inputs, HeadsThatCannotBeReadAreRefused) {
  const SmallCrowdFolder folder{SmallCrowd{}};
  fs::remove(folder.head("bob"));
  fs::create_directory(folder.head("bob"));
  testing::expect_error(ExitCode::kMissingInput, {"bob.obj"}, [&] {
    run(folder, {"faces={files: [heads/ann.obj, heads/bob.obj], units: cm}"});
  });
}

TEST(Inputs, UncoveredVerticesAreCountedInAWarning) {
  SmallCrowd crowd;
  crowd.regions = 3;
  const SmallCrowdFolder folder(crowd);
  reference::Picture black{4, 4, 3, std::vector<double>(48, 0.0)};
  testing::write_mask(folder / "mask_0.png", black);
  run(folder);
  const auto report = testing::read_json(folder.out() / "report.json");
  // All but the loose vertex and the ball of eight, which follows the skin and needs no mask.
  EXPECT_EQ(report.at("masks").at("uncovered_vertices"), crowd.bowl.vertex_count() - 9);
  EXPECT_THAT(report.at("warnings").dump(), ::testing::HasSubstr("region_3"));
}

TEST(Inputs, SettingsHashTellsWhatMeshesDependOn) {
  SmallCrowd crowd;
  crowd.regions = 3;
  const SmallCrowdFolder folder(crowd);
  const auto settings = [&](const std::vector<std::string>& set) {
    ConfigOverrides overrides;
    overrides.assignments = set;
    return load_job(folder.config(), overrides).settings.hex();
  };
  const std::string plain = settings({});
  EXPECT_EQ(settings({"crowd.count=7", "crowd.seed=5", "sampling.max_sources=1"}), plain);
  for (const char* other :
       {"smoothing.boundary=free", "smoothing.operator=lazy", "smoothing.levels=cubic",
        "smoothing.levels=basis", "regions=none", "regions.names=[region_2, region_1, region_3]"}) {
    EXPECT_NE(settings({other}), plain) << other;
  }
  const std::vector<std::string> basis = {"smoothing.levels=basis"};
  EXPECT_NE(settings({"smoothing.levels=basis", "faces.units=mm"}), settings(basis))
      << "the tolerance is a length";
  edit(folder, "bob", [](Lines& lines) { lines[first_line(lines, "v ")] = "v -7 -8 1.5"; });
  EXPECT_NE(settings({}), plain);
}

}  // namespace
}  // namespace crowdface
