// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string_view>

#include <nlohmann/json.hpp>

namespace crowdface {

/// What stands in a report between its summary and its faces, which may be a million.
inline constexpr std::string_view kBeforeFaces = ",\n  \"faces\": [";

/// A report.json without its faces.
/// \return what `is_discarded()` if it is no report of ours.
nlohmann::ordered_json read_report_summary(const std::filesystem::path& file);

}  // namespace crowdface
