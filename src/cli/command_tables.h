// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}  // namespace CLI

namespace crowdface::cli {

/// The description of an option, flag or argument of a command, with the texts that the help shows.
struct OptionDescription {
  /// names of the option, such as "-o" and "--output"; for an argument, its name, such as "config"
  std::vector<std::string> names;
  std::string type;  ///< name of the value, such as "DIR"; empty for a flag
  /// The values that the option accepts; empty: any value.
  std::vector<std::string> accepted_values;
  std::string default_value;  ///< default value that the help shows; empty: the help shows none
  std::string help;           ///< what the option does
  /// is_argument: positional, without dashes; is_repeated: the user may give several values
  bool is_argument = false, is_required = false, is_repeated = false;
};

/// The description of a command, with the texts that the help shows.
struct CommandDescription {
  std::string name, help;
  std::vector<OptionDescription> options;
};

/// The complete description of the program's command line.
struct ProgramDescription : CommandDescription {
  std::string footer;  ///< text at the end of the help
  std::vector<CommandDescription> commands;
};

/// Returns the description of all commands and options that were added to the CLI11 parser.
ProgramDescription describe_program(const CLI::App& program);

}  // namespace crowdface::cli
