// SPDX-License-Identifier: Apache-2.0
// Tests 4, 11 and 12 of docs/reliability.md: what is refused before any work, and without a trace.
#include <csignal>
#include <cstdio>

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "crowdface/core/log.h"
#include "crowdface/core/text.h"
#include "crowdface/run/crowd_sheets.h"
#include "crowdface/run/generate.h"

#include "reliability/io_faults.h"
#include "support/crowd_files.h"
#include "support/expect_error.h"
#include "support/small_crowd.h"

namespace crowdface::testing {
namespace {

namespace fs = std::filesystem;

class Refusals : public ::testing::Test {
 protected:
  /// Runs with these overrides. \return its outcome; `outside` must then be as before.
  ChildOutcome run(const ConfigOverrides& overrides, bool dry_run = false) const {
    return run_with_fault(folder_.out(), {}, [&] {
      generate(folder_.config(), overrides, {folder_.cache(), Replace::kRefuse, dry_run});
    });
  }
  ChildOutcome run_with(const std::string& set) const { return run({{set}, {}, {}, {}}); }

  /// All files but the crowd's own and the cache's.
  std::map<std::string, std::string> outside() const {
    auto files = crowd_files(folder_.folder().path());
    std::erase_if(files, [](const auto& file) {
      return file.first.starts_with("out/") || file.first.starts_with("cache/");
    });
    return files;
  }

