// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

// Declarations of CLI11 classes. Only command_line.cpp and main.cpp include the headers of CLI11,
// because these headers are slow to compile.
namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace crowdface::cli {

/// A handle to an option, argument or flag that was added to a command. Callers use the handle to
/// set further properties.
class OptionHandle {
 public:
  explicit OptionHandle(CLI::Option& option) : option_(&option) {}
  /// Reports an error if the user does not give the option.
  OptionHandle required() const;
  /// Accepts only these words as values.
  OptionHandle one_of(const std::vector<std::string>& words) const;
  /// Shows this text in the help as the default value.
  OptionHandle show_default(const std::string& text) const;
  /// Reports an error if this option is given without the option `other`.
  OptionHandle needs(const std::string& other) const;
  /// Reports an error if this option is given together with one of the options `others`.
  OptionHandle excludes(const std::vector<std::string>& others) const;

 private:
  CLI::Option* option_;
};

/// Adds a command to the program, and returns it, so that options can be added to it.
/// \param description  for the help.
CLI::App& add_subcommand(CLI::App& program, const char* name, const char* description);

/// Adds an option without a value. `value` becomes true if the user gives the option.
OptionHandle add_flag(CLI::App& command, const std::string& name, bool& value,
                      const std::string& help);

/// Adds an option with a value or a positional argument. The help shows the initial content of
/// `value` as the default.
/// \param name  such as "-o,--output" for an option, "config" for a positional argument.
/// \param type  name of the value in the help, such as "DIR".
OptionHandle add_option(CLI::App& command, const std::string& name, std::string& value,
                        const std::string& type, const std::string& help);

/// Adds an option. If the user gives the option, calls `take` with the option's value.
OptionHandle add_option(CLI::App& command, const std::string& name,
                        const std::function<void(const std::string&)>& take,
                        const std::string& type, const std::string& help);

/// Adds an option that stores its value in `value`. If the user does not give the option, `value`
/// stays empty.
OptionHandle add_optional(CLI::App& command, const std::string& name,
                          std::optional<std::string>& value, const std::string& type,
                          const std::string& help);

/// Adds an option that the user may give several times. `values` receives all values in the order
/// of the command line.
OptionHandle add_repeated(CLI::App& command, const std::string& name,
                          std::vector<std::string>& values, const std::string& type,
                          const std::string& help);

}  // namespace crowdface::cli
