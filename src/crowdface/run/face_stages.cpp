// SPDX-License-Identifier: Apache-2.0
#include "crowdface/run/face_stages.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <functional>
#include <mutex>
#include <set>
#include <string>
#include <utility>

#include "crowdface/core/block_shelf.h"
#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/interrupt.h"
#include "crowdface/core/memory.h"
#include "crowdface/core/parallel.h"
#include "crowdface/core/progress.h"
#include "crowdface/core/text.h"
#include "crowdface/heads/face_textures.h"
#include "crowdface/io/single_precision.h"
#include "crowdface/run/face_writer.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;

/// Faces blended together at most: they share the reading of the fields, and memory for more that is new to the
/// process would take longer than that saves. A multiple of the faces that the product makes at a time.
constexpr std::size_t kMostAtOnce = 24;
/// What rendering takes per vertex of a face while it runs: its normals, its quads on the image, and the gallery's
/// smaller mesh. 272 were measured on 1.2 million vertices with a ray tracer's tree of all of them; 74 of its own are left.
constexpr std::uint64_t kRenderBytesAVertex = 300;
/// What the heads' mesh takes per vertex, whatever their number: faces, texture coordinates, neighbours,
/// how parts hang on it. 262 were measured on 1.2 million vertices.
constexpr std::uint64_t kMeshBytesAVertex = 300;

/// Adds the time until its end to a stage.
class Busy {
 public:
  explicit Busy(std::atomic<double>& stage) : stage_(stage) {}
  ~Busy() {
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start_;
    stage_ += took.count();
  }
  Busy(const Busy&) = delete;
  Busy& operator=(const Busy&) = delete;

 private:
  std::atomic<double>& stage_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

std::uint64_t vertex_count(const Inputs& inputs) {
  return static_cast<std::uint64_t>(inputs.faces.topology.vertex_count);
}

std::uint64_t input_bytes(const Inputs& inputs) {
  return inputs.faces.heads.size() * vertex_count(inputs) * 3 * sizeof(double) +
         static_cast<std::uint64_t>(inputs.regions.alpha.size()) * sizeof(double) +
         kMeshBytesAVertex * vertex_count(inputs) + texture_bytes(inputs) +
         displacement_bytes(inputs.shapes) + own_shape_bytes(inputs.shapes);
}

/// What all threads take while they make pictures.
std::uint64_t render_bytes(const Config& config, const Inputs& inputs) {
  if (!config.output.contact_sheet) return 0;
  return static_cast<std::uint64_t>(thread_count()) *
         (kRenderBytesAVertex * vertex_count(inputs) + displacement_bytes(inputs.shapes));
}

/// What fitted levels take that lie in memory of ours.
std::uint64_t level_bytes(const Prepared& prepared) {
  std::uint64_t bytes = 0;
  for (const StoredLevels& levels : prepared.levels) {
    if (!levels.mapped) bytes += levels.fields.numbers.size_bytes();
  }
  const PatchLists& patches = prepared.patches.patches.lists();
  if (!prepared.patches.mapped) {
    bytes += patches.weights.size_bytes() + patches.numbers.size_bytes();
  }
  return bytes;
}

/// What attachments take that somebody wears: as they were read, and in pictures.
std::uint64_t worn_bytes(const Config& config, const Inputs& inputs,
                         const std::vector<CastFace>& crowd) {
  std::set<std::string> worn;
  for (const CastFace& face : crowd) worn.insert(face.attachments.begin(), face.attachments.end());
  std::uint64_t bytes = 0;
  std::vector<const Attachment*> items;
  for (const std::string& name : worn) {
    items.push_back(&inputs.attachments.at(name));
    bytes +=
        static_cast<std::uint64_t>(items.back()->file.topology.vertex_count) * kMeshBytesAVertex;
  }
  if (!config.output.contact_sheet) return bytes;
  return bytes + worn_picture_bytes(items, shown_texels(*config.output.contact_sheet));
}

[[noreturn]] void refuse_memory(std::string_view least, std::uint64_t memory) {
  throw UsageError(concat("this job needs ", least, " of memory, ", format_bytes(memory),
                          " are allowed (--memory); fewer threads (--threads) need less"));
}

/// How many faces are in memory at a time: while a group is blended, each thread may be at one of the group
/// before, and there are never more than two groups.
std::uint64_t faces_held(std::uint64_t at_once) {
  return at_once + std::min(at_once, static_cast<std::uint64_t>(thread_count()));
}

/// How many faces are blended together within the memory.
/// \param standing  what the process holds whatever their number.
std::size_t faces_at_once(std::uint64_t standing, std::uint64_t one_face, std::uint64_t memory) {
  const std::uint64_t least = standing + faces_held(1) * one_face;
  if (least > memory) refuse_memory(format_bytes(least), memory);
  std::size_t at_once = kMostAtOnce;
  while (standing + faces_held(at_once) * one_face > memory) --at_once;
  return at_once;
}

/// Memory of faces that are done, for faces to come: memory that is new to a process costs as much as
/// half of blending.
class FaceMemory {
 public:
  Positions take() {
    const std::lock_guard lock(mutex_);
    if (free_.empty()) return {};
    Positions positions = std::move(free_.back());
    free_.pop_back();
    return positions;
  }
  void give_back(Positions positions) {
    const std::lock_guard lock(mutex_);
    free_.push_back(std::move(positions));
  }

