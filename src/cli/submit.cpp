// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cerrno>
#include <filesystem>

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "crowdface/core/error.h"
#include "crowdface/core/log.h"
#include "crowdface/core/text.h"
#include "crowdface/run/job.h"
#include "crowdface/run/output_check.h"
#include "crowdface/run/task_scripts.h"

#include "cli/commands.h"
#include "cli/common_options.h"

namespace crowdface::cli {
namespace {

namespace fs = std::filesystem;

struct SubmitOptions : CommonOptions {
  ConfigOptions config;
  std::string engine = "slurm", shards, prepares, processors = "1", memory, scratch, program;
  std::string grace = "60";
  JobEngineOptions of_engine;
  bool print = false;
};

void declare_submit(CLI::App& command, SubmitOptions& options) {
  options.config.add_to(command);
  options.config.add_review_to(command);
  add_option(command, "--engine", options.engine, "NAME", "The engine: slurm or parallel");
  add_option(command, "--shards", options.shards, "N",
             "Number of tasks that make faces (default: about ten minutes per task)");
  add_option(command, "--prepare-tasks", options.prepares, "N",
             "Number of tasks that prepare heads (default: about one minute per task)");
  add_option(command, "--processors", options.processors, "N", "Processors per task");
  add_option(command, "--memory", options.memory, "SIZE",
             "Memory per task, such as \"8 GiB\" (default: set by the engine)");
  add_option(command, "--partition", options.of_engine.partition, "NAME", "The Slurm partition");
  add_option(command, "--time", options.of_engine.time_limit, "TIME",
             "Time limit of a task in a Slurm format, such as 2:00:00");
  add_option(command, "--grace", options.grace, "SECONDS",
             "Seconds before the time limit at which a task is told to stop");
  add_option(command, "--scratch", options.scratch, "DIR",
             "A local folder on each machine, to which tasks copy the prepared heads; each machine "
             "expands variables such as $TMPDIR");
  add_repeated(command, "--host", options.of_engine.hosts, "HOST",
               "With --engine parallel: a machine that runs tasks, reached by ssh");
  add_repeated(command, "--engine-option", options.of_engine.extra_arguments, "OPTION",
               "Pass this option to sbatch or parallel, such as --engine-option=--account=films");
  add_option(command, "--program", options.program, "FILE",
             "The path of crowdface on the machines (default: this program)");
  add_flag(command, "--print", options.print, "Write the scripts, but submit nothing");
}

fs::path full_path(const fs::path& path) {
  return fs::absolute(path).lexically_normal();
}

/// Returns the command-line arguments that name the config and its overrides. Paths are absolute,
/// so that the arguments are valid on every machine.
std::vector<std::string> config_arguments(const ConfigOptions& options, const fs::path& out) {
  std::vector<std::string> arguments = {full_path(options.config_file).string(), "--out",
                                        out.string()};
  const auto add = [&](const char* name, const std::string& value) {
    arguments.insert(arguments.end(), {name, value});
  };
  for (const std::string& value : options.overrides.assignments) add("--set", value);
  if (options.overrides.seed) add("--seed", *options.overrides.seed);
  if (options.overrides.count) add("--count", *options.overrides.count);
  for (const std::string& file : options.overrides.review)
    add("--review", full_path(file).string());
  return arguments;
}

JobEngine engine_from(const std::string& name) {
  for (const JobEngine engine : {JobEngine::kSlurm, JobEngine::kParallel}) {
    if (name == name_of(engine)) return engine;
  }
  throw UsageError(concat("--engine: expected slurm or parallel, found ", quoted(name)));
}

/// Checks the options.
/// \throws UsageError if a given option does not apply to the chosen job engine.
void refuse_inapplicable_options(const SubmitOptions& options, JobEngine engine) {
  const JobEngineOptions& of_engine = options.of_engine;
  const auto only_for = [&](const char* name, bool given, JobEngine wanted) {
    if (!given || engine == wanted) return;
    throw UsageError(concat(name, ": only --engine ", name_of(wanted), " supports this option"));
  };
  only_for("--partition", !of_engine.partition.empty(), JobEngine::kSlurm);
  only_for("--time", !of_engine.time_limit.empty(), JobEngine::kSlurm);
  only_for("--host", !of_engine.hosts.empty(), JobEngine::kParallel);
  if (of_engine.time_limit.find_first_not_of("0123456789:-") != std::string::npos) {
    throw UsageError(
        concat("--time: expected minutes, hours:minutes:seconds or another Slurm "
               "format, found ",
               quoted(of_engine.time_limit)));
  }
}

std::uint64_t count_from(std::string_view option, const std::string& text, std::uint64_t fitting) {
  constexpr std::uint64_t kMax = 9999;
  return text.empty() ? fitting : parse_whole_number(option, text, 1, kMax);
}

TaskJob tasks_of(const SubmitOptions& options, const Job& job) {
  constexpr std::uint64_t kMaxProcessors = 1024;
  TaskJob tasks;
  tasks.directory.root = full_path(job.config.output.directory);
  tasks.program =
      options.program.empty() ? fs::read_symlink("/proc/self/exe") : full_path(options.program);
  tasks.config_arguments = config_arguments(options.config, tasks.directory.root);
  tasks.input_limit_arguments = options.input_limit_arguments();
  tasks.crowd_name = job.config.crowd.name;
  tasks.cache = options.config.cache_folder.empty()
                    ? tasks.directory.cluster_task_folder() / "cache"
                    : full_path(options.config.cache_folder);
  tasks.scratch_folder = options.scratch;
  tasks.processor_count = parse_whole_number("--processors", options.processors, 1, kMaxProcessors);
  tasks.memory_bytes = parse_byte_size("--memory", options.memory);
  tasks.prepare_task_count =
      count_from("--prepare-tasks", options.prepares,
                 suitable_prepare_task_count(job.inputs, tasks.processor_count));
  tasks.shard_count = count_from(
      "--shards", options.shards,
      suitable_shard_count(job.config, job.inputs, face_count(job.config), tasks.processor_count));
  return tasks;
}

/// Runs a generated script, and waits until the script ends. If the script fails, throws an error
/// with the script's exit code and a message.
/// \param crowd  the crowd's folder, which the error message names.
void run_script(const fs::path& script, const fs::path& crowd) {
  std::string program = "bash", argument = script.string();
  std::array<char*, 3> arguments = {program.data(), argument.data(), nullptr};
  pid_t child = 0;
  if (const int error =
          ::posix_spawnp(&child, "bash", nullptr, nullptr, arguments.data(), environ)) {
    throw IoError(concat("cannot start bash: ", std::generic_category().message(error)));
  }
  int status = 0;
  while (::waitpid(child, &status, 0) < 0) {
    const int error = errno;
    if (error == EINTR) continue;
    throw IoError(concat("waiting for ", script.string(),
                         " failed: ", std::generic_category().message(error)));
  }
  const int code = WIFEXITED(status) ? WEXITSTATUS(status) : static_cast<int>(ExitCode::kIoError);
  if (code == 0) return;
  const bool is_ours = code == static_cast<int>(ExitCode::kUnsatisfiable) ||
                       (code >= static_cast<int>(ExitCode::kUsage) &&
                        code <= static_cast<int>(ExitCode::kInterrupted));
  throw RecoverableError(is_ours ? static_cast<ExitCode>(code) : ExitCode::kIoError,
                         concat(script.string(), ": ended with code ", code, "; crowdface status ",
                                crowd.string(), " shows the failed tasks"));
}

void submit(const SubmitOptions& options) {
  const JobEngine engine = engine_from(options.engine);
  refuse_inapplicable_options(options, engine);
  JobEngineOptions of_engine = options.of_engine;
  of_engine.grace_seconds = parse_whole_number("--grace", options.grace, 1, 65535);
  const Job job =
      load_job(options.config.config_file, options.config.overrides, options.config.cache_path());
  const TaskJob tasks = tasks_of(options, job);
  check_output(job, Replace::kRefuse);
  const fs::path file = write_task_scripts(tasks, engine, of_engine);
  log_info(concat(face_count(job.config), " faces; tasks: ", tasks.prepare_task_count,
                  " to prepare heads, 1 to ", "plan, ", tasks.shard_count,
                  " to make faces, 1 to gather; crowdface status ", tasks.directory.root.string(),
                  " shows their progress"));
  if (options.print) {
    print(concat(file.string(), "\n"));
  } else {
    run_script(file, tasks.directory.root);
  }
}

}  // namespace

CommandAction add_submit(CLI::App& program) {
  return add_command(program, "submit",
                     "Run the whole job as tasks on a farm: Slurm or GNU parallel", declare_submit,
                     submit);
}

}  // namespace crowdface::cli
