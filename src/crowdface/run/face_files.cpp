// SPDX-License-Identifier: Apache-2.0
#include "crowdface/run/face_files.h"

#include <iterator>
#include <set>
#include <utility>

#include "crowdface/core/text.h"
#include "crowdface/io/npy.h"
#include "crowdface/pictures/gallery_page.h"
#include "crowdface/run/face_encoders.h"
#include "crowdface/run/face_texture_encoder.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;

/// Builds the list of one face's mesh files.
class MeshFileList {
 public:
  MeshFileList(const Config& config, const Inputs& inputs, const FacePlan& face,
               const MeshFileOptions& options)
      : config_(config), inputs_(inputs), face_(face), options_(options) {}

  std::vector<FaceFile> files() {
    if (options_.formats.empty()) return {};
    const std::size_t levels = options_.includes_all_variants ? inputs_.detail_levels.size() : 0;
    for (std::size_t level = 0; level <= levels; ++level) add_meshes(level);
    if (options_.includes_all_variants && !inputs_.points.empty()) {
      add(kFacePointsFileSuffix, {}, "following_points",
          [](const FinishedFace& face) { return face.encoders->points(face); });
    }
    if (has([](const auto& format) { return format.attachments == DataStorage::kOwnFiles; })) {
      for (std::size_t level = 0; level <= levels; ++level) add_attachments(level);
    }
    if (blends_textures(inputs_)) add_textures();
    if (options_.includes_all_variants && !config_.neck.body_texture.empty()) {
      files_.push_back({options_.folder / kBlendedFolder / concat(face_.id, ".body.png"),
                        {},
                        {},
                        [](const FinishedFace& face) {
                          EncodedFile bytes;
                          bytes.add_without_copy(face.textures->back().front());
                          return bytes;
                        }});
    }
    return std::move(files_);
  }

 private:
  template <class Is>
  bool has(const Is& is) const {
    return any_format(options_.formats, is);
  }
  std::size_t shapes() const {
    return options_.includes_all_variants ? inputs_.shapes.shapes.size() : 0;
  }

  /// Joins the non-empty words with "+", for example to "LOD1+bob+smile". File names contain this
  /// text between the face's id and the extension.
  static std::string joined_with_plus(const std::vector<std::string>& words) {
    std::string joined;
    for (const std::string& word : words) {
      if (!word.empty()) joined += concat(joined.empty() ? "" : "+", word);
    }
    return joined;
  }
  template <class Make>
  void add(const std::string& end, const std::string& section, std::string key, const Make& make) {
    const std::string name = concat(options_.stem, end.starts_with('.') ? "" : "+", end);
    files_.push_back({options_.folder / name, section, std::move(key), make});
  }

  void add_meshes(std::size_t level) {
    for (const MeshFormat format : options_.formats) {
      if (level == 0 || traits_of(format).has_polygons) add_mesh(format, level, {});
    }
    for (const MeshFormat format : options_.formats) {
      const DataStorage shapes = traits_of(format).shapes;
      if (shapes == DataStorage::kOneFile && level == 0 && this->shapes() > 0) {
        const std::string end = concat("shapes", extension_of(format));
        add(end, "shapes", end,
            [](const FinishedFace& face) { return encode_npy(face.moves, face.face.id); });
      }
      if (shapes != DataStorage::kOwnFiles) continue;
      for (std::size_t s = 0; s < this->shapes(); ++s) add_mesh(format, level, s);
    }
  }

  void add_mesh(MeshFormat format, std::size_t level, ShapeNumber shape) {
    const MeshFormatTraits& traits = traits_of(format);
    const std::string end = joined_with_plus({level_suffix(level, ""),
                                              shape ? inputs_.shapes.shapes[*shape].name : ""}) +
                            std::string(traits.extension);
    const std::string section = level > 0 ? "lods" : shape ? "shapes" : "";
    add(end, section, section.empty() ? std::string(traits.report_key) : end,
        [=](const FinishedFace& face) { return face.encoders->mesh(face, format, level, shape); });
  }

