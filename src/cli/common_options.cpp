// SPDX-License-Identifier: Apache-2.0
#include "cli/common_options.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>

#include <spawn.h>
#include <unistd.h>

#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/input_limits.h"
#include "crowdface/core/log.h"
#include "crowdface/core/memory.h"
#include "crowdface/core/output_file.h"
#include "crowdface/core/text.h"
#include "crowdface/heads/cache_folder.h"

namespace crowdface::cli {
namespace {

/// Returns whether a file looks like a log file: the file is empty or starts with a date such as
/// 2026-11-22T.
bool begins_like_a_log(const std::string& path) {
  constexpr std::string_view kForm = "dddd-dd-ddT";
  std::ifstream stream(path);
  if (stream.peek() == std::ifstream::traits_type::eof()) return true;
  return std::ranges::all_of(kForm, [&](char form) {
    const int found = stream.get();
    return form == 'd' ? found >= '0' && found <= '9' : found == form;
  });
}

void open_log(const std::string& path) {
  const std::filesystem::path file = checked_output_path(path);
  if (path_exists(file) && !begins_like_a_log(file)) {
    throw CannotCreate(concat(path,
                              ": --log-file: expected a new file or an existing log, found a file "
                              "that is not a log; choose another name"));
  }
  add_log_file(file);
}

}  // namespace

void CommonOptions::add_to(CLI::App& command) {
  add_option(command, "--threads", threads, "N", "Number of threads (default: one per processor)");
  add_flag(command, "-q,--quiet", quiet, "Print only warnings and errors");
  add_flag(command, "-v,--verbose", verbose, "Print more details").excludes({"-q"});
  add_option(command, "--log-file", log_file, "FILE", "Also write all messages to this file");
  add_repeated(command, "--limit", limits, "NAME=NUMBER",
               "Change a limit on the size of inputs: " + describe_input_limits());
}

std::vector<std::string> CommonOptions::input_limit_arguments() const {
  std::vector<std::string> arguments;
  for (const std::string& limit : limits) arguments.insert(arguments.end(), {"--limit", limit});
  return arguments;
}

std::unique_ptr<ThreadLimit> CommonOptions::apply() const {
  constexpr std::uint64_t kMaxThreads = 1024;
  set_log_level(quiet ? LogLevel::kQuiet : verbose ? LogLevel::kVerbose : LogLevel::kNormal);
  if (!log_file.empty()) open_log(log_file);
  limit_image_memory(usable_memory_bytes() / 8 * 3);
  for (const std::string& limit : limits) set_input_limit(limit);
  const std::uint64_t limit =
      threads.empty() ? 0 : parse_whole_number("--threads", threads, 1, kMaxThreads);
  return std::make_unique<ThreadLimit>(static_cast<int>(limit));
}

void CacheOption::add_to(CLI::App& command) {
  add_option(command, "--cache", cache_folder, "DIR", "Folder of the head cache");
}

std::filesystem::path CacheOption::cache_path() const {
  return cache_folder.empty() ? cache_directory() : std::filesystem::path(cache_folder);
}

void ConfigOptions::add_to(CLI::App& command) {
  add_option(command, "config", config_file, "CONFIG", "The config file (docs/config.md)")
      .required();
  add_repeated(command, "--set", overrides.assignments, "KEY.PATH=VALUE",
               "Override one config value, such as smoothing.boundary=free");
  add_optional(command, "--seed", overrides.seed, "N", "Override crowd.seed");
  add_optional(command, "--count", overrides.count, "N", "Override crowd.count");
  add_optional(command, "--out", overrides.out, "DIR", "Override output.directory");
  CacheOption::add_to(command);
}

void ConfigOptions::add_review_to(CLI::App& command) {
  add_repeated(command, "--review", overrides.review, "FILE",
               "Draw the rejected faces of this review again; reviews apply in order");
}

void ConfigOptions::add_without_reviews_to(CLI::App& command) {
  add_flag(command, "--without-reviews", overrides.without_reviews,
           "Start without the reviews that the output folder keeps; move them to a folder that is "
           "named after the date");
}

void WriteOptions::add_to(CLI::App& command) {
  add_flag(command, "--force", force,
           "Replace another config's crowd in the output folder; its reviews stay and apply");
  add_flag(command, "--dry-run", dry_run,
           "Check everything and report what would be written, but write nothing");
  add_option(command, "--memory", memory_limit, "SIZE",
             "Memory limit, such as \"4 GiB\" (default: three quarters of the machine's memory); "
             "sets how many faces are made at once; images use at most half of it");
}

void WriteOptions::add_shard_to(CLI::App& command) {
  add_option(command, "--shard", shard, "I/N",
             "Make only part I of N of the faces; `crowdface gather` combines the parts");
  add_flag(command, "--planned", planned,
           "Use the plan that `crowdface plan` wrote to the output folder; make no new plan")
      .needs("--shard");
}

GenerateOptions WriteOptions::generate_options(const std::filesystem::path& cache) const {
  const std::uint64_t bytes = parse_byte_size("--memory", memory_limit);
  if (bytes > 0) limit_image_memory(bytes / 2);
  return {cache,
          force ? Replace::kForce : Replace::kRefuse,
          dry_run,
          bytes,
          parse_shard_option(shard),
          planned ? PlanSource::kFolder : PlanSource::kFolderOrCasting};
}

Shard parse_shard_option(const std::string& text) {
  if (text.empty()) return {};
  const auto given = parse_shard(text);
  if (!given) {
    throw UsageError(
        concat("--shard: expected I/N, such as 2/7, with I from 1 to N and N at most "
               "9999, found ",
               quoted(text)));
  }
  return *given;
}

std::uint64_t parse_byte_size(std::string_view option, const std::string& text) {
  if (text.empty()) return 0;
  const auto given = parse_bytes(text);
  if (!given || *given == 0) {
    throw UsageError(
        concat(option, ": expected a size with its unit, such as \"4 GiB\", found ", quoted(text)));
  }
  return *given;
}

void add_mesh_output(CLI::App& command, std::string& out) {
  add_option(
      command, "-o,--output", out, "FILE",
      concat("The mesh to write; the file extension sets the format: ", list_of_extensions()))
      .required();
}

MeshFormat parse_mesh_output(const std::string& out) {
  if (const auto format = mesh_format_of(out)) return *format;
  throw UsageError(concat("--output: expected a file name that ends in ", list_of_extensions(),
                          ", found ", quoted(out)));
}

void require_obj_output(const std::string& out) {
  if (mesh_format_of(out) == MeshFormat::kObj) return;
  throw UsageError(concat("--output: expected a file name that ends in .obj, found ", quoted(out)));
}

void print(std::string_view text) {
  std::cout << printable(text);
}

void show_page(const std::string& address, Browser browser) {
  print(concat(address, '\n'));
  std::cout.flush();
  if (browser == Browser::kNone) return;
  // NOLINTNEXTLINE(concurrency-mt-unsafe): no code here sets an environment variable
  if (std::getenv("DISPLAY") == nullptr && std::getenv("WAYLAND_DISPLAY") == nullptr) return;
  std::string program = "xdg-open", argument = address;
  char* const arguments[] = {program.data(), argument.data(), nullptr};
  pid_t process = 0;
  ::posix_spawnp(&process, program.c_str(), nullptr, nullptr, arguments, environ);
}

std::uint64_t parse_whole_number(std::string_view option, const std::string& text,
                                 std::uint64_t least, std::uint64_t most) {
  const auto value = parse_unsigned(text);
  if (!value || *value < least || *value > most) {
    throw UsageError(concat(option, ": expected a whole number from ", least, " to ", most,
                            ", found ", quoted(text)));
  }
  return *value;
}

}  // namespace crowdface::cli
