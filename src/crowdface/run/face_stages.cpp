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

/// Maximum number of faces in a group. All faces of a group are blended together, so that the
/// blender reads the heads' fields once for each group. Larger groups lose more time to memory
/// allocation than they save in reading. Must be a multiple of the number of faces that one matrix
/// product handles.
constexpr std::size_t kMaxAtOnce = 24;
/// Memory for rendering, per vertex of a face: normals, projected quads, and the gallery's smaller
/// mesh. Measured at 1.2 million vertices, with a margin.
constexpr std::uint64_t kRenderBytesPerVertex = 300;
/// Memory of the heads' mesh per vertex, independent of the number of heads: polygons, texture
/// coordinates, adjacency, binding of parts. Measured: 262 bytes at 1.2 million vertices.
constexpr std::uint64_t kMeshBytesPerVertex = 300;

std::uint64_t vertex_count(const Inputs& inputs) {
  return static_cast<std::uint64_t>(inputs.head_set.topology.vertex_count);
}

std::uint64_t input_bytes(const Inputs& inputs) {
  return inputs.head_set.heads.size() * vertex_count(inputs) * 3 * sizeof(double) +
         static_cast<std::uint64_t>(inputs.regions.alpha.size()) * sizeof(double) +
         kMeshBytesPerVertex * vertex_count(inputs) + texture_bytes(inputs) +
         displacement_bytes(inputs.shapes) + own_shape_bytes(inputs.shapes);
}

/// Memory, in bytes, that all threads together need for rendering.
std::uint64_t render_bytes(const Config& config, const Inputs& inputs) {
  if (!config.output.contact_sheet) return 0;
  return static_cast<std::uint64_t>(thread_count()) *
         (kRenderBytesPerVertex * vertex_count(inputs) + displacement_bytes(inputs.shapes));
}

/// Memory, in bytes, of the fitted smoothing levels that are not memory-mapped.
std::uint64_t level_bytes(const PreparedHeads& prepared) {
  std::uint64_t bytes = 0;
  for (const StoredLevels& levels : prepared.levels) {
    if (!levels.mapped_file) bytes += levels.fields.quantized_values.size_bytes();
  }
  const PatchArrays& patches = prepared.patches.patches.arrays();
  if (!prepared.patches.mapped_file) {
    bytes += patches.weights.size_bytes() + patches.quantized_values.size_bytes();
  }
  return bytes;
}

/// Memory, in bytes, of all attachments that some face wears: their meshes, and their textures for
/// renders.
std::uint64_t placement_memory_bytes(const Config& config, const Inputs& inputs,
                                     const std::vector<FacePlan>& crowd) {
  std::set<std::string> placed;
  for (const FacePlan& face : crowd)
    placed.insert(face.attachments.begin(), face.attachments.end());
  std::uint64_t bytes = 0;
  std::vector<const Attachment*> items;
  for (const std::string& name : placed) {
    items.push_back(&inputs.attachments.at(name));
    bytes +=
        static_cast<std::uint64_t>(items.back()->file.topology.vertex_count) * kMeshBytesPerVertex;
  }
  if (!config.output.contact_sheet) return bytes;
  return bytes + attachment_texture_bytes(items, max_rendered_texels(*config.output.contact_sheet));
}

[[noreturn]] void refuse_memory(std::string_view least, std::uint64_t memory_bytes) {
  throw UsageError(concat("this job needs ", least, " of memory, but --memory allows ",
                          format_bytes(memory_bytes),
                          "; use fewer threads (--threads), or allow more memory"));
}

/// Returns the maximum number of faces in memory at the same time: the faces of the group that is
/// being blended and, for each thread, one face of the previous group that the thread is finishing.
std::uint64_t faces_held(std::uint64_t at_once) {
  return at_once + std::min(at_once, static_cast<std::uint64_t>(thread_count()));
}

/// Returns how many faces can be blended in one group within `memory_bytes`.
/// \param fixed_bytes  memory that does not depend on the number of faces in a group
std::size_t faces_at_once(std::uint64_t fixed_bytes, std::uint64_t one_face,
                          std::uint64_t memory_bytes) {
  const std::uint64_t least = fixed_bytes + faces_held(1) * one_face;
  if (least > memory_bytes) refuse_memory(format_bytes(least), memory_bytes);
  std::size_t at_once = kMaxAtOnce;
  while (fixed_bytes + faces_held(at_once) * one_face > memory_bytes) --at_once;
  return at_once;
}

/// Reuses the memory of finished faces. This saves time, because allocating new memory for a face
/// takes half as long as blending the face. Thread-safe.
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

/// Faces that were blended in one batch. Each thread claims the next unclaimed face and finishes
/// it.
class FaceGroup {
 public:
  /// Makes the other threads claim and finish faces.
  /// \param make  called with each face's index in the group and its positions
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
  /// Claims and finishes faces until every face has been claimed. \throws the exception of `make`;
  /// the remaining faces are then skipped.
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
  /// Waits until all faces are finished. \throws the exception of `make`.
  void wait() { tasks_.wait(); }

 private:
  std::vector<Positions> positions_;
  std::function<void(std::size_t, const Positions&)> make_;
  FaceMemory* memory_ = nullptr;
  std::atomic<std::size_t> next_ = 0;
  // declared last, so that the tasks end before the other members are destroyed
  BackgroundTasks tasks_;
};

}  // namespace

void refuse_too_little_memory(const Config& config, const Inputs& inputs,
                              std::uint64_t memory_bytes) {
  const std::uint64_t least = input_bytes(inputs) + render_bytes(config, inputs);
  if (least > memory_bytes) refuse_memory(concat("more than ", format_bytes(least)), memory_bytes);
}

