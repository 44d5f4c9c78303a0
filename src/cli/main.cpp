// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <iostream>
#include <new>
#include <sstream>
#include <string>
#include <system_error>
#include <vector>

#include <CLI/CLI.hpp>
#include <fcntl.h>
#include <unistd.h>

#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/instruction_set.h"
#include "crowdface/core/interrupt.h"
#include "crowdface/core/log.h"
#include "crowdface/core/memory.h"
#include "crowdface/core/text.h"
#include "crowdface/core/version.h"
#include "crowdface/io/project_library.h"

#include "cli/commands.h"

namespace crowdface::cli {
namespace {

constexpr const char* kDescription =
    "Crowds of believable faces from a handful of scanned heads.\n"
    "\n"
    "To make a first crowd:\n"
    "  crowdface synth -o heads --count 8 --vertices 20000 --seed 1\n"
    "  crowdface init heads                 # writes a commented config: crowd.yaml\n"
    "  crowdface check crowd.yaml           # reports all problems\n"
    "  crowdface generate crowd.yaml        # meshes, renders, contact sheets, report";

constexpr const char* kFooter =
    "Exit codes: 0 done, 3 constraints cannot be met, 64 usage or config, 65 bad data,\n"
    "66 input missing, 70 a bug, 73/74 output failed, 75 interrupted (run again to continue).\n"
    "`crowdface COMMAND --help` explains a command; docs/config.md explains every config key.";

constexpr const char* kLack =
    "the system cannot provide more threads, memory or open files; use fewer threads (--threads): ";

/// Returns whether an exception reports a lack of system resources. Compares the message text: if
/// TBB cannot start a thread, only the text of TBB's exception names the cause.
bool is_lack_of_resources(const std::exception& error) {
  const std::string_view what = error.what();
  for (const std::errc lack : {std::errc::resource_unavailable_try_again,
                               std::errc::not_enough_memory, std::errc::too_many_files_open}) {
    if (what.find(std::make_error_code(lack).message()) != what.npos) return true;
  }
  return false;
}

constexpr const char* kOutOfMemory = "out of memory; use fewer threads (--threads)";

/// Logs an error and returns the exit code. If an allocation has failed, also logs that memory ran
/// out, because a library may report a failed allocation as an invalid file.
int fail(ExitCode code, std::string_view message) {
  log_error(message);
  if (!is_out_of_memory()) return static_cast<int>(code);
  if (message != kOutOfMemory) log_error(kOutOfMemory);
  return static_cast<int>(ExitCode::kIoError);
}

/// Runs a command and returns the exit code. Only this function translates exceptions to messages
/// and exit codes.
int run(const CommandAction& command) {
  try {
    command();
    if (is_out_of_memory()) throw std::bad_alloc();
    if (const auto failed = first_log_file_error()) {
      throw IoError(concat("the log is incomplete: ", *failed));
    }
    if (!std::cout.flush()) throw IoError("standard output: writing failed");
    return static_cast<int>(ExitCode::kDone);
  } catch (const RecoverableError& error) {
    return fail(error.code(), error.what());
  } catch (const std::filesystem::filesystem_error& error) {
    return fail(ExitCode::kIoError, error.what());
  } catch (const std::system_error& error) {
    return fail(ExitCode::kIoError, concat(kLack, error.what()));
  } catch (const std::bad_alloc&) {
    return fail(ExitCode::kIoError, kOutOfMemory);
  } catch (const std::exception& error) {
    if (is_lack_of_resources(error)) {
      return fail(ExitCode::kIoError, concat(kLack, error.what()));
    }
    return fail(ExitCode::kBug, concat("internal error, please report it: ", error.what()));
  }
}

/// The terminate handler: reports exceptions that cannot be caught, such as running out of memory
/// in a destructor or in a thread of a library.
[[noreturn]] void end_at_once() {
  std::string_view text =
      "error: out of memory; run the same command again with fewer threads (--threads)\n";
  auto code = ExitCode::kIoError;
  try {
    if (const auto error = std::current_exception()) std::rethrow_exception(error);
  } catch (const std::bad_alloc&) {
  } catch (...) {
    text = "error: internal error, please report it\n";
    code = ExitCode::kBug;
  }
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, text.data(), text.size());
  ::_exit(static_cast<int>(code));
}

/// Throws an error that names an unknown command. Without this function, CLI11 would only report
/// that a command is required.
void refuse_unknown_command(const CLI::App& program, int argc, const char* const* argv) {
  if (argc < 2 || argv[1][0] == '-') return;
  std::vector<std::string> names;
  for (const CLI::App* command : program.get_subcommands({})) names.push_back(command->get_name());
  if (std::ranges::find(names, argv[1]) != names.end()) return;
  const auto nearest = nearest_word(argv[1], names);
  throw UsageError(concat("unknown command ", quoted(argv[1]),
                          nearest ? concat("; did you mean ", *nearest, "?")
                                  : concat("; expected one of ", join(names))));
}

/// Refuses two kinds of option values that CLI11 accepts. Empty values, such as `--shard "$PART"`
/// if PART is not set, are probably mistakes. A file name with line breaks could imitate a log
/// message.
void refuse_senseless_values(const CLI::App& program) {
  for (const CLI::App* command : program.get_subcommands()) {
    for (const CLI::Option* option : command->get_options()) {
      for (const std::string& value : option->results()) {
        if (value.empty()) {
          throw UsageError(concat(option->get_name(), ": expected a value, found an empty one"));
        }
        if (value.find_first_of("\r\n") != value.npos) {
          throw UsageError(
              concat(option->get_name(), ": expected a single line, found ", quoted(value)));
        }
      }
    }
  }
}

/// Opens /dev/null for each standard stream that is closed. Otherwise the next opened file would
/// get the number of this stream, and messages would be written into the file.
void open_standard_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(stream, F_GETFD) != -1) continue;
    // open() returns the lowest free file descriptor, which is `stream`. A closed standard output
    // gets a descriptor that is only for reading, so that writing to standard output still fails.
    if (::open("/dev/null", stream == STDOUT_FILENO ? O_RDONLY : O_RDWR) < 0) return;
  }
}

