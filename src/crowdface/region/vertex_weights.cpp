// SPDX-License-Identifier: Apache-2.0
#include "crowdface/region/vertex_weights.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/text.h"
#include "crowdface/io/legacy_text.h"
#include "crowdface/region/mask_source.h"

namespace crowdface {
namespace {

/// Removes the first column if the column numbers the rows, from 0 or 1, and has no name. pandas
/// and R write such a column.
void remove_row_numbers(VertexWeights& weights) {
  NpyArray& rows = weights.rows;
  const std::size_t width = rows.width();
  if (weights.names.empty() || weights.names.size() + 1 != width || rows.values.empty()) return;
  std::vector<double> others;
  for (std::size_t i = 0; i < rows.values.size(); ++i) {
    const std::size_t row = i / width;
    if (i % width > 0) {
      others.push_back(rows.values[i]);
    } else if (rows.values[i] != rows.values[0] + static_cast<double>(row)) {
      return;
    }
  }
  if (rows.values[0] != 0 && rows.values[0] != 1) return;
  rows.values = std::move(others);
  rows.shape[1] = width - 1;
}

VertexWeights read_rows(const std::filesystem::path& path) {
  VertexWeights weights;
  NpyArray& rows = weights.rows;
  std::size_t line_number = 0, count = 0, width = 0;
  const MappedFile file(path);
  const std::string content = plain_text(file.bytes());
  for (const std::string_view line : split_lines(content)) {
    ++line_number;
    std::string text(line.substr(0, line.find('#')));
    // If there are semicolons, read commas as decimal points: spreadsheets that write decimal
    // commas separate columns by semicolons.
    if (text.find(';') != text.npos) std::ranges::replace(text, ',', '.');
    std::ranges::replace_if(
        text, [](char c) { return c == ',' || c == ';' || c == '"'; }, ' ');
    const std::vector<std::string> words = words_of(text);
    if (words.empty()) continue;
    if (count == 0 && weights.names.empty() && !parse_double(words[0])) {
      weights.names = words;
      continue;
    }
    if (count == 0) width = words.size();
    const auto fail = [&](const std::string& what) {
      throw InvalidInput(concat(path.string(), ':', line_number, ": ", what));
    };
    if (words.size() != width) fail(concat("expected ", width, " numbers, found ", words.size()));
    for (const std::string& word : words) {
      const auto number = parse_double(word);
      if (!number) fail(concat("expected a number, found ", quoted(word)));
      rows.values.push_back(*number);
    }
    ++count;
  }
  rows.shape = {count, width};
  remove_row_numbers(weights);
  if (!weights.names.empty() && weights.names.size() != rows.width()) {
    refuse_file(path, concat("expected a name for each of ", width, " columns, found ",
                             weights.names.size()));
  }
  return weights;
}

}  // namespace

bool holds_vertex_weights(const std::filesystem::path& path) {
  const std::string ending = lower_case(path.extension().string());
  return ending == ".npy" || ending == ".txt" || ending == ".csv";
}

VertexWeights read_vertex_weights(const std::filesystem::path& path) {
  VertexWeights weights;
  if (lower_case(path.extension().string()) == ".npy") {
    weights.rows = read_npy_array(path);
  } else {
    weights = read_rows(path);
  }
  const auto bad = std::ranges::find_if(weights.rows.values, [](double value) {
    return !(value >= kMinMaskValue) || !std::isfinite(value);
  });
  if (bad != weights.rows.values.end()) {
    refuse_file(path, concat("expected weights of zero or more, found ", *bad, " for vertex ",
                             (bad - weights.rows.values.begin()) /
                                 static_cast<std::ptrdiff_t>(weights.rows.width())));
  }
  for (double& value : weights.rows.values) value = std::max(value, 0.0);
  return weights;
}

}  // namespace crowdface
