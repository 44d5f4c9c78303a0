// SPDX-License-Identifier: Apache-2.0
#include "crowdface/core/problems.h"

#include <algorithm>

namespace crowdface {

void Problems::add(ExitCode kind, std::string message) {
  // The same problem met on two paths is told once.
  if (std::ranges::find(messages_, message) != messages_.end()) return;
  messages_.push_back(std::move(message));
  kinds_.push_back(kind);
}

ExitCode Problems::code() const {
  for (const ExitCode first : {ExitCode::kUsage, ExitCode::kMissingInput, ExitCode::kBadData}) {
    if (std::ranges::find(kinds_, first) != kinds_.end()) return first;
  }
  return kinds_.empty() ? ExitCode::kDone : kinds_.front();
}

void Problems::throw_if_any() const {
  if (empty()) return;
  std::string all;
  for (const std::string& message : messages_) {
    if (!all.empty()) all += '\n';
    all += message;
  }
  throw Error(code(), all);
}

}  // namespace crowdface
