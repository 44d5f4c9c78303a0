// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/pdf_pages.h"

#include <algorithm>
#include <cstdint>
#include <vector>

#include "crowdface/core/require.h"
#include "crowdface/core/text.h"
#include "crowdface/io/little_endian.h"

namespace crowdface {
namespace {

constexpr double kPixelsAnInch = 150;
constexpr double kPointsAnInch = 72;
constexpr double kLongestSide = 14400;  // points, PDF 1.4's limit

/// The compressed rows of pixels of a PNG. PDF's Flate filter with PNG predictors decodes them
/// without conversion.
struct PngData {
  std::uint32_t width = 0, height = 0;
  std::string data;
};

PngData unwrap(const std::string& png) {
  constexpr std::size_t kSignature = 8, kChunkFrame = 12, kHeader = 13;
  const auto check = [](bool sound) {
    require(sound, "a PDF's page needs a whole PNG of 8-bit RGB");
  };
  PngData picture;
  for (std::size_t at = kSignature; at + kChunkFrame <= png.size();) {
    const std::size_t length = big_endian_at(png.data() + at);
    check(length <= png.size() - at - kChunkFrame);
    const std::string_view kind(png.data() + at + 4, 4);
    const std::size_t content = at + 8;
    if (kind == "IHDR" && length == kHeader) {
      picture.width = big_endian_at(png.data() + content);
      picture.height = big_endian_at(png.data() + content + 4);
      // Require eight bits per value, RGB, and no interlacing.
      check(png[content + 8] == 8 && png[content + 9] == 2 && png[content + 12] == 0);
    } else if (kind == "IDAT") {
      picture.data.append(png, content, length);
    }
    at = content + length + 4;
  }
  check(picture.width != 0 && picture.height != 0 && !picture.data.empty());
  return picture;
}

/// Writes the numbered objects of a PDF file and the table of the objects' offsets.
class PdfWriter {
 public:
  void object(const std::string& content) {
    starts_.push_back(text_.size());
    text_ += concat(starts_.size(), " 0 obj\n", content, "\nendobj\n");
  }
  void stream(const std::string& dictionary, const std::string& data) {
    object(
        concat("<< ", dictionary, " /Length ", data.size(), " >>\nstream\n", data, "\nendstream"));
  }
  std::string finish() {
    const std::size_t table = text_.size();
    text_ += concat("xref\n0 ", starts_.size() + 1, "\n0000000000 65535 f \n");
    for (const std::size_t start : starts_) {
      text_ += concat(zero_padded(start, 10), " 00000 n \n");
    }
    text_ += concat("trailer\n<< /Size ", starts_.size() + 1, " /Root 1 0 R >>\nstartxref\n", table,
                    "\n%%EOF\n");
    return std::move(text_);
  }

 private:
  std::string text_ = "%PDF-1.4\n%\xE2\xE3\xCF\xD3\n";
  std::vector<std::size_t> starts_;
};

void add_page(const PngData& picture, std::size_t first_object, PdfWriter& pdf) {
  const double scale = kPointsAnInch / kPixelsAnInch;
  const double longest = scale * std::max(picture.width, picture.height);
  const double shrink = std::min(1.0, kLongestSide / longest);
  const std::string width = format_fixed(scale * shrink * picture.width, 3);
  const std::string height = format_fixed(scale * shrink * picture.height, 3);
  pdf.object(concat("<< /Type /Page /Parent 2 0 R /MediaBox [0 0 ", width, ' ', height,
                    "] /Resources << /XObject << /Picture ", first_object + 2,
                    " 0 R >> >> /Contents ", first_object + 1, " 0 R >>"));
  pdf.stream("", concat("q ", width, " 0 0 ", height, " 0 0 cm /Picture Do Q"));
  pdf.stream(concat("/Type /XObject /Subtype /Image /Width ", picture.width, " /Height ",
                    picture.height, " /ColorSpace /DeviceRGB /BitsPerComponent 8 ",
                    "/Filter /FlateDecode /DecodeParms << /Predictor 15 /Colors 3 ",
                    "/BitsPerComponent 8 /Columns ", picture.width, " >>"),
             picture.data);
}

}  // namespace

std::string encode_pdf(std::span<const std::string> pngs) {
  require(!pngs.empty(), "a PDF without a page");
  constexpr std::size_t kFirst = 3, kObjectsPerPage = 3;
  PdfWriter pdf;
  pdf.object("<< /Type /Catalog /Pages 2 0 R >>");
  std::string pages;
  for (std::size_t p = 0; p < pngs.size(); ++p) {
    pages += concat(p > 0 ? " " : "", kFirst + kObjectsPerPage * p, " 0 R");
  }
  pdf.object(concat("<< /Type /Pages /Kids [", pages, "] /Count ", pngs.size(), " >>"));
  for (std::size_t p = 0; p < pngs.size(); ++p) {
    add_page(unwrap(pngs[p]), kFirst + kObjectsPerPage * p, pdf);
  }
  return pdf.finish();
}

}  // namespace crowdface
