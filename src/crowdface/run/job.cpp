// SPDX-License-Identifier: Apache-2.0
#include "crowdface/run/job.h"

#include <algorithm>
#include <functional>

#include "crowdface/config/config_difference.h"
#include "crowdface/config/input_files.h"
#include "crowdface/core/file.h"
#include "crowdface/core/log.h"
#include "crowdface/core/text.h"
#include "crowdface/heads/load_inputs.h"
#include "crowdface/heads/settings_digest.h"
#include "crowdface/pictures/face_comparison.h"
#include "crowdface/pictures/sheets.h"
#include "crowdface/smooth/level_size.h"

namespace crowdface {
namespace {

/// Converts `value`, one end of a smoothness distribution's range, to a number of smoothing
/// iterations.
double level_of(double value, SmoothnessDistribution::Unit unit, const SmoothingLevelScale& scale) {
  switch (unit) {
    case SmoothnessDistribution::Unit::kFraction:
      return static_cast<double>(iterations_of(value, scale));
    case SmoothnessDistribution::Unit::kSize:
      return value > 0 ? static_cast<double>(iterations_for_wavelength(scale.operator_kind, value,
                                                                       scale.edge_length_mm))
                       : 0;
    case SmoothnessDistribution::Unit::kIterations:
      break;
  }
  return value;
}

/// Adds a problem if a smoothness exceeds `inputs.max_level` (L_max), the maximum number of
/// smoothing iterations. This maximum is known only after the heads are read.
void check_smoothness(const SmoothnessDistribution& distribution, const std::string& where,
                      const Config& config, const Inputs& inputs, Problems& problems) {
  const SmoothingLevelScale scale = level_scale(config, inputs);
  const double high = distribution.range.high;
  const double level = level_of(high, distribution.unit, scale);
  std::string asked = concat(level, " iterations");
  if (distribution.unit == SmoothnessDistribution::Unit::kSize) {
    asked = concat("a size of ", high, " mm, which is ", asked);
  }
  if (level > static_cast<double>(inputs.max_level)) {
    problems.add(ExitCode::kUsage,
                 concat(config.file.string(), ": ", where, ": expected at most ", inputs.max_level,
                        " iterations (smoothing.max_size or max_iterations), found ", asked));
  }
}

/// Checks that each band begins at fewer smoothing iterations than the previous band, for all
/// values that casting can sample. Otherwise adds a problem.
/// \param where  prefix of the config keys in messages
void check_sampling(const SamplingOptions& sampling, const std::string& where, const Config& config,
                    const Inputs& inputs, Problems& problems) {
  const SmoothingLevelScale scale = level_scale(config, inputs);
  const auto names = config.region_names();
  for (std::size_t k = 0; k < names.size(); ++k) {
    check_smoothness(sampling.regions[k].smoothness, concat(where, "smoothness (", names[k], ')'),
                     config, inputs, problems);
  }
  for (std::size_t k = 0; k < names.size(); ++k) {
    SmoothnessDistribution before;
    for (std::size_t b = 0; b < sampling.bands.size(); ++b) {
      const SmoothnessDistribution& own = smoothness_of(sampling, k, b);
      const std::string here = concat(where, "bands.", sampling.bands[b].name, " (", names[k], ')');
      check_smoothness(own, here, config, inputs, problems);
      const double least = level_of(before.range.low, before.unit, scale);
      const double most = level_of(own.range.high, own.unit, scale);
      if (b > 0 && most > least) {
        problems.add(ExitCode::kUsage,
                     concat(config.file.string(), ": ", here, ": begins at up to ", most,
                            " iterations, but the band before it may end at ", least,
                            "; expected bands from coarse to fine whose ranges do not overlap"));
      }
      before = own;
    }
  }
}

/// Returns a warning about each band without detail. A band contains the detail that smoothing with
/// its number of iterations removes, down to the next finer band. So a band has no detail if its
/// number of iterations is 0 in every region.
std::vector<std::string> empty_bands(const SamplingOptions& sampling, const Config& config,
                                     const Inputs& inputs) {
  std::vector<std::string> warnings;
  const SmoothingLevelScale scale = level_scale(config, inputs);
  const double finest = wavelength_of_iterations(scale.operator_kind, 1, scale.edge_length_mm);
  for (std::size_t b = 1; b < sampling.bands.size(); ++b) {
    double most = 0;
    for (std::size_t k = 0; k < sampling.regions.size(); ++k) {
      const SmoothnessDistribution& own = smoothness_of(sampling, k, b);
      most = std::max(most, level_of(own.range.high, own.unit, scale));
    }
    if (most > 0) continue;
    warnings.push_back(
        concat("sampling.bands.", sampling.bands[b].name,
               " begins at 0 iterations and holds no detail: one iteration on edges of ",
               format_fixed(scale.edge_length_mm, 2), " mm corresponds to a size of ",
               format_fixed(finest, 1), " mm"));
  }
  return warnings;
}

void check_levels(const Config& config, const Inputs& inputs, Problems& problems) {
  check_sampling(*config.sampling, "sampling.", config, inputs, problems);
  for (const Group& group : config.groups) {
    check_sampling(group.sampling, concat("group ", group.name, ", "), config, inputs, problems);
  }
  for (const ManualRecipe& recipe : config.recipes) {
    const std::string where = concat("recipe ", recipe.id);
    for (const ManualRecipe::Region& region : recipe.regions) {
      if (region.smoothness) check_smoothness(*region.smoothness, where, config, inputs, problems);
      for (const ManualRecipe::Band& band : region.bands) {
        if (band.smoothness) check_smoothness(*band.smoothness, where, config, inputs, problems);
      }
    }
  }
}

/// Crowds with more faces than this use numbered subfolders, unless the config sets
/// output.faces_per_folder.
constexpr std::uint64_t kMaxInOneFolder = 10'000;
constexpr std::uint64_t kFacesPerFolder = 1'000;

/// Copies the minimum distances of the existing faces from the folder's config.yaml, so that these
/// faces do not change if the config has a smaller `min_distance`.
/// \return the config with these distances; unchanged if there are no existing faces.
Config with_kept_distances(Config config, const std::string& before) {
  DiversityOptions& diversity = *config.diversity;
  const auto kept = distances_in_config(before);
  const auto count = number_in_config(before, "crowd.count");
  const bool is_own = !diversity.min_distance_mm_up_to_face.empty() && kept &&
                      diversity.min_distance_mm_up_to_face != kept->min_distance_mm_up_to_face;
  if (!kept || !count || is_own || diversity.min_distance_mm > kept->min_distance_mm) return config;
  diversity.min_distance_mm_up_to_face = kept->min_distance_mm_up_to_face;
  if (diversity.min_distance_mm < kept->min_distance_mm) {
    diversity.min_distance_mm_up_to_face[*count] = kept->min_distance_mm;
  }
  return config;
}

/// Completes a config with facts about the crowd that exists in the output folder: the number of
/// existing faces, the smallest allowed distances between faces with which these faces were cast,
/// and the number of faces in each numbered subfolder. If there is no such crowd, a large crowd
/// gets numbered subfolders.
/// \param replaced  whether the run casts the crowd again (`--force`).
void continue_crowd(Config& config, bool replaced) {
  const CrowdDirectory directory{config.output.directory};
  const std::string before =
      path_exists(directory.config()) ? read_file(directory.config()) : std::string();
  Config continued = replaced ? config : with_kept_distances(config, before);
  const bool is_same =
      !before.empty() &&
      config_differences(before, effective_config(continued, directory.root)).empty();
  if (is_same) {
    config = std::move(continued);
    if (!replaced) config.crowd.existing_face_count = number_in_config(before, "crowd.count");
  }
  if (config.output.faces_per_folder) return;
  if (is_same) {
    config.output.faces_per_folder = number_in_config(before, "output.faces_per_folder");
  } else if (face_count(config) > kMaxInOneFolder) {
    config.output.faces_per_folder = kFacesPerFolder;
  }
}

using ReadConfig = std::function<ConfigReading(const ConfigOverrides&, Problems&)>;

/// Reads the config. Also reads the review files that the crowd's folder keeps, if the folder holds
/// the crowd of this config or if `overrides` asks for these review files.
ConfigReading read_with_kept_reviews(const ReadConfig& read, ConfigOverrides overrides,
                                     Problems& problems) {
  ConfigReading reading = read(overrides, problems);
  if (reading.is_complete) continue_crowd(reading.config, overrides.keep_reviews_of_other_configs);
  const CrowdDirectory directory{reading.config.output.directory};
  const std::vector<std::filesystem::path> kept = directory.stored_reviews();
  if (!reading.is_complete || kept.empty()) return reading;
  const auto read_again = [&] {
    reading = read(overrides, problems);
    if (reading.is_complete)
      continue_crowd(reading.config, overrides.keep_reviews_of_other_configs);
  };
  if (overrides.without_reviews) {
    overrides.ignored_reviews_folder = directory.reviews();
    read_again();
    reading.config.review.ignores_stored_reviews = true;
    return reading;
  }
  std::vector<std::string> differences;
  if (path_exists(directory.config())) {
    const std::string before = read_file(directory.config());
    differences = config_differences(before, effective_config(reading.config, directory.root));
    overrides.former_face_count = number_in_config(before, "crowd.count");
    const auto distances = distances_in_config(before);
    const double now = reading.config.diversity->min_distance_mm;
    if (distances && distances->min_distance_mm != now &&
        !overrides.keep_reviews_of_other_configs) {
      overrides.former_min_distance_mm = distances->min_distance_mm;
    }
  }
  if (!differences.empty() && !overrides.keep_reviews_of_other_configs) {
    log_warning(concat(directory.root.string(), ": keeps reviews of another config's crowd (it ",
                       "differs in ", join(differences), "), which are not applied"));
    return reading;
  }
  overrides.stored_reviews = kept;
  read_again();
  if (!differences.empty() && !reading.is_complete) {
    problems.add(ExitCode::kUsage,
                 concat(directory.reviews().string(), ": --force applies the reviews of the crowd ",
                        "that it replaces; to start without them, use --without-reviews"));
  }
  return reading;
}

/// Adds a problem for each new review whose `after` is larger than the number of earlier reviews.
/// Does not check reviews that are already in the crowd's folder, because an older version may have
/// accepted them.
void check_reviews(const Config& config, Problems& problems) {
  const Config::Reviews& reviews = config.review;
  const auto kept = CrowdDirectory{config.output.directory}.stored_reviews();
  for (std::size_t i = kept.size(); i < reviews.reviews.size(); ++i) {
    const std::uint64_t after = reviews.reviews[i].review_count_seen_by_reviewer.value_or(0);
    if (after <= i) continue;
    problems.add(ExitCode::kUsage, concat(reviews.files[i].string(), ": after: expected at most ",
                                          i, ", the number of earlier reviews, found ", after));
  }
}

std::optional<Job> load_read_job(const ReadConfig& read, const ConfigOverrides& overrides,
                                 const CacheFolder& cache, Problems& problems) {
  ConfigReading reading = read_with_kept_reviews(read, overrides, problems);
  if (!reading.is_complete) {
    check_inputs(reading, cache, problems);
    return std::nullopt;
  }
  Config& config = reading.config;
  for (const std::string& text : reading.warnings) log_warning(text);
  check_paths(config, problems);
  check_reviews(config, problems);
  std::optional<Inputs> inputs = load_inputs(config, cache, problems);
  if (!inputs) return std::nullopt;
  check_levels(config, *inputs, problems);
  for (std::string& text : empty_bands(*config.sampling, config, *inputs)) {
    log_warning(text);
    inputs->warnings.push_back(std::move(text));
  }
  check_compared_mesh(config, *inputs, problems);
  if (!problems.empty()) return std::nullopt;
  const SmoothingOperator smoothing(inputs->adjacency, config.smoothing.boundary,
                                    config.smoothing.operator_kind);
  const PlanNames names = config.plan_names();
  const Digest settings = settings_digest(config, *inputs);
  return Job{std::move(config), std::move(*inputs), smoothing, names, settings};
}

}  // namespace

std::optional<Job> load_job(const std::filesystem::path& config_file,
                            const ConfigOverrides& overrides, const CacheFolder& cache,
                            Problems& problems) {
  return load_read_job([&](const ConfigOverrides& more,
                           Problems& out) { return read_partial_config(config_file, more, out); },
                       overrides, cache, problems);
}

Job load_job(const Config& config, const CacheFolder& cache, const ConfigOverrides& overrides) {
  const std::filesystem::path file = config.file.empty() ? "config" : config.file;
  const std::string text = effective_config(config, std::filesystem::absolute(file).parent_path());
  Problems problems;
  std::optional<Job> job = load_read_job(
      [&](const ConfigOverrides& more, Problems& out) {
        return read_config_text(text, std::filesystem::absolute(file), more, out);
      },
      overrides, cache, problems);
  problems.throw_if_any();
  return std::move(*job);
}

Job load_job(const std::filesystem::path& config_file, const ConfigOverrides& overrides,
             const CacheFolder& cache) {
  Problems problems;
  std::optional<Job> job = load_job(config_file, overrides, cache, problems);
  problems.throw_if_any();
  return std::move(*job);
}

std::uint64_t face_count(const Config& config) {
  std::uint64_t faces = config.crowd.count + config.recipes.size();
  for (const FamilyOptions& family : config.families) {
    faces += static_cast<std::uint64_t>(family.member_count);
    for (const Parent& parent : family.parents) faces += parent.is_new ? 1U : 0U;
  }
  return faces;
}

CrowdDirectory crowd_directory_of(const Config& config) {
  return {config.output.directory, config.output.faces_per_folder.value_or(0)};
}

std::string stored_config_text(Config config, const CrowdDirectory& directory) {
  for (std::size_t i = 0; i < config.review.files.size(); ++i) {
    config.review.files[i] = directory.review(i + 1);
  }
  return effective_config(config, directory.root);
}

CrowdConfig crowd_config(const Config& config, const CrowdDirectory& directory) {
  std::string text = stored_config_text(config, directory);
  return {text, config.review.texts,
          [text](const std::string& other) { return config_differences(other, text); },
          config.review.original_texts, config.review.ignores_stored_reviews};
}

SmoothingLevelScale level_scale(const Config& config, const Inputs& inputs) {
  return {config.smoothing.operator_kind, inputs.max_level, inputs.edge_length_mm};
}

}  // namespace crowdface
