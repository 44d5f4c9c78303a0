// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "crowdface/config/config.h"
#include "crowdface/core/parallel.h"
#include "crowdface/render/contact_sheet.h"

namespace crowdface {

/// Writes pages of contact sheets to a folder, in the requested formats. Every 64 pages form a
/// batch with its own index (an image that shows all pages of the batch) and, if requested, its own
/// PDF file, so that the memory in use does not grow with the number of faces.
class SheetWriter {
 public:
  /// \param folder  must exist.
  /// \param title   text above each index image.
  SheetWriter(std::filesystem::path folder, const std::vector<SheetFormat>& formats,
              std::string title);

  /// Adds a page.
  /// \param stem     file name without extension.
  /// \param caption  text under the page in the index.
  void add(const std::string& stem, const std::string& caption, Rgb8Image page);
  /// Writes the index and the PDF file of the last batch. A single page gets no index. \return all
  /// files written.
  std::vector<std::filesystem::path> finish();

 private:
  /// Encodes and writes a page in the background.
  void write_in_background(const std::string& stem, Rgb8Image page);
  /// Waits until all pages added so far are written.
  void wait();
  /// Returns the path of a file in the folder, and adds the path to `written_files_`.
  std::filesystem::path add_file(const std::string& name);
  /// Writes the index of the current batch. \param number  suffix of the file name: "_001" or empty
  void write_index(const std::string& number);
  /// Writes the index and, if requested, the PDF file of the current batch of pages, and begins
  /// the next batch.
  void finish_page_batch(bool is_last);

  std::filesystem::path folder_;
  std::vector<SheetFormat> formats_;
  std::string title_;
  std::size_t finished_batch_count_ = 0;
  std::vector<std::string> pdf_page_pngs_;  ///< pages of the current batch, if a PDF is requested
  std::vector<SheetCell> index_cells_;      ///< one cell for each page of the current batch
  std::vector<std::filesystem::path> written_files_;
  int pages_in_memory_ = 0;
  // Must be the last member: its destructor waits for tasks that use the other members.
  BackgroundTasks tasks_;
};

}  // namespace crowdface
