// SPDX-License-Identifier: Apache-2.0
#include "crowdface/config/starter_config.h"

#include "crowdface/config/config_keys.h"

namespace crowdface {

std::string starter_config(const StarterFacts& facts) {
  std::string text =
      "# A first crowd. Run it with: crowdface generate THIS_FILE\n"
      "# Every key, with its range and default, is explained in docs/config.md.";
  for (const Key<Config>& key : root_keys()) {
    const auto lines = key.starter ? key.starter(facts) : std::nullopt;
    if (lines) text += concat(starter_lines(key.name, *lines), '\n');
  }
  return text;
}

}  // namespace crowdface
