// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}  // namespace CLI

namespace crowdface::cli {

/// An option, flag or argument of a command, as the help shows it.
struct OptionTable {
  std::vector<std::string> names;  ///< "-o", "--output"; for an argument its name, "config"
  std::string type;                ///< name of the value, "DIR"; empty for a flag
  std::vector<std::string> words;  ///< the accepted values; empty: any
  std::string initial;             ///< default value; may be empty
  std::string help;
  bool argument = false, required = false, repeated = false;
};

struct CommandTable {
  std::string name, help;
  std::vector<OptionTable> options;
};

/// The complete description of the program's command line.
struct ProgramTable : CommandTable {
  std::string footer;
  std::vector<CommandTable> commands;
};

/// Reads from the CLI11 parser the description of all commands and options.
ProgramTable tables_of(const CLI::App& program);

}  // namespace crowdface::cli
