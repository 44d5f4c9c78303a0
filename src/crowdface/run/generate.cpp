// SPDX-License-Identifier: Apache-2.0
#include "crowdface/run/generate.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <future>
#include <memory>
#include <utility>

#include "crowdface/core/contains.h"
#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/interrupt.h"
#include "crowdface/core/log.h"
#include "crowdface/core/memory.h"
#include "crowdface/core/parallel.h"
#include "crowdface/core/progress.h"
#include "crowdface/core/text.h"
#include "crowdface/crowd/crowd_lock.h"
#include "crowdface/crowd/crowd_table.h"
#include "crowdface/crowd/ledger.h"
#include "crowdface/heads/face_attachments.h"
#include "crowdface/heads/face_shapes.h"
#include "crowdface/heads/face_textures.h"
#include "crowdface/pictures/face_comparison.h"
#include "crowdface/pictures/sheets.h"
#include "crowdface/run/casting.h"
#include "crowdface/run/casting_report.h"
#include "crowdface/run/copy_materials.h"
#include "crowdface/run/crowd_sheets.h"
#include "crowdface/run/face_ledger.h"
#include "crowdface/run/face_stages.h"
#include "crowdface/run/lazy.h"
#include "crowdface/run/mesh_encoder.h"
#include "crowdface/run/mesh_judge.h"
#include "crowdface/run/output_check.h"
#include "crowdface/run/overridden_plan.h"
#include "crowdface/run/planned.h"
#include "crowdface/run/report.h"
#include "crowdface/run/resume.h"
#include "crowdface/run/shard_progress.h"
#include "crowdface/run/usd_stage.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;

/// Runs one stage and records its duration.
template <class Work>
auto timed(StageSeconds& stages, const char* stage, const Work& work) {
  const auto start = std::chrono::steady_clock::now();
  auto result = work();
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  stages.emplace_back(stage, took.count());
  return result;
}

/// Writes the log into the crowd's folder during the lifetime of this object.
class CrowdLog {
 public:
  explicit CrowdLog(const fs::path& path) { add_log_file(path); }
  ~CrowdLog() { close_log_file(); }
  CrowdLog(const CrowdLog&) = delete;
  CrowdLog& operator=(const CrowdLog&) = delete;
};

/// The plan of a crowd, and the objects that build the faces of this crowd.
struct PlannedJob {
  PlannedJob(const Job& job, PreparedHeads heads)
      : prepared(std::move(heads)),
        builder([&job, this] {
          return std::make_unique<FaceBuilder>(job.config, job.inputs, prepared);
        }),
        textures([&job] { return std::make_unique<FaceTextures>(job.config, job.inputs); }),
        attachments(job.config, job.inputs),
        shapes([&job] { return std::make_unique<FaceShapes>(job.config, job.inputs); }) {}

  PreparedHeads prepared;
  Lazy<FaceBuilder> builder;
  Lazy<FaceTextures> textures;
  FaceAttachments attachments;
  Lazy<FaceShapes> shapes;
  CrowdPlan crowd_plan;
  std::vector<std::string> warnings;  ///< warnings about the cast crowd; empty for a shard's faces
  nlohmann::ordered_json casting;     ///< content of casting.json; null for a shard's faces
  /// The files from which `crowd_plan` was read; empty if this run cast the crowd. If a shard reads
  /// the plan, `crowd_plan` holds only the shard's faces.
  std::vector<LedgerEntry::File> plan_files;
  bool planned() const { return !plan_files.empty(); }
  /// For each face: the colour of the skin just above the ring of vertices at the neck. Empty if
  /// there is no neck or faces have no colours.
  std::vector<Eigen::Array3d> neck_colours(const Job& job) {
    std::vector<Eigen::Array3d> colours;
    if (!job.inputs.heads_on_body) return colours;
    for (const FacePlan& face : crowd_plan.crowd) {
      const auto colour = textures.get().seam_colour(face.recipe);
      if (!colour) break;
      colours.push_back(*colour);
    }
    return colours;
  }
};

PreparedHeads prepare_for(const Job& job, const GenerateOptions& options, StageSeconds& stages) {
  return timed(stages, "prepare",
               [&] { return prepare(job.config, job.inputs, job.smoothing, options.cache); });
}

