// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "crowdface/crowd/ledger.h"
#include "crowdface/heads/head_cache.h"
#include "crowdface/pictures/pictures.h"
#include "crowdface/run/casting.h"
#include "crowdface/run/face_files.h"

namespace crowdface {

/// The crowd's pictures, if it has any. Made ready when they are first asked for, as that takes a
/// while, and a run that finds all done needs none.
class LazyPictures {
 public:
  LazyPictures(const Job& job, const CrowdDirectory& directory)
      : job_(job), directory_(directory) {}
  bool wanted() const { return job_.config.output.contact_sheet.has_value(); }
  const CrowdPictures& get() {
    if (!pictures_) {
      pictures_ = std::make_unique<CrowdPictures>(job_.config, *job_.config.output.contact_sheet,
                                                  job_.inputs, job_.settings, directory_);
    }
    return *pictures_;
  }

 private:
  const Job& job_;
  const CrowdDirectory& directory_;
  std::unique_ptr<CrowdPictures> pictures_;
};

/// Contact sheets, gallery and what they need, unless they are there: they follow from the faces'
/// pictures and meshes, the config and the page.
/// \param files  of each face of the crowd.
/// \return how many pages the faces take.
std::size_t make_sheets(const Job& job, const CrowdDirectory& directory, const Prepared& prepared,
                        const Cast& cast, const std::vector<FaceFiles>& files,
                        LazyPictures& pictures, Ledger& ledger);

/// The contact sheets of a finished crowd again, from its meshes; only founders of families, who
/// have none, are blended.
/// \param set    changes to the crowd's own config, such as "output.contact_sheet.columns=8".
/// \param cache  folder of prepared heads, which founders are made of.
void remake_sheets(const std::filesystem::path& crowd_directory,
                   const std::vector<std::string>& set,
                   const std::filesystem::path& cache = cache_directory());

}  // namespace crowdface
