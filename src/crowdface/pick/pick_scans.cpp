// SPDX-License-Identifier: Apache-2.0
#include "crowdface/pick/pick_scans.h"

#include <utility>

#include "crowdface/core/file.h"

namespace crowdface {

PickableScans::PickableScans(std::vector<Entry> entries,
                             std::function<PickInputs(const Entry&)> read_inputs)
    : entries_(std::move(entries)), read_inputs_(std::move(read_inputs)) {
  std::size_t first = 0;
  while (first < entries_.size() && is_picked(first)) ++first;
  open(first < entries_.size() ? first : 0);
}

std::shared_ptr<OpenScan> PickableScans::current() const {
  const std::lock_guard lock(mutex_);
  return current_;
}

std::size_t PickableScans::current_index() const {
  const std::lock_guard lock(mutex_);
  return current_index_;
}

bool PickableScans::is_picked(std::size_t index) const {
  return path_exists(entries_[index].landmark_file);
}

void PickableScans::open(std::size_t index) {
  PickInputs inputs = read_inputs_(entries_[index]);
  const std::lock_guard lock(mutex_);
  // Use the template landmarks that were picked with the previous scan.
  if (inputs.template_landmark_file.empty() && current_ && is_picked(current_index_)) {
    inputs.template_landmark_file = entries_[current_index_].landmark_file;
  }
  current_ = std::make_shared<OpenScan>(std::move(inputs));
  current_index_ = index;
}

}  // namespace crowdface