 private:
  std::mutex mutex_;
  std::vector<Positions> free_;
};

/// Faces that were blended together. Any thread makes the files of the next that nobody is at.
class FaceGroup {
 public:
  /// \param make  what is done with each face, by its place in the group
  void begin(std::vector<Positions> positions,
             std::function<void(std::size_t, const Positions&)> make, FaceMemory& memory) {
    positions_ = std::move(positions);
    make_ = std::move(make);
    memory_ = &memory;
    next_ = 0;
    for (int t = 1; t < thread_count(); ++t) {
      tasks_.run([this] { make_files(); });
    }
  }
  /// Returns when no face is left that nobody is at. \throws what making one threw; then no more are begun.
  void make_files() {
    try {
      for (std::size_t f = next_++; f < positions_.size(); f = next_++) {
        Positions positions = std::move(positions_[f]);
        make_(f, positions);
        memory_->give_back(std::move(positions));
      }
    } catch (...) {
      next_ = positions_.size();
      throw;
    }
  }
  /// Returns when all are done. \throws what making one threw.
  void wait() { tasks_.wait(); }

 private:
  std::vector<Positions> positions_;
  std::function<void(std::size_t, const Positions&)> make_;
  FaceMemory* memory_ = nullptr;
  std::atomic<std::size_t> next_ = 0;
  BackgroundTasks tasks_;  // after what it uses, so that it ends first
};

}  // namespace

void refuse_too_little_memory(const Config& config, const Inputs& inputs, std::uint64_t memory) {
  const std::uint64_t least = input_bytes(inputs) + render_bytes(config, inputs);
  if (least > memory) refuse_memory(concat("more than ", format_bytes(least)), memory);
}

