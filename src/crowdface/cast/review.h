// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace crowdface {

/// What a reviewer says about one face.
struct ReviewMark {
  enum class Verdict {
    kKeep,    ///< stays as it is
    kReject,  ///< drawn anew, all of it but what is locked
  };
  std::string id;
  Verdict verdict = Verdict::kKeep;
  /// Parts that stay when the face is drawn anew: bands of regions, region by region. Without bands
  /// they are the regions.
  std::vector<std::size_t> locked;
  std::optional<std::string> note;
};
using Review = std::vector<ReviewMark>;

}  // namespace crowdface
