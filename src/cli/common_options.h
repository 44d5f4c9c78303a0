// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "crowdface/config/config_reader.h"
#include "crowdface/core/parallel.h"
#include "crowdface/run/generate.h"

#include "cli/commands.h"

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
  /// `--limit` as it was given, for runs that this one starts.
  std::vector<std::string> limit_arguments() const;
  /// Applies them. \return keeps the thread limit for as long as it lives.
  [[nodiscard]] std::unique_ptr<ThreadLimit> apply() const;
};

/// `--cache`, the folder of prepared heads.
struct CacheOption {
  std::string cache;

  void add_to(CLI::App& command);
  /// That folder, or the usual one.
  std::filesystem::path cache_path() const;
};

/// The config file and what the command line changes in it.
struct ConfigOptions : CacheOption {
  std::string config;
  ConfigOverrides overrides;

  void add_to(CLI::App& command);
  /// `--review`, of commands that cast.
  void add_review_to(CLI::App& command);
};

/// `--force` and `--dry-run`, of commands that fill a crowd's folder.
struct WriteOptions {
  bool force = false;
  bool dry_run = false;
  std::string memory;
  std::string shard;
  bool planned = false;

  void add_to(CLI::App& command);
  /// `--shard` and `--planned`, of commands that build faces.
  void add_shard_to(CLI::App& command);
  GenerateOptions with_cache(const std::filesystem::path& cache) const;
};

/// The `I/N` of `--shard`; the whole if `text` is empty. \throws UsageError.
Shard shard_from(const std::string& text);

/// A size with its unit, "4 GiB", of an option; 0 if `text` is empty. \throws UsageError.
std::uint64_t bytes_from(std::string_view option, const std::string& text);

/// What a command is asked for, on standard output: made printable, as logs are.
void print(std::string_view text);

enum class Browser { kOpen, kNone };

/// Prints the address of a page that is served now, and opens the browser where there is a screen to show it
/// on; whether that worked the user sees.
void show_page(const std::string& address, Browser browser);

/// A whole number between the two, or \throws UsageError naming the option.
std::uint64_t whole_number(std::string_view option, const std::string& text, std::uint64_t least,
                           std::uint64_t most);

/// Adds a command.
/// \tparam Options  CommonOptions, which every command has, and its own.
/// \param declare   adds its own options, which are read into these Options.
template <class Options>
Run add_command(CLI::App& program, const char* name, const char* description,
                void (*declare)(CLI::App&, Options&), void (*work)(const Options&)) {
  const auto options = std::make_shared<Options>();
  CLI::App& command = add_subcommand(program, name, description);
  declare(command, *options);
  options->CommonOptions::add_to(command);
  return [options, work] {
    const auto threads = options->apply();
    work(*options);
  };
}

}  // namespace crowdface::cli
