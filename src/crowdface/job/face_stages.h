// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "crowdface/job/crowd_directory.h"
#include "crowdface/job/crowd_renders.h"
#include "crowdface/job/face_builder.h"
#include "crowdface/job/face_ledger.h"
#include "crowdface/job/report.h"
#include "crowdface/validity/skin_check.h"

namespace crowdface {

/// The crowd's files as they were written, and what they took.
struct BuiltFaces {
  std::vector<FaceFiles> files;  ///< #crowd
  StageBusy busy;
  std::size_t at_once = 0;  ///< faces blended together
};

/// Blends, writes and renders faces; each is recorded when all its files are there. While one group of faces is written and rendered the next
/// is blended: two groups at most are in memory.
/// \param renders  may be null: no pictures.
/// \param check    may be null: no mesh is judged.
/// \param crowd    recipes of the faces to build.
/// \param memory   bytes that the whole process may take; sets how large a group is.
/// \throws UsageError, before anything is written, if one face at a time does not fit.
BuiltFaces build_faces(const Job& job, const Prepared& prepared, const CrowdDirectory& directory,
                       const CrowdRenders* renders, const SkinCheck* check,
                       const FaceLedger& ledger, const std::vector<Recipe>& crowd,
                       std::uint64_t memory);

}  // namespace crowdface