  void add_attachments(std::size_t level) {
    for (const std::string& name : face_.attachments) {
      add_attachment(name, level, {});
      if (!options_.includes_all_variants) continue;
      const auto shapes = shapes_in_files(inputs_.attachments.at(name), options_.formats, inputs_);
      for (std::size_t s = 0; s < shapes.size(); ++s) add_attachment(name, level, s);
    }
  }

  void add_attachment(const std::string& name, std::size_t level, ShapeNumber shape) {
    const std::string end =
        concat(joined_with_plus({level_suffix(level, ""), name,
                                 shape ? inputs_.shapes.shapes[*shape].name : ""}),
               extension_of(MeshFormat::kObj));
    add(end, level > 0 ? "lods" : "attachments", end, [=](const FinishedFace& face) {
      return face.encoders->attachment(face, name, level, shape);
    });
  }

  void add_textures() {
    if (!has([](const auto& format) { return format.textures != DataStorage::kInside; })) return;
    for (const FaceTextureFile& file : face_texture_files(config_, inputs_, face_.id)) {
      files_.push_back({options_.folder / file.name, {}, {}, [=](const FinishedFace& face) {
                          EncodedFile bytes;
                          bytes.add_without_copy(
                              (*face.textures)[file.picture_index][file.format_index]);
                          return bytes;
                        }});
    }
    if (!has([](const auto& format) { return format.has_material_file; })) return;
    files_.push_back(
        {options_.folder / material_file_name(face_.id), {}, {}, [](const FinishedFace& face) {
           return face.encoders->textures().material_file(face.face);
         }});
  }

  const Config& config_;
  const Inputs& inputs_;
  const FacePlan& face_;
  const MeshFileOptions& options_;
  std::vector<FaceFile> files_;
};

}  // namespace

std::vector<FaceFile> mesh_files(const Config& config, const Inputs& inputs, const FacePlan& face,
                                 const MeshFileOptions& options) {
  return MeshFileList(config, inputs, face, options).files();
}

void write_files_of(const FinishedFace& face, const std::vector<FaceFile>& files) {
  std::vector<EncodedFile> encoded;
  for (const FaceFile& file : files) encoded.push_back(file.make(face));
  std::vector<FileToWrite> to_write;
  for (std::size_t f = 0; f < files.size(); ++f) {
    to_write.push_back({files[f].path, encoded[f].pieces()});
  }
  write_files(to_write);
}

FaceFileLists::FaceFileLists(const Config& config, const Inputs& inputs,
                             const CrowdDirectory& directory)
    : config_(config), inputs_(inputs), directory_(directory), has_gallery_(has_gallery(config)) {}

std::vector<FaceFile> FaceFileLists::shown_files(const FacePlan& face) const {
  std::vector<FaceFile> files;
  if (!config_.output.contact_sheet) return files;
  files.push_back({directory_.render(face.id), {}, {}, [](const FinishedFace& shown) {
                     return EncodedFile(shown.pictures->png);
                   }});
  if (has_gallery_) {
    files.push_back({directory_.gallery_face(face.id), {}, {}, [](const FinishedFace& shown) {
                       return EncodedFile(*shown.pictures->gallery_script);
                     }});
  }
  return files;
}

std::vector<FaceFile> FaceFileLists::all_files(const FacePlan& face) const {
  std::vector<FaceFile> files = mesh_files(
      config_, inputs_, face,
      {.formats = config_.output.meshes, .folder = directory_.meshes_of(face.id), .stem = face.id});
  std::ranges::move(shown_files(face), std::back_inserter(files));
  return files;
}

void FaceFileLists::make_folders(std::span<const FacePlan* const> faces) const {
  std::set<fs::path> made;
  for (const FacePlan* face : faces) {
    if (!made.insert(directory_.numbered_subfolder(face->id)).second) continue;
    for (const FaceFile& file : all_files(*face)) make_directories(file.path.parent_path());
  }
}

}  // namespace crowdface
