// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace crowdface {

/// A scan of a batch and the files that a wrap of it writes.
struct WrappedScan {
  std::filesystem::path scan, report, picture;
};

/// An HTML page over the reports of a batch, to be written into their folder: one row for each
/// scan, with its image and warnings. The most doubtful rows come first: scans without a head, then
/// heads whose worst feature agrees least with the scan.
std::string wrap_page(const std::vector<WrappedScan>& scans);

}  // namespace crowdface
