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
    kReject,  ///< redrawn, except for what is locked
  };
  std::string id;
  Verdict verdict = Verdict::kKeep;
  /// Parts that stay when the face is redrawn: region · #bands + band. Without bands, parts are
  /// regions.
  std::vector<std::size_t> locked;
  std::optional<std::string> note;
};
using Review = std::vector<ReviewMark>;

}  // namespace crowdface