  SmallCrowdFolder folder_{[] {
    SmallCrowd crowd;
    crowd.count = 1;
    crowd.bowl.materials = true;
    return crowd;
  }()};
};

// Test 12.
TEST_F(Refusals, NamesNeverLeadOutOfTheFolder) {
  const auto before = outside();
  const std::vector<std::string> names = {"../x",
                                          "..",
                                          "../../x",
                                          "/tmp/x",
                                          "a/b",
                                          "a/../../b",
                                          ".",
                                          ".x",
                                          "~",
                                          "a\\b",
                                          "a\\0b",
                                          "a b",
                                          "ünïcode",
                                          "名",
                                          "x\x7f",
                                          "%2e%2e",
                                          "$HOME",
                                          "`id`",
                                          "a;b",
                                          "*",
                                          std::string(300, 'a'),
                                          "con:",
                                          "a\tb",
                                          "a\nb",
                                          std::string(65, 'b')};
  for (const std::string& name : names) {
    std::string quoted_name = "\"";
    for (const char c : name) {
      if (c == '\\' && !name.starts_with("a\\0")) quoted_name += '\\';
      quoted_name += c == '\n' ? std::string("\\n") : c == '\t' ? "\\t" : std::string(1, c);
    }
    quoted_name += '"';
    EXPECT_EQ(run_with("crowd.name=" + quoted_name).code, 64) << name;
    EXPECT_EQ(
        run_with(concat("recipes=[{id: ", quoted_name,
                        ", target: bob, regions: {all: {weights: {ann: 1}, smoothness: 0.3}}}]"))
            .code,
        64)
        << name;
    EXPECT_EQ(
        run_with(concat("families=[{name: ", quoted_name, ", members: 1, target: bob}]")).code, 64)
        << name;
  }
  EXPECT_EQ(outside(), before);
  EXPECT_FALSE(fs::exists(folder_.out()));
}

TEST_F(Refusals, MaterialFilesNeverLeadOutOfTheFolder) {
  folder_.folder().write("secret.png", "secret");
  for (const char* library : {"../secret.png", "/etc/passwd", "a/../../secret.png",
                              "..\\secret.png", "./../secret.png"}) {
    fs::remove_all(folder_.out());
    std::string text = read_text(folder_.head("ann"));
    text.replace(text.find("mtllib"), text.find('\n', text.find("mtllib")) - text.find("mtllib"),
                 concat("mtllib ", library));
    for (const std::string& head : folder_.names()) {
      folder_.folder().write("heads/" + head + ".obj", text);
    }
    const auto before = outside();
    EXPECT_EQ(run({}).code, 0) << library;
    EXPECT_EQ(outside(), before) << library;
    for (const auto& [name, bytes] : crowd_files(folder_.out())) {
      EXPECT_EQ(bytes.find("secret\n"), bytes.npos) << name;
      EXPECT_NE(bytes, "secret") << name;
    }
  }
}

TEST_F(Refusals, LinksNeverLeadOutOfTheFolder) {
  fs::create_directories(folder_ / "elsewhere");
  for (const char* name : {"meshes", "meshes/topology", "renders", "renders/heads",
                           "renders/founders", "sheets", "gallery", "gallery/data/faces"}) {
    fs::remove_all(folder_.out());
    fs::create_directories((folder_.out() / name).parent_path());
    fs::create_directory_symlink(folder_ / "elsewhere", folder_.out() / name);
    const ChildOutcome outcome = run({});
    EXPECT_EQ(outcome.code, 73) << name;
    EXPECT_NE(outcome.message.find("link"), std::string::npos) << outcome.message;
  }
  EXPECT_TRUE(fs::is_empty(folder_ / "elsewhere"));
  // What grows is not written through one either.
  for (const char* name : {"ledger.jsonl", "crowdface.log"}) {
    fs::remove_all(folder_.out());
    fs::create_directories(folder_.out());
    const fs::path mine = folder_.folder().write("elsewhere/mine", "");
    fs::create_symlink(mine, folder_.out() / name);
    EXPECT_EQ(run({}).code, 73) << name;
    EXPECT_EQ(read_text(mine), "") << name;
  }
  // A file that is a link is replaced, not written through.
  fs::remove_all(folder_.out());
  folder_.folder().write("elsewhere/mine.obj", "mine");
  EXPECT_EQ(run({}).code, 0);
  fs::remove(folder_.out() / "meshes/mob_0001.obj");
  fs::create_symlink(folder_ / "elsewhere/mine.obj", folder_.out() / "meshes/mob_0001.obj");
  EXPECT_EQ(run({}).code, 0);
  EXPECT_EQ(read_text(folder_ / "elsewhere/mine.obj"), "mine");
  EXPECT_FALSE(fs::is_symlink(folder_.out() / "meshes/mob_0001.obj"));
}

// Test 4: they were met when all faces had been made.
TEST_F(Refusals, WhatStandsInTheWayIsToldBeforeAnythingIsPrepared) {
  for (const char* name : {"sheets", "meshes", "renders", "gallery"}) {
    fs::remove_all(folder_.out());
    folder_.folder().write(concat("out/", name), "a file");
    const ChildOutcome outcome = run({});
    EXPECT_EQ(outcome.code, 73) << name;
    EXPECT_NE(outcome.message.find(name), std::string::npos) << outcome.message;
  }
  for (const char* name : {"report.json", "timings.json", "likeness.json", "plan.jsonl",
                           "ledger.jsonl", "crowdface.log", "sheets/sheet_001.png"}) {
    fs::remove_all(folder_.out());
    fs::create_directories(folder_.out() / name);
    const ChildOutcome outcome = run({});
    EXPECT_EQ(outcome.code, 73) << name;
    EXPECT_NE(outcome.message.find(name), std::string::npos) << outcome.message;
  }
  EXPECT_FALSE(fs::exists(folder_.cache())) << "nothing was prepared";
}

// Test 12.
TEST_F(Refusals, PlansNeverNameFilesElsewhere) {
  ASSERT_EQ(run_with("output.contact_sheet={columns: 2, rows: 2, cell: 32}").code, 0);
  const std::string plan = read_text(folder_.out() / "plan.jsonl");
  for (const char* id : {"../x", "a/b", "..", "", "/tmp/x"}) {
    std::string other = plan;
    other.replace(other.find("mob_0001"), 8, id);
    folder_.folder().write("out/plan.jsonl", other);
    const ChildOutcome outcome = run_with_fault(
        folder_.out(), {}, [&] { remake_sheets(folder_.out(), {}, folder_.cache()); });
    EXPECT_EQ(outcome.code, 65) << id;
    EXPECT_NE(outcome.message.find("plan.jsonl:1: id"), std::string::npos) << outcome.message;
  }
}

// Test 12.
TEST_F(Refusals, SheetsMadeAnewFollowNoLinkEither) {
  ASSERT_EQ(run_with("output.contact_sheet={columns: 2, rows: 2, cell: 32}").code, 0);
  for (const char* name : {"sheets", "renders", "ledger.jsonl"}) {
    fs::create_directories(folder_ / "elsewhere");
    fs::rename(folder_.out() / name, folder_ / "elsewhere" / name);
    folder_.folder().write("elsewhere/sheets/family_photo.png", "mine");
    fs::create_symlink(folder_ / "elsewhere" / name, folder_.out() / name);
    const auto before = crowd_files(folder_.folder().path());
    const ChildOutcome outcome = run_with_fault(
        folder_.out(), {}, [&] { remake_sheets(folder_.out(), {"output.contact_sheet.cell=48"}); });
    EXPECT_EQ(outcome.code, 73) << name << ' ' << outcome.message;
    EXPECT_THAT(differing_files(before, crowd_files(folder_.folder().path())),
                ::testing::IsEmpty());
    fs::remove(folder_.out() / name);
    fs::rename(folder_ / "elsewhere" / name, folder_.out() / name);
  }
}

// Test 11.
TEST_F(Refusals, ExtremeNumbersWrapNowhere) {
  const auto refused = [&](const std::string& set) {
    const ChildOutcome outcome = run_with(set);
    EXPECT_EQ(outcome.code, 64) << set << ": " << outcome.message;
  };
  for (const char* count :
       {"-1", "1000001", "2147483647", "2147483648", "4294967296", "9223372036854775808",
        "18446744073709551615", "18446744073709551616", "1e3", "0x10", "1.5"}) {
    refused(concat("crowd.count=", count));
  }
  for (const char* iterations : {"0", "-1", "10000001", "18446744073709551616", "nan"}) {
    refused(concat("smoothing.max_iterations=", iterations));
  }
  for (const char* range : {"[0, 1e300]", "[-1, 0]", "[1, 0]", "inf", "nan", "1e400"}) {
    refused(concat("sampling.smoothness=", range));
    if (std::string(range) != "[-1, 0]") refused(concat("sampling.extrapolation=", range));
  }
  for (const char* weight : {"-1", "1e300", "nan", "0"}) {
    refused(concat("recipes=[{id: mine, target: bob, regions: {all: {weights: {ann: ", weight,
                   "}, smoothness: 0.3}}}]"));
  }
  EXPECT_FALSE(fs::exists(folder_.out()));
  EXPECT_EQ(run_with("crowd.count=0").code, 0);
  fs::remove_all(folder_.out());
  EXPECT_EQ(run_with("recipes=[{id: mine, target: bob, regions: {all: {weights: {ann: 1e6, cyd: "
                     "1e-300}, smoothness: 1, extrapolation: 4}}}]")
                .code,
            0);
}

TEST_F(Refusals, ADryRunOfAMillionTellsTheBytes) {
  const fs::path said = folder_ / "said";
  const ChildOutcome outcome = run_with_fault(folder_.out(), {}, [&] {
    if (std::freopen(said.c_str(), "w", stderr) == nullptr) throw std::runtime_error("freopen");
    set_log_level(LogLevel::kNormal);
    generate(folder_.config(), {{}, "1000000", {}, {}}, {folder_.cache(), Replace::kRefuse, true});
  });
  EXPECT_EQ(outcome.code, 0) << outcome.message;
  const double each = static_cast<double>(fs::file_size(folder_.head("ann")));
  const std::string text = read_text(said);
  const std::size_t found = text.find("about ");
  ASSERT_NE(found, text.npos) << text;
  EXPECT_NEAR(std::stod(text.substr(found + 6)), each, each / 10)
      << "MB for a million: bytes a face";
  EXPECT_FALSE(fs::exists(folder_.out()));
}

// Test 4.
TEST_F(Refusals, FoldersThatCannotBeWrittenToAreRefusedBeforeTheWork) {
  folder_.folder().write("file", "a file");
  fs::create_directories(folder_ / "loop");
  fs::create_symlink(folder_ / "loop/b", folder_ / "loop/a");
  fs::create_symlink(folder_ / "loop/a", folder_ / "loop/b");
  std::vector<std::string> outs = {"file", "file/below", "file/far/below", "loop/a/x",
                                   std::string(300, 'x')};
  outs.push_back(outs.back() + "/y");
  if (::geteuid() == 0) {
    outs.emplace_back("/proc/crowd");  // root may write to any other folder
  } else {
    fs::create_directories(folder_ / "closed");
    ::chmod((folder_ / "closed").c_str(), 0555);
    outs.emplace_back("closed/x");
  }
  for (const std::string& out : outs) {
    ConfigOverrides overrides;
    overrides.out = out.starts_with('/') ? out : (folder_ / out).string();
    const ChildOutcome outcome = run(overrides);
    EXPECT_EQ(outcome.code, 73) << out << ": " << outcome.message;
    EXPECT_TRUE(out == "/proc/crowd" || !fs::exists(folder_.cache())) << out << ": work was done";
  }
}

// A run whose folder was removed sometimes ended well, without plan and config.
TEST_F(Refusals, AFolderThatVanishesAtAnyMomentIsTold) {
  const auto run_until = [&](std::uint64_t call) {
    return run_with_fault(folder_.out(), {Fault::Kind::kSignal, call, SIGUSR1}, [&] {
      static std::string from, to;
      from = folder_.out().string();
      to = (folder_ / "elsewhere").string();
      std::signal(SIGUSR1, [](int) { ::rename(from.c_str(), to.c_str()); });
      generate(folder_.config(), {}, {folder_.cache(), Replace::kRefuse, false});
    });
  };
  const std::uint64_t calls = run_until(1'000'000).calls;
  int told = 0;
  for (std::uint64_t call = 0; call < calls; call += 7) {
    fs::remove_all(folder_.out());
    fs::remove_all(folder_ / "elsewhere");
    const ChildOutcome outcome = run_until(call);
    ASSERT_TRUE(outcome.struck) << call;
    if (outcome.code != 0) ++told;
    if (outcome.code == 0) {  // nothing was there yet, or all was done
      EXPECT_TRUE(!fs::exists(folder_ / "elsewhere") || call + 10 > calls) << call;
    } else {
      EXPECT_TRUE(outcome.code == 73 || outcome.code == 74) << outcome.code << outcome.message;
    }
  }
  EXPECT_GT(told, 10);
  EXPECT_EQ(run({}).code, 0);
}

// What was removed was outside the crowd.
TEST_F(Refusals, LeftoversAreNotRemovedThroughLinks) {
  ASSERT_EQ(run({}).code, 0);
  const fs::path mine = folder_.folder().write("elsewhere/.crowdface-1-0.tmp", "mine");
  fs::create_directory_symlink(folder_ / "elsewhere", folder_.out() / "notes");
  folder_.folder().write("out/more/.crowdface-1-0.tmp", "left over");
  EXPECT_EQ(run({}).code, 0);
  EXPECT_TRUE(fs::exists(mine));
  EXPECT_FALSE(fs::exists(folder_.out() / "more/.crowdface-1-0.tmp"));
}

TEST_F(Refusals, TexturesBehindLinksOutOfTheHeadsFolderAreNotCopied) {
  folder_.folder().write("secret.png", "secret");
  fs::create_directories(folder_ / "elsewhere");
  folder_.folder().write("elsewhere/secret.png", "secret");
  fs::create_symlink(folder_ / "secret.png", folder_ / "heads/link.png");
  fs::create_directory_symlink(folder_ / "elsewhere", folder_ / "heads/deep");
  folder_.folder().write("heads/inside.png", "inside");
  fs::create_symlink(folder_ / "heads/inside.png", folder_ / "heads/fine.png");
  folder_.folder().write("heads/bowl.mtl",
                         "newmtl skin\nmap_Kd link.png\nmap_Ks deep/secret.png\nmap_Ka fine.png\n");
  EXPECT_EQ(run({}).code, 0);
  const auto files = crowd_files(folder_.out());
  for (const auto& [name, bytes] : files) EXPECT_NE(bytes, "secret") << name;
  EXPECT_TRUE(files.contains("meshes/fine.png"));
  EXPECT_THAT(files.at("report.json"), ::testing::HasSubstr("link.png\\\" lies outside"));
}

}  // namespace
}  // namespace crowdface::testing
