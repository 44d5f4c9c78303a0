// SPDX-License-Identifier: Apache-2.0
#include "crowdface/editor/edit.h"

#include <chrono>
#include <system_error>

#include "crowdface/core/interrupt.h"
#include "crowdface/editor/edit_api.h"
#include "crowdface/editor/edit_benchmark.h"
#include "crowdface/editor/editor_lock.h"

namespace crowdface {
namespace {

/// A crowd's folder stands for the config in it, whose faces go there.
Job load_edited_job(const std::filesystem::path& given, ConfigOverrides overrides,
                    const std::filesystem::path& cache) {
  std::error_code ignored;
  if (!std::filesystem::is_directory(given, ignored)) return load_job(given, overrides, cache);
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
  EditSession session(std::move(job), options.cache, options.preview_vertices);
  EditedFolder folder(session.job(), path);
  std::error_code ignored;
  GenerateRun run(generate_arguments(session.job().config, overrides, options.cache),
                  path / "generate.log");
  EditApi api(session, folder, run, !std::filesystem::is_directory(given, ignored));
  LocalServer server([&](const HttpRequest& request) { return api.answer(request); }, options.port);
  lock.tell(server.address());
  started(server.address());
  server.run(interrupted);
}

}  // namespace crowdface