/// Returns the warnings that depend only on the config and the plan.
std::vector<std::string> casting_warnings(const Job& job, const CrowdPlan& crowd_plan) {
  std::vector<std::string> warnings = warnings_about_faces_near_heads(crowd_plan, job.names.heads);
  for (std::string& text : overridden_plan_warnings(job.config, crowd_plan.crowd)) {
    warnings.push_back(std::move(text));
  }
  return warnings;
}

/// Reads the crowd, or a shard's faces, from the folder's plan.
/// \return null if the folder has no complete plan of this job and `options.plan_source` allows
///         casting.
/// \throws MissingInput if the folder has no complete plan of this job and `options.plan_source`
///         does not allow casting.
std::unique_ptr<PlannedJob> planned_job(const Job& job, const GenerateOptions& options,
                                        StageSeconds& stages) {
  const CrowdDirectory directory = crowd_directory_of(job.config);
  auto planned = read_planned_faces(job, directory, options.shard);
  if (!planned) {
    if (options.plan_source == PlanSource::kFolderOrCasting) return nullptr;
    throw MissingInput(
        concat(directory.plan_marker().string(),
               ": does not record a complete plan of this config; run crowdface plan first"));
  }
  auto crowd = std::make_unique<PlannedJob>(job, prepare_for(job, options, stages));
  crowd->plan_files = std::move(planned->files);
  if (options.shard.is_whole_crowd()) {
    crowd->crowd_plan = timed(stages, "cast", [&] {
      return restore_crowd_plan(job, directory, crowd->prepared, std::move(planned->faces),
                                options.cache);
    });
    crowd->casting = nlohmann::ordered_json::parse(read_file(directory.casting()));
    crowd->warnings = casting_warnings(job, crowd->crowd_plan);
    check_compared_crowd(job.config, crowd->crowd_plan.crowd);
    log_info("using the plan in the folder");
  } else {
    crowd->crowd_plan.crowd = std::move(planned->faces);
    log_info(concat("using the plan in the folder; ", crowd->crowd_plan.crowd.size(),
                    " of its faces belong to shard ", options.shard.name()));
  }
  return crowd;
}

/// Prepares heads and casts the crowd. Runs before any file is written. A crowd that cannot be cast
/// therefore neither leaves files nor destroys another crowd in the folder.
std::unique_ptr<PlannedJob> cast_job(const Job& job, const GenerateOptions& options,
                                     StageSeconds& stages) {
  auto crowd = std::make_unique<PlannedJob>(job, prepare_for(job, options, stages));
  crowd->crowd_plan = timed(stages, "cast", [&] {
    return plan_crowd(
        job.config, job.inputs, crowd->prepared,
        [&]() -> const FaceBuilder& { return crowd->builder.get(); }, crowd->attachments,
        options.cache);
  });
  log_casting(crowd->crowd_plan);
  crowd->warnings = casting_warnings(job, crowd->crowd_plan);
  for (std::string& text : population_warnings(crowd->crowd_plan.traits)) {
    crowd->warnings.push_back(std::move(text));
  }
  for (const std::string& text : crowd->warnings) log_warning(text);
  check_compared_crowd(job.config, crowd->crowd_plan.crowd);
  crowd->casting = casting_to_json(job.config, crowd->crowd_plan);
  return crowd;
}

/// Logs how much a run would write. \param inputs  null if only a plan is requested
void log_dry_run(const Config& config, const Inputs* inputs) {
  const std::uint64_t faces = face_count(config);
  if (inputs == nullptr) {
    log_info(concat("dry run: a plan of ", faces, " faces into ", config.output.directory.string(),
                    "; nothing was written"));
    return;
  }
  const std::uint64_t bytes = faces * estimate_mesh_bytes(*inputs, config.output.meshes);
  log_info(concat("dry run: ", faces, " faces of ", inputs->head_set.topology.vertex_count,
                  " vertices, about ", format_fixed(static_cast<double>(bytes) / 1e6, 1),
                  " MB of meshes, ", config.output.contact_sheet ? faces : 0, " renders into ",
                  config.output.directory.string(), "; nothing was written"));
}

