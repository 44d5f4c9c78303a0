// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

// Only command_line.cpp and main.cpp include CLI11, because this header-only library is slow to
// compile.
namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace crowdface::cli {

/// Sets further properties of an option, argument or flag that was added to a command.
class AddedOption {
 public:
  explicit AddedOption(CLI::Option& option) : option_(&option) {}
  AddedOption required() const;
  AddedOption one_of(const std::vector<std::string>& words) const;
  AddedOption shown_default(const std::string& text) const;
  AddedOption needs(const std::string& other) const;
  AddedOption excludes(const std::vector<std::string>& others) const;

 private:
  CLI::Option* option_;
};

CLI::App& add_subcommand(CLI::App& program, const char* name, const char* description);

AddedOption add_flag(CLI::App& command, const std::string& name, bool& value,
                     const std::string& help);

/// Adds an option with a value, "-o,--output", or an argument, "config". The help shows the initial
/// content of `value` as the default. \param type  name of the value in the help, such as "DIR".
AddedOption add_option(CLI::App& command, const std::string& name, std::string& value,
                       const std::string& type, const std::string& help);

/// Adds an option; if the user gives the option, `take` receives its value.
AddedOption add_option(CLI::App& command, const std::string& name,
                       const std::function<void(const std::string&)>& take, const std::string& type,
                       const std::string& help);

/// Adds an option; if the user does not give the option, `value` stays empty.
AddedOption add_optional(CLI::App& command, const std::string& name,
                         std::optional<std::string>& value, const std::string& type,
                         const std::string& help);

/// Adds an option that may be repeated; `values` receives all values in order.
AddedOption add_repeated(CLI::App& command, const std::string& name,
                         std::vector<std::string>& values, const std::string& type,
                         const std::string& help);

}  // namespace crowdface::cli
