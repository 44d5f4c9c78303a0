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

/// Returns an HTML page that summarises the reports of a batch. The caller writes the page into the
/// folder of the reports. The page has a section for each scan, with the scan's image and warnings.
/// Scans without a resulting head come first. The other scans are sorted by the agreement between
/// scan and head at the face feature that agrees least; the smallest agreement comes first.
std::string wrap_page(const std::vector<WrappedScan>& scans);

}  // namespace crowdface
