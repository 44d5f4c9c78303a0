// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "crowdface/config/config.h"
#include "crowdface/core/parallel.h"
#include "crowdface/render/contact_sheet.h"

namespace crowdface {

/// Writes pages of contact sheets into one folder, in the formats asked for. Every 64 pages have an
/// index and, if asked for, a PDF of their own, so that memory does not grow with the crowd.
class SheetWriter {
 public:
  /// \param folder  must be there. \param title  of each index.
  SheetWriter(std::filesystem::path folder, const std::vector<SheetFormat>& formats,
              std::string title);

  /// \param stem     the file's name without ending. \param caption  under its picture in the index.
  void add(const std::string& stem, const std::string& caption, Rgb8Image page);
  /// Writes the index, if there are several pages, and the PDF. \return all files written.
  std::vector<std::filesystem::path> finish();

 private:
  /// Packs and writes a page beside what the caller does next.
  void write_beside(const std::string& stem, Rgb8Image page);
  void wait();
  std::filesystem::path add_file(const std::string& name);
  void write_index(const std::string& number);
  void finish_volume(bool is_last);

  std::filesystem::path folder_;
  std::vector<SheetFormat> formats_;
  std::string title_;
  std::size_t volumes_ = 0;        ///< finished
  std::vector<std::string> pngs_;  ///< of this volume's pages, if there is to be a PDF
  std::vector<SheetCell> index_;   ///< of this volume
  std::vector<std::filesystem::path> written_;
  int pages_beside_ = 0;
  BackgroundTasks beside_;  // after what it uses, so that it ends first
};

}  // namespace crowdface