/// What a run over a crowd does about missing faces.
enum class Purpose {
  kGenerate,  ///< the run builds missing faces
  kGather,    ///< the run fails if a face is missing
};

/// Maximum memory of the process, in bytes.
std::uint64_t memory_for(const GenerateOptions& options) {
  return options.memory_bytes > 0 ? options.memory_bytes : usable_memory_bytes() / 4 * 3;
}

/// Runs all stages after casting. The folder must already be prepared for this crowd. \return a
/// summary for the user.
std::string fill_directory(const Job& job, const CrowdDirectory& directory, PlannedJob& planned,
                           const GenerateOptions& options, Purpose purpose,
                           Lazy<CrowdPictures>& pictures, Lazy<FaceStages>& face_stages,
                           StageSeconds& stages, std::optional<ShardProgress>& progress) {
  const CrowdPlan& crowd_plan = planned.crowd_plan;
  const std::vector<FacePlan>& crowd = crowd_plan.crowd;
  Ledger ledger(directory.root, directory.ledger(options.shard),
                relevant_ledgers(directory, options.shard));
  ledger.write(directory.relative(directory.config()), stored_config_text(job.config, directory));
  const auto write = [&](const fs::path& path, const TextPieces& text) {
    return ledger.write(directory.relative(path), text);
  };
  const std::vector<Eigen::Array3d> neck_colours = planned.neck_colours(job);
  if (planned.planned()) {
    for (const LedgerEntry::File& file : planned.plan_files) ledger.record_existing(file);
    if (options.shard.is_whole_crowd()) {
      write(directory.table(),
            table_text(crowd, job.names, neck_colours, head_tags_and_attachment_kinds(job.config)));
    }
  } else {
    write_plan(job, directory, crowd_plan, planned.casting, neck_colours, write);
  }
  const bool has_whole_crowd = options.shard.is_whole_crowd() || !planned.planned();

  const auto& sheet = job.config.output.contact_sheet;
  const FaceFileLists lists(job.config, job.inputs, directory);
  const FaceLedger face_ledger(ledger, job, lists, [&] {
    if (progress) progress->step();
  });
  const Shard asked_for = has_whole_crowd ? options.shard : Shard();
  FaceProgress so_far = timed(stages, "check", [&] {
    if (purpose == Purpose::kGenerate) return find_done_faces(face_ledger, crowd, asked_for);
    Progress checking("checking faces", crowd.size());
    return find_done_faces(face_ledger, crowd, asked_for, [&] { checking.step(); });
  });
  const std::size_t built = so_far.missing_faces.size();
  if (purpose == Purpose::kGather) require_all_faces(directory, crowd, so_far.missing_faces);
  if (!options.shard.is_whole_crowd()) {
    progress.emplace(directory.progress(options.shard), so_far.shard_face_count,
                     so_far.shard_face_count - built);
  }

  std::vector<std::string> warnings = job.inputs.warnings;
  const auto warn = [&](const std::vector<std::string>& more) {
    warnings.insert(warnings.end(), more.begin(), more.end());
  };
  warn(planned.warnings);
  // Material files are copied while faces are built, because most of the copying waits for the disk
  std::future<std::vector<std::string>> copying;
  if (has_whole_crowd) {
    copying = std::async(std::launch::async, [&] {
      return copy_materials(job.config, job.inputs, directory, crowd, ledger);
    });
  }
  if (has_whole_crowd && contains(job.config.output.meshes, MeshFormat::kUsd)) {
    ledger.write(directory.relative(directory.stage()),
                 make_usd_stage_text(job.config, job.inputs, crowd));
  }
  write_shared_files(job.config, job.inputs, directory, ledger);
  StageTimes busy;
  timed(stages, "build", [&] {
    if (built == 0) return built;
    const CrowdRenders* renders = sheet ? &pictures.get().renders() : nullptr;
    BackgroundTasks beside;
    if (renders != nullptr && options.shard.is_whole_crowd()) {
      beside.run([&] { pictures.get().write_heads(); });
    }
    std::vector<const FacePlan*> faces;
    std::vector<FaceResult*> results;
    for (const std::size_t i : so_far.missing_faces) {
      faces.push_back(&crowd[i]);
      results.push_back(&so_far.faces[i]);
    }
    face_stages.get().build(lists, renders, face_ledger, faces, results, busy);
    beside.wait();
    return built;
  });
  if (copying.valid()) warn(copying.get());
  face_stages.release();
  if (!options.shard.is_whole_crowd()) {
    ledger.require_files();
    progress->end(ShardState::kDone);
    return concat("shard ", options.shard.name(), ": ", built, built == 1 ? " face" : " faces",
                  " built; when all shards are done: crowdface gather ", directory.root.string());
  }
  warn(mesh_warnings(*job.config.believability, crowd, so_far.faces));
  std::size_t pages = 0;
  if (sheet && !crowd.empty()) {
    pages = timed(stages, "sheets", [&] {
      return make_sheets(job, directory, crowd_plan, so_far.faces, planned.builder, pictures,
                         ledger);
    });
  }
  write(directory.report(), report_text(job, planned.prepared, crowd_plan, planned.casting, lists,
                                        so_far.faces, neck_colours, pages, warnings));
  ledger.compact();
  gather_logs(directory);
  remove_shard_files(directory);
  write_file(directory.timings(),
             format_timings(stages, busy, built, planned.prepared.cached_head_count));
  ledger.require_files();
  return concat(
      crowd.size(), crowd.size() == 1 ? " face" : " faces", " in ", directory.root.string(),
      built < crowd.size() ? concat(", ", crowd.size() - built, " of them done before") : "",
      pages > 0 ? concat("; contact sheet: ", directory.sheet(1).string()) : "");
}

