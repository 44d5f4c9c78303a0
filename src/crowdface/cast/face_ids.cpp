// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/face_ids.h"

#include "crowdface/cast/family.h"
#include "crowdface/core/text.h"

namespace crowdface {

std::string face_id(const std::string& crowd, std::uint64_t index) {
  return concat(crowd, '_', zero_padded(index, 4));
}

std::string member_id(const std::string& crowd, const std::string& family, int member) {
  return concat(crowd, '_', family, '_', member < 10 ? "0" : "", member);
}

std::string parent_id(const std::string& crowd, const Parent& parent) {
  return concat(crowd, '_', parent.id);
}

}  // namespace crowdface