FaceStages::FaceStages(const Config& config, const Inputs& inputs, const Prepared& prepared,
                       const FaceBuilder& builder, const FaceTextures& textures,
                       const FaceAttachments* attachments, const FaceShapes& shapes,
                       const std::vector<CastFace>& crowd, std::uint64_t memory)
    : writers_(config, inputs, config.output.meshes, crowd,
               directory_of(config).shared_from_mesh()),
      builder_(builder),
      textures_(textures),
      attachments_(attachments),
      shapes_(shapes),
      attachment_writers_(inputs, config.output.meshes, directory_of(config).shared_from_mesh(),
                          writers_.worn_on_levels()),
      formats_(config.output.meshes) {
  std::uint64_t standing = input_bytes(inputs) + render_bytes(config, inputs) +
                           level_bytes(prepared) + writers_.memory_bytes() + shapes.memory_bytes();
  std::uint64_t of_thread = writers_.encode_bytes();
  if (textures_.any()) {
    own_.emplace(config, inputs, crowd, directory_of(config).shared_from_mesh());
    standing += textures_.memory_bytes();
    of_thread += textures_.blend_bytes() + own_->encode_bytes();
    if (config.output.contact_sheet) {
      of_thread +=
          OwnCoat::bytes(inputs.textures, inputs.maps, shown_texels(*config.output.contact_sheet));
    }
  }
  if (skin_is_judged(config, inputs)) {
    std::set<Index> targets;
    for (const CastFace& face : crowd) targets.insert(face.recipe.target);
    check_.emplace(skin_check(config, inputs, targets));
    standing += check_->memory_bytes();
    of_thread += check_->compare_bytes();
  }
  if (attachments_ != nullptr) {
    standing += attachments_->memory_bytes() + worn_bytes(config, inputs, crowd);
    of_thread += attachments_->worn_bytes();
    of_thread += attachment_writers_.encode_bytes();
  }
  const std::uint64_t of_threads = static_cast<std::uint64_t>(thread_count()) * of_thread;
  waiting_bytes_ = std::min(of_threads, FaceWriter::kLeastWaitingBytes);
  // Files wait for the writer, and others are with it, beside those that threads are at.
  standing += of_threads + 2 * waiting_bytes_;
  const std::uint64_t one_face = builder.bytes(1);
  at_once_ = faces_at_once(standing, one_face, memory);
  // Where there is room, more may wait: the disk has work while faces are blended.
  const std::uint64_t room = memory - standing - faces_held(at_once_) * one_face;
  waiting_bytes_ = std::clamp(waiting_bytes_ + room / 2, waiting_bytes_,
                              std::max(waiting_bytes_, FaceWriter::kMostWaitingBytes));
  encoded_bytes_ = of_threads + 2 * waiting_bytes_;
}

/// Encodes, renders and judges one face after the other, on any thread, and leaves their files to the writer.
class FaceStages::Output {
 public:
  Output(const FaceStages& stages, const CrowdDirectory& directory, const CrowdRenders* renders,
         FaceWriter& writer)
      : stages_(stages), directory_(directory), renders_(renders), writer_(writer) {}

  FaceFiles make(const CastFace& face, const Positions& positions) {
    throw_if_interrupted();
    MadeFace made{&face, {}};
    const Skin skin = paint(face.recipe);
    std::vector<Displacements> moves;
    if (stages_.writers_.holds_shapes() || (renders_ != nullptr && renders_->show_shapes())) {
      const Busy busy(encode_);
      moves = stages_.shapes_.of_face(face.recipe, as_written(positions), &made.files.crossing);
    }
    std::vector<WornAttachment> worn;
    if (stages_.attachments_ != nullptr) {
      const Busy busy(blend_);
      worn = stages_.attachments_->worn_by(face, positions, moves);
    }
    std::vector<ReadyFile> ready = encode(face, positions, moves, worn, skin.files, made.files);
    if (renders_ != nullptr) {
      const Busy busy(render_);
      FacePictures drawn = renders_->draw(face.id, face.recipe.target, positions, moves,
                                          skin.coat ? &*skin.coat : nullptr, worn);
      made.files.picture =
          add(directory_.render(face.id), EncodedFile(std::move(drawn.picture)), ready);
      if (drawn.preview) {
        made.files.preview =
            add(directory_.gallery_face(face.id), EncodedFile(std::move(*drawn.preview)), ready);
      }
    }
    if (stages_.check_) {
      const Busy busy(check_seconds_);
      made.files.skin = stages_.builder_.defects(*stages_.check_, face.recipe, positions);
    }
    FaceFiles files = made.files;
    writer_.add(std::move(made), std::move(ready));
    return files;
  }

  void add_to(StageBusy& busy) const {
    busy.blend += blend_;
    busy.encode += encode_;
    busy.write += writer_.busy_seconds();
    busy.render += render_;
    busy.check += check_seconds_;
  }

 private:
  static FileDigest add(fs::path path, EncodedFile file, std::vector<ReadyFile>& to) {
    const FileDigest content{file.size(), file.digest()};
    to.push_back({std::move(path), std::move(file)});
    return content;
  }

  /// A face's own textures: in their files' bytes, if it has files, and as pictures show them.
  struct Skin {
    std::shared_ptr<OwnTextures::Encoded> files = std::make_shared<OwnTextures::Encoded>();
    std::optional<OwnCoat> coat;
  };