/// Whether an earlier run may have made all faces of this shard.
bool may_be_complete(const CrowdDirectory& directory, const Shard& shard) {
  return path_exists(directory.ledger()) ||
         (shard.is_whole_crowd() ? !directory.shard_ledgers().empty()
                                 : path_exists(directory.ledger(shard)));
}

/// Whether this run is certain to make faces. A resumed crowd may already be complete, and a new
/// crowd can be rejected before anything is written.
bool makes_faces(const Config& config, const GenerateOptions& options) {
  const CrowdDirectory directory = crowd_directory_of(config);
  const bool is_new =
      options.replace == Replace::kForce || !may_be_complete(directory, options.shard);
  return is_new && face_count(config) > 0;
}

/// Casts the crowd and writes all files into its folder. Skips work that an earlier run finished.
void run_job(const Job& job, const GenerateOptions& options, Purpose purpose,
             const LogBuffer& memory, StageSeconds& stages) {
  const CrowdDirectory directory = crowd_directory_of(job.config);
  check_output(job, options.replace);
  const bool is_new = purpose == Purpose::kGenerate && makes_faces(job.config, options);
  if (is_new) refuse_too_little_memory(job.config, job.inputs, memory_for(options));
  std::unique_ptr<PlannedJob> crowd;
  if (options.replace == Replace::kRefuse) crowd = planned_job(job, options, stages);
  if (!crowd) crowd = cast_job(job, options, stages);
  Lazy<CrowdPictures> pictures([&] {
    return std::make_unique<CrowdPictures>(job.config, job.inputs, job.settings, directory,
                                           crowd->textures.get(), crowd->shapes.get());
  });
  Lazy<FaceStages> face_stages([&] {
    BackgroundTasks beside;
    beside.run([&] { crowd->textures.get(); });
    crowd->attachments.bind(crowd->crowd_plan.crowd);
    beside.wait();
    // Lazy is not thread-safe, so make the shapes before the task starts, which reads them, too.
    const FaceShapes& shapes = crowd->shapes.get();
    if (job.config.output.contact_sheet) beside.run([&] { pictures.get(); });
    auto made = std::make_unique<FaceStages>(
        job.config, job.inputs, crowd->prepared, crowd->builder.get(), crowd->textures.get(),
        crowd->attachments, shapes, crowd->crowd_plan.crowd, memory_for(options));
    beside.wait();
    return made;
  });
  if (is_new && !crowd->crowd_plan.crowd.empty())
    timed(stages, "setup", [&] { return &face_stages.get(); });
  const CrowdLock lock(directory, options.shard);
  prepare_output_folder(job, options.replace);
  const CrowdLog log(directory.log(options.shard));
  memory.replay();
  std::optional<ShardProgress> progress;
  try {
    const std::string done = fill_directory(job, directory, *crowd, options, purpose, pictures,
                                            face_stages, stages, progress);
    lock.require_same_folder();
    log_info(done);
  } catch (const std::exception& error) {
    if (progress) {
      progress->end(is_interrupted() ? ShardState::kInterrupted : ShardState::kFailed,
                    error.what());
    }
    log_debug(error.what());  // `main` reports the error after this log is closed
    throw;
  }
}

