// SPDX-License-Identifier: Apache-2.0
#include "crowdface/crowd/verify.h"

#include "crowdface/core/error.h"
#include "crowdface/core/text.h"

#include "cli/commands.h"
#include "cli/common_options.h"

namespace crowdface::cli {
namespace {

void tell(const char* what, const std::vector<std::string>& names) {
  for (const std::string& name : names) print(concat(what, name, "\n"));
}

std::string count(std::size_t number, const char* what) {
  return concat(number, ' ', what);
}

struct VerifyOptions : CommonOptions {
  std::string directory;
};

void declare_verify(CLI::App& command, VerifyOptions& options) {
  add_option(command, "directory", options.directory, "CROWD_DIR", "The crowd's folder").required();
}

void verify(const VerifyOptions& options) {
  const CrowdCheck check = verify_crowd(options.directory);
  tell("missing: ", check.missing_files);
  tell("altered: ", check.altered_files);
  tell("not finished: ", check.unfinished_items);
  tell("", check.remarks);
  if (!check.is_intact()) {
    throw InvalidInput(concat(options.directory, ": ", check.file_count,
                              " files expected: ", count(check.missing_files.size(), "missing, "),
                              count(check.altered_files.size(), "altered, "),
                              count(check.unfinished_items.size(), "not finished"),
                              check.remarks.empty() ? "" : "; " + join(check.remarks, "; "),
                              "; to repair the crowd, run crowdface generate with its config"));
  }
  print(concat(options.directory, ": all ", check.file_count, " files are unchanged\n"));
}

}  // namespace

CommandAction add_verify(CLI::App& program) {
  return add_command(program, "verify",
                     "Check a finished crowd against its ledger: find missing and altered files",
                     declare_verify, verify);
}

}  // namespace crowdface::cli
