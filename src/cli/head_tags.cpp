// SPDX-License-Identifier: Apache-2.0
#include "cli/head_tags.h"

#include "crowdface/core/text.h"

namespace crowdface::cli {
namespace {

constexpr double kAdultFrom = 35, kOldFrom = 55;

}  // namespace

std::string_view age_class(double years) {
  if (years >= kOldFrom) return "old";
  return years >= kAdultFrom ? "adult" : "young";
}

std::string format_tags(const std::vector<TaggedHead>& heads, std::string_view about) {
  std::string out = concat("# ", about, ". For the config's section faces.\n# young: under ",
                           kAdultFrom, " years; old: from ", kOldFrom, " on; adult: between.\n",
                           "faces:\n  tags:", heads.empty() ? " {}\n" : "\n");
  for (const TaggedHead& head : heads) {
    out += concat("    ", head.name, ": [", head.male ? "male" : "female", ", ",
                  age_class(head.years), head.more.empty() ? "" : ", ", head.more, "]  # ",
                  format_fixed(head.years, 0), " years\n");
  }
  return out;
}

std::string head_name(std::string_view kind, std::uint64_t index) {
  return concat(kind, "_", zero_padded(index, 2));
}

}  // namespace crowdface::cli
