// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

namespace crowdface {

/// Where a piece of a config stands: in a file, or (line 0) on the command line.
struct YamlPlace {
  std::shared_ptr<const std::string> source;  ///< file name, or the option as it was given
  int line = 0;                               ///< from 1
  int column = 0;                             ///< from 1, counted in characters, not bytes
  /// "file:line:column", or the option.
  std::string text() const;
};

}  // namespace crowdface
