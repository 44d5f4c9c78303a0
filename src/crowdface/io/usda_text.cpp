// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/usda_text.h"

#include "crowdface/core/parallel.h"
#include "crowdface/core/text.h"
#include "crowdface/core/units.h"
#include "crowdface/io/single_precision.h"

namespace crowdface {
namespace {

constexpr Index kRowsOfText = 8192;

void append_row(std::string& out, const Positions& rows, Index i) {
  char buffer[kMaxUsdaRowLength + kMaxFloatTextLength];
  char* at = buffer;
  if (i > 0) *at++ = ',';
  for (Index c = 0; c < 3; ++c) {
    *at++ = c == 0 ? '(' : ',';
    at = write_single(at, rows(i, c));
  }
  *at++ = ')';
  out.append(buffer, at);
}

}  // namespace

std::string usda_name(std::string_view text) {
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  std::string name;
  if (text.empty() || is_digit(text.front())) name += '_';
  for (const char c : text) {
    const bool is_letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
    name += is_letter || is_digit(c) ? c : '_';
  }
  return name;
}

std::string UsdaNames::add(std::string_view text) {
  const std::string plain = usda_name(text);
  std::string name = plain;
  for (std::size_t number = 2; !used_names_.insert(name).second; ++number) {
    name = concat(plain, '_', number);
  }
  return name;
}

std::string usda_list(std::span<const std::uint32_t> numbers) {
  std::string list = "[";
  for (const std::uint32_t number : numbers) {
    if (list.size() > 1) list += ',';
    list += std::to_string(number);
  }
  return list += ']';
}

std::string usda_list(std::span<const std::string> items) {
  return concat('[', join({items.begin(), items.end()}, ", "), ']');
}

std::string usda_string(std::string_view text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted + '"';
}

std::string usda_rows(const Positions& rows) {
  std::vector<std::string> blocks(
      static_cast<std::size_t>((rows.rows() + kRowsOfText - 1) / kRowsOfText));
  parallel_blocks(rows.rows(), kRowsOfText, [&](Index begin, Index end) {
    std::string& block = blocks[static_cast<std::size_t>(begin / kRowsOfText)];
    for (Index i = begin; i < end; ++i) append_row(block, rows, i);
  });
  return blocks.size() == 1 ? std::move(blocks.front()) : join(blocks, "");
}

std::string usda_uvs(const TextureCoordinates& uvs) {
  std::string text = "[";
  for (Index i = 0; i < uvs.rows(); ++i) {
    char buffer[2 * kMaxFloatTextLength];
    char* at = buffer;
    if (i > 0) *at++ = ',';
    *at++ = '(';
    at = write_single(at, uvs(i, 0));
    *at++ = ',';
    at = write_single(at, uvs(i, 1));
    *at++ = ')';
    text.append(buffer, at);
  }
  return text + ']';
}

std::string usda_layer_metadata(LengthUnit unit, Axis up) {
  constexpr double kMmPerMetre = 1000;
  const bool is_z = up.index == 2 && up.sign > 0;
  return concat("    metersPerUnit = ", mm_per(unit) / kMmPerMetre, "\n    upAxis = \"",
                is_z ? 'Z' : 'Y', "\"\n");
}

}  // namespace crowdface
