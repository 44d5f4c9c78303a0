// SPDX-License-Identifier: Apache-2.0

#include "crowdface/config/input_files.h"
#include "crowdface/core/error.h"
#include "crowdface/core/log.h"
#include "crowdface/core/output_file.h"
#include "crowdface/core/text.h"
#include "crowdface/heads/face_textures.h"
#include "crowdface/run/face_builder.h"
#include "crowdface/run/job.h"
#include "crowdface/run/write_face.h"

#include "cli/commands.h"
#include "cli/common_options.h"

namespace crowdface::cli {
namespace {

/// Reads one face from a plan. \param reference "FILE#ID": path of the plan and id of the face.
PlanLine find_recipe(const std::string& reference, const PlanNames& names) {
  const std::size_t hash = reference.rfind('#');
  if (hash == reference.npos || hash == 0 || hash + 1 == reference.size()) {
    throw UsageError(concat("--recipe: expected PLAN.jsonl#ID, found ", quoted(reference)));
  }
  const std::string file = reference.substr(0, hash), id = reference.substr(hash + 1);
  std::vector<std::string> ids;
  for (PlanLine& line : read_plan(file, names)) {
    if (line.face.id == id) return std::move(line);
    ids.push_back(line.face.id);
  }
  const auto nearest = nearest_word(id, ids);
  throw InvalidInput(concat(file, ": expected a recipe with the id ", quoted(id), ", found none",
                            nearest ? concat("; did you mean ", *nearest, "?") : ""));
}

/// Checks that the fitted smoothing levels of the heads suffice for a recipe.
/// \throws InvalidInput if the recipe needs more iterations than the fitted levels contain, which
/// is possible in a hand-edited plan.
void check_levels(const Recipe& recipe, const Job& job, const std::string& reference) {
  for (std::size_t k = 0; k < recipe.regions.size(); ++k) {
    if (recipe.regions[k].iterations <= job.inputs.max_level) continue;
    throw InvalidInput(concat(reference, ": ", job.names.regions[k], ": expected at most ",
                              job.inputs.max_level,
                              " iterations (smoothing.max_size or "
                              "max_iterations), found ",
                              recipe.regions[k].iterations));
  }
}

struct BlendOptions : CommonOptions {
  ConfigOptions config;
  std::string recipe, out;
  bool any_settings = false;
};

void declare_blend(CLI::App& command, BlendOptions& options) {
  options.config.add_to(command);
  add_option(command, "--recipe", options.recipe, "PLAN.jsonl#ID",
             "The plan file and the id of the face, joined by #")
      .required();
  add_mesh_output(command, options.out);
  add_flag(command, "--any-settings", options.any_settings,
           "Blend even if the heads, masks or smoothing differ from those of the plan");
}

void blend(const BlendOptions& options) {
  const MeshFormat format = parse_mesh_output(options.out);
  const std::filesystem::path file = checked_output_path(options.out);
  const Job job =
      load_job(options.config.config_file, options.config.overrides, options.config.cache_path());
  refuse_to_write_over(input_files(job.config), {file});
  const PlanLine line = find_recipe(options.recipe, job.names);
  if (line.settings_hash != job.settings.hex() && !options.any_settings) {
    throw InvalidInput(concat(options.recipe, ": planned with other settings: expected ",
                              job.settings.hex(), " (heads, masks and smoothing of ",
                              options.config.config_file, "), found ", line.settings_hash,
                              "; use --any-settings to blend the face anyway"));
  }
  if (job.config.smoothing.levels != LevelRepresentation::kExact)
    check_levels(line.face.recipe, job, options.recipe);
  PreparedHeads prepared;
  // The exact filter smooths the heads of the config. Only the fitted levels need prepared heads.
  if (job.config.smoothing.levels == LevelRepresentation::kExact) {
    prepared.filter.emplace(job.smoothing, job.inputs.head_set.heads.front().positions);
  } else {
    prepared = prepare(job.config, job.inputs, job.smoothing, options.config.cache_path());
  }
  const Positions positions = FaceBuilder(job.config, job.inputs, prepared).build(line.face.recipe);
  write_face(job, FaceTextures(job.config, job.inputs), line.face, format, positions, file);
  log_info(concat(line.face.id, " written to ", options.out));
}

}  // namespace

CommandAction add_blend(CLI::App& program) {
  return add_command(program, "blend", "Blend one face from its recipe in a plan", declare_blend,
                     blend);
}

}  // namespace crowdface::cli
