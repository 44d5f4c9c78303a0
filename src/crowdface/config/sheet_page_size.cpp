// SPDX-License-Identifier: Apache-2.0
#include "crowdface/config/sheet_page_size.h"

#include <algorithm>

namespace crowdface {

CellSize plain_cell_size(const Config::ContactSheet& sheet) {
  return {sheet.cell * static_cast<int>(sheet.views.size()), sheet.cell, 2};
}

bool fits_on_a_page(const Config::ContactSheet& sheet) {
  CellSize cell = plain_cell_size(sheet);
  cell.label_lines = std::max(cell.label_lines, static_cast<int>(sheet.labels.size()));
  SheetOptions options{.columns = sheet.columns, .title = "title", .legend = {}, .note = {}};
  if (sheet.compare.with != Config::Comparison::With::kNothing) {
    cell.width += sheet.cell;
    cell.label_lines += 1;
    options.legend.emplace();
  }
  return sheet.rows <= most_rows(cell, options);
}

}  // namespace crowdface
