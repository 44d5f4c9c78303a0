// SPDX-License-Identifier: Apache-2.0
// A tiny crowd whose runs are disturbed, and what an undisturbed run gives.
#pragma once

#include <cstdlib>
#include <map>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "crowdface/core/interrupt.h"
#include "crowdface/core/parallel.h"
#include "crowdface/crowd/ledger.h"
#include "crowdface/io/image.h"
#include "crowdface/run/generate.h"

#include "reliability/io_faults.h"
#include "support/crowd_files.h"
#include "support/small_crowd.h"

namespace crowdface::testing {

/// How often a random test is done: the first number in the test suite, the second in
/// scripts/soak.sh.
inline int times(int in_suite, int in_soak) {
  return std::getenv("CROWDFACE_SOAK") != nullptr ? in_soak : in_suite;
}

/// Three small faces with pictures and a sheet. Whatever runs, runs in a child process: threads of
/// this process would not live on there.
class DisturbedCrowd : public ::testing::Test {
 protected:
  DisturbedCrowd() : DisturbedCrowd(small()) {}
  explicit DisturbedCrowd(const SmallCrowd& crowd, std::vector<std::string> set = {})
      : folder_(crowd), set_(std::move(set)) {
    // The library behind images takes most of a child's time to load: it is there before the first
    // of them.
    encode_png(1, 1, 1, std::vector<std::uint8_t>(1));
    undisturbed_ = run({});
    EXPECT_EQ(undisturbed_.code, 0) << undisturbed_.message;
    whole_ = files();
    std::filesystem::remove_all(folder_.out());
  }

  static SmallCrowd small() {
    SmallCrowd crowd;
    crowd.bowl.materials = true;
    crowd.count = times(3, 20);
    crowd.contact_sheet = "{columns: 2, rows: 2, cell: 32}";
    return crowd;
  }

  ChildOutcome run(const Fault& fault) const {
    return run_with_fault(folder_.out(), fault, [this] { generate_here(); });
  }
  void generate_here() const {
    const ThreadLimit limit(2);
    if (fault_signals_) catch_interrupts();
    ConfigOverrides overrides;
    overrides.assignments = set_;
    generate(folder_.config(), overrides, {folder_.cache(), Replace::kRefuse, false});
  }

  /// None if what failed was the first look at the folder, before it was made.
  std::map<std::string, std::string> files() const {
    if (!std::filesystem::exists(folder_.out())) return {};
    return crowd_files(folder_.out());
  }

  /// Files that are not those of the undisturbed run.
  std::vector<std::string> differences() const { return differing_files(whole_, files()); }

  std::size_t proven_faces() const {
    std::set<std::string> faces;
    for (const LedgerEntry& entry : read_ledger(folder_.out() / "ledger.jsonl").entries) {
      if (entry.item.starts_with("faces/")) faces.insert(entry.item);
    }
    return faces.size();
  }

  /// What is there after a disturbed run is no half file, and another run makes it whole.
  void expect_resumed(const std::string& after) const {
    for (const auto& [name, bytes] : files()) {
      if (name.find("/.crowdface") != name.npos || name.starts_with(".crowdface") ||
          name == "ledger.jsonl") {
        continue;
      }
      if (name == "planned.json") {  // a finished crowd needs it no more
        EXPECT_TRUE(read_json(folder_.out() / name).is_object()) << after;
        continue;
      }
      EXPECT_TRUE(whole_.contains(name) && whole_.at(name) == bytes) << name << " after " << after;
    }
    const std::size_t proven = proven_faces();
    const ChildOutcome resumed = run({});
    EXPECT_EQ(resumed.code, 0) << after << ": " << resumed.message;
    EXPECT_THAT(differences(), ::testing::IsEmpty()) << after;
    const auto built = read_json(folder_.out() / "timings.json").at("faces").get<std::size_t>();
    EXPECT_EQ(built + proven, static_cast<std::size_t>(folder_.crowd().count)) << after;
  }

  SmallCrowdFolder folder_;
  std::vector<std::string> set_;
  bool fault_signals_ = false;
  ChildOutcome undisturbed_;
  std::map<std::string, std::string> whole_;
};

}  // namespace crowdface::testing
