// SPDX-License-Identifier: Apache-2.0
#include "crowdface/run/task_scripts.h"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "crowdface/core/file.h"
#include "crowdface/core/text.h"
#include "crowdface/run/mesh_encoder.h"
#include "crowdface/run/mesh_judge.h"

namespace crowdface {
namespace {

/// Quotes a text as one word for the shell.
std::string shell_word(std::string_view text) {
  std::string word = "'";
  for (const char c : text) {
    if (c == '\'') {
      word += R"('\'')";
    } else {
      word += c;
    }
  }
  return word + "'";
}

std::string shell_words(const std::vector<std::string>& words) {
  std::vector<std::string> quoted_words;
  for (const std::string& word : words) quoted_words.push_back(shell_word(word));
  return join(quoted_words, " ");
}

std::string assign(std::string_view name, std::string_view value) {
  return concat(name, '=', shell_word(value), '\n');
}

/// Estimated processor time for one face, in seconds, computed from measured times per byte, vertex
/// and pixel.
double face_seconds(const Config& config, const Inputs& inputs) {
  constexpr double kByte = 3.3e-9, kBlendVertex = 5e-8, kJudgeVertex = 3.6e-6;
  constexpr double kPixel = 6.5e-7, kPictureVertex = 6e-8;
  const auto vertices = static_cast<double>(inputs.head_set.topology.vertex_count);
  double seconds = kByte * static_cast<double>(estimate_mesh_bytes(inputs, config.output.meshes)) +
                   kBlendVertex * vertices;
  if (skin_is_judged(config, inputs)) seconds += kJudgeVertex * vertices;
  if (const auto& sheet = config.output.contact_sheet) {
    const double pixels = static_cast<double>(sheet->cell) * sheet->cell;
    seconds +=
        static_cast<double>(sheet->views.size()) * (kPixel * pixels + kPictureVertex * vertices);
  }
  return seconds;
}

/// Returns the smallest number of tasks, 1 … `most`, with which each task takes at most
/// `seconds_per_task`.
std::uint64_t tasks_for(double seconds, double seconds_per_task, std::uint64_t most) {
  const double tasks = std::min(std::ceil(seconds / seconds_per_task), static_cast<double>(most));
  return std::max<std::uint64_t>(static_cast<std::uint64_t>(tasks), 1);
}

std::filesystem::path script_of(const TaskJob& job) {
  return job.directory.cluster_task_folder() / "task.sh";
}

constexpr std::string_view kTask = R"sh(
stage=$1 number=${2:-${SLURM_ARRAY_TASK_ID:-1}}
attempt=$((${SLURM_RESTART_COUNT:-0} + 1))
mkdir -p "$folder/log"
# Slurm writes what the task says there itself.
[ -n "${SLURM_JOB_ID-}" ] || exec >>"$folder/log/$stage-$number.log" 2>&1
echo "=== $stage $number, attempt $attempt, on ${SLURMD_NODENAME:-$(hostname)}, $(date -u +%FT%TZ)"

# The machine's own copy of the prepared heads; where it cannot be made, the shared ones do.
copy_cache() {
  local own entry
  own=$(eval "printf %s \"$scratch\"")/crowdface-cache-$(id -u)
  mkdir -p "$own" || return
  {
    flock 9 || return
    for entry in "$cache"/*.cf*; do
      [ -e "$entry" ] && [ ! -e "$own/${entry##*/}" ] || continue
      cp "$entry" "$own/.copy" && mv "$own/.copy" "$own/${entry##*/}" || { rm -f "$own/.copy"; return 1; }
    done
  } 9>"$own/.lock" || return
  cache=$own
}
if [ -n "$scratch" ] && [ "$stage" != prepare ]; then
  copy_cache || echo "warning: $scratch cannot take the prepared heads; the shared ones are used"
fi

case $stage in
  prepare) command=(prepare "${config[@]}" --shard "$number/$prepares") ;;
  plan) command=(plan "${config[@]}") ;;
  blend) command=(generate "${config[@]}" --planned --shard "$number/$shards") ;;
  gather) command=(gather "$directory") ;;
  *) echo "error: no stage $stage"; exit 64 ;;
esac
case $stage in plan | blend) command+=("${memory[@]}") ;; esac

