// SPDX-License-Identifier: Apache-2.0
#include "crowdface/run/face_stages.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <functional>
#include <mutex>
#include <set>
#include <string>
#include <utility>

#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/interrupt.h"
#include "crowdface/core/memory.h"
#include "crowdface/core/parallel.h"
#include "crowdface/core/progress.h"
#include "crowdface/core/text.h"
#include "crowdface/heads/face_textures.h"
#include "crowdface/run/face_finisher.h"
#include "crowdface/run/face_writer.h"

namespace crowdface {
namespace {

/// Faces blended together at most: they share the reading of the fields, and memory for more that is new to the
/// process would take longer than that saves. A multiple of the faces that the product makes at a time.
constexpr std::size_t kMostAtOnce = 24;
/// What rendering takes per vertex of a face while it runs: its normals, its quads on the image, and the gallery's
/// smaller mesh. 272 were measured on 1.2 million vertices with a ray tracer's tree of all of them; 74 of its own are left.
constexpr std::uint64_t kRenderBytesAVertex = 300;
/// What the heads' mesh takes per vertex, whatever their number: faces, texture coordinates, neighbours,
/// how parts hang on it. 262 were measured on 1.2 million vertices.
constexpr std::uint64_t kMeshBytesAVertex = 300;

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
                       const FaceAttachments& attachments, const FaceShapes& shapes,
                       const std::vector<CastFace>& crowd, std::uint64_t memory)
    : encoders_(config, inputs, config.output.meshes, crowd,
                directory_of(config).shared_from_mesh()),
      builder_(builder),
      textures_(textures),
      attachments_(attachments),
      shapes_(shapes) {
  std::uint64_t standing = input_bytes(inputs) + render_bytes(config, inputs) +
                           level_bytes(prepared) + encoders_.memory_bytes() +
                           shapes.memory_bytes() + attachments.memory_bytes() +
                           worn_bytes(config, inputs, crowd);
  std::uint64_t of_thread = encoders_.encode_bytes() + attachments.worn_bytes();
  // Colours at vertices: a face's own, and what a picture is drawn with.
  if (!inputs.colours.empty()) of_thread += vertex_count(inputs) * 3 * (1 + sizeof(float));
  if (textures_.any()) {
    standing += textures_.memory_bytes();
    of_thread += textures_.blend_bytes();
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
}

/// Encodes, renders and judges one face after the other, on any thread, and leaves their files to the writer.
class FaceStages::Output {
 public:
  Output(const FaceStages& stages, const FaceFileLists& lists, const CrowdRenders* renders,
         FaceWriter& writer, StageBusy& busy)
      : stages_(stages),
        lists_(lists),
        finisher_{stages.textures_, stages.attachments_, stages.shapes_, &stages.encoders_,
                  renders},
        writer_(writer),
        busy_(busy) {}

  FaceResult make(const CastFace& face, const Positions& positions) {
    throw_if_interrupted();
    FinishedFace finished(face, positions);
    finisher_.finish(finished, busy_);
    FaceResult result;
    std::vector<ReadyFile> ready;
    {
      const Busy timer(busy_.encode);
      for (FaceFile& file : lists_.of(face)) {
        EncodedFile bytes = file.make(finished);
        bytes.keep(finished.textures);
        result.files.push_back({bytes.size(), bytes.digest()});
        ready.push_back({std::move(file.path), std::move(bytes)});
      }
    }
    result.crossing = std::move(finished.crossing);
    if (stages_.check_) {
      const Busy timer(busy_.check);
      result.skin = stages_.builder_.defects(*stages_.check_, face.recipe, positions);
    }
    writer_.add({&face, result}, std::move(ready));
    return result;
  }

 private:
  const FaceStages& stages_;
  const FaceFileLists& lists_;
  FaceFinisher finisher_;
  FaceWriter& writer_;
  StageBusy& busy_;
};

void FaceStages::build(const FaceFileLists& lists, const CrowdRenders* renders,
                       const FaceLedger& ledger, std::span<const CastFace* const> faces,
                       std::span<FaceResult* const> results, StageBusy& busy) const {
  lists.make_folders(faces);
  Progress progress("faces", faces.size());
  FaceWriter writer(ledger, waiting_bytes_, [&] { progress.step(); });
  Output output(*this, lists, renders, writer, busy);
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
      recipes.push_back(&faces[first + f]->recipe);
      positions.push_back(memory.take());
    }
    {
      const Busy timer(busy.blend);
      builder_.build(recipes, positions);
    }
    group.begin(
        std::move(positions),
        [&, first](std::size_t f, const Positions& face) {
          *results[first + f] = output.make(*faces[first + f], face);
        },
        memory);
    group.make_files();
  }
  for (FaceGroup& group : groups) group.wait();
  writer.finish();
  busy.write += writer.busy_seconds();
}

}  // namespace crowdface
