// SPDX-License-Identifier: Apache-2.0
#include "crowdface/pictures/pictures.h"

#include <algorithm>
#include <set>

#include "crowdface/core/file.h"
#include "crowdface/core/folder.h"
#include "crowdface/core/interrupt.h"
#include "crowdface/core/log.h"
#include "crowdface/core/parallel.h"
#include "crowdface/core/text.h"
#include "crowdface/pictures/gallery_page.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;

/// The folder of the gallery's page, if the crowd gets a gallery. Logs a message if the page is not
/// built.
std::optional<std::filesystem::path> page_for(const Config& config) {
  if (config.output.gallery == Gallery::kNone) return std::nullopt;
  auto page = find_gallery_page();
  if (!page) {
    log_info(
        "no gallery: its page was not built (scripts/build_gallery.sh builds it; it needs npm)");
  }
  return page;
}

/// Removes scripts whose name is not in `names`, such as scripts of faces that are no longer in the
/// crowd.
void remove_others(const fs::path& folder, const std::set<std::string>& names) {
  for (const fs::path& path : list_files(folder, extension_filter(".js"))) {
    if (!names.contains(path.stem().string())) remove_if_exists(path);
  }
}

}  // namespace

CrowdPictures::CrowdPictures(const Config& config, const Inputs& inputs, const Digest& settings,
                             const CrowdDirectory& directory, const FaceTextures& textures,
                             const FaceShapes& shapes)
    : config_(config),
      inputs_(inputs),
      settings_digest_(settings),
      directory_(directory),
      textures_(textures),
      shapes_(shapes),
      renders_(config, *config.output.contact_sheet, inputs, &textures),
      page_folder_(page_for(config)) {
  if (!page_folder_) return;
  gallery_ = std::make_unique<GalleryMeshes>(config, inputs, renders_.mesh());
  renders_.add_gallery(*gallery_);
}

void CrowdPictures::write_heads() {
  if (heads_are_written_) return;
  make_directories(directory_.head_render("").parent_path());
  const std::vector<Head>& heads = inputs_.head_set.heads;
  for (std::size_t h = 0; h < heads.size(); ++h) {
    throw_if_interrupted();
    write_file(directory_.head_render(heads[h].name),
               renders_.render_png(heads[h].positions, static_cast<Index>(h)));
  }
  heads_are_written_ = true;
}

void CrowdPictures::write_founder(const std::string& family, const Positions& positions,
                                  const Recipe& recipe) const {
  const std::filesystem::path path = directory_.founder_render(family);
  make_directories(path.parent_path());
  write_file(path, renders_.render_png(positions, textures_, recipe));
}

void CrowdPictures::write_gallery(const std::vector<FacePlan>& crowd,
                                  const CrowdLikeness& likeness) const {
  make_directories(directory_.gallery_head("").parent_path());
  std::set<std::string> ids, placed;
  for (const FacePlan& face : crowd) ids.insert(face.id);
  const std::vector<ColouredAttachment> worn = inputs_.attachments.attachments_of(crowd);
  for (const ColouredAttachment& coloured : worn) placed.insert(coloured.name());
  for (const fs::path& folder : folder_and_numbered_subfolders(directory_.gallery_faces())) {
    remove_others(folder, ids);
  }
  const fs::path attachments = directory_.gallery_attachment("").parent_path();
  remove_others(attachments, placed);
  if (!placed.empty()) make_directories(attachments);
  parallel_for_each(worn.size(), [&](std::size_t i) {
    write_file(directory_.gallery_attachment(worn[i].name()),
               gallery_->attachment_script(worn[i], renders_.attachment_surfaces()));
  });
  parallel_for_each(inputs_.head_set.heads.size(), [&](std::size_t h) {
    const auto head = static_cast<Index>(h);
    write_file(directory_.gallery_head(inputs_.head_set.heads[h].name),
               renders_.gallery_script_of_head(head, shapes_.shapes_of_head(head)));
  });
  write_file(directory_.gallery() / "data/mesh.js", gallery_->shared_script());
  write_scripts(crowd, likeness);
  for (const std::string_view file : kGalleryPageFiles) {
    write_file(directory_.gallery() / file, read_file(*page_folder_ / file));
  }
}

WrittenSheets CrowdPictures::write_sheets_and_gallery(const std::vector<FacePlan>& crowd,
                                                      const CrowdLikeness& likeness) const {
  std::vector<std::string> ids;
  for (const FacePlan& face : crowd) ids.push_back(face.id);
  const PlanNames names = config_.plan_names();
  write_file(directory_.likeness(), likeness_text(likeness, names, ids));
  if (page_folder_) {
    write_gallery(crowd, likeness);
    log_info(concat("gallery: ", (directory_.gallery() / "index.html").string()));
  }
  return write_sheets({config_, inputs_, directory_, renders_, shapes_, crowd, likeness.likeness});
}

std::vector<std::filesystem::path> picture_files(const CrowdDirectory& directory,
                                                 const WrittenSheets& sheets) {
  std::vector<std::filesystem::path> files = files_made_together_with_sheets(directory);
  files.insert(files.end(), sheets.files.begin(), sheets.files.end());
  files.push_back(directory.likeness());
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace crowdface
