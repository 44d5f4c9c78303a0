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
#include "crowdface/run/lazy.h"
#include "crowdface/run/pipeline.h"

namespace crowdface {

/// Contact sheets, gallery and what they need, unless they are there: they follow from the faces'
/// pictures and meshes, the config and the page.
/// \param faces    what is known of each face of the crowd.
/// \param builder  builds founders of families, who have no meshes.
/// \return how many pages the faces take.
std::size_t make_sheets(const Job& job, const CrowdDirectory& directory, const Cast& cast,
                        const std::vector<FaceResult>& faces, Lazy<FaceBuilder>& builder,
                        Lazy<CrowdPictures>& pictures, Ledger& ledger);

/// The contact sheets of a finished crowd again, from its meshes; only founders of families, who
/// have none, are blended.
/// \param set    changes to the crowd's own config, such as "output.contact_sheet.columns=8".
/// \param cache  folder of prepared heads, which founders are made of.
void remake_sheets(const std::filesystem::path& crowd_directory,
                   const std::vector<std::string>& set,
                   const std::filesystem::path& cache = cache_directory());

}  // namespace crowdface
