// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include <nlohmann/json.hpp>

#include "crowdface/core/append_file.h"
#include "crowdface/core/hash.h"

namespace crowdface {

/// Strokes of a brush that no mask holds yet, a line of JSON each, so that they outlive the editor.
class StrokeLog {
 public:
  /// Reads what an editor left behind that painted on the same; what is cut short at the end is left out.
  /// \param painted_on  tells masks and preview apart: strokes on others are forgotten, which is said.
  StrokeLog(std::filesystem::path file, const Digest& painted_on);

  /// In their order, as `add` was given them.
  const std::vector<nlohmann::ordered_json>& strokes() const { return strokes_; }
  const std::filesystem::path& file() const { return file_; }
  /// \throws CannotCreate, IoError: then the file does not hold it.
  void add(const nlohmann::ordered_json& stroke);
  /// The masks hold them.
  void clear();

 private:
  std::filesystem::path file_;
  Digest painted_on_;
  std::vector<nlohmann::ordered_json> strokes_;
  std::unique_ptr<AppendFile> open_;  ///< from the first `add` on
};

}  // namespace crowdface
