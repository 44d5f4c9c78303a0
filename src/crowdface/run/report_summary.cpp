// SPDX-License-Identifier: Apache-2.0
#include "crowdface/run/report_summary.h"

#include "crowdface/core/file.h"
#include "crowdface/core/text.h"
#include "crowdface/io/shallow_json.h"

namespace crowdface {

nlohmann::ordered_json read_report_summary(const std::filesystem::path& file) {
  const MappedFile report(file);
  const std::string_view whole = report.bytes();
  return parse_shallow_json(concat(whole.substr(0, whole.find(kBeforeFaces)), "\n}"));
}

}  // namespace crowdface
