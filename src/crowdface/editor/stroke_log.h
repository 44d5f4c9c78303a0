// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include <nlohmann/json.hpp>

#include "crowdface/core/append_file.h"
#include "crowdface/core/hash.h"

namespace crowdface {

/// Stores brush strokes and undo steps in a file, one line of JSON for each, until the painted
/// masks are saved. The strokes therefore survive the end of the editor.
class StrokeLog {
 public:
  /// Reads the strokes that an earlier session of the editor stored in `file`. Ignores an
  /// incomplete last line.
  /// \param preview_digest  hash of the masks and of the preview mesh that the new session paints
  ///                        on. If the stored strokes were painted on other masks, they are
  ///                        discarded with a log message.
  StrokeLog(std::filesystem::path file, const Digest& preview_digest);

  /// All stored strokes and undo steps, oldest first.
  const std::vector<nlohmann::ordered_json>& strokes() const { return strokes_; }
  const std::filesystem::path& file() const { return file_; }
  /// Appends a stroke or an undo step.
  /// \throws CannotCreate, IoError: in this case the file does not contain the stroke.
  void add(const nlohmann::ordered_json& stroke);
  /// Removes all strokes. Call this function after the saved masks contain the effect of the
  /// strokes.
  void clear();

 private:
  std::filesystem::path file_;
  /// hash of the masks and of the preview on which the strokes are painted
  Digest preview_digest_;
  std::vector<nlohmann::ordered_json> strokes_;
  /// appends to `file_`; null until the next call of `add`
  std::unique_ptr<AppendFile> append_file_;
};

}  // namespace crowdface
