// SPDX-License-Identifier: Apache-2.0
#pragma once

#ifdef __SANITIZE_THREAD__
#include <sanitizer/tsan_interface.h>
#endif

namespace crowdface {

/// Where threads of a library leave work that others of its threads take up. Debian's TBB and Embree
/// are built without ThreadSanitizer, which has to be told of it; other builds do nothing here.
class HandOver {
 public:
#ifdef __SANITIZE_THREAD__
  void give() {
    __tsan_release(&at_);
  }
  void take() {
    __tsan_acquire(&at_);
  }

 private:
  char at_ = 0;
#else
  void give() {}
  void take() {}
#endif
};

}  // namespace crowdface
