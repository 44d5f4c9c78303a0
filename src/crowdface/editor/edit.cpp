// SPDX-License-Identifier: Apache-2.0
#include "crowdface/editor/edit.h"

#include <system_error>

#include "crowdface/core/interrupt.h"
#include "crowdface/editor/edit_api.h"
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

}  // namespace

void edit(const std::filesystem::path& given, const ConfigOverrides& overrides,
          const EditOptions& options, const std::function<void(const std::string&)>& started) {
  Job job = load_edited_job(given, overrides, options.cache);
  const std::filesystem::path path = make_edited_folder(job.config);
  EditorLock lock(path);
  const EditSession session(std::move(job), options.cache, options.preview_vertices);
  EditedFolder folder(session.job(), path);
  std::error_code ignored;
  EditApi api(session, folder, !std::filesystem::is_directory(given, ignored));
  LocalServer server([&](const HttpRequest& request) { return api.answer(request); }, options.port);
  lock.tell(server.address());
  started(server.address());
  server.run(interrupted);
}

}  // namespace crowdface