FaceStages::FaceStages(const Config& config, const Inputs& inputs, const PreparedHeads& prepared,
                       const FaceBuilder& builder, const FaceTextures& textures,
                       const FaceAttachments& attachments, const FaceShapes& shapes,
                       const std::vector<FacePlan>& crowd, std::uint64_t memory_bytes)
    : encoders_(config, inputs, config.output.meshes, crowd,
                crowd_directory_of(config).path_from_mesh_to_shared()),
      builder_(builder),
      textures_(textures),
      attachments_(attachments),
      shapes_(shapes) {
  std::uint64_t fixed_bytes = input_bytes(inputs) + render_bytes(config, inputs) +
                              level_bytes(prepared) + encoders_.memory_bytes() +
                              shapes.memory_bytes() + attachments.memory_bytes() +
                              placement_memory_bytes(config, inputs, crowd);
  std::uint64_t bytes_per_thread =
      encoders_.encoding_memory_bytes() + attachments.placement_memory_bytes();
  // Each thread holds the vertex colours of a face twice: as bytes, and as floats for rendering.
  if (!inputs.vertex_colours.empty())
    bytes_per_thread += vertex_count(inputs) * 3 * (1 + sizeof(float));
  if (textures_.has_textures()) {
    fixed_bytes += textures_.memory_bytes();
    bytes_per_thread += textures_.blend_bytes();
    if (config.output.contact_sheet) {
      bytes_per_thread +=
          FaceTextureSet::memory_bytes(inputs.textures, inputs.other_textures,
                                       max_rendered_texels(*config.output.contact_sheet));
    }
  }
  if (skin_is_judged(config, inputs)) {
    std::set<Index> targets;
    for (const FacePlan& face : crowd) targets.insert(face.recipe.target);
    check_.emplace(skin_check(config, inputs, targets));
    fixed_bytes += check_->memory_bytes();
    bytes_per_thread += check_->comparison_memory_bytes();
  }
  const std::uint64_t bytes_of_threads =
      static_cast<std::uint64_t>(thread_count()) * bytes_per_thread;
  max_waiting_bytes_ = std::min(bytes_of_threads, FaceWriter::kMinWaitingBytes);
  // Encoded files with up to `max_waiting_bytes_` bytes wait in the queue. The batch that is being
  // written may have the same size.
  fixed_bytes += bytes_of_threads + 2 * max_waiting_bytes_;
  const std::uint64_t one_face = builder.memory_bytes(1);
  faces_per_group_ = faces_at_once(fixed_bytes, one_face, memory_bytes);
  // If memory is left, enlarge the queue of encoded files: a long queue keeps the disk busy while
  // faces are blended.
  const std::uint64_t room = memory_bytes - fixed_bytes - faces_held(faces_per_group_) * one_face;
  max_waiting_bytes_ = std::clamp(max_waiting_bytes_ + room / 2, max_waiting_bytes_,
                                  std::max(max_waiting_bytes_, FaceWriter::kMaxWaitingBytes));
}

/// Encodes, renders and judges faces, and passes their files to the writer. Thread-safe.
class FaceStages::Output {
 public:
  Output(const FaceStages& stages, const FaceFileLists& lists, const CrowdRenders* renders,
         FaceWriter& writer, StageTimes& busy)
      : stages_(stages),
        lists_(lists),
        finisher_{stages.textures_, stages.attachments_, stages.shapes_, &stages.encoders_,
                  renders},
        writer_(writer),
        busy_(busy) {}

  FaceResult make(const FacePlan& face, const Positions& positions) {
    throw_if_interrupted();
    FinishedFace finished(face, positions);
    finisher_.finish(finished, busy_);
    FaceResult result;
    std::vector<ReadyFile> ready;
    {
      const StageTimer timer(busy_.encode_seconds);
      for (FaceFile& file : lists_.all_files(face)) {
        EncodedFile bytes = file.make(finished);
        bytes.share_ownership(finished.textures);
        result.file_digests.push_back({bytes.size(), bytes.digest()});
        ready.push_back({std::move(file.path), std::move(bytes), result.file_digests.back()});
      }
    }
    result.skin_intersections = std::move(finished.skin_intersections);
    if (stages_.check_) {
      const StageTimer timer(busy_.check_seconds);
      result.skin_defects = stages_.builder_.defects(*stages_.check_, face.recipe, positions);
    }
    writer_.add({&face, result}, std::move(ready));
    return result;
  }

 private:
  const FaceStages& stages_;
  const FaceFileLists& lists_;
  FaceFinisher finisher_;
  FaceWriter& writer_;
  StageTimes& busy_;
};

void FaceStages::build(const FaceFileLists& lists, const CrowdRenders* renders,
                       const FaceLedger& ledger, std::span<const FacePlan* const> faces,
                       std::span<FaceResult* const> results, StageTimes& busy) const {
  lists.make_folders(faces);
  Progress progress("faces", faces.size());
  FaceWriter writer(ledger, max_waiting_bytes_, [&] { progress.step(); });
  Output output(*this, lists, renders, writer, busy);
  FaceMemory memory;
  std::array<FaceGroup, 2> groups;
  std::size_t turn = 0;
  for (std::size_t first = 0; first < faces.size(); first += faces_per_group_, turn ^= 1) {
    FaceGroup& group = groups[turn];
    group.wait();
    throw_if_interrupted();
    const std::size_t count = std::min(faces_per_group_, faces.size() - first);
    std::vector<const Recipe*> recipes;
    std::vector<Positions> positions;
    for (std::size_t f = 0; f < count; ++f) {
      recipes.push_back(&faces[first + f]->recipe);
      positions.push_back(memory.take());
    }
    {
      const StageTimer timer(busy.blend_seconds);
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
  busy.write_seconds += writer.busy_seconds();
}

}  // namespace crowdface
