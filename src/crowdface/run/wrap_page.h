// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace crowdface {

/// A scan of a batch, and the files that wrapping this scan writes.
struct WrappedScan {
  std::filesystem::path scan_file, report_file, picture_file;
};

/// An HTML page that summarises the reports of a batch; the caller writes the page into the folder
/// of the reports. The page has a row for each scan, with the scan's image and warnings. The most
/// doubtful scans come first: scans without a resulting head, then scans whose worst-fitting face
/// feature agrees least with the wrapped head.
std::string wrap_page(const std::vector<WrappedScan>& scans);

}  // namespace crowdface