"$program" "${command[@]}" "${limits[@]}" --cache "$cache" --threads "$processors" &
child=$!
trap 'kill -TERM $child 2>/dev/null' TERM INT HUP
wait $child
code=$?
while kill -0 $child 2>/dev/null; do
  wait $child
  code=$?
done
echo "=== ended with code $code"

# Interrupted: as often as it takes, where an attempt goes on from the last. Killed, or what a disk or a
# machine may be to blame for: twice more.
case $code in
  75) case $stage in plan | gather) most=5 ;; *) most=100 ;; esac ;;
  73 | 74) most=3 ;;
  *) [ $code -gt 128 ] && most=3 || most=0 ;;
esac
if [ -n "${SLURM_JOB_ID-}" ] && [ $attempt -lt $most ]; then
  task=${SLURM_ARRAY_JOB_ID:-$SLURM_JOB_ID}${SLURM_ARRAY_TASK_ID:+_$SLURM_ARRAY_TASK_ID}
  # One that was cancelled stays so.
  if scontrol show job -o "$task" | grep -q 'JobState=RUNNING'; then
    # Before the request, because Slurm ends this script at once.
    echo "=== requeued"
    scontrol requeue "$task" || echo "=== ended with code $code"
  fi
fi
exit $code
)sh";

constexpr std::string_view kSlurm = R"sh(
command -v sbatch >/dev/null || { echo "sbatch is not on the path: no Slurm here" >&2; exit 66; }
submitted=() complete=
# All stages or none.
trap '[ -n "$complete" ] || scancel "${submitted[@]}" 2>/dev/null' EXIT
# add NAME DEPENDENCY ARGUMENT …: submits a stage, leaves its id in `id`
add() {
  local stage=$1 after=$2
  shift 2
  id=$(sbatch "${common[@]}" --job-name="$crowd-$stage" ${after:+--dependency=afterany:$after} "$@" \
    "$folder/task.sh" "$stage") || exit 74
  id=${id%%;*}
  submitted+=("$id")
  echo "$stage $id"
}
mkdir -p "$folder/log"
log=${folder//%/%%}/log
add prepare '' --array=1-"$prepares" --output="$log/prepare-%a.log"
add plan "$id" --output="$log/plan-1.log"
# Whatever became of those before: a shard without a plan ends at once, and gathering says what is missing.
add blend "$id" --array=1-"$shards" --output="$log/blend-%a.log"
add gather "$id" --output="$log/gather-1.log"
complete=yes
)sh";

constexpr std::string_view kParallel = R"sh(
command -v parallel >/dev/null || { echo "parallel is not on the path" >&2; exit 66; }
# side_by_side STAGE COUNT: each of its tasks up to five times, on another machine if there is one
side_by_side() {
  seq "$2" | parallel --will-cite --jobs 1 "${hosts[@]}" --retries 5 "${more[@]}" \
    --joblog "$folder/log/$1.joblog" "$task" "$1" {}
}
# here STAGE: on this machine
here() {
  local code=0
  bash "$folder/task.sh" "$1" 1 || code=$?
  [ $code -eq 0 ] || { grep 'error: ' "$folder/log/$1-1.log" | tail -n 1 >&2; exit $code; }
}
mkdir -p "$folder/log"
# Whatever becomes of a task: planning prepares what is missing, and gathering says which faces are.
side_by_side prepare "$prepares" || true
here plan
side_by_side blend "$shards" || true
here gather
)sh";

constexpr std::string_view kHead = R"sh(#!/usr/bin/env bash
# Written by crowdface submit; docs/farm.md explains it.
)sh";

std::string task_script(const TaskJob& job) {
  std::string script(kHead);
  script += "# task.sh STAGE NUMBER: one task of the crowd, on the machine that it is started on\n";
  script += "set -uo pipefail\n";
  script += assign("folder", job.directory.cluster_task_folder().string());
  script += assign("directory", job.directory.root.string());
  script += assign("program", job.program.string());
  script += concat("config=(", shell_words(job.config_arguments), ")\n");
  script += concat("limits=(", shell_words(job.input_limit_arguments), ")\n");
  script += assign("cache", job.cache.string());
  script += assign("scratch", job.scratch_folder);
  script += concat("prepares=", job.prepare_task_count, " shards=", job.shard_count,
                   " processors=", job.processor_count, "\n");
  // Give crowdface seven eighths of the task's memory, and leave the rest to other processes.
  const std::string memory =
      job.memory_bytes == 0 ? "" : concat("--memory '", job.memory_bytes / 8 * 7 / 1024, " KiB'");
  script += concat("memory=(", memory, ")\n");
  return script + std::string(kTask);
}

