// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

// CLI11 is included by command_line.cpp and main.cpp only: each file that includes it compiles all of it.
namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace crowdface::cli {

/// An option, an argument or a flag of a command, so that more can be asked of it.
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

/// An option with a value, "-o,--output", or an argument, "config". A default that stands in `value`
/// is shown. \param type  "DIR", what help calls the value.
AddedOption add_option(CLI::App& command, const std::string& name, std::string& value,
                       const std::string& type, const std::string& help);

/// An option whose value is handed to `take`, where it was given.
AddedOption add_option(CLI::App& command, const std::string& name,
                       const std::function<void(const std::string&)>& take, const std::string& type,
                       const std::string& help);

/// An option whose value is kept only if it was given.
AddedOption add_optional(CLI::App& command, const std::string& name,
                         std::optional<std::string>& value, const std::string& type,
                         const std::string& help);

/// An option that may be repeated; its values come one after the other.
AddedOption add_repeated(CLI::App& command, const std::string& name,
                         std::vector<std::string>& values, const std::string& type,
                         const std::string& help);

}  // namespace crowdface::cli
