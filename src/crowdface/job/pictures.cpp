// SPDX-License-Identifier: Apache-2.0
#include "crowdface/job/pictures.h"

#include <algorithm>
#include <system_error>

#include "crowdface/core/file.h"
#include "crowdface/core/interrupt.h"
#include "crowdface/core/log.h"
#include "crowdface/core/parallel.h"
#include "crowdface/core/progress.h"
#include "crowdface/core/text.h"
#include "crowdface/job/mesh_writers.h"
#include "crowdface/job/rounded.h"

namespace crowdface {
namespace {

constexpr std::size_t kNeighbours = 6;  // of each face: two rows on its page

/// The page, if this crowd is to have one; says what is missing.
std::optional<std::filesystem::path> page_for(const Config& config) {
  if (config.output.gallery == Gallery::kNone) return std::nullopt;
  auto page = find_gallery_page();
  if (!page) {
    log_info(
        "no gallery: its page was not built (scripts/build_gallery.sh builds it; it needs npm)");
  }
  return page;
}

}  // namespace

CrowdPictures::CrowdPictures(const Job& job, const Config::ContactSheet& sheet,
                             const CrowdDirectory& directory)
    : job_(job),
      sheet_(sheet),
      directory_(directory),
      renders_(job.config, sheet, job.inputs),
      page_(page_for(job.config)) {
  if (!page_) return;
  gallery_ = std::make_unique<GalleryMeshes>(job.config, job.inputs);
  renders_.add_gallery(*gallery_);
}

void CrowdPictures::write_heads() const {
  make_directories(directory_.head_render("").parent_path());
  const std::vector<Head>& heads = job_.inputs.faces.heads;
  for (std::size_t h = 0; h < heads.size(); ++h) {
    throw_if_interrupted();
    write_file(directory_.head_render(heads[h].name),
               renders_.render_png(heads[h].positions, static_cast<Index>(h)));
  }
}

void CrowdPictures::write_founders(const std::vector<FamilyFounder>& founders,
                                   const FaceBuilder& builder) const {
  if (founders.empty()) return;
  make_directories(directory_.founder_render("").parent_path());
  std::vector<Positions> built(1);
  for (const FamilyFounder& founder : founders) {
    throw_if_interrupted();
    const Recipe* recipe = &founder.face.recipe;
    builder.build({&recipe, 1}, built);
    write_file(directory_.founder_render(founder.family),
               renders_.render_png(built[0], founder.face.recipe.target));
  }
}

void CrowdPictures::write_faces(const std::vector<CastFace>& crowd) const {
  renders_.make_folders(directory_);
  Progress progress("pictures", crowd.size());
  parallel_for_each(static_cast<Index>(crowd.size()), [&](Index i) {
    throw_if_interrupted();
    const CastFace& face = crowd[static_cast<std::size_t>(i)];
    renders_.write(directory_, face.id, face.recipe.target,
                   read_face(directory_, face.id, job_.config.output.meshes,
                             job_.inputs.faces.topology.vertex_count));
    progress.step();
  });
}

std::size_t CrowdPictures::finish(const std::vector<CastFace>& crowd,
                                  const CrowdLikeness& likeness) const {
  std::vector<std::string> ids;
  for (const CastFace& face : crowd) ids.push_back(face.id);
  write_file(directory_.likeness(), format_likeness(likeness, job_.names, ids));
  if (page_) {
    std::vector<std::string> lines;
    for (const CastFace& face : crowd) {
      lines.push_back(format_recipe(face, job_.names, job_.settings));
    }
    write_gallery(directory_, job_, *page_, *gallery_, lines, likeness);
    log_info(concat("gallery: ", (directory_.gallery() / "index.html").string()));
  }
  return write_sheets(job_, sheet_, directory_, renders_, crowd, likeness.likeness);
}

std::vector<std::filesystem::path> picture_files(const CrowdDirectory& directory) {
  std::vector<std::filesystem::path> files = {directory.likeness()};
  const auto add = [&](const std::filesystem::path& folder, const auto& is_ours) {
    std::error_code none;
    for (const auto& entry : std::filesystem::directory_iterator(folder, none)) {
      if (entry.is_regular_file() && is_ours(entry.path())) files.push_back(entry.path());
    }
  };
  const auto ends_in = [](const char* ending) {
    return [ending](const std::filesystem::path& path) { return path.extension() == ending; };
  };
  add(directory.sheets(), is_sheet_file);
  add(directory.head_render("").parent_path(), ends_in(".png"));
  add(directory.founder_render("").parent_path(), ends_in(".png"));
  add(directory.gallery(), is_page_file);
  add(directory.gallery() / "data", ends_in(".js"));
  add(directory.gallery_head("").parent_path(), ends_in(".js"));
  std::sort(files.begin(), files.end());
  return files;
}

CrowdLikeness crowd_likeness(const Cast& cast) {
  CrowdLikeness likeness{cast.anchors, find_likeness(cast.places, kNeighbours)};
  for (std::vector<Neighbour>& near : likeness.likeness.near) {
    // As it stands in the file, so that pictures made from that are the same.
    for (Neighbour& other : near) other.mm = rounded(other.mm);
  }
  return likeness;
}

}  // namespace crowdface
