// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <utility>

namespace crowdface {

/// A value that the first call of `get` makes, because making it is expensive. Not thread-safe.
template <class T>
class Lazy {
 public:
  explicit Lazy(std::function<std::unique_ptr<T>()> make) : make_(std::move(make)) {}

  /// Returns the value, and makes it if there is none.
  T& get() {
    if (!value_) value_ = make_();
    return *value_;
  }
  /// Frees the value; the next call of `get` makes it again.
  void release() { value_.reset(); }

 private:
  std::function<std::unique_ptr<T>()> make_;
  std::unique_ptr<T> value_;
};

}  // namespace crowdface
