// SPDX-License-Identifier: Apache-2.0
#include "crowdface/run/face_stages.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>

#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/interrupt.h"
#include "crowdface/core/memory.h"
#include "crowdface/core/parallel.h"
#include "crowdface/core/progress.h"
#include "crowdface/core/text.h"

namespace crowdface {
namespace {

/// Faces blended together at most: they share the reading of the fields, and by then blending is a small
/// part of what a face takes.
constexpr std::size_t kMostAtOnce = 32;
/// What rendering takes per vertex of a face while it runs: its triangles, normals and ray tree, and the
/// gallery's smaller mesh. 272 were measured on 1.2 million vertices.
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

std::uint64_t vertex_count(const Job& job) {
  return static_cast<std::uint64_t>(job.inputs.faces.topology.vertex_count);
}

/// What the inputs take.
std::uint64_t input_bytes(const Job& job) {
  return job.inputs.faces.heads.size() * vertex_count(job) * 3 * sizeof(double) +
         static_cast<std::uint64_t>(job.inputs.regions.alpha.size()) * sizeof(double) +
         kMeshBytesAVertex * vertex_count(job);
}

/// What all threads take while they make pictures.
std::uint64_t render_bytes(const Job& job) {
  if (!job.config.output.contact_sheet) return 0;
  return static_cast<std::uint64_t>(thread_count()) * kRenderBytesAVertex * vertex_count(job);
}

/// What the process holds whatever the number of faces at once.
std::uint64_t standing_bytes(const Job& job, const Prepared& prepared, const MeshWriters& writers) {
  std::uint64_t bytes = input_bytes(job);
  bytes += writers.memory_bytes();
  for (const StoredLevels& levels : prepared.levels) {
    if (!levels.mapped) bytes += levels.fields.size_bytes();
  }
  return bytes;
}

[[noreturn]] void refuse_memory(std::string_view least, std::uint64_t memory) {
  throw UsageError(concat("this job needs ", least, " of memory, ", format_bytes(memory),
                          " are allowed (--memory); fewer threads (--threads) need less"));
}

/// How many faces are blended together within the memory.
std::size_t faces_at_once(const Job& job, const Prepared& prepared, const FaceBuilder& builder,
                          const MeshWriters& writers, const SkinCheck* check,
                          std::uint64_t memory) {
  const auto threads = static_cast<std::uint64_t>(thread_count());
  const std::uint64_t work =
      render_bytes(job) +
      threads * (writers.encode_bytes() + (check != nullptr ? check->compare_bytes() : 0));
  const std::uint64_t standing = standing_bytes(job, prepared, writers) + work +
                                 (check != nullptr ? check->memory_bytes() : 0);
  const std::uint64_t least = standing + 2 * builder.bytes(1);
  if (least > memory) {
    refuse_memory(format_bytes(least), memory);
  }
  const std::uint64_t fit = (memory - standing) / (2 * builder.bytes(1));
  return static_cast<std::size_t>(std::min<std::uint64_t>(fit, kMostAtOnce));
}

/// Encodes, writes and renders one face after the other, on any thread.
class FaceOutput {
 public:
  FaceOutput(const MeshWriters& writers, const CrowdDirectory& directory,
             const CrowdRenders* renders, const SkinCheck* check, const FaceLedger& ledger)
      : writers_(writers),
        directory_(directory),
        renders_(renders),
        check_(check),
        ledger_(ledger) {}

  FaceFiles write(const CastFace& face, const Positions& positions) {
    throw_if_interrupted();
    FaceFiles files;
    std::vector<EncodedMesh> meshes;
    {
      const Busy busy(encode_);
      meshes = writers_.encode(face, positions);
    }
    {
      const Busy busy(write_);
      for (const EncodedMesh& mesh : meshes) {
        files.meshes.push_back(write_mesh(mesh, directory_.mesh(face.id, mesh.format)));
      }
    }
    if (renders_ != nullptr) {
      const Busy busy(render_);
      const WrittenPictures written =
          renders_->write(directory_, face.id, face.recipe.target, positions);
      files.picture = written.picture;
      files.preview = written.preview;
    }
    if (check_ != nullptr) {
      const Busy busy(check_seconds_);
      files.skin = check_->compare(positions, face.recipe.target);
    }
    ledger_.record(face, files);
    return files;
  }

  void add_to(StageBusy& busy) const {
    busy.encode += encode_;
    busy.write += write_;
    busy.render += render_;
    busy.check += check_seconds_;
  }

 private:
  const MeshWriters& writers_;
  const CrowdDirectory& directory_;
  const CrowdRenders* renders_;
  const SkinCheck* check_;
  const FaceLedger& ledger_;
  std::atomic<double> encode_ = 0, write_ = 0, render_ = 0, check_seconds_ = 0;
};

/// A group of faces in memory, and what is still being done with it.
struct Slot {
  std::vector<Positions> positions;
  BackgroundTasks tasks;  // after what it uses, so that it ends first
};

}  // namespace

void refuse_too_little_memory(const Job& job, std::uint64_t memory) {
  const std::uint64_t least = input_bytes(job) + render_bytes(job);
  if (least > memory) refuse_memory(concat("more than ", format_bytes(least)), memory);
}

FaceStages::FaceStages(const Job& job, const Prepared& prepared, const std::vector<CastFace>& crowd,
                       std::uint64_t memory)
    : writes_meshes_(!job.config.output.meshes.empty()),
      writers_(job.config, job.inputs, job.config.output.meshes, crowd),
      builder_(job, prepared),
      check_(skin_check(job, crowd)),
      at_once_(faces_at_once(job, prepared, builder_, writers_, check_.get(), memory)) {}

BuiltFaces FaceStages::build(const CrowdDirectory& directory, const CrowdRenders* renders,
                             const FaceLedger& ledger, const std::vector<CastFace>& faces) const {
  BuiltFaces built;
  built.files.resize(faces.size());
  if (writes_meshes_) make_directories(directory.meshes());
  if (renders != nullptr) renders->make_folders(directory);

  FaceOutput output(writers_, directory, renders, check_.get(), ledger);
  std::atomic<double> blend_seconds = 0;
  Progress progress("faces", faces.size());
  std::array<Slot, 2> slots;
  std::size_t turn = 0;
  for (std::size_t first = 0; first < faces.size(); first += at_once_, turn ^= 1) {
    Slot& slot = slots[turn];
    slot.tasks.wait();
    throw_if_interrupted();
    const std::size_t count = std::min(at_once_, faces.size() - first);
    std::vector<const Recipe*> recipes;
    for (std::size_t f = 0; f < count; ++f) recipes.push_back(&faces[first + f].recipe);
    slot.positions.resize(count);
    {
      const Busy busy(blend_seconds);
      builder_.build(recipes, slot.positions);
    }
    for (std::size_t f = 0; f < count; ++f) {
      slot.tasks.run([&, f, first, positions = &slot.positions[f]] {
        built.files[first + f] = output.write(faces[first + f], *positions);
        progress.step();
      });
    }
  }
  for (Slot& slot : slots) slot.tasks.wait();
  output.add_to(built.busy);
  built.busy.blend = blend_seconds;
  return built;
}

}  // namespace crowdface
