// SPDX-License-Identifier: Apache-2.0
#include "crowdface/editor/edit.h"

#include <chrono>
#include <memory>
#include <mutex>

#include "crowdface/core/file.h"
#include "crowdface/core/interrupt.h"
#include "crowdface/editor/edit_api.h"
#include "crowdface/editor/edit_benchmark.h"
#include "crowdface/editor/editor_lock.h"

namespace crowdface {
namespace {

/// A crowd's folder stands for the config in it, whose faces go there.
Job load_edited_job(const std::filesystem::path& given, ConfigOverrides overrides,
                    const std::filesystem::path& cache) {
  if (!is_folder(given)) return load_job(given, overrides, cache);
  if (!overrides.out) overrides.out = given.string();
  return load_job(CrowdDirectory{given}.config(), overrides, cache);
}

/// The command that makes the faces of the job as it was opened.
std::vector<std::string> generate_arguments(const Config& config, const ConfigOverrides& overrides,
                                            const std::filesystem::path& cache) {
  std::vector<std::string> arguments = {"generate", config.file.string(), "--cache",
                                        cache.string()};
  const auto add = [&](const char* option, const std::optional<std::string>& value) {
    if (value) arguments.insert(arguments.end(), {option, *value});
  };
  for (const std::string& assignment : overrides.set) add("--set", assignment);
  add("--count", overrides.count);
  add("--seed", overrides.seed);
  add("--out", config.output.directory.string());
  return arguments;
}

/// A job as it stood when it was opened, and what answers for it.
struct OpenedJob {
  OpenedJob(Job job, const EditOptions& options, const std::filesystem::path& path, MarkLines marks,
            GenerateRun& run, bool may_edit_config, std::function<void()> open_again)
      : session(std::move(job), options.cache, options.preview_vertices),
        folder(session.job(), path, std::move(marks)),
        api(session, folder, run, may_edit_config, std::move(open_again)) {}
  EditSession session;
  EditedFolder folder;
  EditApi api;
};

}  // namespace

std::string benchmark_edit(const std::filesystem::path& given, const ConfigOverrides& overrides,
                           const EditOptions& options) {
  const auto begin = std::chrono::steady_clock::now();
  const EditSession session(load_edited_job(given, overrides, options.cache), options.cache,
                            options.preview_vertices);
  const std::chrono::duration<double> opened = std::chrono::steady_clock::now() - begin;
  return edit_benchmark(session, opened.count());
}

void edit(const std::filesystem::path& given, const ConfigOverrides& overrides,
          const EditOptions& options, const std::function<void(const std::string&)>& started) {
  Job job = load_edited_job(given, overrides, options.cache);
  const std::filesystem::path path = make_edited_folder(job.config);
  EditorLock lock(path);
  const bool is_crowd = is_folder(given);
  GenerateRun run(generate_arguments(job.config, overrides, options.cache), path / "generate.log");

  std::mutex opening, answering;
  std::shared_ptr<OpenedJob>
      opened;  // under `answering`; requests to an older one are answered to the end
  const auto now_opened = [&] {
    const std::lock_guard its(answering);
    return opened;
  };
  std::function<void()> open_again;
  const auto open = [&](Job next) {
    const auto before = now_opened();
    auto made = std::make_shared<OpenedJob>(std::move(next), options, path,
                                            before ? before->folder.marks() : MarkLines(), run,
                                            !is_crowd, open_again);
    const std::lock_guard its(answering);
    opened = std::move(made);
  };
  open_again = [&] {
    const std::lock_guard one(opening);
    open(load_edited_job(given, overrides, options.cache));
  };
  open(std::move(job));
  LocalServer server([&](const HttpRequest& request) { return now_opened()->api.answer(request); },
                     options.port);
  lock.tell(server.address());
  started(server.address());
  server.run(interrupted);
}

}  // namespace crowdface
