// SPDX-License-Identifier: Apache-2.0
#include "crowdface/pictures/sheet_writer.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "crowdface/core/contains.h"
#include "crowdface/core/file.h"
#include "crowdface/core/text.h"
#include "crowdface/io/image.h"
#include "crowdface/io/pdf_pages.h"
#include "crowdface/render/shading.h"

namespace crowdface {
namespace {

// Largest width and height of a page's image in the index, in pixels
constexpr int kIndexWidth = 480, kIndexHeight = 960;
constexpr std::size_t kPagesPerBatch = 64;

std::string to_png(const Rgb8Image& image) {
  return encode_png(image.width, image.height, 3, image.pixels);
}

/// Converts to linear light, as EXR requires.
std::string to_exr(const Rgb8Image& image) {
  const std::array<float, 256>& linear = linear_of_srgb8();
  std::vector<float> pixels(image.pixels.size());
  std::transform(image.pixels.begin(), image.pixels.end(), pixels.begin(),
                 [&](std::uint8_t value) { return linear[value]; });
  return encode_exr(image.width, image.height, 3, pixels);
}

}  // namespace

SheetWriter::SheetWriter(std::filesystem::path folder, const std::vector<SheetFormat>& formats,
                         std::string title)
    : folder_(std::move(folder)), formats_(formats), title_(std::move(title)) {
  // Background tasks hold pointers to the elements, so the elements must not move in memory.
  pdf_page_pngs_.reserve(kPagesPerBatch);
}

std::filesystem::path SheetWriter::add_file(const std::string& name) {
  return written_files_.emplace_back(folder_ / name);
}

void SheetWriter::write_in_background(const std::string& stem, Rgb8Image page) {
  if (pages_in_memory_ == thread_count()) wait();  // limits the number of pages in memory
  ++pages_in_memory_;
  const auto png_file = add_file(stem + ".png");
  std::filesystem::path exr_file;
  if (contains(formats_, SheetFormat::kExr)) exr_file = add_file(stem + ".exr");
  std::string* kept =
      contains(formats_, SheetFormat::kPdf) ? &pdf_page_pngs_.emplace_back() : nullptr;
  tasks_.run([png_file, exr_file, kept, page = std::move(page)] {
    std::string png = to_png(page);
    write_file(png_file, png);
    if (!exr_file.empty()) write_file(exr_file, to_exr(page));
    if (kept != nullptr) *kept = std::move(png);
  });
}

void SheetWriter::wait() {
  tasks_.wait();
  pages_in_memory_ = 0;
}

void SheetWriter::add(const std::string& stem, const std::string& caption, Rgb8Image page) {
  if (index_cells_.size() == kPagesPerBatch) finish_page_batch(false);
  const auto width = static_cast<int>(std::int64_t{kIndexHeight} * page.width / page.height);
  index_cells_.push_back(
      {shrink_picture(page, std::clamp(width, 1, std::min(kIndexWidth, page.width))),
       concat(std::filesystem::path(stem).filename().string(), "\n", caption)});
  write_in_background(stem, std::move(page));
}

void SheetWriter::write_index(const std::string& number) {
  const auto columns = static_cast<int>(
      std::clamp(std::ceil(std::sqrt(static_cast<double>(index_cells_.size()))), 1.0, 8.0));
  const std::size_t before = finished_batch_count_ * kPagesPerBatch;
  const std::string note =
      number.empty() ? concat(index_cells_.size(), " sheets")
                     : concat("sheets ", before + 1, " to ", before + index_cells_.size());
  const Rgb8Image page = sheet_in_columns(
      index_cells_, {.columns = columns, .rows = 0, .title = title_, .legend = {}, .note = note});
  const std::string png = to_png(page);
  write_file(add_file(concat("index", number, ".png")), png);
  wait();
  if (contains(formats_, SheetFormat::kPdf)) pdf_page_pngs_.insert(pdf_page_pngs_.begin(), png);
}

void SheetWriter::finish_page_batch(bool is_last) {
  const bool is_only = is_last && finished_batch_count_ == 0;
  const std::string number =
      is_only ? std::string() : concat('_', zero_padded(finished_batch_count_ + 1, 3));
  if (!is_only || index_cells_.size() > 1) write_index(number);
  wait();
  if (!pdf_page_pngs_.empty()) {
    write_file(add_file(concat("sheets", number, ".pdf")), encode_pdf(pdf_page_pngs_));
  }
  index_cells_.clear();
  pdf_page_pngs_.clear();
  ++finished_batch_count_;
}

std::vector<std::filesystem::path> SheetWriter::finish() {
  finish_page_batch(true);
  return std::move(written_files_);
}

}  // namespace crowdface
