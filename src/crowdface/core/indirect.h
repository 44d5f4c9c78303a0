// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

namespace crowdface {

/// A value on the heap that is copied like a member, as `std::indirect` of C++26. `T` may be
/// incomplete where a class has a member of this type, if that class defines its constructors,
/// destructor and assignments in a source file. A moved-from object may only be assigned to or
/// destroyed.
template <class T>
class Indirect {
 public:
  Indirect() : value_(std::make_unique<T>()) {}
  Indirect(const Indirect& other) : value_(std::make_unique<T>(*other)) {}
  Indirect(Indirect&&) noexcept = default;
  Indirect& operator=(const Indirect& other) { return *this = Indirect(other); }
  Indirect& operator=(Indirect&&) noexcept = default;
  ~Indirect() = default;

  T& operator*() { return *value_; }
  const T& operator*() const { return *value_; }
  T* operator->() { return value_.get(); }
  const T* operator->() const { return value_.get(); }

 private:
  std::unique_ptr<T> value_;  ///< null only in a moved-from object
};

}  // namespace crowdface
