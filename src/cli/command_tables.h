// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}  // namespace CLI

namespace crowdface::cli {

/// An option, flag or argument of a command, as the help shows it.
struct OptionDescription {
  std::vector<std::string> names;  ///< "-o", "--output"; for an argument its name, "config"
  std::string type;                ///< name of the value, "DIR"; empty for a flag
  std::vector<std::string> accepted_values;  ///< empty: any value
  std::string default_value;                 ///< may be empty
  std::string help;
  bool argument = false, required = false, repeated = false;
};

struct CommandDescription {
  std::string name, help;
  std::vector<OptionDescription> options;
};

/// The complete description of the program's command line.
struct ProgramDescription : CommandDescription {
  std::string footer;
  std::vector<CommandDescription> commands;
};

/// Reads from the CLI11 parser the description of all commands and options.
ProgramDescription describe_program(const CLI::App& program);

}  // namespace crowdface::cli
