// SPDX-License-Identifier: Apache-2.0
#include "crowdface/editor/edit.h"

#include <memory>
#include <mutex>

#include <fcntl.h>

#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/file_descriptor.h"
#include "crowdface/core/file_lock.h"
#include "crowdface/core/interrupt.h"
#include "crowdface/core/text.h"
#include "crowdface/editor/edit_api.h"

namespace crowdface {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& folder,
                         const std::filesystem::path& address) {
  std::string where = "its address is not known yet";
  try {
    where = read_file(address);
    // The address file cannot be read: it belongs to another user, or the other editor has just
    // started and has not written its address yet.
  } catch (const RecoverableError&) {
  }
  throw UsageError(concat(folder.parent_path().string(),
                          ": another crowdface edit is already running here: ", where));
}

/// Holds the exclusive right to edit a crowd during the lifetime of this object. The lock applies
/// to all machines that share the file system, and ends when the process is killed.
class EditorLock {
 public:
  /// Takes the lock.
  /// \param folder  folder for the lock file and for the file with the editor's address; must
  ///                exist. Only the user who started the editor can read the address file.
  /// \throws UsageError with the address of the other editor if there is one.
  explicit EditorLock(const std::filesystem::path& folder)
      : address_(folder / ".address"),
        lock_(folder / ".editor.lock", LockKind::kExclusive, [&] { refuse(folder, address_); }) {}
  ~EditorLock() { remove_if_exists(address_); }

  /// Writes the editor's address into the address file. If another editor is started while the lock
  /// is held, its error message contains this address.
  /// \throws CannotCreate
  void write_address(const std::string& address) {
    remove_if_exists(address_);
    constexpr mode_t kOwnerOnly = 0600;
    FileDescriptor file(
        ::open(address_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, kOwnerOnly));
    if (!file.valid() || !write_all(file.get(), address) || !file.close()) {
      throw CannotCreate(concat(address_.string(), ": cannot be written: ", errno_message()));
    }
  }

 private:
  std::filesystem::path address_;
  FileLock lock_;
};

/// Returns the arguments of the `generate` run that makes the faces of the opened job. The
/// arguments include the overrides that the editor was started with.
std::vector<std::string> generate_arguments(const Config& config, const ConfigOverrides& overrides,
                                            const EditOptions& options) {
  std::vector<std::string> arguments = {"generate", config.file.string(), "--cache",
                                        options.cache.path.string()};
  arguments.insert(arguments.end(), options.generate_arguments.begin(),
                   options.generate_arguments.end());
  const auto add = [&](const char* option, const std::optional<std::string>& value) {
    if (value) arguments.insert(arguments.end(), {option, *value});
  };
  for (const std::string& assignment : overrides.assignments) add("--set", assignment);
  add("--count", overrides.count);
  add("--seed", overrides.seed);
  add("--out", config.output.directory.string());
  return arguments;
}

/// A job with the config and crowd as read when the job was opened, and the objects that answer
/// requests about this job.
struct OpenedJob {
  OpenedJob(Job job, const EditOptions& options, EditedFolder& folder, GenerateRun& run,
            bool may_edit_config, std::function<void()> reload_job)
      : session(std::move(job), options.cache, options.preview_vertices),
        api(session, folder, run, may_edit_config, std::move(reload_job)) {}
  EditSession session;
  EditApi api;
};

}  // namespace

void edit(const std::filesystem::path& config_or_crowd, const ConfigOverrides& overrides,
          const EditOptions& options, const std::function<void(const std::string&)>& started) {
  Job job = load_edited_job(config_or_crowd, overrides, options.cache);
  const std::filesystem::path path = make_edited_folder(job.config);
  EditorLock lock(path);
  EditedFolder folder(path);
  const bool is_crowd = is_folder(config_or_crowd);
  GenerateRun run(generate_arguments(job.config, overrides, options), path / "generate.log");

  std::mutex opening, answering;
  std::shared_ptr<OpenedJob>
      opened;  // guarded by `answering`; a running request keeps its job alive
  std::function<void()> reload_job;
  const auto open = [&](Job next) {
    auto made =
        std::make_shared<OpenedJob>(std::move(next), options, folder, run, !is_crowd, reload_job);
    const std::lock_guard its(answering);
    opened = std::move(made);
  };
  reload_job = [&] {
    const std::lock_guard one(opening);
    open(load_edited_job(config_or_crowd, overrides, options.cache));
  };
  open(std::move(job));
  const auto now_opened = [&] {
    const std::lock_guard its(answering);
    return opened;
  };
  LocalServer server([&](const HttpRequest& request) { return now_opened()->api.answer(request); },
                     options.port);
  lock.write_address(server.address());
  started(server.address());
  server.run(is_interrupted);
}

}  // namespace crowdface
