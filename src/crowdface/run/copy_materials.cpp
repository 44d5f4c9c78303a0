// SPDX-License-Identifier: Apache-2.0
#include "crowdface/run/copy_materials.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/interrupt.h"
#include "crowdface/core/log.h"
#include "crowdface/core/parallel.h"
#include "crowdface/core/text.h"
#include "crowdface/heads/coloured_textures.h"
#include "crowdface/heads/face_textures.h"
#include "crowdface/heads/heads_on_body.h"
#include "crowdface/io/material_files.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;

/// Copies each file once: heads in one folder usually refer to the same files.
class MaterialCopies {
  /// A neutral texture, one hair colour, and the files to write. Each of these files gets the same
  /// picture: the neutral texture, tinted with the hair colour.
  struct TintedTexture {
    fs::path neutral;
    HairColour colour;
    std::vector<fs::path> copies;
  };

 public:
  /// \param own  kinds of textures; each face has its own files of these kinds. If `own` is not
  ///             empty, each face also has its own material file.
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
      const bool own_library = material.is_material_file && !own_.empty();
      const bool own_texture = material.kind && own_.contains(*material.kind);
      if (!own_library && !own_texture) copy(material, head);
    }
  }

  /// Copies the material files and textures of each attachment in each colour into a
  /// separate folder. Tints the colour textures with this colour.
  void add(const std::vector<ColouredAttachment>& coloured_attachments) {
    std::map<std::pair<fs::path, std::string>, TintedTexture> all;
    for (const ColouredAttachment& coloured : coloured_attachments) {
      for (const AttachmentFile& file : files_of(coloured)) {
        const fs::path to =
            attachment_folder(coloured.item->name, coloured.label()) / file.file.destination;
        if (file.is_coloured) {
          TintedTexture& dyed = all[{file.file.source, coloured.label()}];
          dyed.neutral = file.file.source;
          dyed.colour = *coloured.colour;
          dyed.copies.push_back(to);
        } else {
          copy({file.file.source, to}, coloured.item->name);
        }
      }
    }
    std::vector<TintedTexture> textures;
    for (auto& [key, dyed] : all) textures.push_back(std::move(dyed));
    constexpr std::size_t kAtOnce = 32;  // textures in memory
    for (std::size_t first = 0; first < textures.size(); first += kAtOnce) {
      throw_if_interrupted();
      const std::size_t count = std::min(kAtOnce, textures.size() - first);
      std::vector<std::string> encoded(count);
      parallel_for_each(count, [&](std::size_t t) {
        const TintedTexture& dyed = textures[first + t];
        try {
          encoded[t] = coloured_texture(dyed.neutral, dyed.colour);
        } catch (const InvalidInput&) {  // other code warns about unreadable textures
          encoded[t] = read_file(dyed.neutral);
        }
      });
      for (std::size_t t = 0; t < count; ++t) {
        for (const fs::path& copy : textures[first + t].copies) write(copy, encoded[t]);
      }
    }
  }

  /// Returns one warning per problem; each warning names the heads that have the problem.
  /// \param earlier_warnings  the result omits each problem that one of these warnings mentions,
  ///              even if this object has found the problem in additional heads.
  std::vector<std::string> warnings(const std::vector<std::string>& earlier_warnings) const {
    std::vector<std::string> warnings;
    for (const auto& [warning, heads] : heads_of_warning_) {
      const std::string begin = warning + " (";
      const auto is_this = [&](const std::string& text) { return text.starts_with(begin); };
      if (std::any_of(earlier_warnings.begin(), earlier_warnings.end(), is_this)) continue;
      warnings.push_back(concat(begin, join(heads), ")"));
    }
    return warnings;
  }

 private:
  void copy(const MaterialFile& material, const std::string& head) {
    throw_if_interrupted();
    const auto [digest, is_unread] = read_.try_emplace(material.source);
    if (is_unread) digest->second = hash_file(material.source).digest;
    const auto [first, is_new] = copied_.emplace(material.destination, digest->second);
    if (is_new) {
      write(material.destination, MappedFile(material.source).bytes());
    } else if (first->second != digest->second) {
      heads_of_warning_[concat(material.destination.string(),
                               " differs between heads; the first head's file is used")]
          .push_back(head);
    }
  }

  void write(const fs::path& relative, std::string_view bytes) {
    const fs::path to = directory_.meshes() / relative;
    refuse_link_out_of_crowd(directory_, to.parent_path());
    make_directories(to.parent_path());
    ledger_.write(directory_.relative(to), bytes);
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
  for (const PictureName& picture : face_picture_names(inputs)) own.insert(picture.kind);
  MaterialCopies copies(directory, ledger, std::move(own));
  for (const Index target : targets) {
    const auto head = static_cast<std::size_t>(target);
    copies.add(inputs.head_files[head], inputs.head_set.heads[head].name);
  }
  if (any_format(formats, refers_to_attachment_textures)) {
    std::vector<ColouredAttachment> coloured_attachments = inputs.attachments.attachments_of(crowd);
    if (config.neck.write_body && config.neck.body_texture.empty()) {
      coloured_attachments.push_back({inputs.heads_on_body->body.get()});
    }
    copies.add(coloured_attachments);
  }
  std::vector<std::string> warnings = copies.warnings(inputs.warnings);
  for (const std::string& warning : warnings) log_warning(warning);
  return warnings;
}

}  // namespace crowdface
