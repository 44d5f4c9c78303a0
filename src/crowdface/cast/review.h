// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
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

/// The marks of one reviewer.
struct Review {
  /// Number of sampled faces of the crowd that was reviewed. The review applies to this crowd;
  /// faces with larger numbers are cast later, so that a larger crowd changes none of its faces.
  /// Empty: the whole crowd.
  std::optional<std::uint64_t> count;
  std::vector<ReviewMark> marks;
};

}  // namespace crowdface
