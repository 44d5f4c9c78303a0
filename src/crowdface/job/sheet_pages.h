// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "crowdface/job/config.h"
#include "crowdface/render/contact_sheet.h"

namespace crowdface {

/// Writes pages of contact sheets into one folder, in the formats asked for.
class SheetPages {
 public:
  /// \param folder  must be there; pages of an earlier run that are not written again are removed by
  ///                `finish`.
  SheetPages(std::filesystem::path folder, const std::vector<SheetFormat>& formats);

  /// \param stem     the file's name without ending. \param caption  under its picture in the index.
  void add(const std::string& stem, const std::string& caption, const Rgb8Image& page);
  /// Writes the index, if there are several pages, and the PDF that holds them all.
  void finish(const std::string& title);

 private:
  bool has(SheetFormat format) const;
  void write(const std::string& name, const std::string& bytes);
  void write_index(const std::string& title);

  std::filesystem::path folder_;
  std::vector<SheetFormat> formats_;
  std::vector<std::string> pngs_;  ///< of all pages, if there is to be a PDF
  std::vector<SheetCell> index_;
  std::vector<std::string> written_;
};

}  // namespace crowdface
