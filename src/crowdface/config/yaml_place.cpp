// SPDX-License-Identifier: Apache-2.0
#include "crowdface/config/yaml_place.h"

#include "crowdface/core/text.h"

namespace crowdface {

std::string YamlPlace::text() const {
  return line == 0 ? *source : concat(*source, ':', line, ':', column);
}

}  // namespace crowdface
