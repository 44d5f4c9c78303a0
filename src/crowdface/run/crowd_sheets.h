// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "crowdface/crowd/ledger.h"
#include "crowdface/heads/cache_folder.h"
#include "crowdface/pictures/pictures.h"
#include "crowdface/run/casting.h"
#include "crowdface/run/face_builder.h"
#include "crowdface/run/face_files.h"
#include "crowdface/run/job.h"
#include "crowdface/run/lazy.h"

namespace crowdface {

/// Makes the contact sheets, the gallery and the data files of both, unless these files are up to
/// date. The files depend on the faces' images and meshes, the config and the gallery's page.
/// \param faces    results, one per face of the crowd
/// \param builder  builds the founders of families, which have no mesh files
/// \return the number of sheets that the faces fill.
std::size_t make_sheets(const Job& job, const CrowdDirectory& directory,
                        const CrowdPlan& crowd_plan, const std::vector<FaceResult>& faces,
                        Lazy<FaceBuilder>& builder, Lazy<CrowdPictures>& pictures, Ledger& ledger);

/// Makes the contact sheets of a finished crowd again from its mesh files. Blends only the founders
/// of families, because founders have no mesh files.
/// \param assignments  changes to the crowd's own config (`--set`), such as
///                     "output.contact_sheet.columns=8"
/// \param cache        folder of prepared heads, from which founders are blended
void remake_sheets(const std::filesystem::path& crowd_directory,
                   const std::vector<std::string>& assignments,
                   const std::filesystem::path& cache = cache_directory());

}  // namespace crowdface
