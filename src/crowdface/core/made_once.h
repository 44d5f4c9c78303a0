// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <utility>

namespace crowdface {

/// Values that are made when they are first asked for, by any thread. No lock is held meanwhile, as what
/// makes one may run parallel loops: two threads may make the same one, and the first is kept.
template <class Key, class Value>
class MadeOnce {
 public:
  /// \param make  gives the value; it stays where it is as long as this object.
  template <class Make>
  const Value& get(const Key& key, const Make& make) {
    {
      const std::lock_guard lock(mutex_);
      const auto found = made_.find(key);
      if (found != made_.end()) return *found->second;
    }
    std::unique_ptr<const Value> made = make();
    const std::lock_guard lock(mutex_);
    return *made_.try_emplace(key, std::move(made)).first->second;
  }

 private:
  std::mutex mutex_;
  std::map<Key, std::unique_ptr<const Value>> made_;
};

}  // namespace crowdface
