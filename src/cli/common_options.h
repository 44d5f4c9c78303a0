// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "crowdface/config/config_reader.h"
#include "crowdface/core/parallel.h"
#include "crowdface/io/mesh_format.h"
#include "crowdface/run/generate.h"

#include "cli/commands.h"

namespace crowdface::cli {

/// The options that every command has: `--threads`, `--quiet`, `--verbose`, `--log-file`,
/// `--limit`. The members store numbers as text, and `apply` parses them, because CLI11 accepts
/// numbers that overflow.
struct CommonOptions {
  std::string threads;  ///< number of threads; empty: one per processor
  bool quiet = false;
  bool verbose = false;
  std::string log_file;             ///< path of the log file; empty: no log file
  std::vector<std::string> limits;  ///< the values of `--limit`, such as "vertices=2000000"

  /// Adds these options to a command.
  void add_to(CLI::App& command);
  /// Returns this command line's `--limit` options (limits on the size of inputs), for processes
  /// that this run starts.
  std::vector<std::string> input_limit_arguments() const;
  /// Applies the options. \return an object that limits the number of threads during its lifetime.
  [[nodiscard]] std::unique_ptr<ThreadLimit> apply() const;
};

/// The option `--cache`, the folder of prepared heads.
struct CacheOption {
  std::string cache_folder;  ///< folder of the prepared heads; empty: the default folder

  /// Adds the option to a command.
  void add_to(CLI::App& command);
  /// Returns `cache_folder`, or the default folder if `cache_folder` is empty.
  std::filesystem::path cache_path() const;
};

/// The config file, and the options that override values of the config.
struct ConfigOptions : CacheOption {
  std::string config_file;
  /// The values of `--set`, `--count` and similar options, which override the config.
  ConfigOverrides overrides;

  /// Adds the argument CONFIG and the options to a command.
  void add_to(CLI::App& command);
  /// Adds the option `--review`. For commands that plan a crowd.
  void add_review_to(CLI::App& command);
  /// Adds the option `--without-reviews`. For commands that write a plan.
  void add_without_reviews_to(CLI::App& command);
};

/// The options of commands that write into a crowd's folder: `--force`, `--dry-run`, `--memory`.
struct WriteOptions {
  bool force = false;
  bool dry_run = false;
  std::string memory_limit;  ///< value of `--memory`, such as "4 GiB"; empty: the default
  std::string shard;         ///< value of `--shard`, such as "2/7"; empty: the whole crowd
  bool planned = false;      ///< `--planned`: require a plan in the folder; make no new plan

  /// Adds the options, except `--shard` and `--planned`, to a command.
  void add_to(CLI::App& command);
  /// Adds the options `--shard` and `--planned`. For commands that build faces.
  void add_shard_to(CLI::App& command);
  /// Converts these options to options of `generate`. If the user gives `--memory`, also limits the
  /// memory that this process may reserve for images to half of the given size.
  /// \param cache  folder of prepared heads. \throws UsageError
  GenerateOptions generate_options(const std::filesystem::path& cache) const;
};

/// Parses the value `I/N` of `--shard`; an empty text gives the shard 1/1. \throws UsageError.
Shard parse_shard_option(const std::string& text);

/// Parses a size in bytes with a unit, such as "4 GiB"; returns 0 if `text` is empty.
/// \param option  name of the option, for messages. \throws UsageError.
std::uint64_t parse_byte_size(std::string_view option, const std::string& text);

/// Adds the option `--output` for a mesh of any format.
void add_mesh_output(CLI::App& command, std::string& out);
/// The format of the mesh file given with `--output`. \throws UsageError if unknown.
MeshFormat parse_mesh_output(const std::string& out);
/// Checks that the file name given with `--output` ends in .obj. \throws UsageError if not.
void require_obj_output(const std::string& out);

/// Writes the result of a command to standard output, with control characters escaped as in logs.
void print(std::string_view text);

/// Whether to open a page in the user's browser.
enum class Browser { kOpen, kNone };

/// Prints the address of the page that the process serves. With kOpen, also opens the page in the
/// browser if there is a display. Ignores a failure to start the browser.
void show_page(const std::string& address, Browser browser);

/// Parses a whole number in [least, most]. \param option  name of the option, for messages. \throws
/// UsageError.
std::uint64_t parse_whole_number(std::string_view option, const std::string& text,
                                 std::uint64_t least, std::uint64_t most);

/// Adds a command.
/// \tparam Options  options of the command; derived from CommonOptions.
/// \param declare   adds the command's own options to the parser; the parser stores their values in
///   `Options`.
/// \param work      executes the command.
template <class Options>
CommandAction add_command(CLI::App& program, const char* name, const char* description,
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
