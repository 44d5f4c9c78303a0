// SPDX-License-Identifier: Apache-2.0
#include "crowdface/pick/pick_scans.h"

#include <utility>

#include "crowdface/core/file.h"

namespace crowdface {

PickScans::PickScans(std::vector<Entry> entries, std::function<PickInputs(const Entry&)> read)
    : entries_(std::move(entries)), read_(std::move(read)) {
  std::size_t first = 0;
  while (first < entries_.size() && is_picked(first)) ++first;
  open(first < entries_.size() ? first : 0);
}

std::shared_ptr<OpenScan> PickScans::current() const {
  const std::lock_guard lock(mutex_);
  return current_;
}

std::size_t PickScans::number() const {
  const std::lock_guard lock(mutex_);
  return number_;
}

bool PickScans::is_picked(std::size_t number) const {
  return path_exists(entries_[number].landmarks);
}

void PickScans::open(std::size_t number) {
  PickInputs inputs = read_(entries_[number]);
  const std::lock_guard lock(mutex_);
  // Use the template landmarks that were picked with the previous scan.
  if (inputs.template_landmarks.empty() && current_ && is_picked(number_)) {
    inputs.template_landmarks = entries_[number_].landmarks;
  }
  current_ = std::make_shared<OpenScan>(std::move(inputs));
  number_ = number;
}

}  // namespace crowdface