/// Reads the job and runs it. \param load  returns the job
template <class Load>
void generate_loaded(const Load& load, const GenerateOptions& options) {
  if (!options.shard.is_whole_crowd() && options.replace == Replace::kForce) {
    throw UsageError(
        "--force cannot be combined with --shard, because one shard would remove the files of "
        "another; replace the old crowd with crowdface plan --force first");
  }
  const LogBuffer memory;  // buffers messages: the crowd's log is opened only after casting
  StageSeconds stages;
  const Job job = timed(stages, "read", load);
  if (options.dry_run) {
    check_output(job, options.replace);
    if (makes_faces(job.config, options)) {
      refuse_too_little_memory(job.config, job.inputs, memory_for(options));
    }
    return log_dry_run(job.config, &job.inputs);
  }
  retry_if_truncated([&] { run_job(job, options, Purpose::kGenerate, memory, stages); });
}

/// With `--force`, sets the override that applies the reviews in the crowd's folder even if this
/// folder holds the crowd of another config.
ConfigOverrides include_kept_reviews(ConfigOverrides overrides, const GenerateOptions& options) {
  overrides.keep_reviews_of_other_configs = options.replace == Replace::kForce;
  return overrides;
}

Job job_for(const fs::path& config_file, const ConfigOverrides& overrides,
            const GenerateOptions& options) {
  return load_job(config_file, include_kept_reviews(overrides, options), options.cache);
}

Job job_for(const Config& config, const GenerateOptions& options) {
  return load_job(config, options.cache, include_kept_reviews({}, options));
}

void plan_job(const Job& job, const GenerateOptions& options) {
  check_output(job, options.replace);
  if (options.dry_run) return log_dry_run(job.config, nullptr);
  retry_if_truncated([&] {
    const CrowdDirectory directory = crowd_directory_of(job.config);
    StageSeconds stages;
    const auto crowd = cast_job(job, options, stages);
    const CrowdLock lock(directory, {});
    prepare_output_folder(job, options.replace);
    write_plan(job, directory, crowd->crowd_plan, crowd->casting, crowd->neck_colours(job),
               [](const fs::path& path, const TextPieces& text) { return write_file(path, text); });
    lock.require_same_folder();
    log_info(concat(crowd->crowd_plan.crowd.size(), " recipes in ", directory.plan().string()));
  });
}

}  // namespace

void generate(const fs::path& config_file, const ConfigOverrides& overrides,
              const GenerateOptions& options) {
  generate_loaded([&] { return job_for(config_file, overrides, options); }, options);
}

void generate(const Config& config, const GenerateOptions& options) {
  generate_loaded([&] { return job_for(config, options); }, options);
}

void gather(const fs::path& crowd_directory, const fs::path& cache) {
  const CrowdDirectory directory{crowd_directory};
  const LogBuffer memory;
  StageSeconds stages;
  const Job job = timed(stages, "read", [&] { return load_job(directory.config(), {}, cache); });
  GenerateOptions options;
  options.cache = cache;
  retry_if_truncated([&] { run_job(job, options, Purpose::kGather, memory, stages); });
}

void plan(const fs::path& config_file, const ConfigOverrides& overrides,
          const GenerateOptions& options) {
  plan_job(job_for(config_file, overrides, options), options);
}

void plan(const Config& config, const GenerateOptions& options) {
  plan_job(job_for(config, options), options);
}

}  // namespace crowdface
