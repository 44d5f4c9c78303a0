// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace crowdface::cli {

/// What is known of a head that was made, for the config's `faces.tags`.
struct TaggedHead {
  std::string name;
  bool male = false;
  double years = 0;
  std::string more = {};  ///< a further tag, or none
};

/// "young" below 35 years, "old" from 55 on, "adult" between.
std::string_view age_class(double years);

/// The section `faces` with nothing but the heads' tags, [female, old], and the years as comments.
/// \param about  a line on what heads they are, without "# ".
std::string format_tags(const std::vector<TaggedHead>& heads, std::string_view about);

/// "synth_01": at least two digits.
std::string head_name(std::string_view kind, std::uint64_t index);

}  // namespace crowdface::cli