std::string slurm_script(const TaskJob& job, const JobEngineOptions& options) {
  std::vector<std::string> common = {"--parsable", "--requeue", "--open-mode=append",
                                     concat("--signal=B:TERM@", options.grace_seconds),
                                     concat("--cpus-per-task=", job.processor_count)};
  if (!options.partition.empty()) common.push_back("--partition=" + options.partition);
  if (!options.time_limit.empty()) common.push_back("--time=" + options.time_limit);
  if (job.memory_bytes > 0)
    common.push_back(concat("--mem=", (job.memory_bytes + (1U << 20U) - 1) >> 20U, "M"));
  common.insert(common.end(), options.extra_arguments.begin(), options.extra_arguments.end());
  std::string script(kHead);
  script += "set -euo pipefail\n";
  script += assign("folder", job.directory.cluster_task_folder().string()) +
            assign("crowd", job.crowd_name);
  script += concat("prepares=", job.prepare_task_count, " shards=", job.shard_count, "\n");
  script += concat("common=(", shell_words(common), ")\n");
  return script + std::string(kSlurm);
}

std::string parallel_script(const TaskJob& job, const JobEngineOptions& options) {
  std::string script(kHead);
  script += "set -euo pipefail\n";
  script += assign("folder", job.directory.cluster_task_folder().string());
  // Assign the shell command that runs a task. The command is the same on every machine.
  script += assign("task", "bash " + shell_word(script_of(job).string()));
  script += concat("prepares=", job.prepare_task_count, " shards=", job.shard_count, "\n");
  script += concat(
      "hosts=(", options.hosts.empty() ? "" : "--sshlogin " + shell_word(join(options.hosts, ",")),
      ")\nmore=(", shell_words(options.extra_arguments), ")\n");
  return script + std::string(kParallel);
}

}  // namespace

std::uint64_t suitable_shard_count(const Config& config, const Inputs& inputs, std::uint64_t faces,
                                   std::uint64_t processor_count) {
  constexpr double kSeconds = 600;
  constexpr std::uint64_t kMax = 1000;  // default limit of Slurm's job arrays
  const double all = face_seconds(config, inputs) * static_cast<double>(faces);
  return tasks_for(all / static_cast<double>(processor_count), kSeconds, std::min(kMax, faces));
}

std::uint64_t suitable_prepare_task_count(const Inputs& inputs, std::uint64_t processor_count) {
  constexpr double kSeconds = 60, kVertex = 1.1e-5;
  const std::uint64_t heads = inputs.head_set.heads.size();
  const double all = kVertex * static_cast<double>(inputs.head_set.topology.vertex_count) *
                     static_cast<double>(heads);
  return tasks_for(all / static_cast<double>(processor_count), kSeconds, heads);
}

std::string_view name_of(JobEngine engine) {
  return engine == JobEngine::kSlurm ? "slurm" : "parallel";
}

std::filesystem::path write_task_scripts(const TaskJob& job, JobEngine engine,
                                         const JobEngineOptions& options) {
  const std::filesystem::path folder = job.directory.cluster_task_folder();
  refuse_link_out_of_crowd(job.directory, folder);
  refuse_link_out_of_crowd(job.directory, folder / "log");
  make_directories(folder / "log");
  write_file(script_of(job), task_script(job));
  const nlohmann::ordered_json notes = {{"engine", name_of(engine)},
                                        {"prepares", job.prepare_task_count},
                                        {"shards", job.shard_count},
                                        {"processors", job.processor_count}};
  write_file(folder / "job.json", notes.dump() + "\n");
  write_file(folder / "submit.sh", engine == JobEngine::kSlurm ? slurm_script(job, options)
                                                               : parallel_script(job, options));
  return folder / "submit.sh";
}

}  // namespace crowdface
