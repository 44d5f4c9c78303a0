// SPDX-License-Identifier: Apache-2.0
#include "crowdface/job/generate.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <utility>

#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/interrupt.h"
#include "crowdface/core/log.h"
#include "crowdface/core/memory.h"
#include "crowdface/core/parallel.h"
#include "crowdface/core/progress.h"
#include "crowdface/core/text.h"
#include "crowdface/io/material_files.h"
#include "crowdface/job/config_writer.h"
#include "crowdface/job/crowd_renders.h"
#include "crowdface/job/face_stages.h"
#include "crowdface/job/mesh_writers.h"
#include "crowdface/job/pipeline.h"
#include "crowdface/job/report.h"

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

/// \throws UsageError if a head lies where this run writes meshes and removes those of an old
/// crowd.
void refuse_to_write_over_heads(const Job& job, const CrowdDirectory& directory) {
  const fs::path meshes = fs::weakly_canonical(directory.meshes());
  for (const fs::path& head : job.config.faces.files) {
    if (fs::weakly_canonical(head).parent_path() == meshes) {
      throw UsageError(concat(directory.root.string(), ": the head ", head.string(),
                              " lies among the meshes of this crowd; choose another folder with "
                              "--out"));
    }
  }
}

void open_directory(const Job& job, const CrowdDirectory& directory, Replace replace) {
  refuse_to_write_over_heads(job, directory);
  open_crowd_directory(directory, effective_config(job.config, directory.root), replace);
}

void write_plan(const Job& job, const CrowdDirectory& directory, const std::vector<Recipe>& crowd) {
  write_file(directory.plan(), format_plan(job, crowd));
  write_file(directory.table(), format_csv(crowd, job.names));
}