  /// One texture after the other is blended, encoded and forgotten.
  Skin paint(const Recipe& recipe) {
    Skin skin;
    if (renders_ != nullptr) skin.coat = renders_->own_coat(recipe.target);
    const bool written = stages_.own_ && !stages_.formats_.empty();
    if (!written && !skin.coat) return skin;
    skin.files->resize(stages_.textures_.picture_count());
    parallel_for_each(stages_.textures_.picture_count(), [&](std::size_t p) {
      const BlendedPicture picture = [&] {
        const Busy busy(blend_);
        return stages_.textures_.blend(recipe, p);
      }();
      if (written) {
        const Busy busy(encode_);
        (*skin.files)[p] = stages_.own_->encode(p, picture);
      }
      if (skin.coat) {
        const Busy busy(render_);
        skin.coat->add(p, picture);
      }
    });
    return skin;
  }

  /// The face's meshes, what it wears and its textures. \param files  of which they are noted.
  std::vector<ReadyFile> encode(const CastFace& face, const Positions& positions,
                                std::span<const Displacements> moves,
                                const std::vector<WornAttachment>& worn,
                                const std::shared_ptr<const OwnTextures::Encoded>& textures,
                                FaceFiles& files) {
    std::vector<ReadyFile> ready;
    if (stages_.formats_.empty()) return ready;
    const Busy busy(encode_);
    std::vector<std::string_view> of_mesh;
    if (stages_.own_) of_mesh = stages_.own_->of_mesh(*textures);
    std::vector<EncodedMesh> meshes =
        stages_.writers_.encode(face, positions, moves, of_mesh, worn);
    stages_.attachment_writers_.add_to(meshes, face.id, worn);
    for (EncodedMesh& mesh : meshes) {
      mesh.file.keep(textures);
      const fs::path path = mesh_path(directory_, face.id, mesh.name);
      files.meshes.push_back({mesh.name, add(path, std::move(mesh.file), ready)});
    }
    if (!stages_.own_) return ready;
    for (OwnFile& file : stages_.own_->files(face, stages_.formats_, textures)) {
      files.own.push_back(
          add(directory_.meshes_of(face.id) / file.name, std::move(file.file), ready));
    }
    return ready;
  }

  const FaceStages& stages_;
  const CrowdDirectory& directory_;
  const CrowdRenders* renders_;
  FaceWriter& writer_;
  std::atomic<double> blend_ = 0, encode_ = 0, render_ = 0, check_seconds_ = 0;
};

BuiltFaces FaceStages::build(const CrowdDirectory& directory, const CrowdRenders* renders,
                             const FaceLedger& ledger, const std::vector<CastFace>& faces) const {
  BuiltFaces built;
  built.files.resize(faces.size());
  if (!formats_.empty()) {
    for (const std::string& id : one_of_each_folder(directory, faces)) {
      make_directories(own_ ? directory.blended_of(id) : directory.meshes_of(id));
    }
  }
  if (renders != nullptr) renders->make_folders(directory, faces);

  Progress progress("faces", faces.size());
  const KeptBlocks kept(encoded_bytes_);
  FaceWriter writer(ledger, waiting_bytes_, [&] { progress.step(); });
  Output output(*this, directory, renders, writer);
  std::atomic<double> blend_seconds = 0;
  FaceMemory memory;
  std::array<FaceGroup, 2> groups;
  std::size_t turn = 0;
  for (std::size_t first = 0; first < faces.size(); first += at_once_, turn ^= 1) {
    FaceGroup& group = groups[turn];
    group.wait();
    throw_if_interrupted();
    const std::size_t count = std::min(at_once_, faces.size() - first);
    std::vector<const Recipe*> recipes;
    std::vector<Positions> positions;
    for (std::size_t f = 0; f < count; ++f) {
      recipes.push_back(&faces[first + f].recipe);
      positions.push_back(memory.take());
    }
    {
      const Busy busy(blend_seconds);
      builder_.build(recipes, positions);
    }
    group.begin(
        std::move(positions),
        [&, first](std::size_t f, const Positions& face) {
          built.files[first + f] = output.make(faces[first + f], face);
        },
        memory);
    group.make_files();
  }
  for (FaceGroup& group : groups) group.wait();
  writer.finish();
  output.add_to(built.busy);
  built.busy.blend += blend_seconds;
  return built;
}

}  // namespace crowdface
