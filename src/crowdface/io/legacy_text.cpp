// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/legacy_text.h"

#include <iconv.h>

#include "crowdface/core/text.h"

namespace crowdface {
namespace {

/// Converts bytes from `encoding` to UTF-8. Returns an empty text if the bytes are not valid in
/// `encoding`.
std::string converted(std::string_view bytes, const char* encoding) {
  const iconv_t converter = ::iconv_open("UTF-8", encoding);
  // NOLINTNEXTLINE(performance-no-int-to-ptr): iconv_open returns -1 on failure
  if (converter == reinterpret_cast<iconv_t>(-1)) return {};
  constexpr std::size_t kMaxPerByte = 4;
  std::string in(bytes), out(kMaxPerByte * bytes.size(), '\0');
  char *from = in.data(), *to = out.data();
  std::size_t left = in.size(), room = out.size();
  const bool failed = ::iconv(converter, &from, &left, &to, &room) == static_cast<std::size_t>(-1);
  ::iconv_close(converter);
  if (failed) return {};
  out.resize(out.size() - room);
  return out;
}

/// Whether most bytes above 127 are next to another byte above 127. This is the case in Chinese and
/// Japanese text. In text of western languages, most bytes above 127 are between ASCII letters.
bool has_mostly_pairs(std::string_view bytes) {
  std::size_t high = 0, beside = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const auto is_high = [&](std::size_t k) {
      return k < bytes.size() && static_cast<unsigned char>(bytes[k]) > 127;
    };
    if (!is_high(i)) continue;
    ++high;
    if (is_high(i + 1) || (i > 0 && is_high(i - 1))) ++beside;
  }
  return 2 * beside > high;
}

}  // namespace

std::vector<std::string> legacy_decodings(std::string_view bytes) {
  std::vector<std::string> readings;
  constexpr std::size_t kLongest = 4096;
  if (is_utf8(bytes) || bytes.size() > kLongest) return readings;
  for (const char* encoding : {"GB18030", "CP932", "WINDOWS-1252"}) {
    std::string text = converted(bytes, encoding);
    if (!text.empty()) readings.push_back(std::move(text));
  }
  return readings;
}

std::string plain_text(std::string_view bytes) {
  const bool is_utf16 = bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF");
  std::string text = is_utf16
                         ? converted(bytes, "UTF-16")
                         : std::string(bytes.substr(bytes.starts_with("\xEF\xBB\xBF") ? 3 : 0));
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool is_single = i + 1 == text.size() || text[i + 1] != '\n';
    if (text[i] == '\r' && is_single) text[i] = '\n';
  }
  return text;
}

std::string decoded_text(std::string_view bytes) {
  std::string text = plain_text(bytes);
  if (is_utf8(text)) return text;
  constexpr const char* kWestern = "WINDOWS-1252";
  const bool is_eastern = has_mostly_pairs(text);
  for (const char* encoding :
       {is_eastern ? "GB18030" : kWestern, is_eastern ? "CP932" : "GB18030", kWestern}) {
    std::string decoded = converted(text, encoding);
    if (!decoded.empty()) return decoded;
  }
  return converted(text, "ISO-8859-1");
}

}  // namespace crowdface
