// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

namespace crowdface {

/// Owns a value on the heap. A copy of this object has its own copy of the value, as with
/// `std::indirect` of C++26. A class can have a member of this type before `T` is defined. Then the
/// class must define its constructors, destructor and assignments in a source file. A moved-from
/// object may only be assigned to or destroyed.
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
  std::unique_ptr<T> value_;  ///< the value; null only in a moved-from object
};

}  // namespace crowdface
