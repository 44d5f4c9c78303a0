// SPDX-License-Identifier: Apache-2.0
#include "crowdface/core/input_limits.h"

#include <algorithm>

#include "crowdface/core/error.h"
#include "crowdface/core/text.h"

namespace crowdface {
namespace {

struct Named {
  std::string_view name;
  std::uint64_t InputLimits::*limit;
  std::uint64_t most = 1ULL << 31U;
};
constexpr Named kNamed[] = {{"vertices", &InputLimits::vertices},
                            {"faces", &InputLimits::faces},
                            {"image_pixels", &InputLimits::image_pixels},
                            {"image_bytes", &InputLimits::image_bytes, 1ULL << 50U},
                            {"textures", &InputLimits::textures},
                            {"yaml_bytes", &InputLimits::yaml_bytes},
                            {"yaml_depth", &InputLimits::yaml_depth}};

InputLimits in_force;

}  // namespace

const InputLimits& input_limits() {
  return in_force;
}

void set_input_limit(std::string_view assignment) {
  const std::size_t equals = assignment.find('=');
  const std::string_view name = assignment.substr(0, equals);
  for (const Named& known : kNamed) {
    if (known.name != name || equals == assignment.npos) continue;
    const auto number = parse_unsigned(assignment.substr(equals + 1));
    if (!number || *number < 1 || *number > known.most) {
      throw UsageError(concat("--limit ", name, ": expected a whole number from 1 to ", known.most,
                              ", found ", quoted(assignment)));
    }
    in_force.*known.limit = *number;
    return;
  }
  throw UsageError(concat("--limit: expected NAME=NUMBER with one of the names ",
                          describe_input_limits(), ", found ", quoted(assignment)));
}

void limit_image_memory(std::uint64_t bytes) {
  in_force.image_bytes = std::min(in_force.image_bytes, bytes);
}

std::string describe_input_limits() {
  std::vector<std::string> words;
  for (const Named& known : kNamed) {
    words.push_back(concat(known.name, " (", InputLimits{}.*known.limit, ')'));
  }
  return join(words);
}

}  // namespace crowdface
