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

/// A mesh as the page shows it, made when it is first asked for.
struct ShownMesh {
  std::once_flag once;
  std::string bytes;
};

/// One scan that is open on the page.
struct OpenScan {
  explicit OpenScan(PickInputs inputs) : session(std::move(inputs)) {}
  PickSession session;
  ShownMesh of_template, of_scan;
};

/// The scans that landmarks are picked on, one after the other. Any thread may ask.
class PickScans {
 public:
  struct Entry {
    std::filesystem::path scan, landmarks;
  };
  /// \param read  reads the scan of an entry.
  /// Opens the first that has no file of landmarks, or the first. \throws Error
  PickScans(std::vector<Entry> entries, std::function<PickInputs(const Entry&)> read);

  std::shared_ptr<OpenScan> current() const;
  std::size_t number() const;
  const std::vector<Entry>& entries() const { return entries_; }
  bool is_picked(std::size_t number) const;
  /// \throws Error; the one before stays open then.
  void open(std::size_t number);

 private:
  std::vector<Entry> entries_;
  std::function<PickInputs(const Entry&)> read_;
  mutable std::mutex mutex_;  ///< of what follows
  std::shared_ptr<OpenScan> current_;
  std::size_t number_ = 0;
};

}  // namespace crowdface
