// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "crowdface/config/config.h"
#include "crowdface/render/contact_sheet.h"

namespace crowdface {

/// A cell without a distance map, with two lines of text, as heads and families have them.
CellSize plain_cell_size(const Config::ContactSheet& sheet);

/// Whether a page as the config wants it is not too large to be made.
bool fits_on_a_page(const Config::ContactSheet& sheet);

}  // namespace crowdface
