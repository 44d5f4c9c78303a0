// SPDX-License-Identifier: Apache-2.0
#include "crowdface/run/copy_materials.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "crowdface/core/file.h"
#include "crowdface/core/interrupt.h"
#include "crowdface/core/log.h"
#include "crowdface/core/text.h"
#include "crowdface/heads/face_textures.h"
#include "crowdface/io/material_files.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;

/// Copies each file once: heads in one folder mostly share their files.
class MaterialCopies {
 public:
  /// \param own  kinds of textures that faces have of their own; if not empty, faces have their own
  ///             material files, too
  MaterialCopies(const CrowdDirectory& directory, Ledger& ledger, std::set<TextureKind> own)
      : directory_(directory), ledger_(ledger), own_(std::move(own)) {}

  void add(const ObjFile& file, const std::string& head) {
    const auto [found, is_unknown] =
        known_.try_emplace({file.material_path().parent_path(), file.material_libraries});
    if (is_unknown)
      found->second = find_material_files(file.material_path(), file.material_libraries);
    for (const std::string& warning : found->second.warnings) {
      heads_of_warning_[warning].push_back(head);
    }
    for (const MaterialFile& material : found->second.files) {
      const bool own_library = material.is_library && !own_.empty();
      const bool own_texture = material.kind && own_.contains(*material.kind);
      if (!own_library && !own_texture) copy(material, head);
    }
  }

  /// Copies an attachment's material files and textures into a separate folder.
  void add(const Attachment& item) {
    for (const MaterialFile& material : item.materials.files) {
      copy({material.from, attachment_folder(item.name) / material.relative}, item.name);
    }
  }

  /// \param told  earlier warnings, which are not repeated even if they list more heads
  std::vector<std::string> warnings(const std::vector<std::string>& told) const {
    std::vector<std::string> warnings;
    for (const auto& [warning, heads] : heads_of_warning_) {
      const std::string begin = warning + " (";
      const auto is_this = [&](const std::string& text) { return text.starts_with(begin); };
      if (std::any_of(told.begin(), told.end(), is_this)) continue;
      warnings.push_back(concat(begin, join(heads), ")"));
    }
    return warnings;
  }

 private:
  void copy(const MaterialFile& material, const std::string& head) {
    throw_if_interrupted();
    const auto [digest, is_unread] = read_.try_emplace(material.from);
    if (is_unread) digest->second = hash_file(material.from).digest;
    const auto [first, is_new] = copied_.emplace(material.relative, digest->second);
    if (is_new) {
      const fs::path to = directory_.meshes() / material.relative;
      refuse_folder_elsewhere(directory_, to.parent_path());
      make_directories(to.parent_path());
      ledger_.write(directory_.relative(to), MappedFile(material.from).bytes());
    } else if (first->second != digest->second) {
      heads_of_warning_[concat(material.relative.string(),
                               " differs between heads; the first head's file is used")]
          .push_back(head);
    }
  }

  const CrowdDirectory& directory_;
  Ledger& ledger_;
  std::set<TextureKind> own_;
  std::map<std::pair<fs::path, std::vector<std::string>>, MaterialFiles> known_;
  std::map<fs::path, Digest> read_, copied_;
  std::map<std::string, std::vector<std::string>> heads_of_warning_;
};

}  // namespace

std::vector<std::string> copy_materials(const Config& config, const Inputs& inputs,
                                        const CrowdDirectory& directory,
                                        const std::vector<FacePlan>& crowd, Ledger& ledger) {
  std::set<Index> targets;
  const std::vector<MeshFormat>& formats = config.output.meshes;
  const bool named =
      any_format(formats, [](const auto& format) { return format.has_material_file; });
  for (const FacePlan& face : crowd) {
    if (named) targets.insert(face.recipe.target);
  }
  std::set<TextureKind> own;
  for (const PictureName& picture : own_pictures(inputs)) own.insert(picture.kind);
  MaterialCopies copies(directory, ledger, std::move(own));
  for (const Index target : targets) {
    const auto head = static_cast<std::size_t>(target);
    copies.add(inputs.files[head], inputs.faces.heads[head].name);
  }
  std::set<std::string> placed;
  const bool attachment_named = any_format(formats, names_attachment_textures);
  for (const FacePlan& face : crowd) {
    if (attachment_named) placed.insert(face.attachments.begin(), face.attachments.end());
  }
  for (const std::string& name : placed) copies.add(inputs.attachments.at(name));
  std::vector<std::string> warnings = copies.warnings(inputs.warnings);
  for (const std::string& warning : warnings) log_warning(warning);
  return warnings;
}

}  // namespace crowdface
