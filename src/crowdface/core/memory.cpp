// SPDX-License-Identifier: Apache-2.0
#include "crowdface/core/memory.h"

#include <algorithm>
#include <atomic>
#include <fstream>
#include <new>

#include <sys/resource.h>
#include <unistd.h>

#include "crowdface/core/contains.h"
#include "crowdface/core/text.h"

namespace crowdface {
namespace {

/// The memory limit of one control group, in bytes; nothing if the group has no limit.
std::optional<std::uint64_t> group_limit(const std::filesystem::path& file) {
  std::ifstream stream(file);
  std::string text;
  if (!(stream >> text)) return std::nullopt;
  return parse_unsigned(text);  // "max" is not a number: no limit
}

/// Lowers `least` to the smallest memory limit among a control group and all its parent groups.
/// \param mount  folder of the outermost group.
/// \param file   name of the file in each group's folder that holds the limit.
void lower_to_groups(std::optional<std::uint64_t>& least, const std::filesystem::path& mount,
                     const std::filesystem::path& group, const char* file) {
  std::filesystem::path folder = mount;
  const auto lower = [&] {
    const auto limit = group_limit(folder / file);
    if (limit) least = std::min(least.value_or(*limit), *limit);
  };
  lower();
  for (const std::filesystem::path& part : group.relative_path()) {
    if (part == "..") return;  // outside this control group namespace
    folder /= part;
    lower();
  }
}

std::atomic<bool> ran_out = false;

[[noreturn]] void note_lack_of_memory() {
  ran_out = true;
  throw std::bad_alloc();
}

}  // namespace

std::uint64_t usable_memory_bytes() {
  const std::uint64_t bytes = static_cast<std::uint64_t>(sysconf(_SC_PHYS_PAGES)) *
                              static_cast<std::uint64_t>(sysconf(_SC_PAGE_SIZE));
  return std::min(bytes, control_group_memory_limit_bytes().value_or(bytes));
}

std::optional<std::uint64_t> control_group_memory_limit_bytes(
    const std::filesystem::path& groups_file, const std::filesystem::path& mount_folder) {
  std::optional<std::uint64_t> least;
  const auto lower = [&](const std::string& controllers, const std::string& group) {
    if (controllers.empty()) lower_to_groups(least, mount_folder, group, "memory.max");
    if (contains(split(controllers, ','), "memory")) {
      lower_to_groups(least, mount_folder / "memory", group, "memory.limit_in_bytes");
    }
  };
  lower("", "");  // for systems that do not list the groups
  lower("memory", "");
  std::ifstream lines(groups_file);
  for (std::string line; std::getline(lines, line);) {
    // A line of the file names a control group. With version 1 of control groups, the line is
    // "4:memory:/group". With version 2, it names no controller: "0::/group".
    const std::size_t first = line.find(':'), second = line.find(':', first + 1);
    if (second == line.npos) continue;
    lower(line.substr(first + 1, second - first - 1), line.substr(second + 1));
  }
  return least;
}

void watch_for_out_of_memory() {
  std::set_new_handler(note_lack_of_memory);
}

bool is_out_of_memory() {
  return ran_out;
}

std::uint64_t peak_memory_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;  // Linux reports KiB
}

std::optional<std::uint64_t> parse_bytes(std::string_view text) {
  const std::size_t end = text.find_first_not_of("0123456789.");
  if (end == std::string_view::npos) return std::nullopt;
  const auto number = parse_double(text.substr(0, end));
  std::string_view unit = text.substr(end);
  unit.remove_prefix(std::min(unit.find_first_not_of(' '), unit.size()));
  struct Unit {
    std::string_view name;
    double bytes;
  };
  constexpr Unit kUnits[] = {
      {"KiB", 1024.0}, {"MiB", 1048576.0}, {"GiB", 1073741824.0}, {"TiB", 1099511627776.0},
      {"kB", 1e3},     {"MB", 1e6},        {"GB", 1e9},           {"TB", 1e12}};
  for (const Unit& known : kUnits) {
    if (unit != known.name || !number) continue;
    const double bytes = *number * known.bytes;
    if (bytes < 9e18) return static_cast<std::uint64_t>(bytes);
  }
  return std::nullopt;
}

std::string format_bytes(std::uint64_t bytes) {
  const double value = static_cast<double>(bytes);
  if (value >= 1073741824.0) return concat(format_fixed(value / 1073741824.0, 1), " GiB");
  if (value >= 1048576.0) return concat(format_fixed(value / 1048576.0, 0), " MiB");
  if (value >= 1024.0) return concat(format_fixed(value / 1024.0, 0), " KiB");
  return concat(bytes, " bytes");
}

}  // namespace crowdface
