// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <utility>

namespace crowdface {

/// A map that computes the value of a key when it is first requested, and keeps the value.
/// Thread-safe. No lock is held during the computation, because it may run parallel loops. Two
/// threads may therefore compute the value of the same key; the map keeps the result that is ready
/// first.
template <class Key, class Value>
class LazyMap {
 public:
  /// Returns the value of a key; computes it at the first request.
  /// \param make  returns a std::unique_ptr to the value.
  /// \return     a reference that stays valid as long as this object.
  template <class Make>
  const Value& get(const Key& key, const Make& make) {
    {
      const std::lock_guard lock(mutex_);
      const auto found = values_.find(key);
      if (found != values_.end()) return *found->second;
    }
    std::unique_ptr<const Value> made = make();
    const std::lock_guard lock(mutex_);
    return *values_.try_emplace(key, std::move(made)).first->second;
  }

 private:
  std::mutex mutex_;  ///< guards values_
  std::map<Key, std::unique_ptr<const Value>> values_;
};

}  // namespace crowdface
