// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include <CLI/CLI.hpp>

#include "crowdface/config/config_reader.h"
#include "crowdface/core/parallel.h"
#include "crowdface/run/generate.h"

namespace crowdface::cli {

/// `--threads`, `--quiet`, `--verbose`, `--log-file`: every command has them. Numbers are taken as
/// text, because CLI11 lets them wrap and saturate.
struct CommonOptions {
  std::string threads;
  bool quiet = false;
  bool verbose = false;
  std::string log_file;
  std::vector<std::string> limits;

  void add_to(CLI::App& command);
  /// Applies them. \return keeps the thread limit for as long as it lives.
  [[nodiscard]] std::unique_ptr<ThreadLimit> apply() const;
};

/// The config file and what the command line changes in it.
struct ConfigOptions {
  std::string config;
  ConfigOverrides overrides;
  std::string cache;

  void add_to(CLI::App& command);
  /// `--review`, of commands that cast.
  void add_review_to(CLI::App& command);
  std::filesystem::path cache_path() const;
};

/// `--force` and `--dry-run`, of commands that fill a crowd's folder.
struct WriteOptions {
  bool force = false;
  bool dry_run = false;
  std::string memory;
  std::string shard;

  void add_to(CLI::App& command);
  /// `--shard`, of commands that build faces.
  void add_shard_to(CLI::App& command);
  GenerateOptions with_cache(const std::filesystem::path& cache) const;
};

/// A whole number between the two, or \throws UsageError naming the option.
std::uint64_t whole_number(std::string_view option, const std::string& text, std::uint64_t least,
                           std::uint64_t most);

}  // namespace crowdface::cli
