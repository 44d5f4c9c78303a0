// SPDX-License-Identifier: Apache-2.0
#include "crowdface/core/text.h"

#include "cli/program_test.h"
#include "support/crowd_files.h"

namespace crowdface::testing {
namespace {

namespace fs = std::filesystem;

TEST(Smooth, MatchesPlainIteration) {
  const TemporaryFolder folder;
  Bowl bowl;
  bowl.odd_text = true;
  const fs::path in = folder.write("in.obj", bowl_text(bowl, 1));
  const fs::path out = folder / "out.obj";
  const reference::Obj mesh = reference::read_obj(in);
  const auto smooth = [&](bool fixed, bool lazy, std::uint64_t level, bool plain) {
    SCOPED_TRACE(concat(fixed ? "fixed " : "free ", lazy ? "lazy " : "umbrella ", level));
    std::vector<std::string> arguments = {"smooth",       in.string(),
                                          "-o",           out.string(),
                                          "--iterations", concat(level),
                                          "--boundary",   fixed ? "fixed" : "free",
                                          "--operator",   lazy ? "lazy" : "umbrella",
                                          "--quiet"};
    if (plain) arguments.emplace_back("--plain");
    const Outcome outcome = crowdface(0, arguments);
    EXPECT_EQ(outcome.out + outcome.err, "") << "quiet";
    const reference::Points expected =
        reference::smooth(reference::make_filter(mesh, fixed, lazy), mesh.vertices, level);
    EXPECT_LT(reference::largest_difference(reference::read_obj(out).vertices, expected), 2e-5);
    expect_same_but_positions(in, out);
  };
  smooth(true, false, 37, false);
  smooth(true, true, 1000, false);
  smooth(false, false, 20000, false);
  smooth(false, true, 1, false);
  smooth(true, false, 37, true);
  smooth(false, false, 0, false);
  EXPECT_EQ(reference::read_obj(out).vertices, mesh.vertices) << "level 0";
}

// What the loader underneath lets through (design notes on libraries).
TEST(Smooth, MalformedFilesAre65WithTheirLine) {
  const TemporaryFolder folder;
  const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  const std::string random("\x7f\x45\x4c\x46\x02\x01\x00\x00\xff\xfe\x8a\n\x01\x02", 14);
  for (const auto& [name, text, line] : std::vector<std::tuple<std::string, std::string, int>>{
           {"nan", "v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n", 2},
           {"word", "v 0 0 0\nv 1 0 0\nv 0 abc 0\nf 1 2 3\n", 3},
           {"overflow", "v 1e400 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", 1},
           {"beyond", triangle + "f 1 2 99\n", 4},
           {"zero", triangle + "f 0 1 2\n", 4},
           {"relative", triangle + "f -4 -5 -6\n", 4},
           {"wrap", triangle + "f 1 2 4294967297\n", 4},
           {"binary", random, 1},
           {"cut", "v 0 0 0\nv 1 0 0\nv 0 1", 3}}) {
    const fs::path in = folder.write(name + ".obj", text);
    crowdface(65, {"smooth", in.string(), "--iterations", "1", "-o", (folder / "out.obj").string()},
              {concat(in.string(), ":", line)});
    EXPECT_FALSE(fs::exists(folder / "out.obj")) << name;
  }
}

TEST(Smooth, EmptyMeshesAreRefused) {
  const TemporaryFolder folder;
  const fs::path out = folder / "out.obj";
  const auto smooth = [&](const fs::path& in, int code) {
    crowdface(code, {"smooth", in.string(), "--iterations", "1", "-o", out.string()},
              {in.string()});
    EXPECT_FALSE(fs::exists(out));
  };
  smooth(folder.write("two.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2\n"), 65);
  smooth(folder.write("empty.obj", ""), 65);
  smooth(folder / "none.obj", 66);
}

// The loader underneath loses the first vertex behind a byte order mark.
TEST(Smooth, AByteOrderMarkIsReadOver) {
  const TemporaryFolder folder;
  const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  const fs::path in = folder.write("bom.obj", "\xEF\xBB\xBF" + triangle);
  const fs::path out = folder / "out.obj";
  crowdface(0, {"smooth", in.string(), "--iterations", "0", "-o", out.string()});
  EXPECT_EQ(reference::read_obj(out).vertices,
            reference::read_obj(folder.write("plain.obj", triangle)).vertices);
}

}  // namespace
}  // namespace crowdface::testing
