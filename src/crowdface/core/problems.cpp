// SPDX-License-Identifier: Apache-2.0
#include "crowdface/core/problems.h"

#include <utility>

#include "crowdface/core/contains.h"
#include "crowdface/core/text.h"

namespace crowdface {

void Problems::add(ExitCode code, std::string message) {
  // Two checks may find the same error.
  if (contains(messages_, message)) return;
  messages_.push_back(std::move(message));
  codes_.push_back(code);
}

ExitCode Problems::code() const {
  for (const ExitCode first : {ExitCode::kUsage, ExitCode::kMissingInput, ExitCode::kBadData}) {
    if (contains(codes_, first)) return first;
  }
  return codes_.empty() ? ExitCode::kDone : codes_.front();
}

void Problems::throw_if_any() const {
  if (!empty()) throw RecoverableError(code(), join(messages_, "\n"));
}

}  // namespace crowdface