int run_program(int argc, char** argv) {
  std::set_terminate(end_at_once);
  open_standard_streams();
  // Ignore these signals, so that exceeding the file size limit or writing to a closed pipe is
  // reported as a write error.
  std::signal(SIGXFSZ, SIG_IGN);
  std::signal(SIGPIPE, SIG_IGN);
  // Limit OpenBLAS, which the image library may load, to one thread. OpenBLAS raises SIGINT if it
  // cannot start its threads, and crowdface does not need these threads.
  ::setenv("OPENBLAS_NUM_THREADS", "1", 0);  // NOLINT(concurrency-mt-unsafe): before any thread
  watch_for_out_of_memory();
  watch_mapped_files();
  handle_crashes_during_library_loading();
  CLI::App program(kDescription, "crowdface");
  program.footer(kFooter);
  program.set_version_flag("--version", std::string("crowdface ") + kVersion);
  program.require_subcommand(1);
  CommandAction chosen;
  for (CommandAction (*add)(CLI::App&) :
       {add_generate, add_check,      add_convert, add_init,   add_mask,   add_plan,
        add_prepare,  add_blend,      add_smooth,  add_gather, add_verify, add_sheet,
        add_synth,    add_import,     add_cache,   add_wrap,   add_edit,   add_submit,
        add_status,   add_completion, add_manual}) {
    const std::size_t before = program.get_subcommands({}).size();
    CommandAction command = add(program);
    program.get_subcommands({})[before]->final_callback(
        [&chosen, command = std::move(command)] { chosen = command; });
  }
  if (const int code = run([&] { refuse_unknown_command(program, argc, argv); }); code != 0) {
    return code;
  }
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    // CLI11 also throws for --help and --version, which are not errors.
    std::ostringstream out, problem;
    const bool failed = program.exit(error, out, problem) != 0;
    std::cout << out.str();
    std::cerr << printable(problem.str());
    return failed ? static_cast<int>(ExitCode::kUsage) : run([] {});
  }
  if (const int code = run([&] { refuse_senseless_values(program); }); code != 0) return code;
  catch_interrupts();
  return run([&] {
    if (const char* set =
            std::getenv("CROWDFACE_INSTRUCTION_SET")) {  // NOLINT(concurrency-mt-unsafe): at start
      use_instruction_set(set);
    }
    chosen();
  });
}

}  // namespace
}  // namespace crowdface::cli

int main(int argc, char** argv) {
  return crowdface::cli::run_program(argc, argv);
}
