// SPDX-License-Identifier: Apache-2.0
#include "crowdface/run/output_check.h"

#include <system_error>

#include "crowdface/config/input_files.h"
#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/file_descriptor.h"
#include "crowdface/core/folder.h"
#include "crowdface/core/text.h"
#include "crowdface/io/shallow_json.h"
#include "crowdface/run/report.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;

/// \throws UsageError if this run would overwrite or delete one of the files that it reads.
void refuse_to_write_over_inputs(const Config& config, const CrowdDirectory& directory) {
  const auto& sheet = config.output.contact_sheet;
  for (const fs::path& input : input_files(config)) {
    // The mesh with which the sheets compare faces may be a file of this crowd.
    if (sheet && input == sheet->compare.file) continue;
    for (const fs::path& folder : {directory.meshes(), directory.renders(), directory.sheets()}) {
      if (!is_inside_folder(input, folder)) continue;
      throw UsageError(
          concat(directory.root.string(), ": the input ", input.string(),
                 " is in a folder that this crowd writes to; choose another folder with --out"));
    }
  }
}

/// \throws UsageError if the crowd's config.yaml would overwrite the user's config file, for
///         example with `output.directory: .`.
void refuse_to_write_over_config(const Config& config, const CrowdDirectory& directory) {
  std::error_code error;
  const bool is_same = fs::equivalent(config.file, directory.config(), error);
  throw_if_system_error(directory.config(), error);
  if (!is_same) return;
  if (path_exists(directory.plan())) return;  // the config belongs to a crowd
  if (read_file(config.file) == stored_config_text(config, directory)) return;
  throw UsageError(concat(config.file.string(),
                          ": the crowd's own config would overwrite this file; choose another "
                          "folder with --out, or rename the file"));
}

}  // namespace

void refuse_other_heads(const Digest& settings, const CrowdDirectory& directory, Replace replace) {
  if (replace == Replace::kForce || !path_exists(directory.plan())) return;
  const MappedFile file(directory.plan());
  const std::string_view plan = file.bytes();
  // Search the whole plan, because the first lines of a damaged plan may lack the hash.
  if (plan.find(settings.hex()) != plan.npos) return;
  const auto first = parse_shallow_json(plan.substr(0, plan.find('\n')));
  if (!first.is_object() || !first.contains("settings")) return;
  throw UsageError(
      concat(directory.root.string(),
             ": holds a crowd that was made with other heads or masks, or with another version of "
             "crowdface (\"settings\" in its plan.jsonl); choose another folder with --out, or "
             "replace it with --force (before shards: crowdface plan --force)"));
}

void refuse_other_inputs(const Inputs& inputs, const CrowdDirectory& directory) {
  if (!path_exists(directory.report())) return;
  const auto report = read_report_summary(directory.report());
  if (!report.is_object() || !report.contains("inputs")) return;
  const auto& recorded = report["inputs"];
  std::vector<std::string> changed;
  for (const auto& [name, digest] : digests_without_heads_and_masks(inputs)) {
    if (recorded.contains(name) && recorded[name] != digest.hex()) changed.push_back(name);
  }
  if (changed.empty()) return;
  throw UsageError(
      concat(directory.root.string(), ": its faces were made with other ", join(changed),
             " (\"inputs\" in its report.json); run crowdface generate to make them again"));
}

void check_output(const Job& job, Replace replace) {
  const CrowdDirectory directory = crowd_directory_of(job.config);
  refuse_to_write_over_inputs(job.config, directory);
  refuse_to_write_over_config(job.config, directory);
  check_crowd_directory(directory, crowd_config(job.config, directory), replace);
  refuse_other_heads(job.settings, directory, replace);
}

void prepare_output_folder(const Job& job, Replace replace) {
  const CrowdDirectory directory = crowd_directory_of(job.config);
  refuse_other_heads(job.settings, directory, replace);
  open_crowd_directory(directory, crowd_config(job.config, directory), replace);
}

}  // namespace crowdface
