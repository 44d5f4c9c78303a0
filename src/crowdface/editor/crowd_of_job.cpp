// SPDX-License-Identifier: Apache-2.0
#include "crowdface/editor/crowd_of_job.h"

#include <system_error>

#include "crowdface/core/log.h"
#include "crowdface/core/text.h"

namespace crowdface {

std::optional<std::vector<CastFace>> crowd_of_job(const Job& job) {
  const CrowdDirectory directory = directory_of(job.config);
  std::error_code ignored;
  if (!std::filesystem::exists(directory.plan(), ignored)) return std::nullopt;
  const auto refuse = [&](std::string_view why) {
    log_warning(concat(directory.root.string(), ": its faces are not shown: ", why));
    return std::nullopt;
  };
  try {
    std::vector<CastFace> faces;
    for (PlanLine& line : read_plan(directory.plan(), job.names)) {
      if (line.settings != job.settings.hex()) {
        return refuse("they were cast under other settings");
      }
      faces.push_back(std::move(line.face));
    }
    return faces;
  } catch (const Error& error) {
    return refuse(error.what());
  }
}

}  // namespace crowdface
