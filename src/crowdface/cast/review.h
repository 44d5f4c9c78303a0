// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace crowdface {

/// A reviewer's verdict on one face.
struct ReviewMark {
  enum class Verdict {
    kKeep,    ///< stays as it is
    kReject,  ///< redrawn, except for the locked parts
  };
  std::string id;
  Verdict verdict = Verdict::kKeep;
  /// Parts that do not change when the face is redrawn: region · #bands + band. Without bands, a
  /// part is a region.
  std::vector<std::size_t> locked;
  std::optional<std::string> note;
};
using Review = std::vector<ReviewMark>;

}  // namespace crowdface
