// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "crowdface/cast/likeness.h"
#include "crowdface/job/crowd_directory.h"
#include "crowdface/job/crowd_renders.h"
#include "crowdface/job/pipeline.h"

namespace crowdface {

/// \throws Error if what the faces are to be compared with cannot be read or is no such mesh: better
/// told before the faces are made than after.
void check_comparison(const Job& job, const std::vector<Recipe>& crowd);

/// Writes the contact sheets of a crowd from the pictures in its folder: the faces, the heads, each
/// family, an index; removes what an earlier run left over.
/// \return  how many pages the faces take.
std::size_t write_sheets(const Job& job, const Config::ContactSheet& sheet,
                         const CrowdDirectory& directory, const CrowdRenders& renders,
                         const std::vector<Recipe>& crowd, const Likeness& likeness);

/// How many pages a crowd's contact sheets have.
std::size_t sheet_pages(const Config::ContactSheet& sheet, std::size_t faces);

/// How the faces follow each other: indices into the crowd.
std::vector<std::size_t> sheet_order(SheetOrder order, const std::vector<Recipe>& crowd,
                                     const Likeness& likeness);

/// What stands under a face, a line for each label.
std::string sheet_label(const std::vector<SheetLabel>& labels, const std::vector<Recipe>& crowd,
                        std::size_t face, const Likeness& likeness,
                        const std::vector<std::string>& heads);

}  // namespace crowdface
