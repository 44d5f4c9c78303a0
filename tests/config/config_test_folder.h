// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <fstream>
#include <optional>
#include <string>

#include <gtest/gtest.h>
#include <unistd.h>

#include "crowdface/config/config_reader.h"
#include "crowdface/core/file.h"
#include "crowdface/core/problems.h"
#include "crowdface/core/text.h"

namespace crowdface {

/// A folder of its own for every test, with three empty heads in `heads`, a mask and a mask tile.
/// Reading a config lists heads and looks for masks, but opens none.
class ConfigTest : public testing::Test {
 protected:
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::temp_directory_path() /
              concat("crowdface_", test->test_suite_name(), '_', test->name(), '_', getpid());
    std::filesystem::remove_all(folder_);
    for (const char* name : {"ann", "bob", "cyd"}) touch(concat("heads/", name, ".obj"));
    touch("mask.png");
    touch("tiles.1001.png");
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path touch(const std::string& name, const std::string& text = "") {
    const auto path = folder_ / name;
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary) << text;
    return path;
  }

  /// Reads `text` as the file c.yaml of the folder.
  std::optional<Config> read(const std::string& text, const ConfigOverrides& overrides = {}) {
    const auto file = touch("c.yaml", text);
    problems_ = Problems();
    return read_config(file, overrides, problems_);
  }

  /// The problems, one a line, without the folder's name.
  std::string told() const {
    std::string all = join(problems_.messages(), "\n");
    const std::string prefix = folder_.string() + "/";
    for (std::size_t at; (at = all.find(prefix)) != std::string::npos;)
      all.erase(at, prefix.size());
    return all;
  }

  std::filesystem::path folder_;
  Problems problems_;
};

/// A config without regions that has nothing wrong with it; more may follow.
inline const std::string kPlain =
    "schema: 1\n"
    "crowd: {name: mob, count: 3}\n"
    "faces: {directory: heads, units: cm}\n";

/// The same with three regions; what follows stands from line 5 on.
inline const std::string kBands = kPlain + "regions: {names: [top, mid, low], mask: mask.png}\n";

}  // namespace crowdface
