// SPDX-License-Identifier: Apache-2.0
#include "crowdface/run/generate.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <system_error>
#include <utility>

#include "crowdface/config/config_writer.h"
#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/interrupt.h"
#include "crowdface/core/log.h"
#include "crowdface/core/memory.h"
#include "crowdface/core/parallel.h"
#include "crowdface/core/progress.h"
#include "crowdface/core/text.h"
#include "crowdface/crowd/crowd_lock.h"
#include "crowdface/crowd/ledger.h"
#include "crowdface/io/material_files.h"
#include "crowdface/pictures/sheets.h"
#include "crowdface/run/casting.h"
#include "crowdface/run/casting_report.h"
#include "crowdface/run/crowd_sheets.h"
#include "crowdface/run/face_ledger.h"
#include "crowdface/run/face_stages.h"
#include "crowdface/run/mesh_judge.h"
#include "crowdface/run/mesh_writers.h"
#include "crowdface/run/output_check.h"
#include "crowdface/run/report.h"
#include "crowdface/run/resume.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;

/// Runs one stage and notes how long it took.
template <class Work>
auto timed(StageSeconds& stages, const char* stage, const Work& work) {
  const auto start = std::chrono::steady_clock::now();
  const auto note = [&] {
    stages.emplace_back(
        stage, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  };
  if constexpr (std::is_void_v<decltype(work())>) {
    work();
    note();
  } else {
    auto result = work();
    note();
    return result;
  }
}

/// The log of a crowd stands in its folder, for as long as the run lasts.
class CrowdLog {
 public:
  explicit CrowdLog(const fs::path& path) { add_log_file(path); }
  ~CrowdLog() { close_log_file(); }
  CrowdLog(const CrowdLog&) = delete;
  CrowdLog& operator=(const CrowdLog&) = delete;
};

/// A warning of faces that pass for one of the heads, if there are any that were drawn.
std::optional<std::string> near_heads(const Cast& cast, const std::vector<std::string>& heads) {
  constexpr double kSamePersonMm = 0.5;  // docs/casting.md
  constexpr std::size_t kMostNamed = 8;
  std::vector<std::string> near;
  for (const CastFace& face : cast.crowd) {
    if (!face.index || !face.notes.nearest || face.notes.nearest->head_mm >= kSamePersonMm)
      continue;
    near.push_back(concat(face.id, " (", heads[static_cast<std::size_t>(face.notes.nearest->head)],
                          ", ", format_fixed(face.notes.nearest->head_mm, 2), " mm)"));
  }
  if (near.empty()) return std::nullopt;
  const std::size_t count = near.size();
  near.resize(std::min(count, kMostNamed));
  return concat(count, count == 1 ? " face passes" : " faces pass",
                " for one of the heads: ", join(near), count > kMostNamed ? ", …" : "",
                "; diversity.min_distance_to_faces keeps faces away from them");
}

/// What the crowd is like, in two lines.
void tell_casting(const Cast& cast, const std::vector<std::string>& heads) {
  const CrowdDistances& distances = cast.distances;
  const auto mm = [](double value) { return format_fixed(value, 2); };
  if (distances.crowd.count > 0) {
    log_info(concat("distances between faces: closest ", mm(distances.crowd.min), " mm, median ",
                    mm(distances.crowd.median), " mm; between the input heads: closest ",
                    mm(distances.heads.min), " mm, median ", mm(distances.heads.median),
                    " mm; ratio of the medians ", mm(distances.ratio)));
  }
  std::vector<std::string> thrown;
  for (std::size_t r = 0; r < kReasonCount; ++r) {
    const std::uint64_t count = cast.rejections.count[r];
    if (count > 0) thrown.push_back(concat(count, " for ", name_of(static_cast<Reason>(r))));
  }
  if (!thrown.empty()) log_info(concat("candidates thrown away: ", join(thrown)));
  if (const auto text = near_heads(cast, heads)) log_warning(*text);
}

/// Prepared heads and the crowd cast from them.
struct CastJob {
  Prepared prepared;
  Cast cast;
};

/// Everything that comes before a file is written: a crowd that cannot be cast leaves nothing
/// behind, and no other crowd in the folder is touched for it.
CastJob cast_job(const Job& job, const GenerateOptions& options, StageSeconds& stages) {
  check_output(job, options.replace);
  Prepared prepared = timed(stages, "prepare", [&] {
    return prepare(job.config, job.inputs, job.smoothing, options.cache);
  });
  Cast crowd = timed(stages, "cast", [&] { return cast(job, prepared); });
  tell_casting(crowd, job.names.heads);
  check_compared_crowd(job.config, crowd.crowd);
  return {std::move(prepared), std::move(crowd)};
}

/// \param write  takes a path in the crowd's folder and the file's bytes.
template <class Write>
void write_plan(const Job& job, const CrowdDirectory& directory, const Cast& cast,
                const Write& write) {
  const std::string plan = format_plan(job, cast.crowd);
  remove_report_of_other_plan(directory, plan);
  write(directory.plan(), plan);
  write(directory.table(), format_csv(cast.crowd, job.names));
  if (!cast.founders.empty()) write(directory.founders(), format_founders(job, cast.founders));
  write(directory.casting(), format_casting(job, cast));
}

/// Copies material files and textures of all heads that are targets. \return warnings, each once
/// with the heads it is about.
std::vector<std::string> copy_materials(const Job& job, const CrowdDirectory& directory,
                                        const std::vector<CastFace>& crowd, Ledger& ledger) {
  std::set<Index> targets;
  for (const CastFace& face : crowd) targets.insert(face.recipe.target);
  std::map<std::string, std::vector<std::string>> heads_of_warning;
  // Heads of one folder mostly share these files: each is read once.
  std::map<std::pair<fs::path, std::vector<std::string>>, MaterialFiles> known;
  std::map<fs::path, Digest> read, copied;
  for (const Index target : targets) {
    const ObjFile& file = job.inputs.files[static_cast<std::size_t>(target)];
    const std::string& head = job.names.heads[static_cast<std::size_t>(target)];
    const auto [found, is_unknown] =
        known.try_emplace({file.path.parent_path(), file.material_libraries});
    if (is_unknown) found->second = find_material_files(file.path, file.material_libraries);
    for (const std::string& warning : found->second.warnings) {
      heads_of_warning[warning].push_back(head);
    }
    for (const MaterialFile& material : found->second.files) {
      throw_if_interrupted();
      const auto [digest, is_unread] = read.try_emplace(material.from);
      if (is_unread) digest->second = hash_file(material.from).digest;
      const auto [first, is_new] = copied.emplace(material.relative, digest->second);
      if (is_new) {
        const fs::path to = directory.meshes() / material.relative;
        refuse_folder_elsewhere(directory, to.parent_path());
        make_directories(to.parent_path());
        ledger.write(directory.relative(to), MappedFile(material.from).bytes());
      } else if (first->second != digest->second) {
        heads_of_warning[concat(material.relative.string(),
                                " is not the same file for all heads; the first head's is kept")]
            .push_back(head);
      }
    }
  }
  std::vector<std::string> warnings;
  for (const auto& [warning, heads] : heads_of_warning) {
    warnings.push_back(concat(warning, " (", join(heads), ")"));
    log_warning(warnings.back());
  }
  return warnings;
}

std::uint64_t face_count(const Config& config) {
  std::uint64_t faces = config.crowd.count + config.recipes.size();
  for (const FamilyOptions& family : config.families) {
    faces += static_cast<std::uint64_t>(family.members);
  }
  return faces;
}

/// \param with_faces  false: only the plan is wanted
void tell_dry_run(const Job& job, bool with_faces) {
  const Config& config = job.config;
  const std::uint64_t faces = face_count(config);
  if (!with_faces) {
    log_info(concat("dry run: a plan of ", faces, " faces into ", config.output.directory.string(),
                    "; nothing was written"));
    return;
  }
  const std::uint64_t bytes = faces * estimate_mesh_bytes(job.inputs, config.output.meshes);
  log_info(concat("dry run: ", faces, " faces of ", job.inputs.faces.topology.vertex_count,
                  " vertices, about ", format_fixed(static_cast<double>(bytes) / 1e6, 1),
                  " MB of meshes, ", config.output.contact_sheet ? faces : 0, " renders into ",
                  config.output.directory.string(), "; nothing was written"));
}

/// What a run over a crowd is for.
enum class Purpose {
  kGenerate,  ///< build what is missing
  kGather,    ///< refuse if a face is missing
};

/// What the whole process may take, in bytes.
std::uint64_t memory_for(const GenerateOptions& options) {
  return options.memory > 0 ? options.memory : machine_memory() / 4 * 3;
}

/// What makes a crowd's faces, from when it is first needed.
class LazyStages {
 public:
  /// \param memory  bytes that the whole process may take
  LazyStages(const Job& job, const CastJob& crowd, std::uint64_t memory)
      : job_(job), crowd_(crowd), memory_(memory) {}

  /// \throws UsageError if they do not fit the memory.
  const FaceStages& get() {
    if (!stages_) stages_.emplace(job_, crowd_.prepared, crowd_.cast.crowd, memory_);
    return *stages_;
  }
  /// Frees what they hold.
  void release() { stages_.reset(); }

 private:
  const Job& job_;
  const CastJob& crowd_;
  std::uint64_t memory_;
  std::optional<FaceStages> stages_;
};

/// Builds the faces that are not done; their files take their places in `so_far`.
/// \return how long threads were busy.
StageBusy build_missing(const CrowdDirectory& directory, const std::vector<CastFace>& crowd,
                        const FaceLedger& ledger, LazyStages& face_stages, LazyPictures& pictures,
                        FacesSoFar& so_far) {
  if (so_far.todo.empty()) return {};
  std::vector<CastFace> faces;
  for (const std::size_t i : so_far.todo) faces.push_back(crowd[i]);
  const CrowdRenders* renders = pictures.wanted() ? &pictures.get().renders() : nullptr;
  BuiltFaces built = face_stages.get().build(directory, renders, ledger, faces);
  for (std::size_t f = 0; f < faces.size(); ++f) {
    so_far.files[so_far.todo[f]] = std::move(built.files[f]);
  }
  return built.busy;
}

/// Everything after the crowd is cast and the folder is ready.
void fill_directory(const Job& job, const CrowdDirectory& directory, const CastJob& cast_job,
                    const GenerateOptions& options, Purpose purpose, LazyStages& face_stages,
                    StageSeconds& stages) {
  const Prepared& prepared = cast_job.prepared;
  const std::vector<CastFace>& crowd = cast_job.cast.crowd;
  Ledger ledger(directory.root, directory.ledger(options.shard), directory.ledgers());
  const auto write = [&](const fs::path& path, std::string_view bytes) {
    ledger.write(directory.relative(path), bytes);
  };
  write(directory.config(), effective_config(job.config, directory.root));
  write_plan(job, directory, cast_job.cast, write);

  const auto& formats = job.config.output.meshes;
  const auto& sheet = job.config.output.contact_sheet;
  const bool judged = skin_is_judged(job);
  const FaceLedger face_ledger(ledger, job, directory,
                               {sheet.has_value(), has_gallery(job.config), judged});
  FacesSoFar so_far = find_done_faces(face_ledger, crowd, options.shard);
  const std::size_t built = so_far.todo.size();
  if (purpose == Purpose::kGather) refuse_missing_faces(directory, crowd, so_far.todo);

  std::vector<std::string> warnings = job.inputs.warnings;
  if (auto text = near_heads(cast_job.cast, job.names.heads)) warnings.push_back(std::move(*text));
  if (std::find(formats.begin(), formats.end(), MeshFormat::kObj) != formats.end()) {
    for (std::string& text : copy_materials(job, directory, crowd, ledger)) {
      warnings.push_back(std::move(text));
    }
  }
  write_shared_arrays(job, directory, ledger);
  LazyPictures pictures(job, directory);
  const StageBusy busy = timed(stages, "build", [&] {
    return build_missing(directory, crowd, face_ledger, face_stages, pictures, so_far);
  });
  face_stages.release();  // sheets need the memory
  if (!options.shard.whole()) {
    log_info(concat("shard ", options.shard.name(), ": ", built, built == 1 ? " face" : " faces",
                    " built; when all shards are done: crowdface gather ",
                    directory.root.string()));
    return;
  }
  for (std::string& text : judge_meshes(job, crowd, so_far.files)) {
    warnings.push_back(std::move(text));
  }
  std::size_t pages = 0;
  if (sheet && !crowd.empty()) {
    pages = timed(stages, "sheets", [&] {
      return make_sheets(job, directory, prepared, cast_job.cast, so_far.files, pictures, ledger);
    });
  }
  write(directory.report(),
        format_report(job, prepared, cast_job.cast, so_far.files, pages, warnings));
  ledger.settle();
  gather_logs(directory);
  write_file(directory.timings(), format_timings(stages, busy, built, prepared.from_cache));
  log_info(
      concat(crowd.size(), crowd.size() == 1 ? " face" : " faces", " in ", directory.root.string(),
             built < crowd.size() ? concat(", ", crowd.size() - built, " of them done before") : "",
             pages > 0 ? concat("; contact sheet: ", directory.sheet(1).string()) : ""));
}

/// Whether a run before this one may have made all its faces.
bool goes_on(const CrowdDirectory& directory, const Shard& shard) {
  std::error_code ignored;
  if (fs::exists(directory.ledger(), ignored)) return true;
  return shard.whole() ? !directory.shard_ledgers().empty()
                       : fs::exists(directory.ledger(shard), ignored);
}

/// Whether it is certain that faces will be made: a crowd that goes on may have none to make; a new
/// one is refused before anything is written.
bool makes_faces(const Job& job, const CrowdDirectory& directory, const GenerateOptions& options) {
  const bool is_new = options.replace == Replace::kForce || !goes_on(directory, options.shard);
  return is_new && face_count(job.config) > 0;
}

/// Casts the crowd and fills its folder, as far as that is not done.
void run_job(const Job& job, const GenerateOptions& options, Purpose purpose,
             const LogMemory& memory, StageSeconds& stages) {
  const CrowdDirectory directory{job.config.output.directory};
  const bool is_new = purpose == Purpose::kGenerate && makes_faces(job, directory, options);
  if (is_new) refuse_too_little_memory(job, memory_for(options));
  const CastJob crowd = cast_job(job, options, stages);
  LazyStages face_stages(job, crowd, memory_for(options));
  if (is_new && !crowd.cast.crowd.empty()) timed(stages, "setup", [&] { face_stages.get(); });
  const CrowdLock lock(directory, options.shard);
  refuse_other_heads(job, directory, options.replace);  // another run may have come before this one
  open_crowd_directory(directory, crowd_config(job, directory), options.replace);
  const CrowdLog log(directory.log(options.shard));
  memory.replay();
  try {
    fill_directory(job, directory, crowd, options, purpose, face_stages, stages);
  } catch (const std::exception& error) {
    log_debug(error.what());  // `main` says it aloud, when this log is closed
    throw;
  }
}

}  // namespace

