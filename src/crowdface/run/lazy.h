// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <utility>

namespace crowdface {

/// What takes a while to make, from when it is first asked for.
template <class T>
class Lazy {
 public:
  explicit Lazy(std::function<std::unique_ptr<T>()> make) : make_(std::move(make)) {}

  T& get() {
    if (!made_) made_ = make_();
    return *made_;
  }
  /// Frees it; the next call of get makes it anew.
  void release() { made_.reset(); }

 private:
  std::function<std::unique_ptr<T>()> make_;
  std::unique_ptr<T> made_;
};

}  // namespace crowdface
