// SPDX-License-Identifier: Apache-2.0
#include "cli/common_options.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "crowdface/core/error.h"
#include "crowdface/core/input_limits.h"
#include "crowdface/core/log.h"
#include "crowdface/core/memory.h"
#include "crowdface/core/output_file.h"
#include "crowdface/core/text.h"
#include "crowdface/heads/head_cache.h"

namespace crowdface::cli {
namespace {

/// Adds an option whose value is kept only if it was given.
void add_optional(CLI::App& command, const std::string& name, std::optional<std::string>& value,
                  const std::string& help, const std::string& type) {
  command
      .add_option_function<std::string>(
          name, [&value](const std::string& text) { value = text; }, help)
      ->type_name(type);
}

/// Lines of a log begin with the date, 2026-11-22T: whatever does not is no log.
bool begins_like_a_log(const std::string& path) {
  constexpr std::string_view kForm = "dddd-dd-ddT";
  std::ifstream stream(path);
  if (stream.peek() == std::ifstream::traits_type::eof()) return true;
  return std::all_of(kForm.begin(), kForm.end(), [&](char form) {
    const int found = stream.get();
    return form == 'd' ? found >= '0' && found <= '9' : found == form;
  });
}

void open_log(const std::string& path) {
  const std::filesystem::path file = output_file(path);
  std::error_code ignored;
  if (std::filesystem::exists(file, ignored) && !begins_like_a_log(file)) {
    throw CannotCreate(
        concat(path, ": --log-file: expected a log, or no file yet, found another file"));
  }
  add_log_file(file);
}

}  // namespace

void CommonOptions::add_to(CLI::App& command) {
  command.add_option("--threads", threads, "Threads to use (default: all the machine has)")
      ->type_name("N");
  auto* quiet_flag = command.add_flag("-q,--quiet", quiet, "Only warnings and errors");
  command.add_flag("-v,--verbose", verbose, "More about what happens")->excludes(quiet_flag);
  command.add_option("--log-file", log_file, "Also write everything to this file")
      ->type_name("FILE");
  command
      .add_option("--limit", limits,
                  "How large inputs may be; may be repeated: " + describe_input_limits())
      ->type_name("NAME=NUMBER")
      ->expected(1)
      ->take_all();
}

std::unique_ptr<ThreadLimit> CommonOptions::apply() const {
  constexpr std::uint64_t kMostThreads = 1024;
  set_log_level(quiet ? LogLevel::kQuiet : verbose ? LogLevel::kVerbose : LogLevel::kNormal);
  if (!log_file.empty()) open_log(log_file);
  limit_image_memory(machine_memory() / 8 * 3);
  for (const std::string& limit : limits) set_input_limit(limit);
  const std::uint64_t limit =
      threads.empty() ? 0 : whole_number("--threads", threads, 1, kMostThreads);
  return std::make_unique<ThreadLimit>(static_cast<int>(limit));
}

void ConfigOptions::add_to(CLI::App& command) {
  command.add_option("config", config, "The config file (docs/config.md)")
      ->required()
      ->type_name("CONFIG");
  command
      .add_option_function<std::vector<std::string>>(
          "--set",
          [this](const std::vector<std::string>& values) {
            overrides.set.insert(overrides.set.end(), values.begin(), values.end());
          },
          "Override one config value, such as smoothing.boundary=free; may be repeated")
      ->type_name("KEY.PATH=VALUE")
      ->expected(1)
      ->take_all()
      ->trigger_on_parse();
  add_optional(command, "--seed", overrides.seed, "Override crowd.seed", "N");
  add_optional(command, "--count", overrides.count, "Override crowd.count", "N");
  add_optional(command, "--out", overrides.out, "Override output.directory", "DIR");
  command.add_option("--cache", cache, "Folder of prepared heads")->type_name("DIR");
}

void ConfigOptions::add_review_to(CLI::App& command) {
  command
      .add_option_function<std::vector<std::string>>(
          "--review",
          [this](const std::vector<std::string>& files) {
            overrides.review.insert(overrides.review.end(), files.begin(), files.end());
          },
          "Draw the faces anew that this review rejects; may be repeated, in order")
      ->type_name("FILE")
      ->expected(1)
      ->take_all()
      ->trigger_on_parse();
}

std::filesystem::path ConfigOptions::cache_path() const {
  return cache.empty() ? cache_directory() : std::filesystem::path(cache);
}

void WriteOptions::add_to(CLI::App& command) {
  command.add_flag("--force", force, "Replace another config's crowd in the output folder");
  command.add_flag("--dry-run", dry_run,
                   "Check everything, say what would be written, write nothing");
  command
      .add_option("--memory", memory,
                  "How much the run may take, such as \"4 GiB\" (default: three quarters of what "
                  "there is): sets how many faces are in flight; images take at most half of it")
      ->type_name("SIZE");
}

void WriteOptions::add_shard_to(CLI::App& command) {
  command
      .add_option("--shard", shard,
                  "Only part I of N of the faces; `crowdface gather` puts the parts together")
      ->type_name("I/N");
}

GenerateOptions WriteOptions::with_cache(const std::filesystem::path& cache) const {
  std::uint64_t bytes = 0;
  if (!memory.empty()) {
    const auto given = parse_bytes(memory);
    if (!given || *given == 0) {
      throw UsageError(concat("--memory: expected a size with its unit, such as \"4 GiB\", found ",
                              quoted(memory)));
    }
    bytes = *given;
    limit_image_memory(bytes / 2);
  }
  Shard part;
  if (!shard.empty()) {
    const auto given = parse_shard(shard);
    if (!given) {
      throw UsageError(
          concat("--shard: expected I/N, such as 2/7, with I from 1 to N and N at most "
                 "9999, found ",
                 quoted(shard)));
    }
    part = *given;
  }
  return {cache, force ? Replace::kForce : Replace::kRefuse, dry_run, bytes, part};
}

std::uint64_t whole_number(std::string_view option, const std::string& text, std::uint64_t least,
                           std::uint64_t most) {
  const auto value = parse_unsigned(text);
  if (!value || *value < least || *value > most) {
    throw UsageError(concat(option, ": expected a whole number from ", least, " to ", most,
                            ", found ", quoted(text)));
  }
  return *value;
}

}  // namespace crowdface::cli