void generate(const fs::path& config_file, const ConfigOverrides& overrides,
              const GenerateOptions& options) {
  if (!options.shard.whole() && options.replace == Replace::kForce) {
    throw UsageError(
        "--force does not go with --shard, as one shard would remove what another made; replace "
        "the old crowd with crowdface plan --force first");
  }
  const LogMemory memory;  // the crowd's log is opened once there is a crowd
  StageSeconds stages;
  const Job job = timed(stages, "read", [&] { return load_job(config_file, overrides); });
  if (options.dry_run) {
    check_output(job, options.replace);
    if (makes_faces(job, CrowdDirectory{job.config.output.directory}, options)) {
      refuse_too_little_memory(job, memory_for(options));
    }
    return tell_dry_run(job, true);
  }
  run_job(job, options, Purpose::kGenerate, memory, stages);
}

void gather(const fs::path& crowd_directory, const fs::path& cache) {
  const CrowdDirectory directory{crowd_directory};
  const LogMemory memory;
  StageSeconds stages;
  const Job job = timed(stages, "read", [&] { return load_job(directory.config(), {}); });
  GenerateOptions options;
  options.cache = cache;
  run_job(job, options, Purpose::kGather, memory, stages);
}

void plan(const fs::path& config_file, const ConfigOverrides& overrides,
          const GenerateOptions& options) {
  const Job job = load_job(config_file, overrides);
  if (options.dry_run) {
    check_output(job, options.replace);
    return tell_dry_run(job, false);
  }
  const CrowdDirectory directory{job.config.output.directory};
  StageSeconds stages;
  const CastJob crowd = cast_job(job, options, stages);
  const CrowdLock lock(directory, {});
  refuse_other_heads(job, directory, options.replace);
  open_crowd_directory(directory, crowd_config(job, directory), options.replace);
  write_plan(job, directory, crowd.cast,
             [](const fs::path& path, std::string_view bytes) { write_file(path, bytes); });
  log_info(concat(crowd.cast.crowd.size(), " recipes in ", directory.plan().string()));
}

}  // namespace crowdface
