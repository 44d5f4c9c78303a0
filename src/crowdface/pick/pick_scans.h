// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "crowdface/pick/pick_session.h"

namespace crowdface {

/// A reduced mesh for the page; encoded at the first request.
struct ShownMesh {
  std::once_flag once;  ///< set by the first request, which computes `bytes`
  std::string bytes;    ///< the reduced mesh; see PickableMesh::encode_reduced
};

/// The scan that is open on the page, its session, and the meshes that the page shows.
struct OpenScan {
  explicit OpenScan(PickInputs inputs) : session(std::move(inputs)) {}
  PickSession session;
  ShownMesh shown_template, shown_scan;
};

/// The list of scans on which landmarks are picked, one at a time. Thread-safe.
class PickableScans {
 public:
  /// A scan, and the file in which its landmarks are stored.
  struct Entry {
    std::filesystem::path scan_file, landmark_file;
  };
  /// Opens the first scan without a landmark file, or the first scan if all scans have landmark
  /// files.
  /// \param read_inputs  reads the scan of an entry. \throws Error
  PickableScans(std::vector<Entry> entries, std::function<PickInputs(const Entry&)> read_inputs);

  /// The open scan.
  std::shared_ptr<OpenScan> current() const;
  /// Index of the open scan in entries().
  std::size_t current_index() const;
  const std::vector<Entry>& entries() const { return entries_; }
  /// Whether the landmark file of an entry exists.
  bool is_picked(std::size_t index) const;
  /// Opens a scan. \throws Error; the previous scan then stays open.
  void open(std::size_t index);

 private:
  std::vector<Entry> entries_;
  std::function<PickInputs(const Entry&)> read_inputs_;
  /// Guards the members below.
  mutable std::mutex mutex_;
  std::shared_ptr<OpenScan> current_;  ///< the scan that is open; see current()
  std::size_t current_index_ = 0;
};

}  // namespace crowdface