/// Copies material files and textures of all heads that are targets. \return warnings, each once
/// with the heads it is about.
std::vector<std::string> copy_materials(const Job& job, const CrowdDirectory& directory,
                                        const std::vector<Recipe>& crowd) {
  std::set<Index> targets;
  for (const Recipe& recipe : crowd) targets.insert(recipe.target);
  std::map<std::string, std::vector<std::string>> heads_of_warning;
  std::map<fs::path, Digest> copied;
  for (const Index target : targets) {
    const ObjFile& file = job.inputs.files[static_cast<std::size_t>(target)];
    const std::string& head = job.names.heads[static_cast<std::size_t>(target)];
    MaterialFiles found = find_material_files(file.path, file.material_libraries);
    for (const std::string& warning : found.warnings) heads_of_warning[warning].push_back(head);
    for (const MaterialFile& material : found.files) {
      const MappedFile bytes(material.from);
      const Digest digest = hash_bytes(bytes.bytes());
      const auto [known, is_new] = copied.emplace(material.relative, digest);
      if (is_new) {
        const fs::path to = directory.meshes() / material.relative;
        make_directories(to.parent_path());
        write_file(to, bytes.bytes());
      } else if (known->second != digest) {
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

std::vector<std::string> ids_of(const std::vector<Recipe>& crowd) {
  std::vector<std::string> ids;
  for (const Recipe& recipe : crowd) ids.push_back(recipe.id);
  return ids;
}

std::string sheet_title(const Config& config, std::size_t faces) {
  return concat(config.crowd.name, " · ", faces, faces == 1 ? " face" : " faces", " · seed ",
                config.crowd.seed);
}

void tell_dry_run(const Job& job) {
  const Config& config = job.config;
  const std::uint64_t faces = config.crowd.count + config.recipes.size();
  const std::uint64_t bytes = faces * estimate_mesh_bytes(job.inputs, config.output.meshes);
  log_info(concat("dry run: ", faces, " faces of ", job.inputs.faces.topology.vertex_count,
                  " vertices, about ", format_fixed(static_cast<double>(bytes) / 1e6, 1),
                  " MB of meshes, ", config.output.contact_sheet ? faces : 0, " renders into ",
                  config.output.directory.string(), "; nothing was written"));
}

/// Everything after the inputs are checked and the folder is ready.
void fill_directory(const Job& job, const CrowdDirectory& directory, const GenerateOptions& options,
                    StageSeconds& stages) {
  const Prepared prepared = timed(stages, "prepare", [&] {
    return prepare(job.config, job.inputs, job.smoothing, options.cache);
  });
  const Cast crowd_cast = timed(stages, "cast", [&] { return cast(job, prepared); });
  const std::vector<Recipe>& crowd = crowd_cast.crowd;
  write_plan(job, directory, crowd);

  std::vector<std::string> warnings = job.inputs.warnings;
  const auto& formats = job.config.output.meshes;
  if (std::find(formats.begin(), formats.end(), MeshFormat::kObj) != formats.end()) {
    for (std::string& text : copy_materials(job, directory, crowd)) {
      warnings.push_back(std::move(text));
    }
  }
  const auto& sheet = job.config.output.contact_sheet;
  std::unique_ptr<CrowdRenders> renders;
  if (sheet) renders = std::make_unique<CrowdRenders>(job.config, *sheet, job.inputs);
  const BuiltFaces built = timed(stages, "build", [&] {
    const std::uint64_t memory = options.memory > 0 ? options.memory : machine_memory() / 4 * 3;
    return build_faces(job, prepared, directory, renders.get(), crowd, memory);
  });
  std::size_t pages = 0;
  if (sheet && !crowd.empty()) {
    pages = timed(stages, "sheets", [&] {
      return write_sheets(
          directory, *sheet, sheet_title(job.config, crowd.size()), ids_of(crowd),
          [&](std::size_t i) { return read_render(directory.render(crowd[i].id)); });
    });
  }
  write_file(directory.report(),
             format_report(job, prepared, crowd_cast, built.files, pages, warnings));
  write_file(directory.timings(),
             format_timings(stages, built.busy, crowd.size(), prepared.from_cache));
  log_info(concat(crowd.size(), crowd.size() == 1 ? " face" : " faces", " in ",
                  directory.root.string(),
                  pages > 0 ? concat("; contact sheet: ", directory.sheet(1).string()) : ""));
}

}  // namespace

void generate(const fs::path& config_file, const ConfigOverrides& overrides,
              const GenerateOptions& options) {
  StageSeconds stages;
  const Job job = timed(stages, "read", [&] { return load_job(config_file, overrides); });
  if (options.dry_run) return tell_dry_run(job);
  const CrowdDirectory directory{job.config.output.directory};
  open_directory(job, directory, options.replace);
  const CrowdLog log(directory.log());
  // Said before there was a folder for the log; at this level they reach the file alone.
  for (const std::string& warning : job.inputs.warnings) log_debug(warning);
  try {
    fill_directory(job, directory, options, stages);
  } catch (const std::exception& error) {
    log_debug(error.what());  // `main` says it aloud, when this log is closed
    throw;
  }
}

void plan(const fs::path& config_file, const ConfigOverrides& overrides,
          const GenerateOptions& options) {
  const Job job = load_job(config_file, overrides);
  if (options.dry_run) return tell_dry_run(job);
  const CrowdDirectory directory{job.config.output.directory};
  open_directory(job, directory, options.replace);
  const Prepared prepared = prepare(job.config, job.inputs, job.smoothing, options.cache);
  const Cast crowd_cast = cast(job, prepared);
  write_plan(job, directory, crowd_cast.crowd);
  log_info(concat(crowd_cast.crowd.size(), " recipes in ", directory.plan().string()));
}

void remake_sheets(const fs::path& crowd_directory, const std::vector<std::string>& set) {
  const CrowdDirectory directory{crowd_directory};
  ConfigOverrides overrides;
  overrides.set = set;
  const Job job = load_job(directory.config(), overrides);
  if (!job.config.output.contact_sheet) {
    throw UsageError(concat(directory.config().string(),
                            ": this crowd has no contact sheet; ask for one with --set "
                            "output.contact_sheet='{columns: 6}'"));
  }
  std::vector<std::string> ids;
  for (const PlanLine& line : read_plan(directory.plan(), job.names)) ids.push_back(line.recipe.id);
  const Config::ContactSheet& sheet = *job.config.output.contact_sheet;
  const CrowdRenders renders(job.config, sheet, job.inputs);
  const std::size_t pages =
      write_sheets(directory, sheet, sheet_title(job.config, ids.size()), ids, [&](std::size_t i) {
        return renders.render(read_face(directory, ids[i], job.config.output.meshes,
                                        job.inputs.faces.topology.vertex_count));
      });
  log_info(concat(pages, pages == 1 ? " sheet" : " sheets", " in ", directory.sheets().string()));
}

}  // namespace crowdface
